//! Why a device is on its pins, for people.
//!
//! In: the pins that each of its wires could have, with the cost of the best wiring for each. Out: a line for each wire
//! with its pin and the reason, then the other pins, starting with those that are in nobody's way; or all pins as a
//! table.

use std::collections::BTreeMap;

use sensedsl_diagnostics::{nearest, visible};
use sensedsl_model::design::{ConnectionIndex, Design};
use sensedsl_wiring::assignment::{Assignment, Neatness};
use sensedsl_wiring::{Alternative, Found};
use serde_json::{Value, json};

use crate::columns::table;

/// The width of a line of pins.
const WIDTH: usize = 100;
/// The column at which the pins of a group start.
const PINS_AT: usize = 32;

/// The verdict on a pin, in the order in which people want to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    Chosen,
    Better,
    Cheaper,
    AsGood,
    Costs(u64),
    Shared(u64),
    Unmet(u64),
    Impossible,
}

impl Verdict {
    fn of(wiring: &Assignment, one: &Alternative) -> Self {
        match one.best {
            _ if one.chosen => Self::Chosen,
            None => Self::Impossible,
            Some(best) if best.violated > wiring.violated => {
                Self::Unmet(u64::from(best.violated - wiring.violated))
            }
            Some(best) if best.violated < wiring.violated => Self::Better,
            Some(best) if best.shared > wiring.shared => {
                Self::Shared(u64::from(best.shared - wiring.shared))
            }
            Some(best) if best.shared < wiring.shared => Self::Better,
            Some(best) if best.cost > wiring.cost => {
                Self::Costs(u64::from(best.cost - wiring.cost))
            }
            Some(best) if best.cost < wiring.cost => Self::Cheaper,
            Some(_) => Self::AsGood,
        }
    }

    /// The verdict without numbers: pins with the same group are listed together.
    const fn group(self) -> Self {
        match self {
            Self::Costs(_) => Self::Costs(0),
            Self::Shared(_) => Self::Shared(0),
            Self::Unmet(_) => Self::Unmet(0),
            Self::Chosen | Self::Better | Self::Cheaper | Self::AsGood | Self::Impossible => self,
        }
    }

    /// The title of a group of pins.
    const fn title(self, is_neat: bool) -> &'static str {
        match self {
            Self::Chosen => "chosen",
            Self::Better => "better",
            Self::Cheaper => "costs less, less neat",
            Self::AsGood if is_neat => "as good but for neatness",
            Self::AsGood => "as good, later in order",
            Self::Costs(_) => "costs more in all",
            Self::Shared(_) => "shared with the board",
            Self::Unmet(_) => "a wish less is met",
            Self::Impossible => "needed by other devices",
        }
    }

    /// The text after a pin in its group.
    fn mark(self, one: &Alternative) -> String {
        match (self, &one.shared_with) {
            (Self::Costs(more), _) => format!(" (+{more})"),
            (Self::Shared(1), Some(with)) => format!(" ({})", visible(with)),
            _ => String::new(),
        }
    }

    /// The last column of the table.
    fn long(self, design: &Design, one: &Alternative, is_neat: bool) -> String {
        match (self, &one.shared_with) {
            (Self::Chosen, _) => "chosen".to_owned(),
            (Self::Impossible, _) => "no wiring: the others need it".to_owned(),
            (Self::Unmet(more), _) => format!("{more} more unmet wishes"),
            (Self::Better, _) => "better".to_owned(),
            (Self::Cheaper, _) => "costs less, less neat".to_owned(),
            (Self::Shared(1), Some(with)) => format!("shared with {}", visible(with)),
            (Self::Shared(1), None) => "one more shared pin".to_owned(),
            (Self::Shared(more), _) => format!("{more} more shared pins"),
            (Self::Costs(more), _) => format!("costs {more} more in all"),
            (Self::AsGood, _) if is_neat => {
                "as good in cost; less neat or later in order".to_owned()
            }
            (Self::AsGood, _) => {
                let has_spares = one.best.is_some_and(|best| best.spares > 0)
                    && design.boards.iter().any(|board| board.spare);
                let why = if has_spares {
                    "as good in cost; needs as many spare boards or comes later in order"
                } else {
                    "as good; comes later in order"
                };
                why.to_owned()
            }
        }
    }
}

/// The table of every possible pin.
#[must_use]
pub fn all(design: &Design, wiring: &Assignment, alternatives: &[Alternative]) -> String {
    let row = |one: &Alternative| {
        let why = Verdict::of(wiring, one).long(design, one, is_neat(wiring));
        [one.wire.clone(), pin(design, one), one.signal.clone(), one.usages.to_string(), why]
    };
    let rows: Vec<[String; 5]> = alternatives.iter().map(row).collect();
    let heads = ["Role", "Pin", "Signal", ">Usages", "Why"];
    table(heads, &rows)
}

/// The pins of the wiring with the reasons, then the other pins in groups, and below them what `rest` says of the rest.
#[must_use]
pub fn summary(
    design: &Design,
    wiring: &Assignment,
    alternatives: &[Alternative],
    rest: &str,
) -> String {
    let mut wires: Vec<Vec<(Verdict, &Alternative)>> = Vec::new();
    for one in alternatives {
        let judged = (Verdict::of(wiring, one), one);
        // The wires of a chip's connections may share a name; each has one chosen pin.
        match wires.last_mut().filter(|wire| is_same(wire, one)) {
            Some(wire) => wire.push(judged),
            None => wires.push(vec![judged]),
        }
    }
    let is_neat = is_neat(wiring);
    let chosen = wires.iter().filter_map(|wire| row(design, wire, is_neat));
    let chosen: Vec<[String; 4]> = chosen.collect();
    let heads = ["Role", "Pin", "Signal", "Why"];
    let mut out = table(heads, &chosen);
    out.push_str(&others(design, &wires, is_neat, rest));
    out.push_str(&neatness(wiring));
    out
}

/// Whether some pin of the wiring is on a connector, so that neatness decides between pins that cost the same.
const fn is_neat(wiring: &Assignment) -> bool {
    wiring.neatness.sides > 0
}

/// What neatness saved, and what it cost.
fn neatness(wiring: &Assignment) -> String {
    let Neatness { sides, span, is_proved, before, .. } = wiring.neatness;
    let Some(plain) = before.filter(|_| is_neat(wiring)) else { return String::new() };
    let known = if is_proved { "proved neatest" } else { "neat as found" };
    let compared = if (plain.sides, plain.span) == (sides, span) {
        "Without regard for neatness, the wiring would be as neat.".to_owned()
    } else {
        let rise = wiring.rise();
        let costs = if rise == 0 { "nothing".to_owned() } else { format!("{rise}") };
        format!(
            "Without regard for neatness: connector sides {}, span {}. Neatness costs {costs}.",
            plain.sides, plain.span
        )
    };
    format!("\nAll parts: connector sides {sides}, span {span}, {known}.\n{compared}\n")
}

fn is_same(wire: &[(Verdict, &Alternative)], one: &Alternative) -> bool {
    let has_chosen = wire.iter().any(|(_, other)| other.chosen);
    let is_repeated = |other: &Alternative| {
        (&other.board, &other.pin, &other.signal) == (&one.board, &one.pin, &one.signal)
    };
    wire.iter().all(|(_, other)| other.wire == one.wire)
        && !(has_chosen && one.chosen)
        && !wire.iter().any(|(_, other)| is_repeated(other))
}

fn pin(design: &Design, one: &Alternative) -> String {
    if design.boards.len() > 1 { format!("{} {}", one.board, one.pin) } else { one.pin.clone() }
}

/// The row of a wire: its pin, and the reason for it.
fn row(design: &Design, wire: &[(Verdict, &Alternative)], is_neat: bool) -> Option<[String; 4]> {
    let (_, chosen) = wire.iter().find(|(verdict, _)| *verdict == Verdict::Chosen)?;
    let why = reason(design, wire, is_neat);
    Some([chosen.wire.clone(), pin(design, chosen), chosen.signal.clone(), why])
}

/// The reason why the chosen pin was chosen.
fn reason(design: &Design, wire: &[(Verdict, &Alternative)], is_neat: bool) -> String {
    let mut rest: Vec<&(Verdict, &Alternative)> =
        wire.iter().filter(|(verdict, _)| *verdict != Verdict::Chosen).collect();
    rest.sort_by_key(|(verdict, _)| *verdict);
    let Some((best, next)) = rest.first() else { return "no other pin can be it".to_owned() };
    let next = pin(design, next);
    match best {
        Verdict::Better => format!("not the best there is: {next} is better"),
        Verdict::AsGood => {
            let count = rest.iter().filter(|(verdict, _)| *verdict == Verdict::AsGood).count();
            let them =
                if count == 1 { format!("{next} is") } else { format!("{count} others are") };
            let than =
                if is_neat { "in cost, less neat or later in order" } else { "and later in order" };
            format!("costs least; {them} as good {than}")
        }
        Verdict::Cheaper => format!("neater; {next} costs less"),
        Verdict::Costs(more) => format!("costs least; the next, {next}, costs {more} more in all"),
        Verdict::Shared(_) => "all others are shared with something on the board".to_owned(),
        Verdict::Unmet(_) => "with any other a wish would be unmet".to_owned(),
        Verdict::Impossible | Verdict::Chosen => {
            "all others are needed by other devices".to_owned()
        }
    }
}

/// The pins that were not chosen; wires with the same ones share an entry.
fn others(
    design: &Design,
    wires: &[Vec<(Verdict, &Alternative)>],
    is_neat: bool,
    rest: &str,
) -> String {
    let mut texts: Vec<(Vec<&str>, String)> = Vec::new();
    for wire in wires {
        let text = groups(design, wire, is_neat);
        let name = wire.first().map_or("", |(_, one)| one.wire.as_str());
        match texts.iter_mut().find(|(_, other)| *other == text) {
            Some((names, _)) => names.push(name),
            None => texts.push((vec![name], text)),
        }
    }
    texts.retain(|(_, text)| !text.is_empty());
    if texts.is_empty() {
        return String::new();
    }
    let blocks = texts.iter().map(|(names, text)| format!("  {}\n{text}", names.join(", ")));
    format!("\nOther pins:\n\n{}{rest}", blocks.collect::<Vec<_>>().join("\n"))
}

/// A line for each group of pins of a wire.
fn groups(design: &Design, wire: &[(Verdict, &Alternative)], is_neat: bool) -> String {
    let mut groups: BTreeMap<Verdict, Vec<(Verdict, String, String)>> = BTreeMap::new();
    for (verdict, one) in wire.iter().filter(|(verdict, _)| *verdict != Verdict::Chosen) {
        let group = groups.entry(verdict.group()).or_default();
        let pin = pin(design, one);
        let mark = verdict.mark(one);
        match group.iter_mut().find(|(_, other, _)| *other == pin) {
            // A pin counts with its best signal.
            Some(other) if *verdict < other.0 => *other = (*verdict, pin, mark),
            Some(_) => {}
            None => group.push((*verdict, pin, mark)),
        }
    }
    let line = |(group, mut pins): (Verdict, Vec<(Verdict, String, String)>)| {
        pins.sort_by_key(|(verdict, ..)| *verdict);
        let pins: Vec<String> = pins.into_iter().map(|(_, pin, mark)| pin + &mark).collect();
        format!("    {:<1$}{2}\n", group.title(is_neat), PINS_AT - 4, listed(&pins))
    };
    groups.into_iter().map(line).collect()
}

/// As many pins as fit into a line, and the number of the others.
fn listed(pins: &[String]) -> String {
    const REST: usize = " … 999 more".len();
    let mut out = String::new();
    for (at, pin) in pins.iter().enumerate() {
        let is_last = at + 1 == pins.len();
        let room = WIDTH - PINS_AT - if is_last { 0 } else { REST };
        let text = if at == 0 { pin.clone() } else { format!(", {pin}") };
        if at > 0 && out.chars().count() + text.chars().count() > room {
            return format!("{out} … {} more", pins.len() - at);
        }
        out.push_str(&text);
    }
    out
}

/// The connections of the device or chip with that name.
///
/// # Errors
///
/// There is no such device or chip; the text names the one that was probably meant.
pub fn connections(design: &Design, name: &str) -> Result<Vec<ConnectionIndex>, String> {
    if let Some(device) = design.devices.iter().find(|one| one.name.value == name) {
        return Ok(device.connections.clone());
    }
    if let Some(part) = design.parts.iter().position(|one| one.name.value == name) {
        let all = design.connections.iter().enumerate();
        let own = all.filter(|(_, one)| one.part.0 == part);
        return Ok(own.map(|(index, _)| ConnectionIndex(index)).collect());
    }
    let devices = design.devices.iter().map(|device| device.name.value.as_str());
    let names = devices.chain(design.parts.iter().map(|part| part.name.value.as_str()));
    let meant = nearest(name, names);
    let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
    Err(format!("the file has no device or chip {name}{meant}"))
}

/// All pins, as `sensedsl explain wiring --format json` prints them.
#[must_use]
pub fn value(name: &str, found: &Found<Alternative>) -> Value {
    let list: Vec<Value> = found.all.iter().map(alternative).collect();
    json!({ "version": 1, "device": name, "complete": found.complete, "alternatives": list })
}

/// All pins, each with the verdict for people and what the whole wiring costs more with it; `null` where it is not a
/// matter of cost.
#[must_use]
pub fn places(design: &Design, wiring: &Assignment, alternatives: &[Alternative]) -> Value {
    let place = |one: &Alternative| {
        let verdict = Verdict::of(wiring, one);
        let more = one.best.map(|best| i64::from(best.cost) - i64::from(wiring.cost));
        let is_cost = matches!(
            verdict,
            Verdict::Chosen | Verdict::Cheaper | Verdict::AsGood | Verdict::Costs(_)
        );
        json!({
            "wire": one.wire,
            "board": one.board,
            "pin": one.pin,
            "signal": one.signal,
            "chosen": one.chosen,
            "possible": one.best.is_some(),
            "verdict": verdict.long(design, one, is_neat(wiring)),
            "more": more.filter(|_| is_cost),
        })
    };
    Value::Array(alternatives.iter().map(place).collect())
}

fn alternative(one: &Alternative) -> Value {
    json!({
        "role": one.wire,
        "board": one.board,
        "pin": one.pin,
        "signal": one.signal,
        "usages": one.usages,
        "chosen": one.chosen,
        "violated": one.best.map(|best| best.violated),
        "shared": one.best.map(|best| best.shared),
        "shared_with": one.shared_with,
        "cost": one.best.map(|best| best.cost),
    })
}

#[cfg(test)]
mod tests {
    use super::{PINS_AT, WIDTH, listed};

    #[test]
    fn a_line_ends_in_time_and_says_what_is_left() {
        let pins: Vec<String> = (0..40).map(|number| format!("PD{number}")).collect();
        let line = listed(&pins);
        assert!(line.chars().count() <= WIDTH - PINS_AT, "{line}");
        let shown = line.split(',').count();
        assert!(line.ends_with(&format!(" … {} more", 40 - shown)), "{line}");
        assert_eq!(listed(&pins[..2]), "PD0, PD1");
    }
}
