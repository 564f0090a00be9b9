//! The sources of this crate, for a generator that copies them into a project.

/// Path and text.
macro_rules! files {
    ($($path:literal,)*) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path))),)*]
    };
}

/// The files below `src` that are compiled without the feature `schema`: path and text.
pub const SOURCES: &[(&str, &str)] = files!["difference.rs", "lib.rs", "port.rs", "scale.rs",];
