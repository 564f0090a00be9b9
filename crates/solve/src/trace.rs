//! The record of a search that proves a weight: its splits, and the multipliers that narrowed or
//! closed each case.
//!
//! A record names everything by its place in the [`crate::Problem`]. It holds nothing that has to be
//! believed: crate `proof` recomputes every step from the statement of the problem.

use crate::problem::{BoardId, DeviceId, DmaUserId, PinId, ResourceId, RuleId, StreamId};

/// An alternative: its device, and its place in the device.
pub type Way = (DeviceId, usize);

/// Devices that change places, in pairs, each with all that it alone claims and violates.
pub type Exchange = Vec<(DeviceId, DeviceId)>;

/// A record.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// What moved wires, violated rules, shared pins, cost and spare boards weigh.
    pub weights: [u64; 5],
    /// What is opened once for all who use it.
    pub facilities: Vec<Facility>,
    /// Facilities of which so many must be open.
    pub covers: Vec<Cover>,
    /// The cases, depth first: after [`Step::Narrowed`] comes what is left, after [`Step::Split`] the
    /// case that it is taken, then the case that it is refused.
    pub steps: Vec<Step>,
}

/// Something that is opened once for all who use it together: a bus, a timer at one frequency.
#[derive(Clone, Debug, Default)]
pub struct Facility {
    /// Whoever takes one of these uses the facility.
    pub members: Vec<Way>,
    /// What it occupies.
    pub resource: Option<ResourceId>,
    /// The wires that its members hold together: for each, the role of every member.
    pub wires: Vec<Vec<usize>>,
    /// Whose streams it needs.
    pub users: Vec<DmaUserId>,
    /// Resources that one member at a time can hold in it.
    pub slots: Vec<ResourceId>,
}

/// Facilities of which so many must be open, or these devices have no room.
#[derive(Clone, Debug, Default)]
pub struct Cover {
    /// The devices that have to use one of `great` or `small`.
    pub devices: Vec<DeviceId>,
    /// Facilities of which `need` are open.
    pub great: Vec<usize>,
    /// The others, all of which may be open.
    pub small: Vec<usize>,
    /// How many of `great` are needed.
    pub need: usize,
}

/// One step of the record.
#[derive(Clone, Debug)]
pub enum Step {
    /// Nothing is left.
    Dead,
    /// All that is left weighs too much.
    Closed(Multipliers),
    /// Some choices weigh too much.
    Narrowed(Multipliers),
    /// Either it is so, or it is not.
    Split {
        /// The question.
        on: Question,
        /// What puts another device in the place of its own, which is as good for it.
        twins: Vec<Exchange>,
        /// Other boards that are as good for it.
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
    /// Nobody violates the rule.
    Kept(RuleId),
    /// Nobody uses the board.
    Unused(BoardId),
    /// Somebody uses the facility.
    Open(usize),
}

/// What everybody pays for what, in units of weight divided by `1 << shift`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Multipliers {
    /// See above.
    pub shift: u32,
    /// What a pin costs beyond its weight.
    pub pins: Vec<(PinId, i64)>,
    /// What a resource costs.
    pub resources: Vec<(ResourceId, i64)>,
    /// What a stream costs.
    pub streams: Vec<(StreamId, i64)>,
    /// What a device pays to a facility that it uses.
    pub links: Vec<(usize, DeviceId, i64)>,
    /// What the holder of a resource pays to a facility.
    pub tickets: Vec<(usize, ResourceId, i64)>,
    /// What a device pays for a rule that it violates as a whole (0) or by a role (1 and up).
    pub rules: Vec<(RuleId, DeviceId, usize, i64)>,
    /// What an open facility saves for each of its covers.
    pub covers: Vec<(usize, i64)>,
}
