//! `i2c`: a device on an I2C bus.

use sensedsl_board::signal::{Function, I2cLine};
use sensedsl_diagnostics::codes::{
    e0215_bad_address, h0701_eight_bit_address, w0601_unused_property,
};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::encoding::{self, Encoding};
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, REQUIRED, Takes, first};
use crate::spanned::Spanned;

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "i2c",
    article: "an",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &[
        "address",
        "speed",
        "exclusive",
        "trigger",
        "wait",
        "register",
        "length",
        "order",
        "start",
        "encoding",
        "scl",
        "sda",
    ],
    sharing: Sharing::Addresses,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "SCL and SDA of one unit, shared by devices with different addresses",
    example: "address = 0x40; register = 0;",
    colour: "#2FB5F5",
    colour_on_dark: "#1184F1",
    letter: 'I',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("address", Takes::Hex(0, 255)),
        REQUIRED,
        "The address of the part: 7-bit form, 0x08 to 0x77; from 0x80 on the 8-bit form of data sheets, which \
         is even (0xE6 is 0x73).",
        "address = 0x68;",
    ),
    Meaning::new(
        ("speed", Takes::Frequency(1_000, 1_000_000)),
        "100 kHz",
        "The greatest clock that the device stands. The bus gets the fastest that suits all its devices.",
        "speed = 400 kHz;",
    ),
    Meaning::new(
        ("exclusive", Takes::Truth),
        "`false`",
        "No other device is on its bus.",
        "exclusive = true;",
    ),
    Meaning::new(
        ("trigger", Takes::Bytes(0, 32)),
        "none",
        "Written to start a measurement.",
        "trigger = [0x00, 0x51];",
    ),
    Meaning::new(
        ("wait", Takes::Time(0, 60_000_000)),
        "0",
        "From the trigger to the measurement; asked sooner, the last value stands.",
        "wait = 65 ms;",
    ),
    Meaning::new(
        ("register", Takes::Whole(0, 255)),
        "none",
        "Selected before reading, or written before an actuator's value. With `register_size = 2` of a driver \
         it goes up to 65535.",
        "register = 0x3B;",
    ),
    Meaning::new(
        ("length", Takes::Whole(1, 2_048)),
        "the size of the type",
        "Bytes that are read or written, divided evenly among the elements of the value.",
        "length = 2;",
    ),
    Meaning::new(
        ("order", Takes::Words(|| first(&ORDERS))),
        "`big`",
        "The order of the bytes of each element: the highest or the lowest one first.",
        "order = little;",
    ),
    Meaning::new(
        ("start", Takes::Bytes(0, 32)),
        "none",
        "Written before the value of a command, behind its register.",
        "start = [0x80, 0xB0, 0x40];",
    )
    .only(Direction::Actuator),
    Meaning::new(
        ("encoding", Takes::Words(|| first(&encoding::OF_I2C))),
        "`none`",
        "How the bytes of a command are sent. `text` sends each letter as six columns of eight dots.",
        "encoding = text;",
    )
    .only(Direction::Actuator),
];

/// The properties that define a protocol. A device with none of them does not have its own protocol.
pub const PROTOCOL: &[&str] = &["trigger", "wait", "register", "length", "order"];

/// Bus clock if the file gives none: standard mode.
const SPEED_DEFAULT_HZ: u32 = 100_000;

/// 7-bit addresses that devices have. The specification also reserves 0x78 to 0x7F, but Devantech
/// rangers use them.
const ADDRESSES: std::ops::RangeInclusive<u8> = 0x08..=0x7F;

/// Order of the bytes of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ByteOrder {
    /// Most significant byte first.
    #[default]
    Big,
    /// Least significant byte first.
    Little,
}

/// The words after `order`.
pub(super) const ORDERS: [(&str, ByteOrder); 2] =
    [("big", ByteOrder::Big), ("little", ByteOrder::Little)];

/// A device on an I2C bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct I2c {
    /// Its address, in 7-bit form.
    pub address: u8,
    /// Where the address is given.
    pub address_span: Option<sensedsl_diagnostics::Span>,
    /// Clock of the bus while the board talks to the device.
    pub speed_hz: u32,
    /// Where the clock is given.
    pub speed_span: Option<sensedsl_diagnostics::Span>,
    /// True if no other device may be on the same bus.
    pub exclusive: bool,
    /// Bytes written to start a measurement; may be empty.
    pub trigger: Vec<u8>,
    /// Time from the trigger until the measurement can be read.
    pub wait_us: u32,
    /// Where the waiting time is given.
    pub wait_span: Option<sensedsl_diagnostics::Span>,
    /// Register written before reading; none to read directly.
    pub register: Option<u16>,
    /// Bytes read (sensor) or written after the register (actuator).
    pub length_bytes: u16,
    /// Order of the bytes of each number.
    pub order: ByteOrder,
    /// Bytes written before the value of a command; may be empty.
    pub start: Vec<u8>,
    /// How the bytes of a command are sent.
    pub encoding: Encoding,
}

fn serves(role: Role, function: &Function) -> bool {
    let Function::I2c { line, .. } = function else { return false };
    match line {
        I2cLine::Scl => role == Role::Scl,
        I2cLine::Sda => role == Role::Sda,
    }
}

impl Properties for I2c {
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self {
        let address = read_address(fields);
        let speed = fields.frequency_hz("speed", 1_000..=1_000_000);
        let exclusive = fields.boolean("exclusive").is_some_and(|flag| flag.value);
        let trigger = fields.bytes("trigger", 0..=32);
        let wait = fields.time_us("wait", 0..=60_000_000);
        let register = register(fields);
        let size_bytes = u64::try_from(value.size_bytes()).unwrap_or(u64::MAX);
        let length =
            fields.integer("length", 1..=2048).map_or(size_bytes, |n| n.value.unsigned_abs());
        let order = order(fields, length == u64::from(value.length.unwrap_or(1)));
        Self {
            address: address.as_ref().map_or(0, |address| address.value),
            address_span: address.map(|address| address.span),
            speed_hz: speed.as_ref().map_or(SPEED_DEFAULT_HZ, |speed| speed.value),
            speed_span: speed.map(|speed| speed.span),
            exclusive,
            trigger: trigger.map(|bytes| bytes.value).unwrap_or_default(),
            wait_us: wait.map_or(0, |wait| wait.value),
            wait_span: wait.map(|wait| wait.span),
            register,
            length_bytes: u16::try_from(length).unwrap_or(u16::MAX),
            order,
            start: start(fields, direction),
            encoding: encoding::read(fields, &encoding::OF_I2C, direction, value),
        }
    }

    fn plain(address: u8) -> Self {
        Self::at(address)
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Scl, Role::Sda]
    }

    fn measuring_us(&self) -> u32 {
        self.wait_us
    }
}

/// The register of a value. Its number has one byte, or as many as the driver states.
pub(super) fn register(fields: &mut Fields<'_>) -> Option<u16> {
    let greatest = (1_i64 << (8 * fields.register_bytes())) - 1;
    let register = fields.integer("register", 0..=greatest)?;
    u16::try_from(register.value).ok()
}

/// The order of the bytes of a number. For a number of one byte the order means nothing, which is
/// reported if the device itself gives one.
pub(super) fn order(fields: &mut Fields<'_>, is_one_byte: bool) -> ByteOrder {
    if let Some(at) = fields.own_span("order").filter(|_| is_one_byte && !fields.has("of")) {
        let why = "there is no order in one byte";
        let unused = w0601_unused_property::unused_property(at, "order", "this value", why);
        fields.say(unused);
    }
    fields.word("order", &ORDERS).map(|word| word.value).unwrap_or_default()
}

/// The bytes before the value of a command.
fn start(fields: &mut Fields<'_>, direction: Direction) -> Vec<u8> {
    let Some(bytes) = fields.bytes("start", 0..=32) else { return Vec::new() };
    if direction == Direction::Sensor {
        fields.needs_direction(bytes.span, "start", Direction::Actuator);
    }
    bytes.value
}

fn read_address(fields: &mut Fields<'_>) -> Option<Spanned<u8>> {
    // The driver knows its part: some have an address that the specification reserves.
    let is_own = fields.own_span("address").is_some();
    let of_part = fields.addresses().to_vec();
    let example = format!("address = 0x{:02X};", of_part.first().unwrap_or(&0x73));
    let written = fields.required_integer("address", 0..=255, &example)?;
    let Spanned { value, span } = written;
    let byte = u8::try_from(value).ok()?;
    let seven_bit = if byte >= 0x80 { byte >> 1 } else { byte };
    let text = format!("0x{byte:02X}");
    if byte >= 0x80 && byte % 2 == 1 {
        let why = "from 0x80 on it is the 8-bit form, which is even";
        fields.say(e0215_bad_address::bad_address(span, &text, why));
        return None;
    }
    if is_own && !ADDRESSES.contains(&seven_bit) && !of_part.contains(&seven_bit) {
        let why = format!("0x{seven_bit:02X} is reserved by the I2C specification");
        fields.say(e0215_bad_address::bad_address(span, &text, &why));
        return None;
    }
    if byte >= 0x80 {
        fields.say(h0701_eight_bit_address::eight_bit_address(span, byte));
    }
    Some(Spanned { value: seven_bit, span })
}

impl I2c {
    /// A device with one byte and no protocol.
    #[must_use]
    pub fn at(address: u8) -> Self {
        Self {
            address,
            address_span: None,
            speed_hz: SPEED_DEFAULT_HZ,
            speed_span: None,
            exclusive: false,
            trigger: Vec::new(),
            wait_us: 0,
            wait_span: None,
            register: None,
            length_bytes: 1,
            order: ByteOrder::Big,
            start: Vec::new(),
            encoding: Encoding::Plain,
        }
    }
}
