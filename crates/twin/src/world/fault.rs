//! Faults: what breaks, when, and for how long.

use sensedsl_model::design::DeviceIndex;
use sensedsl_model::kind::uart::{MessageChecksum, Uart};
use sensedsl_model::kind::{Interface, Kind};

/// A fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The kind of fault.
    pub kind: FaultKind,
    /// The device whose wires are affected; `None` if it is the board or its link.
    pub device: Option<DeviceIndex>,
    /// The start.
    pub at_ns: u64,
    /// The end; the same as the start for a single moment.
    pub until_ns: u64,
}

impl Fault {
    /// Whether it is present at a moment.
    #[must_use]
    pub const fn is_there(&self, now_ns: u64) -> bool {
        self.at_ns <= now_ns && now_ns < self.until_ns
    }
}

/// The kinds of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// A chip does not acknowledge.
    NoAnswer,
    /// A part gives bytes that its checksum does not fit.
    BadChecksum,
    /// A part answers too late.
    Late,
    /// Something holds SDA low.
    StuckSda,
    /// Something holds SCL low.
    Hang,
    /// The cable of a device is torn.
    Torn,
    /// A device no longer sends anything.
    Silent,
    /// The supply fails, and the board restarts.
    Reset,
    /// Random bytes arrive on the link.
    Garbage,
}

impl FaultKind {
    /// All of them, as the documentation lists them.
    pub const ALL: [Self; 9] = [
        Self::NoAnswer,
        Self::BadChecksum,
        Self::Late,
        Self::StuckSda,
        Self::Hang,
        Self::Torn,
        Self::Silent,
        Self::Reset,
        Self::Garbage,
    ];

    /// The word for it in a world.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoAnswer => "no_answer",
            Self::BadChecksum => "bad_checksum",
            Self::Late => "late",
            Self::StuckSda => "stuck_sda",
            Self::Hang => "hang",
            Self::Torn => "torn",
            Self::Silent => "silent",
            Self::Reset => "reset",
            Self::Garbage => "garbage",
        }
    }

    /// Whether it affects the board or its link, not a device.
    #[must_use]
    pub const fn is_of_board(self) -> bool {
        matches!(self, Self::Reset | Self::Garbage)
    }

    /// The kinds of devices that can have it, for people.
    #[must_use]
    pub const fn needs(self) -> &'static str {
        match self {
            Self::NoAnswer => "devices on i2c or onewire",
            Self::BadChecksum => {
                "devices on onewire, and devices on uart whose messages have a checksum"
            }
            Self::Late => "devices on onewire",
            Self::StuckSda | Self::Hang => "devices on i2c",
            Self::Torn => "every sensor",
            Self::Silent => "devices that send by themselves: uart, can, icu, encoder",
            Self::Reset => "the board",
            Self::Garbage => "the link",
        }
    }

    /// Whether a device of a kind can have it.
    #[must_use]
    pub fn fits(self, kind: &Kind) -> bool {
        match self {
            Self::NoAnswer => kind.i2c().is_some() || kind.onewire().is_some(),
            Self::BadChecksum => kind.onewire().is_some() || kind.uart().is_some_and(has_checksum),
            Self::Late => kind.onewire().is_some(),
            Self::StuckSda | Self::Hang => kind.i2c().is_some(),
            Self::Torn => true,
            Self::Silent => match kind.interface() {
                Interface::Uart(_)
                | Interface::Can(_)
                | Interface::Icu(_)
                | Interface::Encoder(_) => true,
                Interface::Analog(_)
                | Interface::I2c(_)
                | Interface::Digital(_)
                | Interface::OneWire(_)
                | Interface::Spi(_)
                | Interface::Pwm(_)
                | Interface::Dac(_)
                | Interface::Stepper(_)
                | Interface::Code(_) => false,
            },
            Self::Reset | Self::Garbage => false,
        }
    }
}

/// Whether a part sends messages by itself in which damage is noticed.
fn has_checksum(uart: &Uart) -> bool {
    uart.checksum != MessageChecksum::None && !uart.exchange.is_dialogue()
}
