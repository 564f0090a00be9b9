//! The host in Rust: a typed crate with a struct for each message and a type for each board.
//!
//! In: a [`HostPlan`]. Out: files of a Cargo package. `names.rs` makes Rust names, `view.rs` puts the plan in Rust's
//! words, `runtime/` is hand-written and copied into the package; the library crates that it builds on are copied beside
//! it.
//!
//! # Example
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use sensedsl_host_rust::Rust;
//! use sensedsl_job::host::{Host as _, HostBoard, HostPlan};
//! use sensedsl_wire::{Direction, Item, ScalarType, Schema, ValueType};
//!
//! let light = Item {
//!     id: 17,
//!     name: "Light".to_owned(),
//!     direction: Direction::Sensor,
//!     value: ValueType::scalar(ScalarType::Uint16),
//! };
//! let rover = HostBoard {
//!     name: "Rover".to_owned(),
//!     schema: Schema { items: vec![light], ..Schema::default() },
//!     baud: 115_200,
//!     silence_ms: None,
//!     presentations: BTreeMap::new(),
//!     cycles_ms: BTreeMap::new(),
//! };
//! let files = Rust.render(&HostPlan::new("garden", &[rover]));
//! let library = files.get("src/lib.rs").unwrap();
//! assert!(str::from_utf8(&library.bytes).unwrap().contains("pub struct Light {"));
//! ```

mod names;
mod view;

use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};
use view::DesignView;

/// The host `rust`.
pub struct Rust;

templates! {
    design: DesignView;
    Library = "lib.rs.txt";
    Manifest = "Cargo.toml.txt";
    Lock = "Cargo.lock.txt";
    Monitor = "monitor.rs.txt";
    Asynchronous = "asynchronous.rs.txt";
    Readme = "README.md.txt";
}

/// The manifests of the library crates, whose sources are copied.
const WIRE_MANIFEST: &str = include_str!("sensedsl-wire.toml.txt");
const HOST_MANIFEST: &str = include_str!("sensedsl-host.toml.txt");

/// A file of `runtime/`.
macro_rules! runtime {
    ($($name:literal,)+) => {
        [$(($name, include_str!(concat!("../runtime/sensedsl/", $name))),)+]
    };
}

/// The hand-written modules.
const RUNTIME: [(&str, &str); 10] = runtime![
    "board.rs",
    "decode.rs",
    "health.rs",
    "link.rs",
    "message.rs",
    "mod.rs",
    "outcome.rs",
    "stream.rs",
    "values.rs",
    "wire.rs",
];

impl Host for Rust {
    fn name(&self) -> &'static str {
        "rust"
    }

    fn about(&self) -> About {
        About {
            language: "Rust 1.90",
            needs: "serialport",
            gives: "a typed crate whose decoder needs neither `std` nor an allocator; blocking, or for any executor",
        }
    }

    /// Each package is checked without its features, which needs no other crate.
    fn compile(&self) -> Compile {
        Compile {
            program: "cargo",
            arguments: &[
                "check",
                "--quiet",
                "--offline",
                "--no-default-features",
                "--manifest-path",
            ],
            extension: "toml",
            standard: "",
            tree: None,
        }
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = FileSet::default();
        files.add("Cargo.toml", print(&Manifest { design }));
        files.add("Cargo.lock", print(&Lock { design }));
        files.add("README.md", print(&Readme { design }));
        files.add("src/lib.rs", print(&Library { design }));
        files.add("examples/monitor.rs", print(&Monitor { design }));
        files.add("examples/asynchronous.rs", print(&Asynchronous { design }));
        for (name, text) in RUNTIME {
            files.add(format!("src/sensedsl/{name}"), text);
        }
        files.add("sensedsl-wire/Cargo.toml", WIRE_MANIFEST);
        for (name, text) in sensedsl_wire::sources::SOURCES {
            files.add(format!("sensedsl-wire/src/{name}"), *text);
        }
        files.add("sensedsl-host/Cargo.toml", HOST_MANIFEST);
        for (name, text) in sensedsl_host::sources::SOURCES {
            files.add(format!("sensedsl-host/src/{name}"), *text);
        }
        files
    }
}
