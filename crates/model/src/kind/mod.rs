//! The kinds of devices: one file each, and one line each in every `match` below.
//!
//! A kind file says which properties the kind has and reads them; which wires a kind needs is
//! told here by [`Kind::roles`], and crate `wiring` makes candidates of it.

use std::fmt;

use sensedsl_wire::{Direction, ScalarType, ValueType};

pub mod analog;
pub mod can;
pub mod dac;
pub mod digital;
pub mod encoder;
pub mod i2c;
pub mod icu;
pub mod pwm;
pub mod spi;
pub mod uart;

/// What a device is connected to, with the properties of that kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A voltage on an ADC input.
    Analog(analog::Analog),
    /// A device on an I2C bus.
    I2c(i2c::I2c),
    /// Edges on an input-capture channel.
    Icu(icu::Icu),
    /// A quadrature encoder.
    Encoder(encoder::Encoder),
    /// A level on a GPIO.
    Digital(digital::Digital),
    /// Bytes on a serial port.
    Uart(uart::Uart),
    /// A device on an SPI bus.
    Spi(spi::Spi),
    /// A pulse width on a timer output.
    Pwm(pwm::Pwm),
    /// A voltage from a DAC output.
    Dac(dac::Dac),
    /// Frames on a CAN bus.
    Can(can::Can),
}

/// The word after `type`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum KindName {
    /// `analog`
    Analog,
    /// `i2c`
    I2c,
    /// `icu`
    Icu,
    /// `encoder`
    Encoder,
    /// `digital`
    Digital,
    /// `uart`
    Uart,
    /// `spi`
    Spi,
    /// `pwm`
    Pwm,
    /// `dac`
    Dac,
    /// `can`
    Can,
}

/// A wire of a device, in the order of the tie-break.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// The only wire of a sensor.
    In,
    /// The only wire of an actuator.
    Out,
    /// I2C clock.
    Scl,
    /// I2C data.
    Sda,
    /// Transmitted by the board.
    Tx,
    /// Received by the board.
    Rx,
    /// SPI clock.
    Sck,
    /// SPI, from the device.
    Miso,
    /// SPI, to the device.
    Mosi,
    /// SPI chip select.
    Cs,
    /// First encoder line.
    A,
    /// Second encoder line.
    B,
    /// The pulse that makes an icu device measure (HC-SR04).
    Trigger,
}

impl Role {
    /// All roles, in the order of the tie-break.
    pub const ALL: [Self; 13] = [
        Self::In,
        Self::Out,
        Self::Scl,
        Self::Sda,
        Self::Tx,
        Self::Rx,
        Self::Sck,
        Self::Miso,
        Self::Mosi,
        Self::Cs,
        Self::A,
        Self::B,
        Self::Trigger,
    ];

    /// The role whose pin that property fixes; none for `pin`, which stands for any only wire.
    #[must_use]
    pub fn from_property(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.property() == name && name != Self::In.property())
    }

    /// The word in JSON output and, but for `in` and `out`, the property that fixes the pin.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::In => "in",
            Self::Out => "out",
            Self::Scl => "scl",
            Self::Sda => "sda",
            Self::Tx => "tx",
            Self::Rx => "rx",
            Self::Sck => "sck",
            Self::Miso => "miso",
            Self::Mosi => "mosi",
            Self::Cs => "cs",
            Self::A => "a",
            Self::B => "b",
            Self::Trigger => "trigger",
        }
    }

    /// The property that fixes the pin of this role.
    #[must_use]
    pub const fn property(self) -> &'static str {
        match self {
            Self::In | Self::Out => "pin",
            Self::Scl
            | Self::Sda
            | Self::Tx
            | Self::Rx
            | Self::Sck
            | Self::Miso
            | Self::Mosi
            | Self::Cs
            | Self::A
            | Self::B
            | Self::Trigger => self.name(),
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl KindName {
    /// All kinds in the order of the language page.
    pub const ALL: [Self; 10] = [
        Self::Analog,
        Self::I2c,
        Self::Icu,
        Self::Encoder,
        Self::Digital,
        Self::Uart,
        Self::Spi,
        Self::Pwm,
        Self::Dac,
        Self::Can,
    ];

    /// The word of the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Analog => "analog",
            Self::I2c => "i2c",
            Self::Icu => "icu",
            Self::Encoder => "encoder",
            Self::Digital => "digital",
            Self::Uart => "uart",
            Self::Spi => "spi",
            Self::Pwm => "pwm",
            Self::Dac => "dac",
            Self::Can => "can",
        }
    }

    /// With its article, for messages.
    #[must_use]
    pub fn with_article(self) -> String {
        let article = match self {
            Self::Analog | Self::I2c | Self::Icu | Self::Encoder | Self::Spi => "an",
            Self::Digital | Self::Uart | Self::Pwm | Self::Dac | Self::Can => "a",
        };
        format!("{article} {} device", self.name())
    }

    /// The kind of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// All names for a message.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// The properties that this kind has beside those of every device.
    #[must_use]
    pub const fn properties(self) -> &'static [&'static str] {
        match self {
            Self::Analog => analog::PROPERTIES,
            Self::I2c => i2c::PROPERTIES,
            Self::Icu => icu::PROPERTIES,
            Self::Encoder => encoder::PROPERTIES,
            Self::Digital => digital::PROPERTIES,
            Self::Uart => uart::PROPERTIES,
            Self::Spi => spi::PROPERTIES,
            Self::Pwm => pwm::PROPERTIES,
            Self::Dac => dac::PROPERTIES,
            Self::Can => can::PROPERTIES,
        }
    }

    /// Which way devices of this kind may go.
    #[must_use]
    pub const fn directions(self) -> &'static [Direction] {
        match self {
            Self::Analog | Self::Icu | Self::Encoder => &[Direction::Sensor],
            Self::Pwm | Self::Dac => &[Direction::Actuator],
            Self::I2c | Self::Digital | Self::Uart | Self::Spi | Self::Can => {
                &[Direction::Sensor, Direction::Actuator]
            }
        }
    }

    /// Whether a value of that type can come from, or go to, a device of this kind; otherwise the
    /// types that can.
    ///
    /// # Errors
    /// The types that can, in words.
    pub fn accepts_type(self, value: ValueType) -> Result<(), &'static str> {
        let plain = value.length.is_none();
        let is_bool = value.scalar == ScalarType::Bool;
        let (fits, can) = match self {
            Self::Analog | Self::Icu | Self::Encoder | Self::Pwm | Self::Dac => {
                (plain && !is_bool, "one number: uint8..uint64, int8..int64, float32 or float64")
            }
            Self::Digital => {
                (plain && value.scalar.integer_range().is_some(), "bool or one whole number")
            }
            Self::I2c | Self::Uart | Self::Spi | Self::Can => (true, ""),
        };
        if fits { Ok(()) } else { Err(can) }
    }

    /// True where the hardware takes the measurement itself, whatever the cycle time.
    #[must_use]
    pub const fn triggers_itself(self) -> bool {
        match self {
            Self::Icu | Self::Encoder => true,
            Self::Analog
            | Self::I2c
            | Self::Digital
            | Self::Uart
            | Self::Spi
            | Self::Pwm
            | Self::Dac
            | Self::Can => false,
        }
    }
}

impl fmt::Display for KindName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Kind {
    /// What an analog device has of its own.
    #[must_use]
    pub const fn analog(&self) -> Option<&analog::Analog> {
        if let Self::Analog(analog) = self { Some(analog) } else { None }
    }

    /// What an I2C device has of its own.
    #[must_use]
    pub const fn i2c(&self) -> Option<&i2c::I2c> {
        if let Self::I2c(i2c) = self { Some(i2c) } else { None }
    }

    /// Its name.
    #[must_use]
    pub const fn name(&self) -> KindName {
        match self {
            Self::Analog(_) => KindName::Analog,
            Self::I2c(_) => KindName::I2c,
            Self::Icu(_) => KindName::Icu,
            Self::Encoder(_) => KindName::Encoder,
            Self::Digital(_) => KindName::Digital,
            Self::Uart(_) => KindName::Uart,
            Self::Spi(_) => KindName::Spi,
            Self::Pwm(_) => KindName::Pwm,
            Self::Dac(_) => KindName::Dac,
            Self::Can(_) => KindName::Can,
        }
    }

    /// The wires a device of this kind needs, in the order of the tie-break.
    #[must_use]
    pub fn roles(&self, direction: Direction) -> Vec<Role> {
        match self {
            Self::Analog(_) => vec![Role::In],
            Self::Icu(icu) if icu.pulse_us.is_some() => vec![Role::In, Role::Trigger],
            Self::Icu(_) => vec![Role::In],
            Self::Digital(_) if direction == Direction::Sensor => vec![Role::In],
            Self::Digital(_) | Self::Pwm(_) | Self::Dac(_) => vec![Role::Out],
            Self::I2c(_) => vec![Role::Scl, Role::Sda],
            Self::Encoder(_) => vec![Role::A, Role::B],
            Self::Uart(uart) if uart.receive_only => vec![Role::Rx],
            Self::Uart(_) | Self::Can(_) => vec![Role::Tx, Role::Rx],
            Self::Spi(_) => vec![Role::Sck, Role::Miso, Role::Mosi, Role::Cs],
        }
    }

    /// A device of that kind without any property given; an i2c device at `address` (7-bit).
    #[must_use]
    pub fn plain(kind: KindName, address: u8) -> Self {
        match kind {
            KindName::Analog => Self::Analog(analog::Analog::default()),
            KindName::I2c => Self::I2c(i2c::I2c::at(address)),
            KindName::Icu => Self::Icu(icu::Icu::default()),
            KindName::Encoder => Self::Encoder(encoder::Encoder { counts: None }),
            KindName::Digital => Self::Digital(digital::Digital::default()),
            KindName::Uart => Self::Uart(uart::Uart::link(uart::BAUD_DEFAULT)),
            KindName::Spi => Self::Spi(spi::Spi::default()),
            KindName::Pwm => Self::Pwm(pwm::Pwm::default()),
            KindName::Dac => Self::Dac(dac::Dac { failsafe: None }),
            KindName::Can => Self::Can(can::Can::default()),
        }
    }
}
