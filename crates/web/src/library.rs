//! What a page offers to choose from: built-in boards, and parts with drivers.

use sensedsl_board::{catalog, mcu};
use sensedsl_generate::target::systems_of;
use sensedsl_model::facts::{PartFacts, snippet};
use sensedsl_model::kind::KindName;
use sensedsl_model::part_facts;
use sensedsl_report::{drivers, svg};
use sensedsl_session::boards::{free, links, package};
use sensedsl_wire::Direction;
use serde_json::{Value, json};

/// All built-in boards, in the order of the catalogue.
pub(crate) fn boards() -> Value {
    Value::Array(catalog::all().iter().map(board).collect())
}

fn board(entry: &catalog::Entry) -> Value {
    let table = entry.table();
    let mut keywords: Vec<&str> = entry.aliases.to_vec();
    keywords.push(entry.description);
    json!({
        "name": entry.name,
        "mcu": entry.mcu,
        "family": mcu::family(entry.mcu),
        "package": package(entry),
        "pins": table.pins.len(),
        "free": free(&table),
        "link": links(entry).join(" "),
        "firmware": systems_of(entry),
        "keywords": keywords.join(" "),
    })
}

/// The picture of a board that nothing is wired to; `null` if there is no such board.
pub(crate) fn picture(name: &str) -> Option<String> {
    let board = catalog::find(name)?;
    svg::of_built_in(board)
}

/// A device of each kind, for a part that no driver is needed for or that has none, and all parts with drivers, in the
/// order of the library.
pub(crate) fn parts() -> Value {
    let ways = |kind: KindName| kind.spec().directions.iter().map(move |way| any(kind, *way));
    let kinds = KindName::ALL.into_iter().flat_map(ways);
    Value::Array(kinds.chain(part_facts().iter().map(part)).collect())
}

fn any(kind: KindName, way: Direction) -> Value {
    let spec = kind.spec();
    let word = match way {
        Direction::Sensor => "sensor",
        Direction::Actuator => "actuator",
    };
    let name = spec.name[..1].to_uppercase() + &spec.name[1..];
    let place = |place, usual: &str| if place == 1 { name.clone() } else { usual.to_owned() };
    let about = kind.about();
    let page = format!("# Any {} {word}\n\n{about}\n\nWires: {}.\n", spec.name, spec.wires);
    json!({
        "name": spec.name,
        "title": format!("Any {} {word}", spec.name),
        "about": about,
        "field": "any",
        "kind": spec.name,
        "quantities": [],
        "aliases": [word],
        "snippet": kind.snippet(way, place) + "\n",
        "page": page,
    })
}

fn part(of: &PartFacts) -> Value {
    let mut quantities: Vec<&str> = Vec::new();
    for value in &of.values {
        let quantity = value.shown.quantity.as_deref();
        quantities.extend(quantity.filter(|one| !quantities.contains(one)));
    }
    let kinds: Vec<&str> = of.kinds.iter().map(|kind| kind.name()).collect();
    let aliases: Vec<&str> =
        of.aliases.iter().map(String::as_str).chain(of.words.iter().copied()).collect();
    json!({
        "name": of.name,
        "title": of.part,
        "about": of.about,
        "field": of.field,
        "kind": kinds.join(", "),
        "quantities": quantities,
        "aliases": aliases,
        "snippet": snippet(of),
        "page": drivers::page(of),
    })
}
