//! Drivers, of the library and of the file, with their values: as names, as chips, as the devices of a chip.

use std::sync::OnceLock;

use sensedsl_model::facts::{PartFacts, snippet};
use sensedsl_model::kind::KindName;
use sensedsl_wire::Direction;
use serde_json::json;

use super::item::{Item, escaped};
use super::subject::{self, DriverFacts, Place, Subject, ValueFacts};
use crate::features::hover;
use crate::library;
use crate::names::folded;
use crate::protocol::completion::{FIELD, MODULE, SNIPPET};

/// The page of a part.
pub(super) fn page(name: &str) -> Option<String> {
    library::part(name).map(hover::page)
}

/// The drivers that the block may name.
pub(super) fn names(subject: &Subject<'_, '_>) -> Vec<Item> {
    let block = subject.site.block();
    let stated = block.value("type").and_then(KindName::from_name);
    let own = subject::of_file(subject.cx);
    let suits = |one: &DriverFacts| {
        let has_values = !one.values.is_empty();
        let way = one.values.iter().any(|value| value.direction == subject.direction);
        if subject.place == Place::Chip {
            return has_values;
        }
        stated.is_none_or(|kind| one.kinds == [kind]) && (way || !has_values)
    };
    let shown = own
        .iter()
        .filter(|one| suits(one))
        .map(|one| Item::new(&one.name, MODULE).detail(&one.about).words(["file"]).rank(10));
    let mut items: Vec<Item> = shown.collect();
    for part in library::parts() {
        let is_own = own.iter().any(|one| one.name == part.name);
        let is_chip = part.values.iter().any(|value| value.name.is_some());
        let way = part.values.iter().any(|value| value.direction == subject.direction);
        let is_device = way && stated.is_none_or(|kind| part.kinds == [kind]);
        let suits = if subject.place == Place::Chip { is_chip } else { is_device };
        if suits && !is_own {
            let also = part.aliases.iter().cloned().chain(part.words.iter().map(|&one| one.into()));
            let item = Item::new(&part.name, MODULE).detail(&part.about).words(also);
            items.push(item.data(json!({ "part": part.name })).rank(20));
        }
    }
    items
}

/// A chip or a device for each part of the library.
pub(super) fn chips() -> Vec<Item> {
    static ALL: OnceLock<Vec<Item>> = OnceLock::new();
    ALL.get_or_init(|| library::parts().iter().map(chip).collect()).clone()
}

fn chip(part: &PartFacts) -> Item {
    let also = part.aliases.iter().cloned().chain(part.words.iter().map(|&one| one.into()));
    Item::new(&part.name, SNIPPET)
        .snippet(escaped(snippet(part).trim_end()))
        .detail(&part.about)
        .words(also)
        .data(json!({ "part": part.name }))
        .rank(300)
}

/// The values of the chip's driver that none of its devices is yet, in one direction or in both.
fn free<'v>(subject: &'v Subject<'_, '_>, way: Option<Direction>) -> Vec<&'v ValueFacts> {
    let chip = subject.site.blocks.iter().find(|block| block.keyword() == "chip");
    let used: Vec<String> = chip
        .iter()
        .flat_map(|chip| &chip.blocks)
        .filter_map(|block| block.value("reading").or_else(|| block.name()))
        .map(folded)
        .collect();
    let all = subject.driver.iter().flat_map(|driver| &driver.values);
    let all = all.filter(|value| way.is_none_or(|way| way == value.direction));
    all.filter(|value| !used.contains(&folded(&value.name))).collect()
}

/// The devices that the chip could have.
pub(super) fn devices(subject: &Subject<'_, '_>) -> Vec<Item> {
    let all = free(subject, None).into_iter().zip(12_u32..);
    all.map(|(value, rank)| {
        let word = match value.direction {
            Direction::Sensor => "sensor",
            Direction::Actuator => "actuator",
        };
        let head = head(value);
        Item::new(format!("{word} {}", value.name), SNIPPET)
            .snippet(format!("{word} {} {{ $0 }}", escaped(&head)))
            .detail(about(value))
            .words([value.name.as_str()])
            .rank(rank)
    })
    .collect()
}

/// After `sensor` or `actuator` in a chip: the rest of a head.
pub(super) fn heads(subject: &Subject<'_, '_>, way: Direction) -> Vec<Item> {
    let all = free(subject, Some(way)).into_iter();
    all.map(|value| {
        let head = head(value);
        Item::new(head.clone(), SNIPPET)
            .snippet(format!("{} {{ $0 }}", escaped(&head)))
            .detail(about(value))
    })
    .collect()
}

fn head(value: &ValueFacts) -> String {
    let verb = match value.direction {
        Direction::Sensor => "returns",
        Direction::Actuator => "accepts",
    };
    format!("{} {verb} {}", camel(&value.name), value.ty)
}

fn about(value: &ValueFacts) -> String {
    let unit = value.quantity.as_deref().map_or(String::new(), |unit| format!(" in {unit}"));
    format!("{}{unit}", value.ty)
}

/// `magnetic_field` becomes `MagneticField`.
fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    words.collect()
}

/// The readings or commands that a device may be.
pub(super) fn readings(subject: &Subject<'_, '_>) -> Vec<Item> {
    let all = subject.driver.iter().flat_map(|driver| &driver.values);
    let fits = all.filter(|value| value.direction == subject.direction).zip(10_u32..);
    fits.map(|(value, rank)| Item::new(&value.name, FIELD).detail(about(value)).rank(rank))
        .collect()
}

/// The connections of the driver.
pub(super) fn connections(subject: &Subject<'_, '_>) -> Vec<Item> {
    let all = subject.driver.iter().flat_map(|driver| &driver.connections);
    all.map(|(name, kind)| Item::new(name, FIELD).detail(kind.about()).rank(10)).collect()
}
