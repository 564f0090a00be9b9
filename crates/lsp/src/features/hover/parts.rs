//! Parts: a device's wires and why they are there, a driver's page, a kind's wires.

use sensedsl_model::design::{ConnectionIndex, Design};
use sensedsl_model::facts::{PartFacts, example};
use sensedsl_model::kind::KindName;
use sensedsl_report::why;
use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::Direction;
use sensedsl_wiring::Wiring;
use sensedsl_wiring::assignment::Assignment;

use crate::context::Context;
use crate::library;
use crate::wires::{self, escaped};

/// A device or a chip: its wires, and what other pins would cost if there is time to find out.
pub(crate) fn part(cx: &Context<'_>, name: &str) -> Option<String> {
    let (design, wiring) = cx.wired.as_ref().and_then(|wired| wired.wired())?;
    let (_, part) = wires::part_of(design, name)?;
    let rows = wires::of_part(&wires::all((design, wiring)), part);
    let first = rows.first()?;
    let values = if first.values.is_empty() {
        String::new()
    } else {
        format!(": {}", first.values.join(", "))
    };
    let head = format!(
        "**{}**{}, {} of {}, id {}, cost {}",
        escaped(part),
        escaped(&values),
        escaped(&first.kind),
        escaped(&first.board),
        first.ids(),
        wires::cost(&rows)
    );
    let table = wires::table(&rows);
    let why = explained(cx, (design, wiring), name);
    let why = why.map_or(String::new(), |why| format!("\n```text\n{why}```\n"));
    Some(format!("{head}\n\n{table}{why}"))
}

/// Why a part is on its pins, as `explain wiring` tells it; none if there was no time.
pub(crate) fn explained(
    cx: &Context<'_>,
    (design, wiring): (&Design, &Assignment),
    name: &str,
) -> Option<String> {
    let (part, _) = wires::part_of(design, name)?;
    let all = design.connections.iter().enumerate();
    let own = all.filter(|(_, one)| one.part == part).map(|(index, _)| ConnectionIndex(index));
    let own: Vec<ConnectionIndex> = own.collect();
    let found = Wiring::within(design, None, cx.cancel).why(wiring, &own);
    let is_known = found.complete && !found.all.is_empty() && !cx.cancel.is_over();
    is_known.then(|| why::summary(design, wiring, &found.all, ""))
}

/// A driver: the page of the library's part, or the block of the file.
pub(crate) fn driver(cx: &Context<'_>, name: &str) -> Option<String> {
    let trees = cx.analysis.snapshot.trees().iter();
    let mut own = trees.flat_map(|(_, tree)| tree.ast().drivers().collect::<Vec<_>>());
    if let Some(node) = own.find(|one| one.name().is_some_and(|own| own.text() == name)) {
        return Some(format!("```sensedsl\n{}\n```", node.syntax().text().to_string().trim()));
    }
    library::part(name).map(page)
}

/// A part of the library in short: what it is, its values, an example.
pub(crate) fn page(part: &PartFacts) -> String {
    let mut text = format!("**{}**\n\n{}\n\n", escaped(&part.part), escaped(&part.about));
    for value in &part.values {
        let name = value.name.as_deref().unwrap_or("value");
        let unit =
            value.shown.quantity.as_deref().map_or(String::new(), |unit| format!(" in {unit}"));
        text.push_str(&format!(
            "- {} `{name}` {}{}\n",
            direction(value.direction),
            value.value,
            escaped(&unit)
        ));
    }
    text.push_str(&format!("\n```sensedsl\n{}```\n", example(part)));
    if let Some(sheet) = &part.sheet {
        text.push_str(&format!("\nSource: {}\n", escaped(sheet)));
    }
    text
}

/// A value of a part of the library.
pub(crate) fn value(driver: &str, name: &str) -> Option<String> {
    let part = library::part(driver)?;
    let value = part.values.iter().find(|one| one.name.as_deref() == Some(name))?;
    let unit = value.shown.quantity.as_deref().map_or(String::new(), |unit| format!(" in {unit}"));
    Some(format!("`{name}` of {}: {}{}", escaped(&part.part), value.value, escaped(&unit)))
}

/// A kind, where it stands after `type`.
pub(crate) fn kind(value: &SyntaxNode, written: &str) -> Option<String> {
    let property = value.ancestors().find_map(ast::Property::cast)?.name()?;
    let kind = KindName::from_name(written.trim_matches('"'))?;
    let spec = kind.spec();
    (property.text() == "type").then(|| {
        format!(
            "**{}**: {}\n\nvalues: {}\n\nproperties: `{}`",
            spec.name,
            spec.wires,
            spec.values.shown(),
            spec.properties.join("`, `")
        )
    })
}

const fn direction(direction: Direction) -> &'static str {
    match direction {
        Direction::Sensor => "sensor",
        Direction::Actuator => "actuator",
    }
}
