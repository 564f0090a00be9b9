//! How a part is talked to beyond what its kind says: what starts it, what it is, how its values are
//! coded. All of it is data; the runtime of the board does what it says.

use sensedsl_wire::ValueType;

/// What a chip needs before its values can be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Protocol {
    /// Written one after the other, once, and again after a failed transfer.
    pub init: Vec<InitStep>,
    /// What must be read where.
    pub identity: Option<Identity>,
    /// Bytes of a register's number.
    pub register_bytes: u8,
    /// On SPI, or-ed to the register when it is read.
    pub read_mask: u8,
    /// Each register is a number by itself: what lies behind it cannot be read with it.
    pub is_one_by_one: bool,
    /// Registers and counts of bytes, read once for the formula.
    pub calibration: Vec<(u16, u16)>,
    /// The formula of its readings.
    pub formula: Option<Formula>,
    /// The constants of the formula.
    pub parameters: Vec<i32>,
}

impl Protocol {
    /// The bytes of a register's number, the most significant first.
    #[must_use]
    pub fn register(&self, number: u32) -> Vec<u8> {
        let [.., high, low] = number.to_be_bytes();
        if self.register_bytes == 2 { vec![high, low] } else { vec![low] }
    }
}

/// One step of an initialisation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InitStep {
    /// Bytes that are written in one transfer.
    Write(Vec<u8>),
    /// A pause.
    Wait {
        /// How long.
        ms: u16,
    },
}

/// The registers that tell a part from others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The first of them.
    pub register: u16,
    /// What must be read there.
    pub expected: Vec<u8>,
    /// The bits that count, as many bytes; empty for all.
    pub mask: Vec<u8>,
}

/// A formula of the runtime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// Temperature and pressure of a BMP280.
    Bmp280,
    /// Those and the humidity of a BME280.
    Bme280,
    /// A thermistor to ground.
    Ntc,
    /// The illuminance of a TSL2561.
    Tsl2561,
}

impl Formula {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Bmp280, Self::Bme280, Self::Ntc, Self::Tsl2561];

    /// The word after `compensate`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bmp280 => "bmp280",
            Self::Bme280 => "bme280",
            Self::Ntc => "ntc",
            Self::Tsl2561 => "tsl2561",
        }
    }

    /// What it computes, in the runtime's order.
    #[must_use]
    pub const fn outputs(self) -> &'static [&'static str] {
        match self {
            Self::Bmp280 => &["temperature", "pressure"],
            Self::Bme280 => &["temperature", "pressure", "humidity"],
            Self::Ntc => &["temperature"],
            Self::Tsl2561 => &["illuminance"],
        }
    }

    /// Bytes of calibration that it needs, bytes that it is computed from, and its parameters.
    #[must_use]
    pub const fn needs(self) -> (u16, u16, usize) {
        match self {
            Self::Bmp280 => (24, 6, 0),
            Self::Bme280 => (32, 8, 0),
            Self::Ntc => (0, 2, 3),
            Self::Tsl2561 => (0, 4, 2),
        }
    }
}

/// How the value of a device is coded in what its part sends or is sent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coding {
    /// The driver's reading or command that it is.
    pub reading: Option<String>,
    /// The type that the part has for it; none for that of the device.
    pub of: Option<ValueType>,
    /// The bits of each word that count, from the highest to the lowest.
    pub bits: Option<(u8, u8)>,
    /// Whether the highest of them is a sign; none for what the type says.
    pub signed: Option<bool>,
    /// Where the word of each element stands, counted in words; empty for one after the other.
    pub elements: Vec<u8>,
    /// Checksums between the words.
    pub crc: Option<Crc>,
    /// Elements of that many bits, one behind the other.
    pub packed_bits: Option<u8>,
    /// Where the value begins in a message, behind its start.
    pub byte: u16,
    /// How it stands in a text.
    pub text: Option<TextField>,
    /// Each byte has two decimal digits.
    pub bcd: bool,
    /// Sent on SPI while as many bytes are received, which are the value's.
    pub exchange: Vec<u8>,
    /// The output of the chip's formula that it is.
    pub output: Option<u8>,
    /// How one value becomes several outputs.
    pub drive: Option<Drive>,
    /// The value that an actuator takes when the host falls silent, for all elements; none to keep the last one. A pwm
    /// or dac device by itself has its own.
    pub failsafe: Option<f64>,
    /// Whether a switch of a chip on a bus is on before the host sets it; none for what the driver says.
    pub initial: Option<bool>,
}

impl Coding {
    /// Whether the bytes are the value, one element after the other.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let Self { reading, of, byte, failsafe, .. } = self;
        let plain = Self {
            reading: reading.clone(),
            of: *of,
            byte: *byte,
            failsafe: *failsafe,
            ..Self::default()
        };
        *self == plain
    }
}

/// Checksums between the words of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crc {
    /// After every two bytes a CRC-8: polynomial 0x31, start 0xFF.
    Sensirion,
}

/// How a number stands in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextField {
    /// Only in sentences whose first field ends so (`RMC`).
    pub sentence: Option<String>,
    /// Which field, from 0.
    pub field: u8,
    /// What is between fields; none where the whole message is one.
    pub separator: Option<u8>,
    /// How it is written.
    pub format: Format,
    /// The value is the number times ten to that power.
    pub decimals: u8,
}

/// How a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Digits with a point.
    Decimal,
    /// Degrees and minutes (`4807.038,N`); the value is in 1e-7 degrees.
    Degrees,
    /// Hexadecimal digits.
    Hex,
}

/// How one signed value becomes several outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// Its magnitude a pulse width, its sign two levels.
    DirectionPins,
    /// One pulse width for each direction.
    TwoPwm,
}

/// What becomes of a value on the board before it is reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    /// Raw values that mean that nothing was measured: from, to.
    pub invalid: Vec<(f64, f64)>,
    /// Where the file itself says so; none where only its driver does.
    pub invalid_span: Option<sensedsl_diagnostics::Span>,
    /// The median of so many values; 0 for none.
    pub median: u8,
    /// Time constant of a low-pass; 0 for none.
    pub smooth_ms: u32,
    /// Only what differs by so much from the last report is reported.
    pub change: Option<f64>,
    /// With `change`: the longest time between two reports; 0 for any.
    pub heartbeat_ms: u32,
}

impl Filter {
    /// Whether every value is reported as it is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
