//! `can`: a value in the frames of a CAN bus.

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["bitrate", "frame", "byte", "tx", "rx"];

/// Bits per second where the file says nothing.
const BITRATE_DEFAULT_HZ: u32 = 500_000;

/// A value on a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Can {
    /// Bits per second; all devices of one bus agree.
    pub bitrate_hz: u32,
    /// Where it is given.
    pub bitrate_span: Option<sensedsl_diagnostics::Span>,
    /// Identifier of the frame, up to 29 bits.
    pub frame_id: u32,
    /// First byte of the value in the frame.
    pub byte: u8,
}

pub(crate) fn read(fields: &mut Fields<'_>) -> Can {
    let bitrate = fields.frequency_hz("bitrate", 10_000..=1_000_000);
    let frame = fields.required_integer("frame", 0..=0x1FFF_FFFF, "frame = 0x120;");
    let byte = fields.integer("byte", 0..=63).and_then(|n| u8::try_from(n.value).ok());
    Can {
        bitrate_hz: bitrate.map_or(BITRATE_DEFAULT_HZ, |rate| rate.value),
        bitrate_span: bitrate.map(|rate| rate.span),
        frame_id: frame.and_then(|n| u32::try_from(n.value).ok()).unwrap_or(0),
        byte: byte.unwrap_or(0),
    }
}

impl Default for Can {
    fn default() -> Self {
        Self { bitrate_hz: BITRATE_DEFAULT_HZ, bitrate_span: None, frame_id: 0, byte: 0 }
    }
}
