//! `spi`: a device on an SPI bus, with its own chip select.

use super::encoding::{self, COLOURS, Colours, Encoding};
use super::i2c::{self, ByteOrder, ORDERS};
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};
use sensedsl_board::signal::{Function, SpiLine};
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "spi",
    article: "an",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &[
        "clock", "mode", "trigger", "wait", "register", "read", "length", "order", "encoding",
        "colours", "sck", "miso", "mosi", "cs",
    ],
    sharing: Sharing::BusAndSelect,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "SCK, MISO and MOSI of one unit, shared; a GPIO as chip select of its own. MOSI, or SCK and MOSI, of a unit that it takes for an LED strip",
    example: "",
    colour: "#001138",
    colour_on_dark: "#A09EE9",
    letter: 'S',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("clock", Takes::Frequency(1_000, 100_000_000)),
        "1 MHz",
        "The highest clock that the device takes.",
        "clock = 10 MHz;",
    ),
    Meaning::new(
        ("mode", Takes::Whole(0, 3)),
        "0",
        "Polarity and phase of the clock.",
        "mode = 3;",
    ),
    Meaning::new(
        ("trigger", Takes::Bytes(0, 32)),
        "none",
        "Sent to start a measurement.",
        "trigger = [0x06];",
    ),
    Meaning::new(
        ("wait", Takes::Time(0, 60_000_000)),
        "0",
        "From the trigger to the measurement.",
        "wait = 10 ms;",
    ),
    Meaning::new(
        ("register", Takes::Whole(0, 255)),
        "none",
        "Sent before the value is read or written. With `register_size = 2` of a driver it goes up to 65535.",
        "register = 0x28;",
    ),
    Meaning::new(
        ("read", Takes::Bytes(0, 32)),
        "none",
        "Sent before the value is read, where there is no register.",
        "read = [0x03];",
    ),
    Meaning::new(
        ("length", Takes::Whole(1, 1_024)),
        "the size of the type",
        "Bytes of the value.",
        "length = 2;",
    ),
    Meaning::new(
        ("order", Takes::Words(|| first(&ORDERS))),
        "`big`",
        "The order of the bytes of each element: the highest or the lowest one first.",
        "order = little;",
    ),
    Meaning::new(
        ("encoding", Takes::Words(|| first(&encoding::OF_SPI))),
        "`none`",
        "How the bytes of a command are sent. `ws2812`, `sk6812` and `apa102` send a colour, 0xRRGGBB, to each LED \
         of a strip.",
        "encoding = ws2812;",
    )
    .only(Direction::Actuator),
    Meaning::new(
        ("colours", Takes::Words(|| first(&COLOURS))),
        "`grb`; `bgr` with `apa102`",
        "The order in which the colours of an LED are sent.",
        "colours = grbw;",
    )
    .only(Direction::Actuator),
];

/// Clock if the file gives none.
const CLOCK_DEFAULT_HZ: u32 = 1_000_000;

/// A device on an SPI bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spi {
    /// The highest clock that the device takes.
    pub clock_hz: u32,
    /// Where the clock is given.
    pub clock_span: Option<sensedsl_diagnostics::Span>,
    /// Clock polarity and phase, 0 to 3.
    pub mode: u8,
    /// Bytes sent to start a measurement; may be empty.
    pub trigger: Vec<u8>,
    /// Time from the trigger until the measurement can be read.
    pub wait_us: u32,
    /// Register sent before the value is read or written; none if there is none.
    pub register: Option<u16>,
    /// Bytes sent before the value is read; may be empty.
    pub read: Vec<u8>,
    /// Bytes of the value.
    pub length_bytes: u16,
    /// Order of the bytes of each number.
    pub order: ByteOrder,
    /// How the bytes of a command are sent.
    pub encoding: Encoding,
    /// The order of the colours of a strip.
    pub colours: Colours,
}

fn serves(role: Role, function: &Function) -> bool {
    let Function::Spi { line, .. } = function else { return false };
    match line {
        SpiLine::Sck => role == Role::Sck,
        SpiLine::Miso => role == Role::Miso,
        SpiLine::Mosi => role == Role::Mosi,
        SpiLine::Nss => false,
    }
}

impl Properties for Spi {
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self {
        let clock = fields.frequency_hz("clock", 1_000..=100_000_000);
        let mode = fields.integer("mode", 0..=3).and_then(|n| u8::try_from(n.value).ok());
        let trigger = fields.bytes("trigger", 0..=32).map(|bytes| bytes.value);
        let wait = fields.time_us("wait", 0..=60_000_000);
        let register = i2c::register(fields);
        let read = fields.bytes("read", 0..=32).map(|bytes| bytes.value).unwrap_or_default();
        let size_bytes = i64::try_from(value.size_bytes()).unwrap_or(i64::MAX);
        let length = fields.integer("length", 1..=1024).map_or(size_bytes, |n| n.value);
        let encoding = encoding::read(fields, &encoding::OF_SPI, direction, value);
        Self {
            clock_hz: clock.map_or(CLOCK_DEFAULT_HZ, |clock| clock.value),
            clock_span: clock.map(|clock| clock.span),
            mode: mode.unwrap_or(0),
            trigger: trigger.unwrap_or_default(),
            wait_us: wait.map_or(0, |wait| wait.value),
            register,
            read,
            length_bytes: u16::try_from(length).unwrap_or(u16::MAX),
            order: i2c::order(fields, length == i64::from(value.length.unwrap_or(1))),
            encoding,
            colours: encoding::colours(fields, encoding),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        self.encoding.wires()
    }

    fn measuring_us(&self) -> u32 {
        self.wait_us
    }
}

impl Default for Spi {
    fn default() -> Self {
        Self {
            clock_hz: CLOCK_DEFAULT_HZ,
            clock_span: None,
            mode: 0,
            trigger: Vec::new(),
            wait_us: 0,
            register: None,
            read: Vec::new(),
            length_bytes: 1,
            order: ByteOrder::Big,
            encoding: Encoding::Plain,
            colours: &[],
        }
    }
}
