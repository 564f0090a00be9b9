//! The record of a search that proves a weight: its splits, and the multipliers that narrowed or
//! closed each case.
//!
//! A record refers to everything by its index in the [`crate::Problem`]. Nothing in it has to be
//! trusted: crate `proof` recomputes every step from the statement of the problem.

use crate::problem::{BoardId, DeviceId, DmaUserId, PinId, ResourceId, RuleId, StreamId};

/// An alternative: its device, and its index in the device.
pub type Way = (DeviceId, usize);

/// Pairs of devices that change places, each with everything that it alone claims and violates.
pub type Exchange = Vec<(DeviceId, DeviceId)>;

/// A record.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// The weights of moved wires, violated rules, shared pins, cost and spare boards.
    pub weights: [u64; 5],
    /// The facilities.
    pub facilities: Vec<Facility>,
    /// Sets of facilities of which a minimum number must be open.
    pub covers: Vec<Cover>,
    /// The cases, depth first. After [`Step::Narrowed`] comes what is left. After [`Step::Split`]
    /// comes the case in which the choice is taken, then the case in which it is refused.
    pub steps: Vec<Step>,
}

/// Something that is opened once for all who use it together: a bus, a timer at one frequency.
#[derive(Clone, Debug, Default)]
pub struct Facility {
    /// The alternatives that use the facility.
    pub members: Vec<Way>,
    /// The resource that it occupies.
    pub resource: Option<ResourceId>,
    /// The wires that its members hold together: for each, the role of every member.
    pub wires: Vec<Vec<usize>>,
    /// The DMA users whose streams it needs.
    pub users: Vec<DmaUserId>,
    /// Resources in it that only one member at a time can hold.
    pub slots: Vec<ResourceId>,
}

/// Facilities of which a minimum number must be open, or these devices have no room.
#[derive(Clone, Debug, Default)]
pub struct Cover {
    /// The devices, each of which must use one of `great` or `small`.
    pub devices: Vec<DeviceId>,
    /// Facilities of which at least `need` must be open.
    pub great: Vec<usize>,
    /// The other facilities, all of which may be open.
    pub small: Vec<usize>,
    /// How many of `great` are needed.
    pub need: usize,
}

/// One step of the record.
#[derive(Clone, Debug)]
pub enum Step {
    /// Nothing is left.
    Dead,
    /// Everything that is left weighs too much.
    Closed(Multipliers),
    /// Some choices weigh too much and are removed.
    Narrowed(Multipliers),
    /// Two cases: a choice is taken, or it is refused.
    Split {
        /// The choice.
        on: Question,
        /// Exchanges that replace its device by another one that is equally good for it.
        twins: Vec<Exchange>,
        /// Other boards that are equally good for it.
        boards: Vec<BoardId>,
    },
}

/// A choice that is taken or refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// The device takes the alternative.
    Way(DeviceId, usize),
    /// The device takes the alternative, and its role the candidate.
    Wire(DeviceId, usize, usize, usize),
    /// No device violates the rule.
    Kept(RuleId),
    /// No device uses the board.
    Unused(BoardId),
    /// At least one device uses the facility.
    Open(usize),
}

/// The prices of everything, in units of weight divided by `1 << shift`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Multipliers {
    /// The scale of all prices.
    pub shift: u32,
    /// The price of a pin, beyond its weight.
    pub pins: Vec<(PinId, i64)>,
    /// The price of a resource.
    pub resources: Vec<(ResourceId, i64)>,
    /// The price of a stream.
    pub streams: Vec<(StreamId, i64)>,
    /// The price that a device pays to a facility that it uses.
    pub links: Vec<(usize, DeviceId, i64)>,
    /// The price that the holder of a resource pays to a facility.
    pub tickets: Vec<(usize, ResourceId, i64)>,
    /// The price that a device pays for a rule that it violates as a whole (0) or by a role (1 and
    /// up).
    pub rules: Vec<(RuleId, DeviceId, usize, i64)>,
    /// The amount that an open facility saves for each of its covers.
    pub covers: Vec<(usize, i64)>,
}
