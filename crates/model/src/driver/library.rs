//! The library of drivers that ships with the tool: the texts of `drivers/`, embedded, so that no file has to be found.

use std::sync::LazyLock;

use sensedsl_packed::Pack;

/// The files of `drivers/`. The build script packs them.
static FILES: Pack = Pack::new(include_bytes!(concat!(env!("OUT_DIR"), "/files.pack")));

/// The files of the library: name and text, in the order of their names.
pub static LIBRARY: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
    FILES.folder("drivers").filter(|(name, _)| name.ends_with(".sense")).collect()
});

/// Search terms, and the drivers that they mean: lines of words and names.
pub(crate) fn search() -> &'static str {
    FILES.text("drivers/search.csv")
}
