//! The pin problem as an Alloy model: every choice is an atom, every rule a fact, and `run`s ask for
//! any wiring, for one as good as ours, and for a better one. A second, wholly different program (a
//! translation to SAT) then confirms that there is a wiring, and that none is better.
//!
//! Atoms are numbered, and names are only in comments, so no name means anything to Alloy.

mod facts;
mod objective;

use std::fmt::Write as _;

use sensedsl_certify::Labels;
use sensedsl_diagnostics::visible;
use sensedsl_solve::problem::{Alternative, Candidate, Problem};
use sensedsl_solve::{Objective, Outcome};

/// The solver's result for the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Known {
    /// The best objective.
    Best(Objective),
    /// The best that was found in the time allowed.
    Found(Objective),
    /// There is no wiring.
    Infeasible,
    /// Time ran out before anything was known.
    Nothing,
}

impl From<&Outcome> for Known {
    fn from(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Solved(best) => Self::Best(best.objective),
            Outcome::Stopped { answer: Some(found), .. } => Self::Found(found.objective),
            Outcome::Stopped { answer: None, .. } => Self::Nothing,
            Outcome::Infeasible(_) => Self::Infeasible,
        }
    }
}

/// A choice: the number of its atom, and its place, by which it excludes others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Choice {
    number: usize,
    device: usize,
    alternative: usize,
    /// The role that it is a wire of; `None` for the alternative itself.
    role: Option<usize>,
}

impl Choice {
    /// Whether the two can never be taken together, whatever else is taken.
    fn excludes(&self, other: &Self) -> bool {
        let same_role = self.role.is_some() && self.role == other.role;
        self.device == other.device && (self.alternative != other.alternative || same_role)
    }
}

/// All choices of a problem in the order of their numbers.
struct Choices<'a> {
    problem: &'a Problem,
    /// For each device, its alternatives, each with its choice and the wires of its roles.
    devices: Vec<Vec<Way<'a>>>,
}

struct Way<'a> {
    choice: Choice,
    of: &'a Alternative,
    roles: Vec<Vec<(Choice, &'a Candidate)>>,
}

impl<'a> Choices<'a> {
    fn new(problem: &'a Problem) -> Self {
        let mut number = 0;
        let mut next = |device, alternative, role| {
            number += 1;
            Choice { number: number - 1, device, alternative, role }
        };
        let mut devices = Vec::new();
        for (d, device) in problem.devices.iter().enumerate() {
            let mut ways = Vec::new();
            for (a, of) in device.alternatives.iter().enumerate() {
                let choice = next(d, a, None);
                let roles = of.roles.iter().enumerate().map(|(r, role)| {
                    role.candidates.iter().map(|one| (next(d, a, Some(r)), one)).collect()
                });
                ways.push(Way { choice, of, roles: roles.collect() });
            }
            devices.push(ways);
        }
        Self { problem, devices }
    }

    fn ways(&self) -> impl Iterator<Item = &Way<'a>> {
        self.devices.iter().flatten()
    }

    fn wires(&self) -> impl Iterator<Item = (Choice, &'a Candidate)> {
        self.ways().flat_map(|way| way.roles.iter().flatten().copied())
    }
}

/// The model.
pub(crate) fn model(problem: &Problem, labels: &Labels, known: Known) -> String {
    let choices = Choices::new(problem);
    let mut out = String::from(
        "// The wiring as a constraint problem, for the Alloy Analyzer: `run any` asks for a wiring. Where\n\
         // SenseDSL has one, `run best` asks for one as good, and `run better`, which must find none, for\n\
         // a better one.\n\n\
         // What can be chosen; what is On is chosen.\n\
         abstract sig Choice {}\n\
         sig On in Choice {}\n",
    );
    declare(&mut out, &choices, labels);
    facts::write(&mut out, &choices, labels);
    objective::write(&mut out, &choices, labels);
    runs(&mut out, objective::width(&choices, known), known);
    out
}

/// The atoms of all choices, each with its meaning.
fn declare(out: &mut String, choices: &Choices<'_>, labels: &Labels) {
    for (ways, (device, names)) in
        choices.devices.iter().zip(labels.devices.iter().zip(&labels.alternatives))
    {
        let mut atoms = Vec::new();
        for (way, names) in ways.iter().zip(names) {
            atoms.push((atom(way.choice), names.name.clone()));
            for (wires, role) in way.roles.iter().zip(&names.roles) {
                for (choice, wire) in wires {
                    let pin = labels.pins.get(wire.pin.0 as usize).map_or("", String::as_str);
                    let signal = labels.signals.get(&wire.signal.0).map_or("", String::as_str);
                    atoms.push((atom(*choice), format!("  {role} on {pin} as {signal}")));
                }
            }
        }
        let _ = write!(out, "\n// {}\n", visible(device));
        sigs(out, "Choice", &atoms);
    }
}

/// Declares atoms with a comment for each.
fn sigs(out: &mut String, parent: &str, atoms: &[(String, String)]) {
    for (at, (atom, meaning)) in atoms.iter().enumerate() {
        let head = if at == 0 { "one sig " } else { "  " };
        let comma = if at + 1 == atoms.len() { "" } else { "," };
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{head}{atom}{comma} // {}", visible(meaning));
    }
    if !atoms.is_empty() {
        let _ = writeln!(out, "  extends {parent} {{}}");
    }
}

fn atom(choice: Choice) -> String {
    format!("C{}", choice.number)
}

/// A set of atoms, several to a line.
fn set(atoms: &[String]) -> String {
    if atoms.is_empty() {
        return "none".to_owned();
    }
    let lines: Vec<String> = atoms.chunks(14).map(|line| line.join(" + ")).collect();
    format!("({})", lines.join(" +\n    "))
}

/// The commands.
fn runs(out: &mut String, width: u32, known: Known) {
    let objective = |objective: Objective| {
        let Objective { moved, violated, shared, cost, spares } = objective;
        let parts = [
            ("moved", u64::from(moved)),
            ("violated", u64::from(violated)),
            ("shared", u64::from(shared)),
            ("cost", u64::from(cost)),
            ("spares", u64::from(spares)),
        ];
        let equal =
            |count| parts.iter().take(count).map(|(name, value)| format!("{name} = {value}"));
        let best = equal(parts.len()).collect::<Vec<_>>().join(" and ");
        let better = parts.iter().enumerate().map(|(at, (name, value))| {
            let less = equal(at).chain([format!("{name} < {value}")]);
            format!("  ({})", less.collect::<Vec<_>>().join(" and "))
        });
        (best, better.collect::<Vec<_>>().join(" or\n"))
    };
    let _ = write!(
        out,
        "\n// Integers of {width} bits hold the greatest cost that there can be; fewer would overflow.\n\
         pred any {{}}\n"
    );
    let (feasible, proved) = match known {
        Known::Best(_) => (" expect 1", " expect 0"),
        Known::Found(_) => (" expect 1", ""),
        Known::Infeasible => (" expect 0", ""),
        Known::Nothing => ("", ""),
    };
    let _ = writeln!(out, "run any for {width} Int{feasible}");
    match known {
        Known::Best(found) | Known::Found(found) => {
            let (best, better) = objective(found);
            let note = match known {
                Known::Found(_) => "// Time ran out before it was proved that none is better.\n",
                Known::Best(_) | Known::Infeasible | Known::Nothing => "",
            };
            let _ = write!(
                out,
                "\npred best {{\n  {best}\n}}\nrun best for {width} Int expect 1\n\n{note}\
                 pred better {{\n{better}\n}}\nrun better for {width} Int{proved}\n"
            );
        }
        Known::Infeasible => out.push_str("// There is no wiring.\n"),
        Known::Nothing => out.push_str("// Time ran out before a wiring was found.\n"),
    }
}
