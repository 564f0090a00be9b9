//! Controllers and tests: the devices that they name, and the pieces of a test's steps.

use sensedsl_model::design::{Design, Device, FaultKind};
use sensedsl_model::kind::Kind;
use sensedsl_model::meaning::{FUNCTIONS, STATES};
use sensedsl_syntax::SyntaxKind;
use sensedsl_wire::Direction;

use super::item::Item;
use super::subject::Subject;
use super::values;
use crate::protocol::completion::{ENUM_MEMBER, FUNCTION, KEYWORD, VALUE};

/// The words that end a condition and begin a time.
const CLAUSES: [&str; 3] = ["within", "from", "to"];

/// The newest design that could be read.
fn design<'d>(subject: &'d Subject<'_, '_>) -> Option<&'d Design> {
    let sound = subject.cx.analysis.snapshot.sound().map(|sound| sound.design);
    sound.or_else(|| Some(subject.cx.wired.as_ref()?.wired()?.0))
}

/// The devices of the design that are chosen, each as an item.
fn named(subject: &Subject<'_, '_>, is_chosen: impl Fn(&Device) -> bool) -> Vec<Item> {
    let all = design(subject).map(|design| design.devices.as_slice()).unwrap_or_default();
    let chosen = all.iter().filter(|device| is_chosen(device));
    chosen
        .map(|device| {
            let way = match device.direction {
                Direction::Sensor => "sensor",
                Direction::Actuator => "actuator",
            };
            let unit = device.shown.quantity.as_deref().map(|unit| format!(", {unit}"));
            let detail = format!("{way}, {}{}", device.value.value, unit.unwrap_or_default());
            Item::new(&device.name.value, VALUE).detail(detail).rank(20)
        })
        .collect()
}

/// The devices that a controller can read or set and does not name yet.
pub(super) fn devices(subject: &Subject<'_, '_>, property: &str) -> Vec<Item> {
    let own = subject.site.block().name();
    let (_, written) = subject.site.property().unwrap_or_default();
    named(subject, |device| {
        let is_code = matches!(device.kind, Kind::Code(_));
        let suits = match device.direction {
            // A parameter is set by the host, and code makes sensors.
            Direction::Actuator => property != "sets" || !is_code,
            Direction::Sensor => property == "reads" || is_code,
        };
        let name = device.name.value.as_str();
        suits && Some(name) != own && written.iter().all(|token| token.text != name)
    })
}

/// What may follow in a step of a test; none if the statement is a property.
pub(super) fn of_step(subject: &Subject<'_, '_>) -> Option<Vec<Item>> {
    let words = subject.site.words();
    let (first, rest) = words.split_first()?;
    Some(match *first {
        "at" => set(subject, rest)?,
        "fault" => fault(subject, rest),
        "always" | "never" | "eventually" | "when" => rule(subject, first, rest),
        _ => return None,
    })
}

fn keywords(words: &[&str]) -> Vec<Item> {
    words.iter().map(|word| Item::new(*word, KEYWORD).rank(10)).collect()
}

/// `at TIME set NAME = VALUE;`; none for the value.
fn set(subject: &Subject<'_, '_>, rest: &[&str]) -> Option<Vec<Item>> {
    match rest.iter().position(|word| *word == "set") {
        None => Some(time(subject, rest.is_empty(), &["set"])),
        Some(at) if rest.len() == at + 1 => {
            Some(named(subject, |device| device.direction == Direction::Actuator))
        }
        Some(_) => None,
    }
}

/// `fault KIND of DEVICE at TIME for TIME;`
fn fault(subject: &Subject<'_, '_>, rest: &[&str]) -> Vec<Item> {
    match rest {
        [] => FaultKind::ALL.map(|kind| Item::new(kind.name(), ENUM_MEMBER)).into(),
        [_] => keywords(&["of", "at"]),
        [_, "of"] => named(subject, |device| device.direction == Direction::Sensor),
        [_, "of", _] => keywords(&["at"]),
        _ => {
            let after = rest.iter().rposition(|word| ["at", "for"].contains(word));
            let is_first = after.is_some_and(|at| at + 1 == rest.len());
            let next: &[&str] = if rest.contains(&"for") { &[] } else { &["for"] };
            time(subject, is_first, next)
        }
    }
}

/// A time, and what may come behind it.
fn time(subject: &Subject<'_, '_>, is_first: bool, next: &[&str]) -> Vec<Item> {
    let mut items = values::times(subject);
    let last = subject.site.before.last().map(|token| token.kind);
    if !is_first && matches!(last, Some(SyntaxKind::Unit | SyntaxKind::Ident | SyntaxKind::RParen))
    {
        items = keywords(next);
    }
    items
}

/// A rule: a condition, and the times that limit it.
fn rule(subject: &Subject<'_, '_>, keyword: &str, rest: &[&str]) -> Vec<Item> {
    let last = subject.site.before.last();
    if let Some(at) = rest.iter().rposition(|word| CLAUSES.contains(word)) {
        let left: Vec<&str> = CLAUSES.into_iter().filter(|word| !rest.contains(word)).collect();
        return time(subject, at + 1 == rest.len(), &left);
    }
    let ends_value = last.is_some_and(|token| {
        let is_word = token.kind == SyntaxKind::Ident && !is_joint(token.text) && !rest.is_empty();
        is_word
            || matches!(
                token.kind,
                SyntaxKind::Int
                    | SyntaxKind::Float
                    | SyntaxKind::Unit
                    | SyntaxKind::RParen
                    | SyntaxKind::RBracket
            )
    });
    if ends_value {
        let mut words = vec!["and", "or"];
        let has_then = rest.contains(&"then");
        if keyword == "when" && !has_then {
            words.push("then");
        } else {
            let has_within = keyword == "eventually" || keyword == "when";
            words.extend(CLAUSES.into_iter().filter(|word| has_within || *word != "within"));
        }
        let mut items = keywords(&words);
        if last.is_some_and(|token| matches!(token.kind, SyntaxKind::Int | SyntaxKind::Float)) {
            items.extend(values::units(subject, None));
        }
        return items;
    }
    operands(subject, rest)
}

/// Whether a word of conditions needs something behind it.
fn is_joint(word: &str) -> bool {
    ["and", "or", "not", "then", "in"].contains(&word)
}

/// What a condition or a value can begin with.
fn operands(subject: &Subject<'_, '_>, rest: &[&str]) -> Vec<Item> {
    if let [.., "health", "(", _, ")", "==" | "!="] = rest {
        return STATES.map(|(name, _)| Item::new(name, ENUM_MEMBER)).into();
    }
    let mut items = named(subject, |_| true);
    let counts = design(subject)
        .into_iter()
        .flat_map(|design| design.controllers.iter().filter_map(|one| design.device(one.device)));
    items.extend(counts.map(|own| {
        let name = format!("{}.overruns", own.name.value);
        Item::new(name, VALUE).detail("how many of its steps were late").rank(30)
    }));
    items.extend(FUNCTIONS.iter().map(|(name, takes, is)| {
        let item = Item::new(*name, FUNCTION).detail(format!("of {takes}: {is}"));
        item.snippet(format!("{name}($0)")).rank(40)
    }));
    items.extend(keywords(&["not"]).into_iter().map(|item| item.rank(60)));
    items.extend(values::constants(subject));
    items
}
