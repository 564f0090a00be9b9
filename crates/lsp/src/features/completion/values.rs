//! The values of properties: words, kinds, units, constants, and what the board and the driver have.

use std::collections::BTreeSet;

use sensedsl_board::profile;
use sensedsl_board::table::Pin;
use sensedsl_model::kind::KindName;
use sensedsl_model::meaning::Takes;
use sensedsl_syntax::ast::{AstNode as _, SourceFile};
use sensedsl_syntax::{SyntaxKind, Unit};

use super::item::Item;
use super::site::{Block, Token, joins};
use super::subject::{Place, Subject};
use super::{control, devices, drivers, pins};
use crate::library;
use crate::protocol::completion::{CONSTANT, ENUM_MEMBER, KEYWORD, UNIT, VALUE};

/// What may stand at the cursor in a property's value.
pub(super) fn of_property(subject: &Subject<'_, '_>) -> Vec<Item> {
    let site = subject.site;
    let Some((name, value)) = site.property() else { return Vec::new() };
    let meaning = subject.meaning();
    let takes = meaning.map(|meaning| meaning.takes);
    if value.last().is_some_and(is_number) && !site.in_text {
        return units(subject, takes.as_ref());
    }
    if !value.last().is_none_or(expects_value) {
        return Vec::new();
    }
    let mut items = match takes {
        Some(_) if name == "mux" => selectors(subject),
        Some(takes) => of_takes(subject, name, &takes),
        // The pin of a connection.
        None if subject.connection(name).is_some() => pins::pins(subject, &subject.wires(name)),
        None => Vec::new(),
    };
    if !site.in_text {
        items = items.into_iter().map(quoted_if_needed).collect();
        items.extend(constants(subject));
    }
    items
}

fn of_takes(subject: &Subject<'_, '_>, name: &str, takes: &Takes) -> Vec<Item> {
    match takes {
        Takes::Kind => devices::kinds(Some(subject.direction)),
        Takes::Driver => drivers::names(subject),
        Takes::Reading => drivers::readings(subject),
        Takes::Connections => drivers::connections(subject),
        Takes::Output => {
            let outputs = subject.driver.iter().flat_map(|driver| &driver.outputs);
            outputs.map(|one| Item::new(*one, ENUM_MEMBER)).collect()
        }
        Takes::Pin => {
            let mut items = pins::pins(subject, &subject.wires(name));
            let may_be_none = name == "tx" && subject.kinds == [KindName::Uart];
            let none = Item::new("none", ENUM_MEMBER).detail("the board sends nothing");
            items.extend(may_be_none.then(|| none.rank(0)));
            items
        }
        Takes::Peripheral => {
            let of_link = subject.place == Place::Link;
            let kinds = if of_link { &[KindName::Uart][..] } else { &subject.kinds };
            pins::peripherals(subject, kinds)
        }
        Takes::Side => pins::places(subject, Pin::sides),
        Takes::Header => pins::places(subject, Pin::headers),
        Takes::Group => groups(subject),
        Takes::Target => targets(),
        Takes::Quantity => quantities(),
        Takes::Devices => control::devices(subject, name),
        Takes::Shown => {
            let mut items = vec![Item::new("raw", KEYWORD).text("raw ").detail("a code")];
            let is_truth = subject.site.block().head.iter().any(|token| token.text == "bool");
            items.extend(["true", "false"].into_iter().filter(|_| is_truth).map(word));
            items
        }
        Takes::Words(_) | Takes::Truth => {
            let words = takes.words().into_iter().zip(10_u32..);
            words.map(|(one, rank)| word(one).rank(rank)).collect()
        }
        Takes::Whole(..)
        | Takes::Hex(..)
        | Takes::Number
        | Takes::Bound
        | Takes::Time(..)
        | Takes::Pulse
        | Takes::Frequency(..)
        | Takes::Rate(..)
        | Takes::Voltage(..)
        | Takes::Resistances
        | Takes::Bytes(..)
        | Takes::Text
        | Takes::Texts
        | Takes::Form(..) => Vec::new(),
    }
}

/// The other values of the block around it and of the same direction: one of them can say which frame it is.
fn selectors(subject: &Subject<'_, '_>) -> Vec<Item> {
    let (own, outer) = (subject.site.block(), subject.site.blocks.get(1));
    let all = outer.iter().flat_map(|outer| &outer.blocks);
    let others = all.filter(|one| one.keyword() == own.keyword() && one.name() != own.name());
    let has_value = subject.site.next.as_ref().is_some_and(|next| next.kind == SyntaxKind::Eq);
    let equals = if has_value { "" } else { " = " };
    let names = others.filter_map(Block::name);
    names.map(|name| Item::new(name, VALUE).text(format!("{name}{equals}"))).collect()
}

fn word(word: &str) -> Item {
    Item::new(word, ENUM_MEMBER).rank(10)
}

fn is_number(token: &Token<'_>) -> bool {
    matches!(token.kind, SyntaxKind::Int | SyntaxKind::Float)
}

/// Whether a value can begin after a token.
fn expects_value(token: &Token<'_>) -> bool {
    joins(token.kind) || matches!(token.kind, SyntaxKind::LBracket | SyntaxKind::LParen)
}

/// The units that a number may have. None of them takes the place of a word that goes on with the statement, such as
/// `set` in `at 1 set`.
pub(super) fn units(subject: &Subject<'_, '_>, takes: Option<&Takes>) -> Vec<Item> {
    let word = subject.cx.text.get(subject.site.word.clone()).unwrap_or_default();
    if ["set", "for", "from", "to", "within", "and", "or", "then"].contains(&word) {
        return Vec::new();
    }
    let all = Unit::ALL.as_slice();
    let units = match takes {
        // A constant may be anything.
        None => all.to_vec(),
        Some(Takes::Shown | Takes::Bound) => shown(subject),
        Some(takes) => takes.units().to_vec(),
    };
    let units = units.into_iter().zip(10_u32..);
    units.map(|(unit, rank)| Item::new(unit.name(), UNIT).rank(rank)).collect()
}

/// What may be written for a time: the unit behind a number, else a constant.
pub(super) fn times(subject: &Subject<'_, '_>) -> Vec<Item> {
    let is_behind_number = subject.site.before.last().is_some_and(is_number);
    if is_behind_number {
        return units(subject, Some(&Takes::Time(0, 0)));
    }
    if subject.site.before.last().is_some_and(|last| last.kind == SyntaxKind::Unit) {
        return Vec::new();
    }
    constants(subject)
}

/// The units of the block's shown value: those that its `quantity` can be converted from.
fn shown(subject: &Subject<'_, '_>) -> Vec<Unit> {
    const ALIKE: &[&[&str]] = &[
        &["us", "ms", "s"],
        &["Hz", "kHz", "MHz"],
        &["mV", "V"],
        &["Ohm", "kOhm"],
        &["mm", "cm", "m"],
        &["mA", "A"],
        &["mm/s", "cm/s", "m/s"],
    ];
    let quantity = subject.site.block().value("quantity");
    let names: Vec<&str> = match quantity {
        Some(quantity) => {
            let alike = ALIKE.iter().find(|units| units.contains(&quantity));
            alike.map_or_else(|| vec![quantity], |units| units.to_vec())
        }
        None if subject.kinds == [KindName::Pwm] => vec!["%", "us", "ms"],
        None => Vec::new(),
    };
    names.into_iter().filter_map(Unit::from_name).collect()
}

/// The constants of all files; none before a number, whose first word a constant cannot be (`raw 307`).
pub(super) fn constants(subject: &Subject<'_, '_>) -> Vec<Item> {
    if subject.site.next.as_ref().is_some_and(is_number) {
        return Vec::new();
    }
    let trees = subject.cx.analysis.snapshot.trees();
    let own = subject.site.before.first().filter(|first| first.text == "const");
    let own = own.and_then(|_| subject.site.property()).map(|(name, _)| name);
    let of_file = |file: SourceFile| {
        let all = file.constants().filter_map(|one| {
            let name = one.name()?.text().to_owned();
            let value = one.value().map(|value| value.syntax().text().to_string());
            Some(Item::new(name, CONSTANT).detail(value.unwrap_or_default().trim()).rank(150))
                .filter(|_| one.name().is_none_or(|name| Some(name.text()) != own))
        });
        all.collect::<Vec<_>>()
    };
    trees.iter().flat_map(|(_, tree)| of_file(tree.ast())).collect()
}

/// The groups that anything is in.
fn groups(subject: &Subject<'_, '_>) -> Vec<Item> {
    fn of_block(block: &Block<'_>, groups: &mut BTreeSet<String>) {
        groups.extend(block.value("group").map(str::to_owned));
        block.blocks.iter().for_each(|inner| of_block(inner, groups));
    }
    let mut groups = BTreeSet::from(["ultrasonic".to_owned(), "none".to_owned()]);
    if let Some(file) = subject.site.blocks.last() {
        of_block(file, &mut groups);
    }
    groups.into_iter().map(|group| Item::new(group, VALUE)).collect()
}

fn targets() -> Vec<Item> {
    let versions = profile::names();
    let systems: BTreeSet<&str> = versions.iter().filter_map(|one| one.split('-').next()).collect();
    let systems = systems.into_iter().map(|one| word(one).detail("its newest version"));
    let mut items: Vec<Item> = systems.collect();
    items.push(word(profile::NONE).detail("pins only, no firmware"));
    items.extend(versions.iter().filter(|one| one.contains('-')).map(|one| word(one).rank(20)));
    items
}

/// The units that devices show: those of the language, and those that parts of the library have.
fn quantities() -> Vec<Item> {
    let of_parts = library::parts().iter().flat_map(|part| &part.values);
    let of_parts = of_parts.filter_map(|value| value.shown.quantity.as_deref());
    let all: BTreeSet<&str> = Unit::ALL.iter().map(|unit| unit.name()).chain(of_parts).collect();
    all.into_iter().map(|unit| Item::new(unit, UNIT)).collect()
}

/// Quotes around what is not a name: `"8N1"`.
fn quoted_if_needed(item: Item) -> Item {
    // What goes on after the name is not a part of it.
    let mut letters = item.written().trim_end_matches([' ', '=']).chars();
    let is_pin = |one: char| one == '.';
    let begins = letters.next().is_some_and(|one| one.is_ascii_alphabetic() || one == '_');
    let is_name =
        begins && letters.all(|one| one.is_ascii_alphanumeric() || one == '_' || is_pin(one));
    if is_name {
        return item;
    }
    let text = format!("\"{}\"", item.written());
    item.text(text)
}
