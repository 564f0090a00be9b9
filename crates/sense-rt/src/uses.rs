//! The parts of the runtime that a program needs: features of the crate, all on by default.
//!
//! A part whose feature is off is left out, and tables must not use it.

/// Values that the host sets.
pub(crate) const ACTUATORS: bool = cfg!(feature = "actuators");
/// Links whose payloads end with a CRC-32.
pub(crate) const CRC32: bool = cfg!(feature = "crc32");
/// Values of float32 and float64.
pub(crate) const REALS: bool = cfg!(feature = "reals");
/// Words that are floats, BCD or packed.
pub(crate) const CODES: bool = cfg!(feature = "codes");
/// Commands that are colours of a strip.
pub(crate) const LAMPS: bool = cfg!(feature = "lamps");
/// Commands that are letters on a display.
pub(crate) const LETTERS: bool = cfg!(feature = "letters");
/// Checksums between words.
pub(crate) const WORD_CRC: bool = cfg!(feature = "word-crc");
/// Filters that take the median.
pub(crate) const MEDIAN: bool = cfg!(feature = "median");
/// Filters that smooth.
pub(crate) const SMOOTH: bool = cfg!(feature = "smooth");
/// Filters that report only changes.
pub(crate) const CHANGE: bool = cfg!(feature = "change");
/// Chips that are written to before they measure.
pub(crate) const CHIP_INIT: bool = cfg!(feature = "chip-init");
/// Chips with an identity.
pub(crate) const CHIP_IDENTITY: bool = cfg!(feature = "chip-identity");
/// Chips with formulas, and with calibration.
pub(crate) const CHIP_FORMULAS: bool = cfg!(feature = "chip-formulas");
/// Chips with commands.
pub(crate) const CHIP_COMMANDS: bool = cfg!(feature = "chip-commands");
/// Chips that send and receive at the same time.
pub(crate) const CHIP_EXCHANGES: bool = cfg!(feature = "chip-exchanges");
