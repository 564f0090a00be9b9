//! The pin problem: the solver's input, in integers only.
//!
//! Names, spans and hardware words stay outside: crate `wiring` makes a [`Problem`] and reads the
//! answer back. A pin that may not be used is simply not a candidate. Every other rule is of one of
//! five kinds: a pin held once, a claim on a resource, a DMA request, a soft rule, a board.

/// Index of a pin in [`Problem::pins`]; the order is the natural order of the tie-break
/// (board by board, then PA2 < PA10 < PB0).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PinId(pub u32);

/// Rank of a signal name; a smaller rank is the earlier name of the tie-break.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SignalId(pub u32);

/// Index of a device in [`Problem::devices`]; the order is the file's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DeviceId(pub u32);

/// Something that holders share only when they agree: a timer, a signal, a bus address,
/// an interrupt line, a package pad. Its name lives outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub u32);

/// Index of a board in [`Problem::boards`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoardId(pub u32);

/// Index of a soft rule (`prefer`, `avoid`) in `0..Problem::rules`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RuleId(pub u32);

/// Index of a DMA user (a peripheral instance whose driver takes streams) in [`Problem::dma`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DmaUserId(pub u32);

/// Index of a DMA stream over all boards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StreamId(pub u32);

/// Who holds a resource or a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Holder {
    /// The claiming device alone.
    Own,
    /// All who name the same number: the devices of one bus, or PWM outputs of one frequency.
    Group(u32),
}

/// A device takes `resource`; every other device that takes it must do so as the same
/// [`Holder::Group`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Claim {
    /// The resource that is taken.
    pub resource: ResourceId,
    /// The holder on whose behalf it is taken.
    pub holder: Holder,
}

/// A pin of one board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// The board it belongs to.
    pub board: BoardId,
    /// Opportunity cost: number of usages in the pin's row of the board table.
    pub cost: u32,
    /// True if something else is on it: it is used only where that violates fewer rules.
    pub shared: bool,
}

/// A board that devices may go to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Board {
    /// True for a spare board: it counts in the objective as soon as one device is on it.
    pub spare: bool,
}

/// One way to connect one role of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// The pin. Two devices may hold a pin together only through `holder`.
    pub pin: PinId,
    /// [`Holder::Own`], or the bus whose devices share the wire.
    pub holder: Holder,
    /// The signal, for the tie-break. If it must be exclusive, that is one of the `claims`.
    pub signal: SignalId,
    /// Resources taken in addition to the pin (signal, interrupt line, pad).
    pub claims: Vec<Claim>,
    /// Soft rules this candidate violates (each rule counts once in the whole answer).
    pub violates: Vec<RuleId>,
    /// True if the wire differs from the wiring that is to be kept.
    pub moved: bool,
}

impl Candidate {
    /// A candidate that takes its pin alone, and nothing else.
    #[must_use]
    pub const fn new(pin: PinId, signal: SignalId) -> Self {
        let claims = Vec::new();
        let violates = Vec::new();
        Self { pin, holder: Holder::Own, signal, claims, violates, moved: false }
    }
}

/// One role of an alternative: exactly one candidate is chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Role {
    /// The candidates, sorted by (pin, signal), without duplicates.
    pub candidates: Vec<Candidate>,
}

/// One peripheral instance (or other discrete choice) a device may take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Alternative {
    /// The board it is on; all candidates' pins are on it.
    pub board: BoardId,
    /// Resources taken whatever pins are chosen (timer, bus, bus address).
    pub claims: Vec<Claim>,
    /// Soft rules violated by choosing this alternative.
    pub violates: Vec<RuleId>,
    /// Peripheral instances put to use, which then need their DMA streams.
    pub dma: Vec<DmaUserId>,
    /// The roles, in the order of the tie-break. The pins of one device differ.
    pub roles: Vec<Role>,
}

/// A device: exactly one alternative is chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Device {
    /// The choices. No (pins, signals) answer is reachable through two alternatives on the same
    /// board, so pins and signals alone tell answers apart.
    pub alternatives: Vec<Alternative>,
}

/// One request of a peripheral instance: exactly one stream of `streams`, held by no other request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DmaRequest {
    /// Streams that can serve it, best first.
    pub streams: Vec<StreamId>,
}

/// A peripheral instance whose driver takes DMA streams; all its requests are served if at least
/// one device uses it. Other things that are dealt out one by one can be put the same way, such as
/// timers of which one must stay free.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DmaUser {
    /// For example RX and TX of an I2C unit.
    pub requests: Vec<DmaRequest>,
}

/// The whole problem.
///
/// An answer gives each device one alternative and each of its roles one candidate so that
/// 1. each pin is held by one device, or by several as one [`Holder::Group`],
/// 2. so is each resource,
/// 3. the DMA requests of all used [`DmaUser`]s get streams of their own.
///
/// It is best when (moved wires, violated rules, shared pins used, sum of the costs of the distinct
/// pins used, spare boards used) is lexicographically least, then its list of pins (devices in
/// order, roles in order), then its list of signals. A wire that devices share as a group counts as
/// one moved wire. All devices of a group use a shared pin with the same signal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Problem {
    /// All pins of all boards in tie-break order.
    pub pins: Vec<Pin>,
    /// All boards.
    pub boards: Vec<Board>,
    /// All devices in file order.
    pub devices: Vec<Device>,
    /// All DMA users.
    pub dma: Vec<DmaUser>,
    /// Number of soft rules.
    pub rules: u32,
    /// Number of resources.
    pub resources: u32,
    /// Number of DMA streams.
    pub streams: u32,
}
