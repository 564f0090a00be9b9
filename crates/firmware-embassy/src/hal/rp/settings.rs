//! What profiles of RP2040 and RP2350 keep for this HAL: how the chips start, and what UF2 files call them.

use serde::Deserialize;

use crate::names::Names;

/// The keys of `[system]`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Settings {
    pub(super) start: Start,
    /// The family of the chips in UF2 files.
    pub(super) uf2_family: u32,
}

/// How a chip starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Start {
    /// With a second stage in the first 256 bytes of the flash: RP2040.
    Boot2,
    /// With a block that describes the image: RP2350.
    Block,
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
