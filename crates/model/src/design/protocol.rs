//! How to talk to a part, beyond what its kind states: how it is started, how it is identified, how
//! its values are coded. All of it is data for the board's runtime.

use sensedsl_wire::ValueType;

/// The data that a chip needs before its values can be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Protocol {
    /// The steps written one after the other, once, and again after a failed transfer.
    pub init: Vec<InitStep>,
    /// The registers to check, and what must be in them.
    pub identity: Option<Identity>,
    /// Bytes in the number of a register.
    pub register_bytes: u8,
    /// Bits that are set in the register's number to read it; only on SPI.
    pub read_mask: u8,
    /// True if each register is read separately, so that those after it cannot be read with it.
    pub is_one_by_one: bool,
    /// Registers and counts of bytes that are read once for the formula.
    pub calibration: Vec<(u16, u16)>,
    /// The formula of its readings.
    pub formula: Option<Formula>,
    /// The constants of the formula.
    pub parameters: Vec<i32>,
}

impl Protocol {
    /// The bytes of a register's number, most significant first.
    #[must_use]
    pub fn register(&self, number: u32) -> Vec<u8> {
        let [.., high, low] = number.to_be_bytes();
        if self.register_bytes == 2 { vec![high, low] } else { vec![low] }
    }
}

/// One step of an initialization.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InitStep {
    /// Bytes written in one transfer.
    Write(Vec<u8>),
    /// A pause.
    Wait {
        /// The length of the pause.
        ms: u16,
    },
}

/// The registers that identify a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The first register.
    pub register: u16,
    /// The expected contents.
    pub expected: Vec<u8>,
    /// The bits that count, in as many bytes; empty for all.
    pub mask: Vec<u8>,
}

/// A formula of the runtime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formula {
    /// Temperature and pressure of a BMP280.
    Bmp280,
    /// Temperature, pressure and humidity of a BME280.
    Bme280,
    /// A thermistor that is connected to ground.
    Ntc,
    /// The illuminance of a TSL2561.
    Tsl2561,
    /// The load that an HX711 tells, its clock being the data of an SPI port.
    Hx711,
}

impl Formula {
    /// All variants.
    pub const ALL: [Self; 5] = [Self::Bmp280, Self::Bme280, Self::Ntc, Self::Tsl2561, Self::Hx711];

    /// The word after `compensate`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bmp280 => "bmp280",
            Self::Bme280 => "bme280",
            Self::Ntc => "ntc",
            Self::Tsl2561 => "tsl2561",
            Self::Hx711 => "hx711",
        }
    }

    /// The outputs, in the runtime's order.
    #[must_use]
    pub const fn outputs(self) -> &'static [&'static str] {
        match self {
            Self::Bmp280 => &["temperature", "pressure"],
            Self::Bme280 => &["temperature", "pressure", "humidity"],
            Self::Ntc => &["temperature"],
            Self::Tsl2561 => &["illuminance"],
            Self::Hx711 => &["load"],
        }
    }

    /// The bytes of calibration that it needs, the bytes that it is computed from, and the number
    /// of its parameters.
    #[must_use]
    pub const fn needs(self) -> (u16, u16, usize) {
        match self {
            Self::Bmp280 => (24, 6, 0),
            Self::Bme280 => (32, 8, 0),
            Self::Ntc => (0, 2, 3),
            Self::Tsl2561 => (0, 4, 2),
            Self::Hx711 => (0, 8, 0),
        }
    }
}

/// An output of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// The formula.
    pub of: Formula,
    /// The place of the output among those of the formula.
    pub number: u8,
}

/// How the value of a device is coded in the bytes that its part sends or receives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coding {
    /// The driver's reading or command that the device is.
    pub reading: Option<String>,
    /// The type that the part uses for it; none for the device's own type.
    pub of: Option<ValueType>,
    /// The bits of each word that count: the highest and the lowest.
    pub bits: Option<(u8, u8)>,
    /// Whether the highest of those bits is a sign; none if the type decides.
    pub signed: Option<bool>,
    /// The place of each element's word, counted in words; empty if they are consecutive.
    pub elements: Vec<u8>,
    /// Checksums between the words.
    pub crc: Option<Crc>,
    /// The number of bits of each element, if elements follow each other without gaps.
    pub packed_bits: Option<u8>,
    /// Where the value begins in a message, counted from the end of the start bytes.
    pub byte: u16,
    /// The value's place in a text.
    pub text: Option<TextField>,
    /// True if each byte holds two decimal digits.
    pub bcd: bool,
    /// True if the highest bit is a sign, and the others are the magnitude.
    pub is_magnitude: bool,
    /// Bytes sent on SPI while as many bytes, which are the value's, are received.
    pub exchange: Vec<u8>,
    /// The output of the chip's formula that the value is.
    pub output: Option<Output>,
    /// How one value becomes several outputs.
    pub drive: Option<Drive>,
    /// The value, for all elements, that an actuator takes when the host goes silent; none to keep
    /// the last one. A pwm or dac device on its own has its own property for this.
    pub failsafe: Option<f64>,
    /// Whether a switch of a chip on a bus is on before the host sets it; none for the driver's
    /// default.
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
    /// A CRC-8 after every two bytes, with polynomial 0x31 and initial value 0xFF.
    Sensirion,
}

/// The place of a number in a text, and how it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextField {
    /// The end of a sentence's first field, if only such sentences count (`RMC`).
    pub sentence: Option<String>,
    /// The index of the field, from 0.
    pub field: u8,
    /// The separator of fields; none if the whole message is one field.
    pub separator: Option<u8>,
    /// The format of the number.
    pub format: Format,
    /// The power of ten that the number is multiplied by to give the value.
    pub decimals: u8,
}

/// The format of a number in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Digits with a decimal point.
    Decimal,
    /// Degrees and minutes (`4807.038,N`); the value is in 1e-7 degrees.
    Degrees,
    /// A number in hexadecimal digits.
    Hex,
}

/// How one signed value becomes several outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// Its magnitude is a pulse width, its sign two levels.
    DirectionPins,
    /// Its magnitude is a pulse width, its sign one level, which is on for a negative value.
    DirectionPin,
    /// One pulse width for each direction.
    TwoPwm,
}

/// How a value is filtered on the board before it is reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    /// Ranges of raw values that mean that nothing was measured.
    pub invalid: Vec<(f64, f64)>,
    /// Where the file itself gives them; none if only its driver does.
    pub invalid_span: Option<sensedsl_diagnostics::Span>,
    /// The number of values whose median is taken; 0 for no median.
    pub median: u8,
    /// Time constant of a low-pass; 0 for none.
    pub smooth_ms: u32,
    /// How much a value must differ from the last report to be reported.
    pub change: Option<f64>,
    /// With `change`: the longest time between two reports; 0 for no limit.
    pub heartbeat_ms: u32,
}

impl Filter {
    /// Whether every value is reported unfiltered.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
