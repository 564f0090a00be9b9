//! The kinds of faults: what can break around a board, as worlds and tests name it.

use crate::kind::uart::{MessageChecksum, Uart};
use crate::kind::{Interface, Kind};

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

    /// The one that is called so.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// How long it lasts where nobody says, in nanoseconds; none if somebody must.
    #[must_use]
    pub const fn usual_ns(self) -> Option<u64> {
        match self {
            // How long the board is without supply.
            Self::Reset => Some(100_000_000),
            // How long bytes arrive.
            Self::Garbage => Some(20_000_000),
            Self::NoAnswer
            | Self::BadChecksum
            | Self::Late
            | Self::StuckSda
            | Self::Hang
            | Self::Torn
            | Self::Silent => None,
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
