//! How the files of `boards/`, `forms/`, `silicon/` and `targets/` become types.

use serde::de::DeserializeOwned;

/// Reads a file.
///
/// The text becomes a value of JSON first, and the value the type. Read from TOML at once, each type is compiled for
/// values, for places and for dates, which is most of what compiling this crate would take.
///
/// # Errors
///
/// Fails if the text is not TOML, with the line, or if it lacks something, with its name.
pub(crate) fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let value: serde_json::Value = toml::from_str(text).map_err(|error| error.to_string())?;
    serde_json::from_value(value).map_err(|error| error.to_string())
}
