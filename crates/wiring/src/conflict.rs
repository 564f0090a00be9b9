//! The reason why there is no wiring, in names.
//!
//! In: the solver's conflict. Out: the devices, and what they compete for, as a diagnostic. The
//! rules and repairs in it are found in `explain.rs`, with more questions to the solver.

use sensedsl_board::pin::PinName;
use sensedsl_board::table::Pin;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0401_no_wiring;
use sensedsl_model::design::{Board, BoardIndex, Design, PartIndex};
use sensedsl_solve::Conflict;

use crate::formulate::{Formulation, Requester};
use crate::names::{Stream, list};
use crate::repairs::{Repair, Repaired};
use crate::rule::Rule;

/// The most repairs in one message; all are in the JSON output.
const REPAIRS_NAMED_MAX: usize = 4;

/// A minimal set of devices that cannot be connected together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoWiring {
    /// The parts, in file order. Without any one of them the others can be connected. Empty if the
    /// serial links of the boards alone cannot be wired.
    pub parts: Vec<PartIndex>,
    /// Boards whose serial link is part of the conflict.
    pub links: Vec<BoardIndex>,
    /// Boards whose kernel needs one of the timers for its clock.
    pub clocks: Vec<BoardIndex>,
    /// Pins and other resources that they compete for.
    pub resources: Vec<Contested>,
    /// The rules without which the devices could be wired. Minimal, like the devices, if at most
    /// 256 rules are in force for them; if there are more, the others are in the list without
    /// having been tried.
    pub rules: Vec<Rule>,
    /// The changes that would help; each was checked by solving. If there are more than 256
    /// changes, only the first are tried, and those that are too hard are left out.
    pub repairs: Vec<Repaired>,
    /// Whether it is known that there is still no wiring whichever of the parts is left out.
    pub others_remain: bool,
    /// False if time ran out before it was known that each of the devices is needed for the
    /// conflict; then nothing is known about rules and repairs.
    pub minimal: bool,
    /// False if time ran out before it was known what would help: there may be more repairs, and no
    /// rules are named.
    pub explained: bool,
}

/// Something that devices compete for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contested {
    /// The pin, unit, signal, interrupt line or DMA stream; with its board if there are several.
    pub name: String,
    /// The board it is on.
    pub board: BoardIndex,
    /// The pins that offer it, as indices into the board's table; empty if no pin shows it.
    pub pins: Vec<usize>,
}

/// The solver's conflict in names, without repairs.
pub(crate) fn named(
    design: &Design,
    formulation: &Formulation<'_>,
    conflict: &Conflict,
) -> NoWiring {
    let askers = conflict.devices.iter().filter_map(|id| formulation.askers.get(id.0 as usize));
    let (mut parts, mut links) = (Vec::new(), Vec::new());
    for asker in askers {
        match asker {
            Requester::Connection(connection) => {
                parts.extend(design.connection(*connection).map(|one| one.part));
            }
            Requester::Link(board) => links.push(*board),
        }
    }
    parts.dedup();
    let resources = resources(formulation, conflict);
    let streams = conflict.streams.iter().filter_map(|id| formulation.streams.get(id.0 as usize));
    let timers = streams.filter(|(_, stream)| matches!(stream, Stream::Timer(_)));
    let mut clocks: Vec<BoardIndex> = timers.map(|(board, _)| *board).collect();
    clocks.sort_unstable();
    clocks.dedup();
    let (rules, repairs) = (Vec::new(), Vec::new());
    let minimal = conflict.minimal;
    NoWiring {
        parts,
        links,
        clocks,
        resources,
        rules,
        repairs,
        others_remain: false,
        minimal,
        explained: true,
    }
}

fn resources(formulation: &Formulation<'_>, conflict: &Conflict) -> Vec<Contested> {
    let several = formulation.offers.len() > 1;
    let on = |board: BoardIndex, name: String, offers: &dyn Fn(&Pin) -> bool| {
        let offer = formulation.offers.get(board.0)?;
        let pins = offer.pins().filter(|(_, pin)| offers(pin)).map(|(at, _)| at).collect();
        let name = if several { format!("{}.{name}", offer.board.name.value) } else { name };
        Some(Contested { name, board, pins })
    };
    let of_chip = conflict.resources.iter().filter_map(|id| {
        let resource = formulation.resources.get(id.0 as usize)?;
        on(resource.board()?, resource.name(), &|pin| resource.is_shown_by(pin))
    });
    let streams = conflict.streams.iter().filter_map(|id| {
        let (board, stream) = formulation.streams.get(id.0 as usize)?;
        on(*board, stream.name(), &|_| false)
    });
    let pins = conflict.pins.iter().filter_map(|id| {
        let (board, pin) = formulation.pins.get(id.0 as usize)?;
        let pin = formulation.offers.get(board.0)?.board.table.pins.get(*pin)?;
        on(*board, pin.name.to_string(), &|one| one.name == pin.name)
    });
    let mut all: Vec<Contested> = Vec::new();
    for contested in of_chip.chain(streams).chain(pins) {
        if !all.iter().any(|one| one.name == contested.name) {
            all.push(contested);
        }
    }
    all
}

impl NoWiring {
    /// The diagnostic: all devices of the conflict, each at its place.
    pub fn diagnostic(&self, design: &Design) -> Diagnostic {
        let mut names: Vec<&str> = self.parts.iter().map(|one| design.part_name(*one)).collect();
        let link_names: Vec<String> = self
            .links
            .iter()
            .filter_map(|board| design.board(*board))
            .map(|board| format!("the link of {}", board.name.value))
            .collect();
        names.extend(link_names.iter().map(String::as_str));
        let mut places = self
            .parts
            .iter()
            .filter_map(|part| design.part(*part))
            .map(|part| part.name.span)
            .chain(self.links.iter().filter_map(|b| design.board(*b)).map(|b| b.name.span));
        let first = places.next().or_else(|| design.boards.first().map(|board| board.name.span));
        let Some(first) = first else {
            return e0401_no_wiring::no_wiring(
                sensedsl_diagnostics::Span::new(design.file, 0..0),
                &list(&names, "and"),
                &self.contested(design),
            );
        };
        let resources = format!("{}{}", self.contested(design), self.counts(design));
        let mut diagnostic = match names.as_slice() {
            [alone] => e0401_no_wiring::nothing_serves(first, alone, &resources),
            _ => e0401_no_wiring::no_wiring(first, &list(&names, "and"), &resources),
        };
        for place in places {
            diagnostic = diagnostic.label(place, "and this");
        }
        for rule in &self.rules {
            if let Some(span) = rule.span() {
                diagnostic = diagnostic.label(span, "because of this");
            }
        }
        diagnostic.help(self.help(design))
    }

    /// How many pins there are for how many wires, if that is the whole conflict.
    fn counts(&self, design: &Design) -> String {
        let connections = || self.parts.iter().flat_map(|part| design.connections_of(*part));
        let one_wire = connections().all(|one| one.kind.roles(one.direction).len() == 1);
        let is_pin = |one: &Contested| {
            one.pins.len() == 1
                && design.board(one.board).is_some_and(|board| {
                    let pin = one.pins.first().and_then(|at| board.table.pins.get(*at));
                    pin.is_some_and(|pin| one.name.ends_with(pin.name.as_str()))
                })
        };
        let (pins, asked) = (self.resources.len(), connections().count());
        if !one_wire || pins < 2 || asked <= pins || !self.resources.iter().all(is_pin) {
            return String::new();
        }
        format!(": {pins} pins, {asked} asked")
    }

    /// The things that they compete for, with the lines of a table that the user can look at.
    fn contested(&self, design: &Design) -> String {
        let words = self.resources.iter().map(|contested| {
            let board = design.board(contested.board).filter(|board| !board.built_in);
            let row = |pin: &usize| Some(board?.table.pins.get(*pin)?.row.to_string());
            let rows: Vec<String> = contested.pins.iter().filter_map(row).collect();
            match rows.as_slice() {
                [] => contested.name.clone(),
                [one] => format!("{} (line {one})", contested.name),
                [..] => {
                    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
                    format!("{} (lines {})", contested.name, list(&rows, "and"))
                }
            }
        });
        words.collect::<Vec<_>>().join(", ")
    }

    fn help(&self, design: &Design) -> String {
        if !self.minimal {
            return "time ran out before it was known whether all of them are needed for the \
                    conflict: allow more of it with --timeout"
                .to_owned();
        }
        let dropped = self.repairs.iter().filter_map(|one| {
            let Repair::Drop(part) = one.repair else { return None };
            Some(design.part_name(part))
        });
        let dropped: Vec<&str> = dropped.collect();
        let others = self.repairs.iter().filter(|one| !matches!(one.repair, Repair::Drop(_)));
        let mut ways: Vec<String> =
            others.take(REPAIRS_NAMED_MAX).map(|one| one.repair.describe(design)).collect();
        match dropped.as_slice() {
            [] => {}
            [one] => ways.push(format!("leave out {one}")),
            [..] => ways.push(format!("leave out one of {}", list(&dropped, "and"))),
        }
        let mut help = match ways.as_slice() {
            [] if !self.explained => {
                return "time ran out before it was known what would help: allow more of it with \
                        --timeout"
                    .to_owned();
            }
            [] if names_one(self) => "take another board, or another kind of device".to_owned(),
            [] if self.others_remain => {
                "without any one of them the others can be connected, but there are other conflicts"
                    .to_owned()
            }
            [] => "without any one of them the others can be connected; whether the whole design \
                   then can was too hard to tell"
                .to_owned(),
            [..] => format!("it works if you {}", ways.join(", or ")),
        };
        help.extend(self.kernels(design));
        if self.rules.iter().any(|rule| matches!(rule, Rule::Target(_))) {
            help.push_str("; with `--target none`, the pins alone would do");
        }
        help.extend(self.off_connectors(design));
        if !self.explained {
            help.push_str("; time ran out before everything else was tried");
        }
        help
    }

    /// The timers that kernels need for their clocks.
    fn kernels(&self, design: &Design) -> Vec<String> {
        let boards = self.clocks.iter().filter_map(|board| design.board(*board));
        let needed = boards.map(|board| {
            let timers = board.profile().map(|profile| profile.kernel.needed()).unwrap_or_default();
            let timers: Vec<&str> = timers.iter().map(String::as_str).collect();
            let one = if timers.len() > 1 { "one of " } else { "" };
            let on = &board.name.value;
            format!("; the kernel of {on} needs {one}{} for its clock", list(&timers, "and"))
        });
        needed.collect()
    }

    /// That a board has free pins which are not offered because they are on no connector.
    fn off_connectors(&self, design: &Design) -> Option<String> {
        let mut boards = self.resources.iter().filter_map(|one| design.board(one.board));
        let free = |board: &Board| -> Vec<PinName> {
            let off = board.table.pins.iter().filter(|pin| board.table.is_off_connectors(pin));
            off.filter(|pin| pin.onboard.is_none()).map(|pin| pin.name.clone()).collect()
        };
        let (board, pins) = boards
            .find_map(|board| Some((board, free(board))).filter(|(_, pins)| !pins.is_empty()))?;
        let (count, name) = (pins.len(), pins.first()?);
        let (pins, are) = if count == 1 { ("pin", "is") } else { ("pins", "are") };
        let on = &board.name.value;
        Some(format!(
            "; {count} free {pins} of {on} {are} on no connector, and used only where the file says so: `pin = {name};`"
        ))
    }
}

fn names_one(conflict: &NoWiring) -> bool {
    conflict.parts.len() + conflict.links.len() == 1
}
