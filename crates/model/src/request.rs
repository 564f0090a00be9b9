//! What a caller asks for: a text, and what overrides the board and the target that it states.

/// What a caller asks for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Request<'a> {
    /// Path of the file, as people see it.
    pub path: &'a str,
    /// The text of the file.
    pub text: &'a str,
    /// A table or a built-in board that overrides the file's.
    pub board: Option<&'a str>,
    /// The target; none for the default.
    pub target: Option<&'a str>,
}
