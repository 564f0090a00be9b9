//! What breaks, when, and for how long.

use sensedsl_model::design::DeviceIndex;
use sensedsl_model::kind::KindName;

/// Something that breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// Whose wires; none where it is the board or its link.
    pub device: Option<DeviceIndex>,
    /// From when.
    pub at_ns: u64,
    /// Until when; the same as the beginning where it is one moment.
    pub until_ns: u64,
}

impl Fault {
    /// Whether it is there at a moment.
    #[must_use]
    pub const fn is_there(&self, now_ns: u64) -> bool {
        self.at_ns <= now_ns && now_ns < self.until_ns
    }
}

/// What can break.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// A chip does not acknowledge.
    NoAnswer,
    /// Something holds SDA low.
    StuckSda,
    /// Something holds SCL low.
    Hang,
    /// The cable of a device is torn.
    Torn,
    /// A device sends nothing any more.
    Silent,
    /// The supply breaks down, and the board starts again.
    Reset,
    /// Random bytes arrive on the link.
    Garbage,
}

impl FaultKind {
    /// All of them, as the documentation lists them.
    pub const ALL: [Self; 7] = [
        Self::NoAnswer,
        Self::StuckSda,
        Self::Hang,
        Self::Torn,
        Self::Silent,
        Self::Reset,
        Self::Garbage,
    ];

    /// The word of a world.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoAnswer => "no_answer",
            Self::StuckSda => "stuck_sda",
            Self::Hang => "hang",
            Self::Torn => "torn",
            Self::Silent => "silent",
            Self::Reset => "reset",
            Self::Garbage => "garbage",
        }
    }

    /// Whether it is the board's or its link's, not a device's.
    #[must_use]
    pub const fn is_of_board(self) -> bool {
        matches!(self, Self::Reset | Self::Garbage)
    }

    /// The kinds whose wires can have it, for people.
    #[must_use]
    pub const fn needs(self) -> &'static str {
        match self {
            Self::NoAnswer | Self::StuckSda | Self::Hang => "devices on i2c",
            Self::Torn => "every sensor",
            Self::Silent => "devices that send by themselves: uart, can, icu, encoder",
            Self::Reset => "the board",
            Self::Garbage => "the link",
        }
    }

    /// Whether a device of a kind can have it.
    #[must_use]
    pub const fn fits(self, kind: KindName) -> bool {
        match self {
            Self::NoAnswer | Self::StuckSda | Self::Hang => matches!(kind, KindName::I2c),
            Self::Torn => true,
            Self::Silent => {
                matches!(kind, KindName::Uart | KindName::Can | KindName::Icu | KindName::Encoder)
            }
            Self::Reset | Self::Garbage => false,
        }
    }
}
