//! How the files of `boards/`, `forms/`, `silicon/` and `targets/` become types.

use serde::de::DeserializeOwned;

/// Reads a file.
///
/// The text becomes a table first, and the table the type. A type read from text at once is compiled three times over,
/// for values, for places and for dates, which is most of what compiling this crate would take.
///
/// # Errors
///
/// Fails if the text is not TOML, with the line, or if it lacks something, with its name.
pub(crate) fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let table: toml::Table = toml::from_str(text).map_err(|error| error.to_string())?;
    table.try_into().map_err(|error| error.to_string())
}
