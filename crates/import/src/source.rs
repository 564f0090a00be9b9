//! What an importer takes and gives: a [`Source`] goes in, [`Texts`] come out.

use sensedsl_model::ReadError;

use crate::format::Format;

/// A file to import.
pub struct Source<'a> {
    /// The file's name, as people see it.
    pub name: &'a str,
    /// The content of the file.
    pub bytes: &'a [u8],
    /// Its format; none to detect it from the content.
    pub format: Option<Format>,
    /// The sheet of a workbook.
    pub sheet: Option<&'a str>,
    /// The name under which the `.sense` file finds its table.
    pub table: &'a str,
    /// The content of a file by its path relative to the source, or why it was not read.
    pub beside: &'a (dyn Fn(&str) -> Result<Vec<u8>, ReadError> + 'a),
}

/// The result of one importer.
#[derive(Debug, Default)]
pub(crate) struct Texts {
    pub(crate) table: Option<String>,
    pub(crate) program: Option<String>,
}
