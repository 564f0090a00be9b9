//! Pins and peripherals: those that can serve a wire on the boards that the device may go to, the best ones first.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::{PinName, natural};
use sensedsl_board::place::Place;
use sensedsl_board::silicon;
use sensedsl_board::table::{Occupation, Pin, release_name};
use sensedsl_model::design::{Board, BoardIndex, Design};
use sensedsl_model::kind::{KindName, Role, Serves, Sharing};
use sensedsl_report::Row;
use sensedsl_wiring::kept_back;

use super::item::Item;
use super::subject::Subject;
use crate::protocol::completion::{MODULE, VALUE};
use crate::wires;

/// A wire that a pin is wanted for.
type Wanted = (KindName, Role);

/// The pins that can be one of these wires; all pins if none is given.
pub(super) fn pins(subject: &Subject<'_, '_>, wanted: &[Wanted]) -> Vec<Item> {
    let listed: Vec<String> = subject.site.words().iter().map(|word| word.to_uppercase()).collect();
    let wired = subject.cx.wired.as_ref().and_then(|wired| wired.wired());
    let rows = wired.map(wires::all).unwrap_or_default();
    let mut items: BTreeMap<PinName, Item> = BTreeMap::new();
    for (design, index, board) in subject.boards() {
        let on = OnBoard::new(design, index, board, &rows);
        for (pin, at) in board.table.pins.iter().zip(0_u32..) {
            let is_listed = listed.contains(&pin.name.as_str().to_uppercase());
            if !is_listed && on.serves(pin, wanted) {
                let state = on.state(pin, wanted, subject.part());
                let item = || {
                    item(pin, board, &state).rank(state.rank * 1_000_000 + pin.cost() * 1_000 + at)
                };
                items.entry(pin.name.clone()).or_insert_with(item);
            }
        }
    }
    items.into_values().collect()
}

/// How free a pin is, and in words.
struct State {
    rank: u32,
    words: String,
}

/// A board with what is on its pins.
struct OnBoard<'d> {
    board: &'d Board,
    kept: BTreeMap<PinName, String>,
    /// The parts that are fixed to a pin.
    fixed: BTreeMap<PinName, &'d str>,
    /// The wires of the newest wiring.
    rows: Vec<&'d Row>,
    analog_only: BTreeSet<PinName>,
    input_only: BTreeSet<PinName>,
}

impl<'d> OnBoard<'d> {
    fn new(design: &'d Design, index: BoardIndex, board: &'d Board, rows: &'d [Row]) -> Self {
        let mut fixed = BTreeMap::new();
        for connection in &design.connections {
            for (_, pin) in &connection.placement.pins {
                if let Some(pin) = pin.value.on(index) {
                    fixed.insert(pin.clone(), design.part_name(connection.part));
                }
            }
        }
        let mcu = board.mcu.as_deref();
        Self {
            board,
            kept: kept_back(design, index),
            fixed,
            rows: rows.iter().filter(|row| row.board == board.name.value).collect(),
            analog_only: mcu.map(silicon::analog_only).unwrap_or_default(),
            input_only: mcu.map(silicon::input_only).unwrap_or_default(),
        }
    }

    /// Whether the pin can be one of these wires.
    fn serves(&self, pin: &Pin, wanted: &[Wanted]) -> bool {
        let can = |(kind, role): &Wanted| {
            let is_gpio = matches!(kind.spec().serves, Serves::AnyPin) || role.is_on_any_pin();
            let is_held_back = self.analog_only.contains(&pin.name)
                || !role.is_driven_by_device() && self.input_only.contains(&pin.name);
            kind.serves(*role, pin) && !(is_gpio && is_held_back)
        };
        wanted.is_empty() || wanted.iter().any(can)
    }

    fn state(&self, pin: &Pin, wanted: &[Wanted], own: Option<&str>) -> State {
        let state = |rank, words: String| State { rank, words };
        if let Some(why) = self.kept.get(&pin.name) {
            return state(5, format!("kept back: {why}"));
        }
        if self.board.link.pins.contains(&pin.name) {
            return state(5, "kept back: the link to the host".to_owned());
        }
        let is_own = |name: &str| own == Some(name);
        let mut here = self.rows.iter().filter(|row| row.pin == pin.name.as_str());
        let user = here.next();
        let shares = |row: &&&Row| {
            let is_bus = |(kind, role): &&Wanted| {
                kind.name() == row.kind
                    && role.name() == row.role
                    && kind.spec().sharing != Sharing::Own
            };
            wanted.iter().any(|one| is_bus(&one))
        };
        if user.is_some_and(|row| is_own(&row.device)) {
            return state(0, "where it is now".to_owned());
        }
        if let Some(row) = user.filter(shares) {
            return state(1, format!("the bus of {}", row.device));
        }
        if let Some(part) = self.fixed.get(&pin.name).filter(|part| !is_own(part)) {
            return state(4, format!("{part} is fixed to it"));
        }
        if let Some(row) = user {
            return state(3, format!("{} is on it, and would move", row.device));
        }
        match &pin.onboard {
            Some(onboard) if onboard.how != Occupation::Taken => {
                state(2, format!("free, beside {}", onboard.part))
            }
            Some(_) | None => state(1, "free".to_owned()),
        }
    }
}

fn item(pin: &Pin, board: &Board, state: &State) -> Item {
    let labels = pin.labels();
    let contacts: Vec<String> = pin.places.iter().filter_map(Place::contact).collect();
    let mut detail = format!("{}, cost {}", state.words, pin.cost());
    for also in labels.iter().copied().chain(contacts.iter().map(String::as_str)) {
        detail.push_str(&format!(" · {also}"));
    }
    let usages: Vec<String> = pin.usages.iter().map(|one| format!("`{}`", one.spelled)).collect();
    let mut text = format!(
        "**{}** of {}\n\n{}",
        pin.name,
        wires::escaped(&board.name.value),
        usages.join(" ")
    );
    if let Some(onboard) = &pin.onboard {
        text.push_str(&format!("\n\nOn the board: {}", wires::escaped(&onboard.part)));
    }
    let words = labels.into_iter().map(str::to_owned).chain(contacts);
    Item::new(pin.name.as_str(), VALUE).detail(detail).documentation(text).words(words)
}

/// The peripherals that can serve these kinds; all if none is given.
pub(super) fn peripherals(subject: &Subject<'_, '_>, kinds: &[KindName]) -> Vec<Item> {
    let mut found: BTreeSet<String> = BTreeSet::new();
    for (_, _, board) in subject.boards() {
        for usage in board.table.pins.iter().flat_map(|pin| &pin.usages) {
            let function = usage.signal.function();
            let can = |kind: &KindName| match kind.spec().serves {
                Serves::AnyPin => false,
                Serves::Signal(is) => Role::ALL.iter().any(|role| is(*role, function)),
            };
            if kinds.is_empty() || kinds.iter().any(can) {
                found.extend(function.units().iter().map(|unit| unit.as_str().to_owned()));
            }
        }
    }
    let mut found: Vec<String> = found.into_iter().collect();
    found.sort_by(|one, other| natural(one, other));
    found.into_iter().zip(10_u32..).map(|(unit, rank)| Item::new(unit, MODULE).rank(rank)).collect()
}

/// The sides or the connectors of the boards.
pub(super) fn places(subject: &Subject<'_, '_>, of: fn(&Pin) -> Vec<&str>) -> Vec<Item> {
    let boards = subject.boards();
    let pins = boards.iter().flat_map(|(_, _, board)| &board.table.pins);
    let mut found: Vec<&str> = pins.flat_map(of).collect();
    found.sort_by(|one, other| natural(one, other));
    found.dedup();
    found.into_iter().zip(10_u32..).map(|(name, rank)| Item::new(name, VALUE).rank(rank)).collect()
}

/// What a rule `release` can free: the on-board parts and the pins that are kept back.
pub(super) fn kept(subject: &Subject<'_, '_>) -> Vec<Item> {
    let mut items: BTreeMap<String, Item> = BTreeMap::new();
    for (design, index, board) in subject.boards() {
        for (pin, why) in kept_back(design, index) {
            let item = Item::new(pin.as_str(), VALUE).detail(why).rank(20);
            items.insert(pin.as_str().to_owned(), item);
        }
        for onboard in board.table.pins.iter().filter_map(|pin| pin.onboard.as_ref()) {
            let name = release_name(&onboard.part);
            let is_name = name.starts_with(|one: char| one.is_ascii_alphabetic());
            if is_name {
                let item = Item::new(&name, MODULE).detail(&onboard.part).rank(10);
                items.insert(name, item);
            }
        }
    }
    items.into_values().collect()
}
