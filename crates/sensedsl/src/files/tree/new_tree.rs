//! What an output folder is to hold: files with their contents, and what is to go, for whichever way writes them.

/// The new contents of a folder.
pub(crate) struct NewTree<'a> {
    /// All files.
    pub(crate) files: Vec<NewFile<'a>>,
    /// The text of the list of generated files.
    pub(crate) list: String,
    /// Generated files that are no longer needed.
    pub(crate) stale: Vec<String>,
}

/// One file of a [`NewTree`].
pub(crate) struct NewFile<'a> {
    /// The path, with `/`.
    pub(crate) path: &'a str,
    /// The contents.
    pub(crate) bytes: &'a [u8],
    /// Whether it belongs to the user once it is there.
    #[cfg_attr(
        not(target_os = "linux"),
        allow(dead_code, reason = "only Linux exchanges two names at once")
    )]
    pub(crate) once: bool,
    /// Whether it is missing or has different bytes.
    pub(crate) changes: bool,
}
