//! `onewire`: a part with one data wire in both directions, and a pull-up on it. Two protocols: 1-Wire (DS18B20), where
//! the board makes a slot for each bit, and that of the DHT22, where a pulse of the board starts a burst of the part.

mod rom;

use super::i2c::{self, ByteOrder, ORDERS};
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, REQUIRED, Takes, first};
use sensedsl_diagnostics::Span;
use sensedsl_wire::{Direction, ScalarType, ValueType};

pub use rom::{Rom, crc8};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "onewire",
    article: "a",
    directions: &[Direction::Sensor],
    values: Values::Any,
    properties: &[
        "protocol", "family", "rom", "pulse", "trigger", "read", "wait", "length", "order", "pin",
    ],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::AnyPin,
    wires: "one GPIO with a resistor to the supply; with `rom` shared by 1-Wire parts. ChibiOS also takes the \
            interrupt line of its number with `protocol = dht`",
    example: "protocol = w1;",
    colour: "#A800E1",
    colour_on_dark: "#4C7A5D",
    letter: 'W',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("protocol", Takes::Words(|| first(&PROTOCOLS))),
        REQUIRED,
        "How bits go over the wire: `w1` is 1-Wire (DS18B20), `dht` that of the DHT22 and DHT11.",
        "protocol = w1;",
    ),
    Meaning::new(
        ("family", Takes::Hex(1, 255)),
        "any",
        "The family code that a 1-Wire part must have; another part is a fault.",
        "family = 0x28;",
    ),
    Meaning::new(
        ("rom", Takes::Text),
        "none: the part is alone on its wire",
        "The address of a 1-Wire part, which may then share its wire with others that have one: family and serial \
         number as Linux writes them, or all 16 digits in the order of the wire.",
        "rom = \"28-0000055f311a\";",
    ),
    Meaning::new(
        ("pulse", Takes::Time(10, 30_000)),
        "1 ms",
        "How long the board pulls the wire low to make a part of `dht` measure: 18 ms for a DHT11.",
        "pulse = 18 ms;",
    ),
    Meaning::new(
        ("trigger", Takes::Bytes(0, 8)),
        "none",
        "Sent to a 1-Wire part to start a measurement, after which it shows that it is busy.",
        "trigger = [0x44];",
    ),
    Meaning::new(
        ("read", Takes::Bytes(1, 8)),
        "`[0xBE]`",
        "Sent to a 1-Wire part before its nine bytes are read, the last of which is their checksum.",
        "read = [0xBE];",
    ),
    Meaning::new(
        ("wait", Takes::Time(0, 60_000_000)),
        "0; 2 s with `protocol = dht`",
        "From the trigger to the measurement. With `protocol = dht` the shortest time from one reading to the next.",
        "wait = 750 ms;",
    ),
    Meaning::new(
        ("length", Takes::Whole(1, 8)),
        "the size of the type",
        "Bytes of the value, divided evenly among its elements.",
        "length = 2;",
    ),
    Meaning::new(
        ("order", Takes::Words(|| first(&ORDERS))),
        "`big`",
        "The order of the bytes of each element: the highest or the lowest one first.",
        "order = little;",
    ),
];

/// How bits go over the wire.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OneWireProtocol {
    /// 1-Wire: the board makes a slot for each bit.
    #[default]
    W1,
    /// A burst of forty bits after a pulse of the board.
    Dht,
}

/// The words after `protocol`.
const PROTOCOLS: [(&str, OneWireProtocol); 2] =
    [("w1", OneWireProtocol::W1), ("dht", OneWireProtocol::Dht)];

/// The usual pulse that makes a part of `dht` measure.
const PULSE_DEFAULT_US: u32 = 1_000;
/// The shortest time between readings of a part of `dht` if the file gives none.
const REST_DEFAULT_US: u32 = 2_000_000;
/// Selects the scratchpad, which all temperature sensors on 1-Wire have.
const READ_SCRATCHPAD: u8 = 0xBE;

/// A part with one data wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneWire {
    /// How bits go over the wire.
    pub protocol: OneWireProtocol,
    /// The family code that the part must have.
    pub family: Option<u8>,
    /// The part's address; none if it is alone on its wire.
    pub rom: Option<Rom>,
    /// Where the address is given.
    pub rom_span: Option<Span>,
    /// Length of the pulse that makes the part measure.
    pub pulse_us: u32,
    /// Bytes sent to start a measurement; may be empty.
    pub trigger: Vec<u8>,
    /// Bytes sent before the value is read.
    pub read: Vec<u8>,
    /// Time from the trigger until the measurement can be read.
    pub wait_us: u32,
    /// The shortest time from one reading to the next.
    pub rest_us: u32,
    /// Where either time is given.
    pub wait_span: Option<Span>,
    /// Bytes of the value.
    pub length_bytes: u16,
    /// Order of the bytes of each number.
    pub order: ByteOrder,
}

impl OneWire {
    /// The bytes of an answer, the last of which is their checksum: the part always gives all of them.
    #[must_use]
    pub const fn answer_bytes(&self) -> u16 {
        match self.protocol {
            OneWireProtocol::W1 => 9,
            OneWireProtocol::Dht => 5,
        }
    }

    /// The wire with no properties given, of that protocol.
    fn bare(protocol: OneWireProtocol) -> Self {
        let is_w1 = protocol == OneWireProtocol::W1;
        Self {
            protocol,
            family: None,
            rom: None,
            rom_span: None,
            pulse_us: PULSE_DEFAULT_US,
            trigger: Vec::new(),
            read: if is_w1 { vec![READ_SCRATCHPAD] } else { Vec::new() },
            wait_us: 0,
            rest_us: if is_w1 { 0 } else { REST_DEFAULT_US },
            wait_span: None,
            length_bytes: 1,
            order: ByteOrder::Big,
        }
    }
}

impl Properties for OneWire {
    fn read(fields: &mut Fields<'_>, _: Direction, value: ValueType) -> Self {
        let spans =
            ["family", "rom", "trigger", "read", "pulse"].map(|name| fields.value_span(name));
        let [family_at, rom_at, trigger_at, read_at, pulse_at] = spans;
        let protocol = fields.word("protocol", &PROTOCOLS);
        if protocol.is_none() && !fields.has("protocol") {
            fields.missing("protocol", "protocol = w1;");
        }
        let protocol = protocol.map(|word| word.value).unwrap_or_default();
        let bare = Self::bare(protocol);
        let family = fields.integer("family", 1..=255);
        let rom = rom::read(fields, family.as_ref().and_then(|one| u8::try_from(one.value).ok()));
        let pulse = fields.time_us("pulse", 10..=30_000);
        let trigger = fields.bytes("trigger", 0..=8);
        let read = fields.bytes("read", 1..=8);
        let wait = fields.time_us("wait", 0..=60_000_000);
        let size_bytes = i64::try_from(value.size_bytes()).unwrap_or(i64::MAX);
        let length = fields.integer("length", 1..=8).map_or(size_bytes, |n| n.value);
        let order = i2c::order(fields, length == i64::from(value.length.unwrap_or(1)));
        let is_w1 = protocol == OneWireProtocol::W1;
        let of_w1 =
            [("family", family_at), ("rom", rom_at), ("trigger", trigger_at), ("read", read_at)];
        for (name, at) in of_w1.into_iter().filter(|_| !is_w1) {
            let Some(at) = at else { continue };
            fields.contradiction(at, "type", &format!("`{name}` is for `protocol = w1`"));
        }
        if let Some(at) = pulse_at.filter(|_| is_w1) {
            fields.contradiction(at, "type", "`pulse` is for `protocol = dht`");
        }
        let wait_us = wait.as_ref().map(|wait| wait.value);
        Self {
            family: family.and_then(|n| u8::try_from(n.value).ok()).filter(|_| is_w1),
            rom: rom.as_ref().map(|rom| rom.value).filter(|_| is_w1),
            rom_span: rom.map(|rom| rom.span),
            pulse_us: pulse.map_or(bare.pulse_us, |pulse| pulse.value),
            trigger: trigger.map(|bytes| bytes.value).filter(|_| is_w1).unwrap_or_default(),
            read: read.map(|bytes| bytes.value).filter(|_| is_w1).unwrap_or(bare.read),
            wait_us: if is_w1 { wait_us.unwrap_or(0) } else { 0 },
            rest_us: if is_w1 { 0 } else { wait_us.unwrap_or(bare.rest_us) },
            wait_span: wait.map(|wait| wait.span),
            length_bytes: u16::try_from(length).unwrap_or(u16::MAX),
            protocol,
            order,
        }
    }

    fn plain(_: u8) -> Self {
        Self::bare(OneWireProtocol::W1)
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Data]
    }

    fn measuring_us(&self) -> u32 {
        self.wait_us
    }
}
