//! The pins of a board that devices may use at all, and the reasons why they may not use the
//! others.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::place::Place;
use sensedsl_board::profile::{self, TargetProfile};
use sensedsl_board::remap::{Blocks, agree_by_pairs};
use sensedsl_board::silicon::{self, PinRole, Silicon};
use sensedsl_board::table::{Occupation, Pin, Role, Usage, release_name};
use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Board, BoardIndex, Design, PreferenceSubject, Transport};
use sensedsl_model::kind;

/// The part that may be on the pins of an oscillator.
const CRYSTAL: &str = "the oscillator's crystal";

/// The reason why a pin is not offered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Withheld {
    /// A `reserve` rule names it.
    Reserved(Span),
    /// An on-board part has it.
    Onboard(String),
    /// The link to the host has it.
    Link,
    /// The MCU needs it for itself.
    Needed(PinRole),
    /// It is on no connector of the board.
    NoConnector,
}

impl Withheld {
    /// What keeps the pin, for people; nothing for a pin on no connector, which nothing keeps.
    fn holder(&self) -> Option<String> {
        match self {
            Self::Reserved(_) => Some("a `reserve` rule of the design".to_owned()),
            Self::Onboard(part) => Some(part.clone()),
            Self::Link => Some("the link to the host".to_owned()),
            Self::Needed(role) => Some(role.describe().to_owned()),
            Self::NoConnector => None,
        }
    }
}

/// The pins of a board that no device may use as long as the design stays as it is, each with what keeps it, for
/// people. Pins on no connector are not among them.
#[must_use]
pub fn kept_back(design: &Design, on: BoardIndex) -> BTreeMap<PinName, String> {
    let Some(board) = design.board(on) else { return BTreeMap::new() };
    let offer = Offer::new(design, on, board);
    let pins = board.table.pins.iter().enumerate();
    pins.filter_map(|(at, pin)| Some((pin.name.clone(), offer.why_withheld(at)?.holder()?)))
        .collect()
}

/// The `reserve` and `release` rules of a board, indexed by what they name, so that each pin is
/// looked up.
struct Rules<'a> {
    /// The first rule that reserves the pin.
    reserved: BTreeMap<String, Span>,
    /// The names that are reserved, as they are spelled: a peripheral has only one spelling.
    reserved_units: BTreeSet<&'a str>,
    released: BTreeSet<String>,
    /// The names that are released, in capitals, as on-board parts are compared in capitals.
    released_parts: BTreeSet<String>,
    /// The pins that devices are fixed to, or prefer.
    named: BTreeSet<PinName>,
}

impl<'a> Rules<'a> {
    fn of(board: &'a Board, named: BTreeSet<PinName>) -> Self {
        let mut reserved = BTreeMap::new();
        for rule in &board.reserved {
            if let Some(pin) = PinName::parse(&rule.value) {
                reserved.entry(pin.as_str().to_owned()).or_insert(rule.span);
            }
        }
        let released = || board.released.iter().map(|rule| &rule.value);
        Self {
            reserved,
            reserved_units: board.reserved.iter().map(|rule| rule.value.as_str()).collect(),
            released: released()
                .filter_map(|name| Some(PinName::parse(name)?.as_str().to_owned()))
                .collect(),
            released_parts: released().map(|name| name.to_uppercase()).collect(),
            named,
        }
    }

    /// Whether a rule frees the pin from its on-board part.
    fn release(&self, pin: &Pin) -> bool {
        let by_part = |part: &str| self.released_parts.contains(&release_name(part).to_uppercase());
        self.released.contains(pin.name.as_str())
            || pin.onboard.as_ref().is_some_and(|onboard| by_part(&onboard.part))
    }
}

/// A board and its pins as devices may use them.
pub(crate) struct Offer<'a> {
    pub(crate) index: BoardIndex,
    pub(crate) board: &'a Board,
    silicon: Option<&'static Silicon>,
    /// Pins that are inputs of a converter and nothing else.
    analog_only: BTreeSet<PinName>,
    /// Pins that cannot put anything out.
    input_only: BTreeSet<PinName>,
    rules: Rules<'a>,
    /// For each pin of the table, why it is withheld.
    withheld: Vec<Option<Withheld>>,
    /// For each pin of the table, what else is on it, if devices may use it all the same.
    shared: Vec<Option<String>>,
    /// For each pin of the table, the contact that it shares with others.
    pads: Vec<Option<String>>,
    /// For each peripheral that remaps its signals, the sets of blocks they are in.
    remaps: BTreeMap<String, Remaps>,
}

impl<'a> Offer<'a> {
    pub(crate) fn new(design: &Design, index: BoardIndex, board: &'a Board) -> Self {
        let fixed = design.connections.iter().flat_map(|one| &one.placement.pins);
        let fixed = fixed.map(|(_, pin)| &pin.value);
        let wishes = design.connections.iter().flat_map(|one| &one.wishes).chain(&board.wishes);
        let preferred = wishes.filter(|wish| wish.prefer).filter_map(|wish| match &wish.what {
            PreferenceSubject::Pin(_, pin) => Some(pin),
            PreferenceSubject::Unit(_)
            | PreferenceSubject::Side(_)
            | PreferenceSubject::Header(_)
            | PreferenceSubject::Together(_)
            | PreferenceSubject::Sequence => None,
        });
        let named = fixed.chain(preferred).filter_map(|pin| pin.on(index).cloned()).collect();
        Self::by_rules(index, board, Rules::of(board, named))
    }

    /// The same board with one more `release`.
    pub(crate) fn with_released(&self, pin: &PinName) -> Self {
        let mut rules = Rules::of(self.board, self.rules.named.clone());
        rules.released.insert(pin.as_str().to_owned());
        Self::by_rules(self.index, self.board, rules)
    }

    fn by_rules(index: BoardIndex, board: &'a Board, rules: Rules<'a>) -> Self {
        let pins = &board.table.pins;
        let roles = roles(board);
        let why = |pin| withheld(board, &rules, &roles, pin);
        let mut withheld: Vec<_> = pins.iter().map(why).collect();
        let pads = shared_pads(pins);
        keep_pads_free(pins, &rules, &pads, &mut withheld);
        let shared = pins.iter().map(|pin| shared(board, &rules, &roles, pin)).collect();
        let silicon = board.silicon();
        let mut analog_only = board.mcu.as_deref().map(silicon::analog_only).unwrap_or_default();
        // `PC3_C` is the converter's side of a switch. If `PC3` is there too, that is the port's.
        let is_beside = |pin: &&Pin| {
            let of_port = pin.name.as_str().strip_suffix("_C").and_then(PinName::parse);
            of_port.is_some_and(|name| board.table.pin(&name).is_some())
        };
        let sides = board.table.pins.iter().filter(is_beside).map(|pin| pin.name.clone());
        analog_only.extend(sides);
        let input_only = board.mcu.as_deref().map(silicon::input_only).unwrap_or_default();
        let remaps = remaps(pins);
        Self {
            index,
            board,
            silicon,
            analog_only,
            input_only,
            rules,
            withheld,
            shared,
            pads,
            remaps,
        }
    }

    /// The other thing that is on a pin that devices may use all the same.
    pub(crate) fn shared_with(&self, pin: usize) -> Option<&str> {
        self.shared.get(pin)?.as_deref()
    }

    /// The contact of a pin, if other pins are on it too.
    pub(crate) fn shared_pad(&self, pin: usize) -> Option<&str> {
        self.pads.get(pin)?.as_deref()
    }

    /// The peripheral and the remap blocks of a usage, if its place depends on them.
    pub(crate) fn blocks(&self, usage: &Usage) -> Option<(String, Blocks)> {
        let unit = unit(usage)?;
        let blocks = usage.blocks?;
        let by_pairs = self.remaps.get(&unit)?.by_pairs;
        Some((unit, if by_pairs { blocks } else { blocks.lowest() }))
    }

    /// The sets of blocks that other signals of the peripheral are in and that exclude these.
    pub(crate) fn other_blocks(&self, unit: &str, blocks: Blocks) -> Vec<Blocks> {
        let sets = self.remaps.get(unit).map(|remaps| remaps.sets.as_slice()).unwrap_or_default();
        sets.iter().copied().filter(|other| other.and(blocks).is_none()).collect()
    }

    pub(crate) fn why_withheld(&self, pin: usize) -> Option<&Withheld> {
        self.withheld.get(pin)?.as_ref()
    }

    /// The pins that are offered, with their index in the table.
    pub(crate) fn pins(&self) -> impl Iterator<Item = (usize, &'a Pin)> {
        let pins = self.board.table.pins.iter().enumerate();
        pins.filter(|(index, _)| self.why_withheld(*index).is_none())
    }

    /// True if an on-board part leaves the pin only to further devices of its bus.
    pub(crate) fn bus_only(&self, pin: &Pin) -> bool {
        let on_bus = pin.onboard.as_ref().is_some_and(|part| part.how == Occupation::Bus);
        on_bus && !self.rules.release(pin)
    }

    /// True for a pin that cannot carry a digital signal.
    pub(crate) fn is_analog_only(&self, pin: &Pin) -> bool {
        self.analog_only.contains(&pin.name)
    }

    /// Whether the pin can be the wire as a GPIO, given which end drives it.
    pub(crate) fn is_gpio(&self, pin: &Pin, role: kind::Role) -> bool {
        let is_input = role.is_driven_by_device() || !self.input_only.contains(&pin.name);
        is_input && !self.is_analog_only(pin)
    }

    /// Whether the pin's edges can interrupt, as far as that is known.
    pub(crate) fn interrupts_at(&self, pin: &Pin) -> bool {
        self.board.profile().is_none_or(|profile| profile.interrupts_at(&pin.name))
    }

    /// Whether a name in a file means this peripheral instance of the board.
    pub(crate) fn same_unit(&self, written: &str, unit: &str) -> bool {
        written == unit || self.silicon.is_some_and(|silicon| silicon.same_unit(written, unit))
    }

    /// True if a rule reserves the peripheral instance, or if it cannot work beside the link.
    pub(crate) fn unit_reserved(&self, unit: &str) -> bool {
        self.rules.reserved_units.iter().any(|rule| self.same_unit(rule, unit))
            || self.excluded_by_link(unit)
    }

    /// True if the MCU's USB device is the link and keeps the peripheral instance from working.
    pub(crate) fn excluded_by_link(&self, unit: &str) -> bool {
        let profile = self.board.profile();
        let usb = profile.filter(|_| self.board.link.transport == Transport::Usb);
        let excludes = usb.and_then(|profile| profile.usb(None)).map(|usb| usb.excludes.as_slice());
        let unit = profile.and_then(|profile| profile.unit(unit));
        unit.is_some_and(|unit| excludes.unwrap_or_default().contains(&unit.name))
    }
}

/// The contact of each pin that is not the only one there; a position on the package is one as well. Pins that share
/// contacts, directly or over others, have the same one.
fn shared_pads(pins: &[Pin]) -> Vec<Option<String>> {
    let keys = |pin: &Pin| -> Vec<String> {
        let key = |place: &Place| place.contact().or_else(|| place.position.clone());
        pin.places.iter().filter_map(key).collect()
    };
    let mut at: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, pin) in pins.iter().enumerate() {
        keys(pin).into_iter().for_each(|key| at.entry(key).or_default().push(index));
    }
    let mut pads: Vec<Option<String>> = vec![None; pins.len()];
    for (key, sharing) in at.into_iter().filter(|(_, sharing)| sharing.len() > 1) {
        let known: Vec<String> =
            sharing.iter().filter_map(|index| pads.get(*index)?.clone()).collect();
        for (index, pad) in pads.iter_mut().enumerate() {
            if sharing.contains(&index) || pad.as_ref().is_some_and(|pad| known.contains(pad)) {
                *pad = Some(key.clone());
            }
        }
    }
    pads
}

/// The remap blocks of a peripheral's signals.
struct Remaps {
    /// Each set once, ascending.
    sets: Vec<Blocks>,
    /// Whether it is enough if devices agree in pairs. It is on all MCUs there are; if a table says
    /// otherwise, each signal is offered only in its lowest block.
    by_pairs: bool,
}

/// The peripheral of a usage.
fn unit(usage: &Usage) -> Option<String> {
    let unit = usage.signal.function().units().into_iter().next()?;
    Some(unit.as_str().to_owned())
}

fn remaps(pins: &[Pin]) -> BTreeMap<String, Remaps> {
    let mut sets: BTreeMap<String, BTreeSet<Blocks>> = BTreeMap::new();
    for usage in pins.iter().flat_map(|pin| &pin.usages).filter(|usage| usage.blocks.is_some()) {
        if let (Some(unit), Some(blocks)) = (unit(usage), usage.blocks) {
            sets.entry(unit).or_default().insert(blocks);
        }
    }
    let remaps = |sets: BTreeSet<Blocks>| {
        let sets: Vec<Blocks> = sets.into_iter().collect();
        if agree_by_pairs(&sets) {
            return Remaps { sets, by_pairs: true };
        }
        let lowest: BTreeSet<Blocks> = sets.into_iter().map(Blocks::lowest).collect();
        Remaps { sets: lowest.into_iter().collect(), by_pairs: false }
    };
    sets.into_iter().map(|(unit, sets)| (unit, remaps(sets))).collect()
}

/// Whatever withholds a pin also withholds all others on its contact, except those that a rule
/// releases.
fn keep_pads_free(
    pins: &[Pin],
    rules: &Rules<'_>,
    pads: &[Option<String>],
    withheld: &mut [Option<Withheld>],
) {
    let reasons: BTreeMap<&str, Withheld> = pads
        .iter()
        .zip(withheld.iter())
        .filter_map(|(pad, why)| Some((pad.as_deref()?, why.clone()?)))
        .collect();
    for ((pad, why), pin) in pads.iter().zip(withheld).zip(pins) {
        if why.is_none() && !rules.released.contains(pin.name.as_str()) {
            *why = pad.as_deref().and_then(|pad| reasons.get(pad)).cloned();
        }
    }
}

fn withheld(
    board: &Board,
    rules: &Rules<'_>,
    roles: &BTreeMap<PinName, PinRole>,
    pin: &Pin,
) -> Option<Withheld> {
    if let Some(rule) = rules.reserved.get(pin.name.as_str()) {
        return Some(Withheld::Reserved(*rule));
    }
    let profile = board.profile();
    if profile.is_some_and(|profile| is_of_usb_link(board, profile, pin)) {
        return Some(Withheld::Link);
    }
    // The part at the other end of a wired link is what the link talks to.
    if rules.release(pin) || board.link.pins.contains(&pin.name) {
        return None;
    }
    if let Some(part) = &pin.onboard
        && part.how == Occupation::Taken
    {
        return Some(Withheld::Onboard(part.part.clone()));
    }
    let role = roles.get(&pin.name).copied().filter(|role| *role != PinRole::Oscillator);
    if let Some(role) = role {
        return Some(Withheld::Needed(role));
    }
    let is_off = board.table.is_off_connectors(pin) && !rules.named.contains(&pin.name);
    is_off.then_some(Withheld::NoConnector)
}

/// The other thing that is on the pin, whether or not the pin is withheld. The board's table states
/// whether a crystal is fitted; a table without a column for it is of a bare part.
fn shared(
    board: &Board,
    rules: &Rules<'_>,
    roles: &BTreeMap<PinName, PinRole>,
    pin: &Pin,
) -> Option<String> {
    if rules.release(pin) || board.link.pins.contains(&pin.name) {
        return None;
    }
    if let Some(part) = &pin.onboard {
        return Some(part.part.clone());
    }
    let is_bare = board.table.columns.iter().all(|column| column.role != Role::Onboard);
    let crystal = is_bare && roles.get(&pin.name) == Some(&PinRole::Oscillator);
    crystal.then(|| CRYSTAL.to_owned())
}

/// The pins that the board's MCU needs for itself.
pub(crate) fn roles(board: &Board) -> BTreeMap<PinName, PinRole> {
    let mut roles = board.mcu.as_deref().map(silicon::pin_roles).unwrap_or_default();
    let debug = board.profile().into_iter().flat_map(|profile| &profile.debug.pins);
    roles.extend(debug.map(|pin| (pin.clone(), PinRole::Debug)));
    roles
}

/// Whether the link to the host takes the pin: no rule can release it.
fn is_of_usb_link(board: &Board, profile: &TargetProfile, pin: &Pin) -> bool {
    if board.link.transport != Transport::Usb {
        return false;
    }
    let links = board.facts.iter().flat_map(|facts| &facts.link);
    let mut links = links.filter(|link| link.transport == profile::Transport::Usb);
    let vbus = profile.usb(None).and_then(|usb| usb.vbus.as_ref());
    // The file has the last word on this pin, also where a built-in board with the same MCU has it wired.
    if vbus.is_some_and(|vbus| *vbus == pin.name) {
        return board.link.vbus;
    }
    profile.link_pins(profile::Transport::Usb, None).contains(&pin.name)
        || links.any(|link| link.pins.contains(&pin.name))
}
