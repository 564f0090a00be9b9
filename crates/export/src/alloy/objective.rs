//! The cost of a wiring, part by part, and the width of the integers that it needs.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_solve::Objective;
use sensedsl_solve::problem::{Pin, RuleId};

use super::{Choices, Known, atom, set, sigs};
use sensedsl_certify::Labels;

/// The atoms of one kind of things, and the choices that put each into its set.
struct Things<'a> {
    /// The letter of the atoms.
    letter: char,
    names: &'a [String],
    /// By number, the choices any one of which is enough.
    chosen: BTreeMap<usize, Vec<String>>,
}

impl Things<'_> {
    fn atom(&self, number: usize) -> String {
        format!("{}{number}", self.letter)
    }

    /// Declares the atoms, and the subset `name` of those that a choice puts into it.
    fn write(&self, out: &mut String, parent: &str, name: &str) {
        if self.chosen.is_empty() {
            return;
        }
        let _ = writeln!(out, "abstract sig {parent} {{}}");
        let meaning = |number: &usize| self.names.get(*number).cloned().unwrap_or_default();
        let atoms = self.chosen.keys().map(|number| (self.atom(*number), meaning(number)));
        sigs(out, parent, &atoms.collect::<Vec<_>>());
        let _ = writeln!(out, "sig {name} in {parent} {{}}");
        for (number, choices) in &self.chosen {
            let atom = self.atom(*number);
            let _ = writeln!(out, "fact {{ {atom} in {name} iff some On & {} }}", set(choices));
        }
    }

    /// Writes a function that counts a subset.
    fn count(&self, out: &mut String, function: &str, name: &str) {
        let count = if self.chosen.is_empty() { "0".to_owned() } else { format!("#{name}") };
        let _ = writeln!(out, "fun {function} : Int {{ {count} }}");
    }
}

pub(super) fn write(out: &mut String, choices: &Choices<'_>, labels: &Labels) {
    out.push_str("\n// Pins in use.\n");
    let pins = pins(choices, labels);
    pins.write(out, "Pin", "Busy");
    out.push_str("\n// Wires that are not where they were: one for each pin.\n");
    let mut moved = Things { letter: 'M', names: &labels.pins, chosen: BTreeMap::new() };
    for (choice, wire) in choices.wires().filter(|(_, wire)| wire.moved) {
        moved.chosen.entry(wire.pin.0 as usize).or_default().push(atom(choice));
    }
    moved.write(out, "Place", "Moved");
    moved.count(out, "moved", "Moved");
    out.push_str("\n// Rules that are violated, each once.\n");
    let rules = rules(choices, labels);
    rules.write(out, "Rule", "Violated");
    rules.count(out, "violated", "Violated");
    out.push_str("\n// Pins in use that something else is on.\n");
    let table = &choices.problem.pins;
    let shared = pins.chosen.keys().filter(|pin| table.get(**pin).is_some_and(|pin| pin.shared));
    let shared: Vec<String> = shared.map(|pin| pins.atom(*pin)).collect();
    let count =
        if shared.is_empty() { "0".to_owned() } else { format!("#(Busy & {})", set(&shared)) };
    let _ = writeln!(out, "fun shared : Int {{ {count} }}");
    out.push_str("\n// The usages in the rows of the pins in use.\n");
    let _ = writeln!(out, "fun cost : Int {{\n  {}\n}}", cost(table, &pins));
    out.push_str("\n// Spare boards in use.\n");
    let mut spares = Things { letter: 'B', names: &labels.boards, chosen: BTreeMap::new() };
    for way in choices.ways() {
        let board = way.of.board.0 as usize;
        if choices.problem.boards.get(board).is_some_and(|board| board.spare) {
            spares.chosen.entry(board).or_default().push(atom(way.choice));
        }
    }
    spares.write(out, "Board", "Spares");
    spares.count(out, "spares", "Spares");
}

fn pins<'a>(choices: &Choices<'_>, labels: &'a Labels) -> Things<'a> {
    let mut pins = Things { letter: 'P', names: &labels.pins, chosen: BTreeMap::new() };
    for (choice, wire) in choices.wires() {
        pins.chosen.entry(wire.pin.0 as usize).or_default().push(atom(choice));
    }
    pins
}

fn rules<'a>(choices: &Choices<'_>, labels: &'a Labels) -> Things<'a> {
    let mut rules = Things { letter: 'R', names: &labels.rules, chosen: BTreeMap::new() };
    let mut violated = |by: String, all: &[RuleId]| {
        for rule in all {
            let choices = rules.chosen.entry(rule.0 as usize).or_default();
            if choices.last() != Some(&by) {
                choices.push(by.clone());
            }
        }
    };
    for way in choices.ways() {
        violated(atom(way.choice), &way.of.violates);
    }
    for (choice, wire) in choices.wires() {
        violated(atom(choice), &wire.violates);
    }
    rules
}

/// The sum of the costs. Pins of one cost are counted together.
fn cost(table: &[Pin], pins: &Things<'_>) -> String {
    let mut alike: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    for pin in pins.chosen.keys() {
        let cost = table.get(*pin).map_or(0, |pin| pin.cost);
        alike.entry(cost).or_default().push(pins.atom(*pin));
    }
    alike.remove(&0);
    let term = |(cost, pins): (u32, Vec<String>)| match cost {
        1 => format!("#(Busy & {})", set(&pins)),
        _ => format!("mul[{cost}, #(Busy & {})]", set(&pins)),
    };
    let sum = alike.into_iter().map(term).reduce(|sum, term| format!("plus[{sum},\n  {term}]"));
    sum.unwrap_or_else(|| "0".to_owned())
}

/// The number of bits that an integer needs for the greatest value of any part, with its sign.
pub(super) fn width(choices: &Choices<'_>, known: Known) -> u32 {
    let problem = choices.problem;
    let used: std::collections::BTreeSet<usize> =
        choices.wires().map(|(_, wire)| wire.pin.0 as usize).collect();
    let costs = used.iter().filter_map(|pin| problem.pins.get(*pin));
    let costs: u64 = costs.map(|pin| u64::from(pin.cost)).sum();
    let counts = [used.len() as u64, u64::from(problem.rules), problem.boards.len() as u64];
    let stated = match known {
        Known::Best(Objective { cost, .. }) | Known::Found(Objective { cost, .. }) => {
            u64::from(cost)
        }
        Known::Infeasible | Known::Nothing => 0,
    };
    let most = counts.into_iter().chain([costs, stated]).max().unwrap_or(0);
    u64::BITS - most.leading_zeros() + 1
}
