//! Arrays with more elements than a board has wires for: the alternatives of all elements in, a
//! report with the counts out.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::codes::{e0322_array_too_long, w0604_unused_rule};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_model::design::{
    BoardIndex, Connection, ConnectionIndex, Design, PreferenceSubject, Together,
};
use sensedsl_wire::Direction;

use super::Placed;
use crate::builder::Meaning;
use crate::converters::units_of;
use crate::formulate::Formulation;

/// Reports the arrays that cannot have a wire for each element, whatever else is on the board.
pub(super) fn too_long(design: &Design, formulation: &Formulation<'_>) -> Vec<Diagnostic> {
    let all = || (0..).map(ConnectionIndex).zip(&design.connections);
    let first = all().filter(|(_, one)| one.element == Some(0));
    first.filter_map(|(_, one)| array(design, formulation, one)).collect()
}

/// Reports rules that want wires on one peripheral although they belong to none.
pub(super) fn without_unit(wires: &Connection) -> Vec<Diagnostic> {
    if wires.element.is_none() || !wires.kind.is_level() {
        return Vec::new();
    }
    let hard = wires.placement.together.iter().filter(|one| one.value == Together::Unit);
    let soft =
        wires.wishes.iter().filter(|one| one.what == PreferenceSubject::Together(Together::Unit));
    let report = |span: Span, rule: &str| {
        w0604_unused_rule::unused_rule(span, rule, "digital wires are of no peripheral")
    };
    let hard = hard.map(|one| report(one.span, "together = unit"));
    hard.chain(soft.map(|one| report(one.span, "prefer together = unit"))).collect()
}

/// A place in which pins are wanted together.
type Place = (BoardIndex, String);

/// The room in a place: a signal can be on several pins, and a pin can have several signals.
#[derive(Default)]
struct Room {
    pins: BTreeSet<usize>,
    signals: BTreeSet<String>,
    /// The interrupt lines of the pins, if each element takes one.
    lines: BTreeSet<u8>,
}

impl Room {
    /// The most elements that can find their wires there.
    fn most(&self) -> usize {
        let signals = if self.signals.is_empty() { usize::MAX } else { self.signals.len() };
        let lines = if self.lines.is_empty() { usize::MAX } else { self.lines.len() };
        self.pins.len().min(signals).min(lines)
    }
}

fn array(design: &Design, formulation: &Formulation<'_>, first: &Connection) -> Option<Diagnostic> {
    let asked = design.connections_of(first.part).count();
    let placed = Placed::new(design, formulation, first);
    let meanings = placed.relaxed(|wanted| wanted.pins.clear());
    // A device that cannot be connected at all gets another report.
    meanings.first()?;
    let device = design.device(first.device)?;
    let hard = first.placement.together.iter().map(|one| one.value);
    let ties: BTreeSet<Together> =
        hard.chain(first.placement.sequence.map(|_| Together::Header)).collect();
    for tie in [None].into_iter().chain(ties.into_iter().map(Some)) {
        let places = places(design, &meanings, first, tie);
        let most = places.values().map(Room::most).max().unwrap_or_default();
        if most >= asked {
            continue;
        }
        let by_lines =
            places.values().any(|room| room.lines.len() == most && room.pins.len() > most);
        let names: Vec<&str> = places
            .iter()
            .filter(|(_, room)| room.most() == most)
            .map(|((_, name), _)| name.as_str())
            .collect();
        let roles = first.kind.roles(first.direction).first().map_or("wire", |role| role.name());
        let pins = format!("`{roles}` pins of {}", first.kind.name().with_article());
        let most = match tie {
            None if by_lines => {
                format!("the board has only {most} interrupt lines, one for each number of a pin")
            }
            None => format!("the board has only {most} {pins}"),
            Some(what) if names.is_empty() => {
                format!("the board's table names no {} for the {pins}", what.name())
            }
            Some(what) => {
                let what = what.name();
                format!("no {what} has more than {most} {pins} ({})", names.join(", "))
            }
        };
        let help = if tie.is_some() {
            "write `prefer` in front of the line, make the array shorter, or take another board"
        } else {
            "make the array shorter, or take another board: `sensedsl parts FILE` lists those that can carry it"
        };
        let report = e0322_array_too_long::array_too_long;
        return Some(report(device.value.span, &device.name.value, asked, &most, help));
    }
    None
}

/// The pins that an element could have, by the place that all elements must have in common.
fn places(
    design: &Design,
    meanings: &[Meaning],
    first: &Connection,
    tie: Option<Together>,
) -> BTreeMap<Place, Room> {
    let fixed = first.placement.unit.as_ref().map(|unit| unit.value.as_str());
    let by_interrupt = first.direction == Direction::Sensor
        && first.kind.digital().is_some_and(|own| own.edge.is_some());
    let mut places: BTreeMap<Place, Room> = BTreeMap::new();
    for meaning in meanings {
        let Some(board) = design.board(meaning.board) else { continue };
        for at in meaning.roles.first().into_iter().flatten() {
            let Some(pin) = board.table.pins.get(at.pin) else { continue };
            let usage = at.usage.and_then(|usage| pin.usages.get(usage));
            let line = board.profile().and_then(|profile| profile.exti_group(&pin.name));
            let names: Vec<String> = match tie {
                None => vec![String::new()],
                Some(Together::Header) => {
                    pin.headers().into_iter().map(str::to_ascii_uppercase).collect()
                }
                Some(Together::Side) => {
                    pin.sides().into_iter().map(str::to_ascii_uppercase).collect()
                }
                Some(Together::Unit) => match (&meaning.unit, usage) {
                    (Some(unit), _) => vec![unit.clone()],
                    (None, Some(usage)) => units_of(board, usage, fixed),
                    (None, None) => Vec::new(),
                },
            };
            for name in names {
                let room = places.entry((meaning.board, name)).or_default();
                room.pins.insert(at.pin);
                room.lines.extend(line.filter(|_| by_interrupt));
                room.signals.extend(usage.map(|usage| usage.signal.name().to_owned()));
            }
        }
    }
    places
}
