//! What profiles of ESP32 keep for this HAL.

use serde::Deserialize;

use crate::names::Names;

/// The keys of `[system]`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Settings {
    /// How often a conversion must be started until there is one.
    pub(super) adc_starts: u8,
}

/// The keys of a line: there are none.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {}

impl Settings {
    /// Reads the keys of a profile; the error says what is wrong with them.
    pub(super) fn of(names: &Names) -> Result<Self, String> {
        let Line {} = names.line_settings()?;
        names.settings()
    }
}
