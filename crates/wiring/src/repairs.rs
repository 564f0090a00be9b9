//! What would help where there is no wiring: changes that were each tried by solving.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use sensedsl_board::pin::PinName;
use sensedsl_board::silicon::PinRole;
use sensedsl_board::table::{Occupation, release_name};
use sensedsl_diagnostics::codes::e0404_out_of_time;
use sensedsl_model::design::{
    Board, BoardIndex, Design, Link, PartIndex, Placement, Spanned, Transport,
};
use sensedsl_model::kind::Kind;

use crate::formulate::{Asker, Formulation};
use crate::names::list;
use crate::offer::roles;
use crate::{Cancel, Solved, Wiring, solver};

/// A change after which there is a wiring.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Repair {
    /// Remove what the file fixes of the device's wiring.
    Free(PartIndex),
    /// Let the devices share a bus.
    Share(Vec<PartIndex>),
    /// Run an output at the frequency of others, so that they can be on one timer.
    Retune(PartIndex, u32),
    /// Let the device go to another board of the file.
    Move(PartIndex, BoardIndex),
    /// Do without a `reserve`.
    Unreserve(BoardIndex, String),
    /// Do without an on-board part.
    Release(BoardIndex, String),
    /// Let the board talk to its host in another way, or not at all.
    Relink(BoardIndex, Transport),
    /// Leave the device out.
    Drop(PartIndex),
}

/// A repair with a wiring after it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repaired {
    /// The change.
    pub repair: Repair,
    /// The opportunity cost of that wiring.
    pub cost: u32,
    /// Whether that is known to be the least there is after the change.
    pub is_best: bool,
}

/// What is known of changes that could help.
#[derive(Debug, Default)]
pub(crate) struct Repairs {
    /// Those that do, the gentlest first.
    pub found: Vec<Repaired>,
    /// Whether all others are known not to help: none was too hard, and none too many.
    pub complete: bool,
}

impl Repair {
    /// The word of the JSON output.
    #[must_use]
    pub const fn action(&self) -> &'static str {
        match self {
            Self::Free(_) => "free",
            Self::Share(_) => "share",
            Self::Retune(..) => "retune",
            Self::Move(..) => "move",
            Self::Unreserve(..) => "unreserve",
            Self::Release(..) => "release",
            Self::Relink(..) => "link",
            Self::Drop(_) => "drop",
        }
    }

    /// The device that is changed, where it is a single one.
    #[must_use]
    pub const fn device(&self) -> Option<PartIndex> {
        match self {
            Self::Free(device)
            | Self::Retune(device, _)
            | Self::Move(device, _)
            | Self::Drop(device) => Some(*device),
            Self::Share(devices) => match devices.as_slice() {
                [device] => Some(*device),
                _ => None,
            },
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => None,
        }
    }

    /// The repair as an instruction.
    #[must_use]
    pub fn describe(&self, design: &Design) -> String {
        let device = |index: &PartIndex| design.part_name(*index);
        let board =
            |index: &BoardIndex| design.board(*index).map_or("", |board| board.name.value.as_str());
        match self {
            Self::Free(index) => format!("remove the fixed pins or place of {}", device(index)),
            Self::Share(devices) => {
                let names: Vec<&str> = devices.iter().map(device).collect();
                let bus = if names.len() == 1 { "its bus" } else { "a bus" };
                format!("let {} share {bus}", list(&names, "and"))
            }
            Self::Retune(index, hz) => format!("run {} at {hz} Hz", device(index)),
            Self::Move(index, to) => format!("move {} to {}", device(index), board(to)),
            Self::Unreserve(on, name) if design.boards.len() > 1 => {
                format!("do not reserve {name} of {}", board(on))
            }
            Self::Unreserve(_, name) => format!("do not reserve {name}"),
            Self::Release(on, part) => match needed(design, *on, part) {
                Some(role) => format!("release {part}, a pin of {}", role.describe()),
                None => format!("release {}", release_name(part)),
            },
            Self::Relink(on, to) => {
                let to = to.name();
                let unasked = design.board(*on).is_some_and(|board| !board.link.stated);
                let why = if unasked { ": nothing in the file asks for the link" } else { "" };
                format!("write `link {{ transport = {to}; }}` in {}{why}", board(on))
            }
            Self::Drop(index) => format!("leave out {}", device(index)),
        }
    }

    /// Whether it does something to devices alone, and nothing to a board.
    const fn is_of_devices(&self) -> bool {
        match self {
            Self::Free(_) | Self::Share(_) | Self::Retune(..) | Self::Move(..) | Self::Drop(_) => {
                true
            }
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => false,
        }
    }

    /// The same change in a design that has only `parts`, which are in order.
    fn renumbered(&self, parts: &[PartIndex]) -> Self {
        let new = |old: &PartIndex| PartIndex(parts.partition_point(|part| part < old));
        match self {
            Self::Free(part) => Self::Free(new(part)),
            Self::Share(all) => Self::Share(all.iter().map(new).collect()),
            Self::Retune(part, hz) => Self::Retune(new(part), *hz),
            Self::Move(part, to) => Self::Move(new(part), *to),
            Self::Drop(part) => Self::Drop(new(part)),
            Self::Unreserve(..) | Self::Release(..) | Self::Relink(..) => self.clone(),
        }
    }

    /// The design after the change.
    fn applied(&self, design: &Design) -> Design {
        let mut design = design.clone();
        match self {
            Self::Free(index) => {
                for wires in design.connections_of_mut(*index) {
                    wires.placement = Placement::default();
                }
            }
            Self::Share(devices) => {
                for wires in &mut design.connections {
                    if let Kind::I2c(i2c) = &mut wires.kind
                        && devices.contains(&wires.part)
                    {
                        i2c.exclusive = false;
                    }
                }
            }
            Self::Retune(index, hz) => {
                for wires in design.connections_of_mut(*index) {
                    if let Kind::Pwm(pwm) = &mut wires.kind {
                        pwm.frequency_hz = *hz;
                    }
                }
            }
            Self::Move(index, to) => {
                for wires in design.connections_of_mut(*index) {
                    wires.board = Some(*to);
                }
            }
            Self::Unreserve(on, name) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.reserved.retain(|rule| rule.value != *name);
                }
            }
            Self::Release(on, part) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    let span = board.name.span;
                    board.released.push(Spanned { value: release_name(part).to_uppercase(), span });
                }
            }
            Self::Relink(on, to) => {
                if let Some(board) = design.boards.get_mut(on.0) {
                    board.link = Link { transport: *to, unit: None, ..board.link.clone() };
                    board.link.pins.clear();
                }
            }
            Self::Drop(index) => {
                design.retain_parts(|part, _| part != *index);
            }
        }
        design
    }
}

/// So many changes are tried; each costs a search for the best wiring. Of a conflict in a robot
/// there are a few dozen.
const TRIED_MAX: usize = 256;

/// Steps of the search that a change is worth, in the first round and in the second.
const SHARES: [u64; 2] = [400, 3_000];

/// Steps that all changes are worth together.
const STEPS_MAX: u64 = 12_000;

/// The repairs that work, the gentlest first: another link where the file asks for none, then
/// freeing what was fixed, then sharing, then moving, then doing without something, then leaving a
/// device out; within each the cheapest wiring first. At most [`TRIED_MAX`] are tried: before all
/// others what concerns a link or one device alone, of which there are three each. Each has its share
/// of the steps, so that hard ones are left out.
pub(crate) fn find(
    design: &Design,
    formulation: &Formulation<'_>,
    parts: &[PartIndex],
    cancel: Cancel<'_>,
) -> Repairs {
    let mut budget = Budget { steps: STEPS_MAX, cancel };
    let mut proposals = proposals(design, parts);
    proposals.sort_by_key(|repair| !is_of_one_device(repair));
    let mut repairs = Repairs { found: Vec::new(), complete: proposals.len() <= TRIED_MAX };
    proposals.truncate(TRIED_MAX);
    // What has no wiring without any of the devices has none whatever is done to them.
    let others = retained(design, |part| !parts.contains(&part));
    if budget.is_impossible(&others) {
        proposals.retain(|repair| !repair.is_of_devices());
    }
    // They are few, so most that is no help is soon known by them alone.
    let devices = retained(design, |part| parts.contains(&part));
    proposals.retain(|repair| match repair {
        // The conflict is minimal.
        Repair::Drop(_) => true,
        _ => !budget.is_impossible(&repair.renumbered(parts).applied(&devices)),
    });
    let mut alike = Alike::new(formulation);
    // What is quickly known of each first: a hard one does not cost the others their turn.
    for share in SHARES {
        alike.unknown.clear();
        proposals.retain(|repair| {
            let as_well_as = alike.of(design, formulation, repair);
            let known = as_well_as.and_then(|change| alike.known(change));
            let tried = known.unwrap_or_else(|| budget.tried(design, repair, share));
            if let Some(change) = as_well_as {
                alike.learn(change, tried);
            }
            if let Tried::Helps { cost, is_best } = tried {
                repairs.found.push(Repaired { repair: repair.clone(), cost, is_best });
            }
            tried == Tried::Unknown
        });
    }
    repairs.complete &= proposals.is_empty();
    if !repairs.found.iter().any(|one| matches!(one.repair, Repair::Share(_))) {
        repairs.found.extend(sharing(design, parts, &mut budget));
    }
    repairs.found.sort_by_key(|one| (rank(design, &one.repair), one.cost));
    repairs
}

/// The design with these of its parts alone, which get new numbers.
fn retained(design: &Design, holds: impl Fn(PartIndex) -> bool) -> Design {
    let mut some = design.clone();
    some.retain_parts(|part, _| holds(part));
    some
}

/// What is known of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tried {
    /// There is a wiring after it that costs so much.
    Helps { cost: u32, is_best: bool },
    /// There is none.
    IsNoHelp,
    /// It takes more than its share of the steps to tell.
    Unknown,
}

/// What devices have in common that can stand for each other: their choices, and what decides on
/// their converters.
type Likeness = (usize, u32, i8);

/// What is done to a device that may be one of several that are alike: it goes to a board, or is left
/// out. To do it to another of them helps as much.
type Change = (Likeness, Option<BoardIndex>);

/// What is known of changes to devices that are alike.
struct Alike {
    /// For each device of the problem the first that is like it.
    first: Vec<usize>,
    tried: BTreeMap<Change, Tried>,
    unknown: BTreeSet<Change>,
}

impl Alike {
    fn new(formulation: &Formulation<'_>) -> Self {
        let first = solver::alike(&formulation.problem).unwrap_or_default();
        Self { first, tried: BTreeMap::new(), unknown: BTreeSet::new() }
    }

    fn of(
        &self,
        design: &Design,
        formulation: &Formulation<'_>,
        repair: &Repair,
    ) -> Option<Change> {
        let (index, to) = match repair {
            Repair::Drop(index) => (*index, None),
            Repair::Move(index, to) => (*index, Some(*to)),
            _ => return None,
        };
        let of_part = |asker: &Asker| {
            let Asker::Connection(connection) = asker else { return None };
            design.connection(*connection).filter(|one| one.part == index)
        };
        let mut all = formulation.askers.iter().enumerate();
        let (number, connection) = all.find_map(|(at, asker)| Some((at, of_part(asker)?)))?;
        // Several sets of wires are alike only as a whole.
        if all.any(|(_, asker)| of_part(asker).is_some()) {
            return None;
        }
        let device = design.device(connection.device)?;
        Some(((*self.first.get(number)?, device.delay_ms, device.prio), to))
    }

    fn known(&self, change: Change) -> Option<Tried> {
        if self.unknown.contains(&change) {
            return Some(Tried::Unknown);
        }
        self.tried.get(&change).copied()
    }

    fn learn(&mut self, change: Change, tried: Tried) {
        if tried == Tried::Unknown {
            self.unknown.insert(change);
        } else {
            self.tried.insert(change, tried);
        }
    }
}

/// What may still be spent on repairs. It counts steps of the search, so that the same file gets the
/// same repairs on every machine; the end of the command bounds it in addition.
struct Budget<'a> {
    steps: u64,
    cancel: Cancel<'a>,
}

impl Budget<'_> {
    fn tried(&mut self, design: &Design, repair: &Repair, share: u64) -> Tried {
        let best = self.spend(&repair.applied(design), share, |wiring| wiring.one_of_the_best());
        match best {
            Some(Some(Solved::Wired(wiring))) => {
                Tried::Helps { cost: wiring.cost, is_best: wiring.bound.is_none() }
            }
            Some(Some(Solved::Failed(why))) if why.code == e0404_out_of_time::CODE => {
                Tried::Unknown
            }
            Some(None | Some(Solved::Infeasible(_) | Solved::Failed(_))) => Tried::IsNoHelp,
            None => Tried::Unknown,
        }
    }

    /// Whether it is soon known that the design has no wiring.
    fn is_impossible(&mut self, design: &Design) -> bool {
        self.spend(design, SHARES[0], |wiring| wiring.is_impossible()) == Some(true)
    }

    /// Asks within the share of the steps; nothing where there are no more.
    fn spend<T>(
        &mut self,
        design: &Design,
        share: u64,
        ask: impl Fn(&Wiring<'_>) -> T,
    ) -> Option<T> {
        let share = share.min(self.steps);
        let spent = AtomicU64::new(0);
        // What it takes to put the problem is no step.
        let is_put = AtomicBool::new(false);
        let over = || {
            let counts = is_put.load(Ordering::Relaxed);
            counts && spent.fetch_add(1, Ordering::Relaxed) >= share || self.cancel.is_over()
        };
        if share == 0 || self.cancel.is_over() {
            return None;
        }
        let wiring = Wiring::within(design, None, Cancel::when(&over));
        is_put.store(true, Ordering::Relaxed);
        let answer = ask(&wiring);
        drop(wiring);
        self.steps -= spent.into_inner().min(share);
        Some(answer)
    }
}

/// The first two devices, or else all, that would help by sharing a bus.
fn sharing(design: &Design, parts: &[PartIndex], budget: &mut Budget<'_>) -> Option<Repaired> {
    let exclusive = |index: &&PartIndex| is_exclusive(design, **index);
    let exclusive: Vec<PartIndex> = parts.iter().filter(exclusive).copied().collect();
    let (first, others) = exclusive.split_first()?;
    let pairs = others.iter().map(|other| vec![*first, *other]);
    pairs.take(TRIED_MAX).chain([exclusive.clone()]).find_map(|some| {
        let repair = Repair::Share(some);
        match budget.tried(design, &repair, SHARES[1]) {
            Tried::Helps { cost, is_best } => Some(Repaired { repair, cost, is_best }),
            Tried::IsNoHelp | Tried::Unknown => None,
        }
    })
}

fn is_exclusive(design: &Design, part: PartIndex) -> bool {
    let mut connections = design.connections_of(part);
    connections.any(|one| matches!(&one.kind, Kind::I2c(i2c) if i2c.exclusive))
}

const fn is_of_one_device(repair: &Repair) -> bool {
    match repair {
        Repair::Relink(..) | Repair::Free(_) | Repair::Share(_) | Repair::Drop(_) => true,
        Repair::Retune(..) | Repair::Move(..) | Repair::Unreserve(..) | Repair::Release(..) => {
            false
        }
    }
}

fn rank(design: &Design, repair: &Repair) -> usize {
    match repair {
        Repair::Relink(on, _) if design.board(*on).is_some_and(|board| !board.link.stated) => 0,
        Repair::Free(_) => 0,
        Repair::Share(_) => 1,
        Repair::Retune(..) => 2,
        Repair::Move(..) => 3,
        Repair::Unreserve(..) => 4,
        Repair::Release(..) => 5,
        Repair::Relink(..) => 6,
        Repair::Drop(_) => 7,
    }
}

/// The other frequencies at which outputs of the conflict run.
fn frequencies<'a>(
    design: &'a Design,
    parts: &'a [PartIndex],
    part: PartIndex,
) -> impl Iterator<Item = u32> {
    let hz = |part: PartIndex| {
        let outputs = design.connections_of(part).filter_map(|one| one.kind.pwm());
        outputs.map(|pwm| pwm.frequency_hz).next()
    };
    let own = hz(part);
    let all = parts.iter().filter_map(move |index| hz(*index));
    let others: BTreeSet<u32> = all.filter(|hz| own.is_some_and(|own| own != *hz)).collect();
    others.into_iter()
}

/// What the MCU needs a pin for that is named so.
fn needed(design: &Design, on: BoardIndex, pin: &str) -> Option<PinRole> {
    let pin = PinName::parse(pin)?;
    roles(design.board(on)?).get(&pin).copied()
}

/// Other links that the board could have; only none where the file asks for the one it has.
fn links(board: &Board) -> impl Iterator<Item = Transport> {
    let has_usb = board.profile().is_some_and(|profile| profile.usb(None).is_some());
    let others = [(Transport::Usb, has_usb), (Transport::Uart, board.profile().is_some())];
    let (now, stated) = (board.link.transport, board.link.stated);
    let linked = board.profile().is_some() && now != Transport::None;
    let others = others.into_iter().filter(move |(_, can)| *can && !stated).map(|(to, _)| to);
    others.chain([Transport::None]).filter(move |to| linked && *to != now)
}

/// Changes that could help the devices of a conflict.
fn proposals(design: &Design, parts: &[PartIndex]) -> Vec<Repair> {
    let mut proposals = Vec::new();
    let mut boards: Vec<BoardIndex> = Vec::new();
    for index in parts {
        let Some(part) = design.part(*index) else { continue };
        if design.connections_of(*index).any(|one| one.placement != Placement::default()) {
            proposals.push(Repair::Free(*index));
        }
        if is_exclusive(design, *index) {
            proposals.push(Repair::Share(vec![*index]));
        }
        proposals.extend(frequencies(design, parts, *index).map(|hz| Repair::Retune(*index, hz)));
        if let Some(bound) = part.board {
            boards.push(bound);
            let others = (0..design.boards.len()).map(BoardIndex).filter(|to| *to != bound);
            proposals.extend(others.map(|to| Repair::Move(*index, to)));
        } else {
            boards.extend((0..design.boards.len()).map(BoardIndex));
        }
        proposals.push(Repair::Drop(*index));
    }
    boards.sort_unstable();
    boards.dedup();
    for on in boards {
        let Some(board) = design.board(on) else { continue };
        proposals.extend(links(board).map(|to| Repair::Relink(on, to)));
        let needed = roles(board).into_iter().filter(|(_, role)| *role != PinRole::Oscillator);
        let needed = needed.filter(|(pin, _)| board.table.pin(pin).is_some());
        proposals.extend(needed.map(|(pin, _)| Repair::Release(on, pin.to_string())));
        let names = board.reserved.iter().map(|rule| rule.value.clone());
        proposals.extend(names.map(|name| Repair::Unreserve(on, name)));
        let mut parts: Vec<String> = board
            .table
            .pins
            .iter()
            .filter_map(|pin| pin.onboard.as_ref())
            .filter(|part| part.how == Occupation::Taken)
            .map(|part| part.part.clone())
            .collect();
        parts.sort();
        parts.dedup();
        proposals.extend(parts.into_iter().map(|part| Repair::Release(on, part)));
    }
    proposals
}
