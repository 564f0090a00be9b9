//! Whole devices, one of each kind and direction.

use std::sync::OnceLock;

use sensedsl_model::kind::{KindName, Values};
use sensedsl_wire::{Direction, ScalarType};

use super::item::Item;
use crate::protocol::completion::{CLASS, SNIPPET, TYPE};

/// A device of each kind.
pub(super) fn of_kinds() -> Vec<Item> {
    static ALL: OnceLock<Vec<Item>> = OnceLock::new();
    let make = || {
        let ways = |kind: KindName| kind.spec().directions.iter().map(move |way| (kind, *way));
        let all = KindName::ALL.into_iter().flat_map(ways).zip(200_u32..);
        all.map(|((kind, way), rank)| device(kind, way).rank(rank)).collect()
    };
    ALL.get_or_init(make).clone()
}

fn device(kind: KindName, way: Direction) -> Item {
    let spec = kind.spec();
    let word = match way {
        Direction::Sensor => "sensor",
        Direction::Actuator => "actuator",
    };
    let text = kind.snippet(way, |place, usual| match place {
        0 => "    $0\n".to_owned(),
        _ => format!("${{{place}:{usual}}}"),
    });
    let about = kind.about();
    Item::new(format!("{word} {}", spec.name), SNIPPET)
        .snippet(text)
        .detail(about)
        .documentation(format!("{about}\n\nWires: {}.", spec.wires))
        .known_as(spec.name)
}

/// The kinds for a direction.
pub(super) fn kinds(way: Option<Direction>) -> Vec<Item> {
    let fits = |kind: &KindName| way.is_none_or(|way| kind.spec().directions.contains(&way));
    let all = KindName::ALL.into_iter().filter(fits).zip(10_u32..);
    all.map(|(kind, rank)| {
        let spec = kind.spec();
        let text = format!(
            "{}\n\nValues: {}.\n\nWires: {}.\n\nProperties: `{}`.",
            kind.about(),
            spec.values.shown(),
            spec.wires,
            spec.properties.join("`, `")
        );
        Item::new(spec.name, CLASS).detail(kind.about()).documentation(text).rank(rank)
    })
    .collect()
}

/// The types of a value of such a kind.
pub(super) fn types(kind: Option<KindName>) -> Vec<Item> {
    let fits = |scalar: &ScalarType| match kind.map(|kind| kind.spec().values) {
        None | Some(Values::Any) => true,
        Some(values) => values.accept(sensedsl_wire::ValueType::scalar(*scalar)).is_ok(),
    };
    let all = ScalarType::ALL.into_iter().filter(fits).zip(10_u32..);
    all.map(|(scalar, rank)| {
        let bytes = scalar.size_bytes();
        let unit = if bytes == 1 { "byte" } else { "bytes" };
        let range = scalar.integer_range().filter(|_| scalar != ScalarType::Bool);
        let range = range.map_or(String::new(), |(least, most)| format!(", {least} to {most}"));
        Item::new(scalar.name(), TYPE).detail(format!("{bytes} {unit}{range}")).rank(rank)
    })
    .collect()
}
