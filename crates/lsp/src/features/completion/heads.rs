//! The heads of blocks, and what rules name: what may follow the words before the cursor.

use sensedsl_diagnostics::{Severity, codes};
use sensedsl_model::meaning::Block;
use sensedsl_wire::Direction;

use super::described::described;
use super::item::Item;
use super::subject::{Place, Subject};
use super::{blocks, boards, devices, drivers, pins, values};
use crate::protocol::completion::{ENUM_MEMBER, KEYWORD, SNIPPET};

pub(super) fn items(subject: &Subject<'_, '_>) -> Vec<Item> {
    let words = subject.site.words();
    let words = match words.as_slice() {
        ["spare"] => return keyword("board"),
        ["spare", rest @ ..] => rest,
        all => all,
    };
    match words {
        ["board"] => boards::names(),
        ["board", _] => keyword("on"),
        ["board", _, "on"] => boards::sources(),
        ["sensor"] if subject.place == Place::Chip => drivers::heads(subject, Direction::Sensor),
        ["actuator"] if subject.place == Place::Chip => {
            drivers::heads(subject, Direction::Actuator)
        }
        ["sensor" | "reading", _] => keyword("returns"),
        ["actuator" | "command", _] => keyword("accepts"),
        ["sensor" | "reading", _, "returns"] | ["actuator" | "command", _, "accepts"] => {
            devices::types(type_after(subject))
        }
        ["sensor" | "reading" | "actuator" | "command", _, _, _, "["] => values::constants(subject),
        ["controller", _] => keyword("every"),
        ["controller", _, "every", ..] => values::times(subject),
        ["connection"] if subject.place == Place::Chip => drivers::connections(subject),
        ["driver" | "connection", _] if subject.place != Place::Chip => keyword("for"),
        ["driver" | "connection", _, "for"] => devices::kinds(None),
        ["prefer" | "avoid"] => wishes(subject),
        ["reserve", ..] if is_next(words) => {
            let mut items = pins::pins(subject, &[]);
            items
                .extend(pins::peripherals(subject, &[]).into_iter().map(|one| one.rank(9_000_000)));
            items
        }
        ["release", ..] if is_next(words) => pins::kept(subject),
        ["allow"] => allowed(),
        ["allow", _] => vec![Item::new("\"reason\"", SNIPPET).snippet("\"${1:reason}\";")],
        _ => Vec::new(),
    }
}

fn keyword(word: &str) -> Vec<Item> {
    vec![Item::new(word, KEYWORD)]
}

/// Whether a list of names goes on here.
fn is_next(words: &[&str]) -> bool {
    words.len() == 1 || words.last() == Some(&",")
}

/// The kind of the block whose head is written, if what follows says it.
fn type_after(subject: &Subject<'_, '_>) -> Option<sensedsl_model::kind::KindName> {
    let site = subject.site;
    let name = site.words().get(1).copied();
    let written = site.block().blocks.iter().find(|block| block.name() == name)?;
    sensedsl_model::kind::KindName::from_name(written.value("type")?)
}

fn wishes(subject: &Subject<'_, '_>) -> Vec<Item> {
    let of_kind = |name: &str| {
        let wires = sensedsl_model::kind::Role::ALL.map(sensedsl_model::kind::Role::property);
        let is_wire = wires.contains(&name);
        !is_wire
            || subject.kinds.is_empty()
            || subject.kinds.iter().any(|kind| kind.spec().properties.contains(&name))
    };
    let all = Block::Wish.properties().into_iter().filter(|one| of_kind(one.name));
    all.map(|one| blocks::property(subject, one.name).documentation(described(one))).collect()
}

/// The codes of warnings and hints.
fn allowed() -> Vec<Item> {
    let all = codes::ALL.iter().filter(|code| code.severity() != Severity::Error);
    all.map(|code| {
        let info = code.info();
        Item::new(code.name(), ENUM_MEMBER)
            .snippet(format!("{} \"${{1:reason}}\";", code.name()))
            .detail(info.title)
            .documentation(info.explanation)
            .words(info.title.split(' '))
    })
    .collect()
}
