//! `can`: a value in the frames of a CAN bus.

mod place;

use super::i2c::{self, ByteOrder, ORDERS};
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::{Fields, name_or_text, plain_integer};
use crate::meaning::{Meaning, REQUIRED, Takes, first};
use crate::spanned::Spanned;
use crate::value::Value;
use sensedsl_board::signal::{CanLine, Function};
use sensedsl_wire::{Direction, ScalarType, ValueType};

pub use place::{BitField, FRAME_BYTES};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "can",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &[
        "bitrate", "frame", "node", "extended", "length", "order", "byte", "bit", "mux", "resend",
        "tx", "rx",
    ],
    sharing: Sharing::Bus,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "RX and TX of one unit, shared by devices of one bit rate",
    example: "frame = 0x120;",
    colour: "#7E5AAB",
    colour_on_dark: "#7356A8",
    letter: 'N',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("bitrate", Takes::Frequency(10_000, 1_000_000)),
        "500 kHz",
        "The bit rate of the bus; all its devices have one.",
        "bitrate = 250 kHz;",
    ),
    Meaning::new(
        ("frame", Takes::Hex(0, 0x1FFF_FFFF)),
        REQUIRED,
        "The identifier of the frame.",
        "frame = 0x120;",
    ),
    Meaning::new(
        ("node", Takes::Whole(0, 255)),
        "0",
        "Added to `frame`: the unit or node number of parts whose identifiers contain it.",
        "node = 5;",
    ),
    Meaning::new(
        ("extended", Takes::Truth),
        "`true` from 0x800 on",
        "The identifier has 29 bits and not 11.",
        "extended = true;",
    ),
    Meaning::new(
        ("length", Takes::Whole(1, 8)),
        "as far as the last value",
        "Bytes of the frame.",
        "length = 8;",
    ),
    Meaning::new(
        ("order", Takes::Words(|| first(&ORDERS))),
        "`big`",
        "The order of the bytes of a number: the highest or the lowest one first.",
        "order = little;",
    ),
    Meaning::new(
        ("byte", Takes::Whole(0, 63)),
        "0",
        "Where the value begins in the frame, in whole bytes.",
        "byte = 2;",
    ),
    Meaning::new(
        ("bit", Takes::Whole(0, 63)),
        "none",
        "Where the value begins in the frame, in bits as a DBC file counts them; in place of `byte`. `bits` \
         beside it says how many it has.",
        "bit = 12;",
    ),
    Meaning::new(
        ("mux", Takes::Form("the value that selects and what it is, such as `Page = 3`", &[])),
        "none",
        "The value is in the frame only where the other value of the same frame is this.",
        "mux = Page = 3;",
    ),
    Meaning::new(
        ("resend", Takes::Time(1_000, 60_000_000)),
        "never",
        "The actuator's frame is sent again and again after it was commanded.",
        "resend = 20 ms;",
    )
    .only(Direction::Actuator),
];

/// Bits per second if the file gives none.
const BITRATE_DEFAULT_HZ: u32 = 500_000;
/// The greatest 11-bit identifier; greater ones have 29 bits.
pub const STANDARD_MAX: u32 = 0x7FF;
/// The greatest 29-bit identifier.
const EXTENDED_MAX: i64 = 0x1FFF_FFFF;
/// The longest time from one repetition of a frame to the next.
const RESEND_MAX_MS: u32 = 60_000;

/// A value on a CAN bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Can {
    /// Bits per second; all devices on one bus must agree.
    pub bitrate_hz: u32,
    /// Where the bit rate is given.
    pub bitrate_span: Option<sensedsl_diagnostics::Span>,
    /// The identifier of the frame, up to 29 bits.
    pub frame_id: u32,
    /// Whether the identifier has 29 bits.
    pub is_extended: bool,
    /// The first byte of the value in the frame.
    pub byte: u8,
    /// The value's bits in the word that begins there; none for whole bytes.
    pub field: Option<BitField>,
    /// Order of the bytes of each number.
    pub order: ByteOrder,
    /// Bytes of the frame; none if it is as long as its values need.
    pub length: Option<u8>,
    /// The time after which a commanded frame is sent again; 0 for never.
    pub resend_ms: u32,
    /// The value that another value of the frame must have for this one to be in it.
    pub mux: Option<Mux>,
}

/// Which of an identifier's frames holds a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mux {
    /// The value of the same frame that tells them apart: its device, or its reading of the same
    /// part.
    pub selector: Spanned<String>,
    /// The selector's value in that frame.
    pub value: Spanned<u64>,
    /// The selector's bits in the frame, and their contents: byte 0 of the frame is the lowest; none
    /// if the frame has no such selector.
    pub bits: Option<(u64, u64)>,
}

fn serves(role: Role, function: &Function) -> bool {
    let Function::Can { line, .. } = function else { return false };
    match line {
        CanLine::Tx => role == Role::Tx,
        CanLine::Rx => role == Role::Rx,
    }
}

impl Properties for Can {
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self {
        let bitrate = fields.frequency_hz("bitrate", 10_000..=1_000_000);
        let (frame_id, is_extended) = identifier(fields);
        let length = fields.integer("length", 1..=i64::from(FRAME_BYTES));
        let length = length.and_then(|n| u8::try_from(n.value).ok());
        let is_one_byte = value.scalar.size_bytes() == 1 && !fields.has("bit");
        let order = i2c::order(fields, is_one_byte);
        let (byte, field) = place::read(fields, order, value);
        Self {
            bitrate_hz: bitrate.map_or(BITRATE_DEFAULT_HZ, |rate| rate.value),
            bitrate_span: bitrate.map(|rate| rate.span),
            frame_id,
            is_extended,
            byte,
            field,
            order,
            length,
            resend_ms: resend(fields, direction),
            mux: mux(fields),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Tx, Role::Rx]
    }
}

impl Can {
    /// The identifier as people write it.
    #[must_use]
    pub fn shown(&self) -> String {
        if self.is_extended {
            format!("0x{:X} (29 bits)", self.frame_id)
        } else {
            format!("0x{:X}", self.frame_id)
        }
    }

    /// The bits of the frame that select the value, and their contents; none if it is in every frame
    /// with its identifier.
    #[must_use]
    pub fn select(&self) -> Option<(u64, u64)> {
        self.mux.as_ref()?.bits
    }

    /// The most bytes that the frame can have.
    #[must_use]
    pub const fn room(&self) -> u8 {
        match self.length {
            Some(length) => length,
            None => FRAME_BYTES,
        }
    }
}

/// The identifier, including the number of the node, and whether it has 29 bits.
fn identifier(fields: &mut Fields<'_>) -> (u32, bool) {
    let node = fields.integer("node", 0..=255).map_or(0, |n| n.value);
    let extended = fields.boolean("extended");
    let frame = fields.required_integer("frame", 0..=EXTENDED_MAX, "frame = 0x120;");
    let Some(Spanned { value, span }) = frame else { return (0, false) };
    let is_long = value > i64::from(STANDARD_MAX);
    let is_extended = extended.map_or(is_long, |word| word.value);
    if is_long && !is_extended {
        let message = format!("0x{value:X} has more than 11 bits, so its frames are extended ones");
        fields.contradiction(span, "extended", &message);
    }
    let most = if is_extended || is_long { EXTENDED_MAX } else { i64::from(STANDARD_MAX) };
    let whole = value + node;
    if whole > most {
        let message = format!(
            "0x{value:X} and {node} are more than 0x{most:X}, the greatest of these identifiers"
        );
        fields.contradiction(span, "node", &message);
    }
    (u32::try_from(whole.min(most)).unwrap_or(0), is_extended || is_long)
}

/// Reads the time after which a frame is repeated.
fn resend(fields: &mut Fields<'_>, direction: Direction) -> u32 {
    let Some(resend) = fields.time_ms("resend", 1..=RESEND_MAX_MS) else { return 0 };
    if direction == Direction::Actuator {
        return resend.value;
    }
    // What a chip states applies to its commands.
    if !fields.is_of_reading() {
        fields.needs_direction(resend.span, "resend", Direction::Actuator);
    }
    0
}

/// `mux = NAME = VALUE`.
fn mux(fields: &mut Fields<'_>) -> Option<Mux> {
    let read = |value: &Value| {
        let [selector, value] = value.list()? else { return None };
        let number = u64::try_from(plain_integer(&value.value)?).ok()?;
        Some(Mux {
            selector: Spanned { value: name_or_text(&selector.value)?, span: selector.span },
            value: Spanned { value: number, span: value.span },
            bits: None,
        })
    };
    let takes = "the value that selects and what it is, such as `mux = Page = 3`";
    fields.read("mux", takes, read).map(|mux| mux.value)
}

impl Default for Can {
    fn default() -> Self {
        Self {
            bitrate_hz: BITRATE_DEFAULT_HZ,
            bitrate_span: None,
            frame_id: 0,
            is_extended: false,
            byte: 0,
            field: None,
            order: ByteOrder::Big,
            length: None,
            resend_ms: 0,
            mux: None,
        }
    }
}
