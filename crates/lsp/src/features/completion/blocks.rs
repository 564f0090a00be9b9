//! What begins a statement: the words of a block, its properties, whole devices and chips.

use sensedsl_model::meaning::{Block, Meaning};
use sensedsl_syntax::SyntaxKind;

use super::described::described;
use super::item::Item;
use super::subject::{Place, Subject};
use super::{devices, drivers};
use crate::protocol::completion::{KEYWORD, PROPERTY};

/// Words of statements: the word, what is written, what it is for.
type Words = &'static [(&'static str, &'static str, &'static str)];

const FILE: Words = &[
    ("board", "board ${1:Robot} on ${2:NUCLEO_F446RE} {\n    $0\n}", "A board, and what is on it."),
    ("use", "use \"$1\";", "Brings in the drivers and devices of another file."),
    ("const", "const ${1:NAME} = $2;", "Gives a value a name."),
    (
        "spare",
        "spare board ${1:Spare} on ${2:NUCLEO_F446RE} {\n    $0\n}",
        "A board that is used only if the devices need it.",
    ),
    (
        "driver",
        "driver ${1:my_part} for ${2:i2c} {\n    $0\n}",
        "Says how a part is wired, started and talked to.",
    ),
    (
        "test",
        "test ${1:Name} {\n    for = ${2:10 s};\n    $0\n}",
        "What must hold while the boards run.",
    ),
];
const PARTS: Words = &[
    (
        "sensor",
        "sensor ${1:Name} returns ${2:uint16} {\n    $0\n}",
        "A device that gives a value to the host.",
    ),
    (
        "actuator",
        "actuator ${1:Name} accepts ${2:uint16} {\n    $0\n}",
        "A device that takes a value from the host.",
    ),
    ("chip", "chip ${1:Name} {\n    driver = $2;\n    $0\n}", "A part with several values."),
];
const WISHES: Words = &[
    ("prefer", "prefer $1 = $2;", "A soft rule: violated when a wire is not so."),
    ("avoid", "avoid $1 = $2;", "A soft rule: violated when a wire is so."),
    (
        "allow",
        "allow ${1:W0602} \"${2:reason}\";",
        "Accepts a warning or hint there, for a reason.",
    ),
];
const RESOURCES: Words = &[
    ("reserve", "reserve $1;", "Pins and peripherals that stay free."),
    ("release", "release $1;", "Pins that may be used although something on the board has them."),
    ("link", "link {\n    $0\n}", "How the board talks to the host."),
];
const OF_BOARD: Words = &[(
    "controller",
    "controller ${1:Name} every ${2:10 ms} {\n    reads = [$3];\n    sets = [$4];\n}",
    "Code of yours that runs on the board.",
)];
const OF_TEST: Words = &[
    ("at", "at ${1:1 s} set $2 = $3;", "The host sets an actuator."),
    ("fault", "fault ${1:no_answer} of $2 at ${3:1 s} for ${4:500 ms};", "Something breaks."),
    ("always", "always $1;", "Holds at all times."),
    ("never", "never $1;", "Holds at no time."),
    ("eventually", "eventually $1 within ${2:5 s};", "Holds at some time."),
    (
        "when",
        "when $1 then $2 within ${3:100 ms};",
        "Each time that the first holds, the second does at most so much later.",
    ),
];
const OF_CHIP: Words = &[
    ("sensor", "sensor ${1:Name} returns ${2:uint16} { $0 }", "One of the chip's readings."),
    ("actuator", "actuator ${1:Name} accepts ${2:uint16} { $0 }", "One of the chip's commands."),
    ("connection", "connection ${1:name} { $0 }", "Says more of one of the chip's connections."),
];
const OF_DRIVER: Words = &[
    (
        "reading",
        "reading ${1:name} returns ${2:uint16} {\n    $0\n}",
        "A value that the part gives.",
    ),
    (
        "command",
        "command ${1:name} accepts ${2:uint16} {\n    $0\n}",
        "A value that the part takes.",
    ),
    ("connection", "connection ${1:name} for ${2:digital} { $0 }", "Wires of one kind."),
];

/// Everything that may begin a statement.
pub(super) fn items(subject: &Subject<'_, '_>) -> Vec<Item> {
    let words: &[Words] = match subject.place {
        Place::File => &[FILE, PARTS],
        Place::Board => &[PARTS, OF_BOARD, WISHES, RESOURCES],
        Place::Controller => &[WISHES],
        Place::Test => &[OF_TEST],
        Place::Device | Place::OfChip => &[WISHES],
        Place::Chip => &[OF_CHIP, WISHES],
        Place::Driver => &[OF_DRIVER],
        Place::Link | Place::Connection | Place::OfDriver | Place::Unknown => &[],
    };
    let mut items = properties(subject);
    // A word whose statement is there already is exchanged alone.
    let is_alone = !subject.site.word.is_empty()
        && subject.site.next.as_ref().is_some_and(|next| next.kind != SyntaxKind::RBrace);
    items.extend(words.iter().copied().flatten().map(|(word, text, about)| {
        let item = Item::new(*word, KEYWORD).detail(*about).rank(20);
        if is_alone { item } else { item.snippet(*text) }
    }));
    if is_alone {
        return items;
    }
    match subject.place {
        Place::File | Place::Board => {
            items.extend(devices::of_kinds());
            items.extend(drivers::chips());
        }
        Place::Chip => items.extend(drivers::devices(subject)),
        Place::Link
        | Place::Device
        | Place::OfChip
        | Place::Connection
        | Place::Driver
        | Place::OfDriver
        | Place::Controller
        | Place::Test
        | Place::Unknown => {}
    }
    items
}

/// The properties that are not there yet.
fn properties(subject: &Subject<'_, '_>) -> Vec<Item> {
    let block = subject.site.block();
    let known: Vec<&str> = block.properties().collect();
    let all = subject.block().map(Block::properties).unwrap_or_default();
    let own = all.into_iter().filter(|one| !known.contains(&one.name));
    let own = own.zip(30_u32..).map(|(one, rank)| {
        let rank = if is_first(one, subject) { 10 } else { rank };
        property(subject, one.name)
            .detail(one.takes.to_string().replace('`', ""))
            .documentation(described(one))
            .rank(rank)
    });
    let mut items: Vec<Item> = own.collect();
    if subject.place == Place::Chip || subject.place == Place::Device {
        let connections = subject.driver.iter().flat_map(|driver| &driver.connections);
        let named = connections.filter(|(name, _)| !known.contains(&name.as_str()));
        items.extend(named.map(|(name, kind)| {
            let detail = format!("the pin of the connection `{name}`, {}", kind.with_article());
            property(subject, name).detail(detail.replace(" device", "")).rank(28)
        }));
    }
    items
}

/// Whether a property comes before all others: what the block must have, and what says what it is.
fn is_first(meaning: &Meaning, subject: &Subject<'_, '_>) -> bool {
    let says_what = ["type", "driver"].contains(&meaning.name) && subject.kinds.is_empty();
    let is_stated = subject.driver.as_ref().is_some_and(|driver| driver.states(meaning.name));
    meaning.is_required() && !is_stated
        || says_what
        || subject.place == Place::OfChip && meaning.name == "reading"
}

/// A property as it is written: its name alone where its value is there already.
pub(super) fn property(subject: &Subject<'_, '_>, name: &str) -> Item {
    let item = Item::new(name, PROPERTY);
    let has_value = subject.site.next.as_ref().is_some_and(|next| next.kind == SyntaxKind::Eq);
    if has_value { item } else { item.snippet(format!("{name} = $1;")) }
}
