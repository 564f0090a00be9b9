//! What profiles of nRF52 keep for this HAL: the memories of a chip, and what its ports can do.

use serde::Deserialize;

use crate::names::Names;

/// The keys of a line.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Settings {
    pub(super) flash_bytes: u32,
    pub(super) ram_bytes: u32,
    /// Whether a serial port can send two stop bits.
    pub(super) has_two_stop_bits: bool,
    /// The family of the chips in UF2 files; `None` if no boot loader takes them.
    pub(super) uf2_family: Option<u32>,
}

/// The keys of `[system]`: there are none.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct System {}

impl Settings {
    /// Reads the keys of a profile; the error says what is wrong with them.
    pub(super) fn of(names: &Names) -> Result<Self, String> {
        let System {} = names.settings()?;
        names.line_settings()
    }
}
