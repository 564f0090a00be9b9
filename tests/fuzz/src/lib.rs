//! What the fuzz targets do: bytes in, a panic where something is wrong.
//!
//! One body a target, called by the fuzzer (`fuzz/`, run by `cargo xtask fuzz`) and by the test
//! `corpus`, which replays what the fuzzer found. The bytes are either the input itself (`text`,
//! `table`, the importers) or choices from which an input is made (`pipeline`, `certificate`,
//! `decoders`): see [`draw`].

pub mod certificate;
pub mod decoders;
pub mod design;
pub mod draw;
pub mod import;
pub mod pipeline;
pub mod reached;
pub mod table;
pub mod text;
pub mod truth;
pub mod workbook;

/// Something that is fuzzed.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, and that of its folder in `fuzz/corpus`.
    pub name: &'static str,
    /// What it does with an input.
    pub body: fn(&[u8]),
}

/// All targets.
pub const TARGETS: &[Target] = &[
    Target { name: "text", body: text::run },
    Target { name: "table", body: table::run },
    Target { name: "pipeline", body: pipeline::run },
    Target { name: "import_tabular", body: import::tabular },
    Target { name: "import_workbook", body: workbook::run },
    Target { name: "import_cubemx", body: import::cubemx },
    Target { name: "import_ioc", body: import::ioc },
    Target { name: "import_hwdef", body: import::hwdef },
    Target { name: "import_micropython", body: import::micropython },
    Target { name: "import_betaflight", body: import::betaflight },
    Target { name: "import_zephyr", body: import::zephyr },
    Target { name: "import_arduino", body: import::arduino },
    Target { name: "import_dbc", body: import::dbc },
    Target { name: "certificate", body: certificate::run },
    Target { name: "decoders", body: decoders::rust_alone },
];

/// The target of that name.
#[must_use]
pub fn target(name: &str) -> Option<Target> {
    TARGETS.iter().copied().find(|target| target.name == name)
}
