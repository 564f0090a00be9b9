//! `can`: a value in the frames of a CAN bus.

use super::spec::Properties;
use super::{KindSpec, Role, Sharing, Values};
use crate::fields::Fields;
use sensedsl_wire::{Direction, ValueType};

/// What is the same for all devices of this kind.
pub const SPEC: KindSpec = KindSpec {
    name: "can",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &["bitrate", "frame", "byte", "tx", "rx"],
    sharing: Sharing::Bus,
    triggers_itself: false,
    wires: "RX and TX of one unit, shared by devices of one bit rate",
    example: "frame = 0x120;",
    colour: "#8E6BBF",
    letter: 'N',
};

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

impl Properties for Can {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        let bitrate = fields.frequency_hz("bitrate", 10_000..=1_000_000);
        let frame = fields.required_integer("frame", 0..=0x1FFF_FFFF, "frame = 0x120;");
        let byte = fields.integer("byte", 0..=63).and_then(|n| u8::try_from(n.value).ok());
        Self {
            bitrate_hz: bitrate.map_or(BITRATE_DEFAULT_HZ, |rate| rate.value),
            bitrate_span: bitrate.map(|rate| rate.span),
            frame_id: frame.and_then(|n| u32::try_from(n.value).ok()).unwrap_or(0),
            byte: byte.unwrap_or(0),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Tx, Role::Rx]
    }
}

impl Default for Can {
    fn default() -> Self {
        Self { bitrate_hz: BITRATE_DEFAULT_HZ, bitrate_span: None, frame_id: 0, byte: 0 }
    }
}
