//! The sources of this crate, for a generator that copies them into a project.

/// Path and text.
macro_rules! files {
    ($($path:literal,)*) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path))),)*]
    };
}

/// All files below `src`: path and text.
pub const SOURCES: &[(&str, &str)] = files![
    "checksum.rs",
    "decode/candidate.rs",
    "decode/leap.rs",
    "decode/memo.rs",
    "decode/mod.rs",
    "decode/table.rs",
    "encode.rs",
    "frame.rs",
    "health.rs",
    "lib.rs",
    "scalar.rs",
    "schema.rs",
];
