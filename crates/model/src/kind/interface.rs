//! Interfaces: the signals by which the value of a device travels, whatever its kind.
//!
//! In: a kind with its properties. Out: its interface, and the answers that depend on nothing else.
//! A kind has an interface of its own, or adds something to that of another kind. Code that decides
//! how levels, pulses or bytes travel matches on [`Interface`], so a kind that builds on a known
//! interface is understood everywhere, and the compiler names every place that a new one changes.

use super::Kind;
use super::analog::Analog;
use super::can::Can;
use super::code::Code;
use super::dac::Dac;
use super::digital::Digital;
use super::encoder::Encoder;
use super::encoding::Encoding;
use super::i2c::{ByteOrder, I2c};
use super::icu::{Icu, Mode};
use super::onewire::OneWire;
use super::pwm::Pwm;
use super::spi::Spi;
use super::stepper::Stepper;
use super::uart::Uart;

/// Generates the type, and a question for each interface, from the table below.
macro_rules! interfaces {
    ($($(#[$doc:meta])* $Interface:ident as $name:ident;)*) => {
        /// The signals by which a value travels, with their settings.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Interface<'a> {
            $($(#[$doc])* $Interface(&'a $Interface),)*
        }

        impl Kind {
            $(
                #[doc = concat!("The settings of the interface `", stringify!($name), "`; none if it has another.")]
                #[must_use]
                pub fn $name(&self) -> Option<&$Interface> {
                    if let Interface::$Interface(own) = self.interface() { Some(own) } else { None }
                }
            )*
        }
    };
}

interfaces! {
    /// A voltage that a converter samples.
    Analog as analog;
    /// Bytes of a part that an address selects.
    I2c as i2c;
    /// Edges that a timer captures.
    Icu as icu;
    /// Two tracks that a timer counts.
    Encoder as encoder;
    /// A level.
    Digital as digital;
    /// Characters, cut into messages.
    Uart as uart;
    /// Bytes of a part that a wire selects.
    Spi as spi;
    /// Pulses of a timer.
    Pwm as pwm;
    /// A voltage that a converter puts out.
    Dac as dac;
    /// Frames with identifiers.
    Can as can;
    /// Bytes of a part on one wire that both ends pull low.
    OneWire as onewire;
    /// Pulses of a timer that are counted, and a level for the direction.
    Stepper as stepper;
    /// None: code makes or takes the value.
    Code as code;
}

/// What is sent and waited for before the bytes of a part with registers come, and their number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegisterAccess<'a> {
    /// Bytes that start a measurement; empty if the part measures on its own.
    pub trigger: &'a [u8],
    /// Time from the trigger to the value, in microseconds.
    pub wait_us: u32,
    /// The register that is read or written; none if the part has only one, or none.
    pub register: Option<u16>,
    /// Bytes sent in place of a register's number; only on SPI.
    pub read: &'a [u8],
    /// Bytes of the value.
    pub length_bytes: u16,
    /// The 7-bit address; none where a wire selects the part.
    pub address: Option<u8>,
}

/// How the bytes of a value are sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bytes {
    /// Bytes of the value; none if its type decides.
    pub length: Option<u16>,
    /// The order of the bytes of each number.
    pub order: ByteOrder,
}

impl Kind {
    /// The signals by which its value travels. A kind that builds on another has that one's.
    #[must_use]
    pub const fn interface(&self) -> Interface<'_> {
        match self {
            Self::Analog(own) => Interface::Analog(own),
            Self::I2c(own) => Interface::I2c(own),
            Self::Icu(own) => Interface::Icu(own),
            Self::Encoder(own) => Interface::Encoder(own),
            Self::Digital(own) => Interface::Digital(own),
            Self::Uart(own) => Interface::Uart(own),
            Self::Spi(own) => Interface::Spi(own),
            Self::Pwm(own) => Interface::Pwm(own),
            Self::Dac(own) => Interface::Dac(own),
            Self::Can(own) => Interface::Can(own),
            Self::OneWire(own) => Interface::OneWire(own),
            Self::Stepper(own) => Interface::Stepper(own),
            Self::Code(own) => Interface::Code(own),
        }
    }

    /// The access to a value on a register bus; none if it is on none.
    #[must_use]
    pub fn register_access(&self) -> Option<RegisterAccess<'_>> {
        match self.interface() {
            Interface::I2c(own) => Some(RegisterAccess {
                trigger: &own.trigger,
                wait_us: own.wait_us,
                register: own.register,
                read: &[],
                length_bytes: own.length_bytes,
                address: Some(own.address),
            }),
            Interface::Spi(own) => Some(RegisterAccess {
                trigger: &own.trigger,
                wait_us: own.wait_us,
                register: own.register,
                read: &own.read,
                length_bytes: own.length_bytes,
                address: None,
            }),
            Interface::OneWire(own) => Some(RegisterAccess {
                trigger: &own.trigger,
                wait_us: own.wait_us,
                register: None,
                read: &own.read,
                length_bytes: own.length_bytes,
                address: None,
            }),
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        }
    }

    /// The bytes of an answer that a part always gives as a whole, its checksum at the end; none if it gives as many
    /// as are asked for.
    #[must_use]
    pub fn answer_bytes(&self) -> Option<u16> {
        self.onewire().map(OneWire::answer_bytes)
    }

    /// How the bytes of a value are sent; none if it is not sent in bytes.
    #[must_use]
    pub fn bytes(&self) -> Option<Bytes> {
        let of = |length, order| Some(Bytes { length, order });
        match self.interface() {
            Interface::I2c(own) => of(Some(own.length_bytes), own.order),
            Interface::Spi(own) => of(Some(own.length_bytes), own.order),
            Interface::Uart(own) => of(Some(own.length_bytes), own.order),
            Interface::OneWire(own) => of(Some(own.length_bytes), own.order),
            Interface::Can(own) => of(own.field.map(|field| field.word_bytes.into()), own.order),
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        }
    }

    /// How the bytes of a command are sent, where they are not the words of its value.
    #[must_use]
    pub const fn encoding(&self) -> Encoding {
        match self.interface() {
            Interface::I2c(own) => own.encoding,
            Interface::Spi(own) => own.encoding,
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => Encoding::Plain,
        }
    }

    /// Whether a converter samples the value.
    #[must_use]
    pub fn is_sampled(&self) -> bool {
        self.analog().is_some()
    }

    /// Whether the value is a level, which no peripheral carries.
    #[must_use]
    pub fn is_level(&self) -> bool {
        self.digital().is_some()
    }

    /// The length of the pulse that makes the part measure, in microseconds; none if none is sent.
    #[must_use]
    pub fn pulse_us(&self) -> Option<u32> {
        self.icu()?.pulse_us
    }

    /// Whether the hardware measures whenever there is something to measure, so that the cycle time
    /// does not apply.
    #[must_use]
    pub fn measures_itself(&self) -> bool {
        self.name().spec().triggers_itself && self.pulse_us().is_none()
    }

    /// Whether the value is the pulse train of a model receiver: an array on one wire.
    #[must_use]
    pub fn is_train(&self) -> bool {
        self.icu().is_some_and(|icu| icu.mode == Mode::Ppm)
    }

    /// The value that an output takes at the start and when the host goes silent; none if the file
    /// gives none.
    #[must_use]
    pub fn failsafe(&self) -> Option<f64> {
        match self.interface() {
            Interface::Pwm(own) => own.failsafe,
            Interface::Dac(own) => own.failsafe,
            Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Spi(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        }
    }

    /// The time after which a command is sent again; 0 for never.
    #[must_use]
    pub fn resend_ms(&self) -> u32 {
        let of_port = self.uart().map_or(0, |uart| uart.exchange.resend_ms);
        self.can().map_or(of_port, |can| can.resend_ms)
    }
}
