//! A page for each part, and one that lists them, in Markdown.

use std::fmt::Write as _;

use sensedsl_model::facts::{PartFacts, ValueFacts, example};
use sensedsl_model::written::shown_hz;
use sensedsl_wire::Direction;

use super::words::{self, wrapped};
use crate::contact::Wires;

/// Characters in a line.
const WIDTH: usize = 120;

/// The page that lists all parts, with links to their pages. `intro` comes before the tables.
#[must_use]
pub fn index(parts: &[PartFacts], intro: &str) -> String {
    let mut out = intro.to_owned();
    for (field, parts) in super::by_field(parts) {
        let _ = write!(
            out,
            "\n## {field}\n\n| driver | kind | part | values |\n| --- | --- | --- | --- |\n"
        );
        for part in parts {
            let _ = writeln!(
                out,
                "| [`{0}`]({0}.md) | {1} | {2} | {3} |",
                part.name,
                words::kinds(part),
                cell(&part.part),
                cell(&words::values(part)),
            );
        }
    }
    out
}

/// The page of one part.
#[must_use]
pub fn page(part: &PartFacts) -> String {
    let mut out = format!("# {}\n\n", part.part);
    out.push_str(&wrapped(&part.about, WIDTH, "", ""));
    let also = match part.aliases.as_slice() {
        [] => String::new(),
        aliases => {
            let aliases: Vec<String> = aliases.iter().map(|one| format!("`{one}`")).collect();
            format!(" Other names that find it: {}.", aliases.join(", "))
        }
    };
    let names = format!("`driver = {};`{also}", part.name);
    let _ = write!(out, "\n{}", wrapped(&names, WIDTH, "", ""));
    out.push_str("\n[All parts](README.md) · [the language](../language.md)\n");
    wiring(&mut out, part);
    if !part.module.notes.is_empty() {
        out.push_str("\n## Notes\n\n");
        for note in &part.module.notes {
            out.push_str(&wrapped(note, WIDTH, "- ", "  "));
        }
    }
    let _ = write!(out, "\n## Example\n\n```\n{}```\n", example(part));
    values(&mut out, part);
    sources(&mut out, part);
    out
}

fn wiring(out: &mut String, part: &PartFacts) {
    out.push_str(
        "\n## Wiring\n\n| wire | kind | at the part | settings |\n| --- | --- | --- | --- |\n",
    );
    for connection in &part.connections {
        let wires = Wires::of_driver(connection);
        for (at, role) in connection.roles.iter().enumerate() {
            let first = at == 0;
            let kind = if first { connection.kind.name().name() } else { "" };
            let settings = if first { words::settings(&connection.kind) } else { String::new() };
            let _ = writeln!(
                out,
                "| `{}` | {kind} | {} | {settings} |",
                wires.wire(*role),
                cell(wires.contact(&part.module, *role).unwrap_or_default()),
            );
        }
    }
    let connector = part.module.connector.join(" · ");
    let pull =
        "The lines need resistors to the supply, 2.2 kOhm to 10 kOhm; most modules have them.";
    let facts = [
        words::supply(part).map(|text| format!("**Supply**: {text}.")),
        words::levels(part).map(|text| format!("**Signals**: {text}.")),
        part.needs_pull_up.then(|| format!("**Pull-up**: {pull}")),
        part.clock_max_hz.map(|hz| format!("**Clock**: {} at most.", shown_hz(hz))),
        words::addresses(part).map(|text| format!("**Address**: {text}.")),
        (!part.module.connector.is_empty())
            .then(|| format!("**Connector**, in the order of the usual module: {connector}.")),
        words::identity(part).map(|text| {
            format!("**Identity**: the board looks for {text}, and reports another part.")
        }),
    ];
    let mut facts = facts.into_iter().flatten().peekable();
    if facts.peek().is_some() {
        out.push('\n');
    }
    for fact in facts {
        out.push_str(&wrapped(&fact, WIDTH, "- ", "  "));
    }
}

fn values(out: &mut String, part: &PartFacts) {
    out.push_str(
        "\n## Values\n\n| value | | type | unit | scale | range | invalid |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for one in &part.values {
        let way = match one.direction {
            Direction::Sensor => "sensor",
            Direction::Actuator => "actuator",
        };
        let name = match &one.name {
            Some(name) => format!("`{name}`"),
            None => "the only one".to_owned(),
        };
        let _ = writeln!(
            out,
            "| {name} | {way} | `{}` | {} | {} | {} | {} |",
            one.value,
            cell(words::unit(one)),
            words::scale(one),
            words::range(one),
            words::invalid(one),
        );
    }
    let has = |of: fn(&ValueFacts) -> bool| part.values.iter().any(of);
    let mut reported = Vec::new();
    if has(|one| one.shown.offset.is_some()) {
        reported.push(
            "A host multiplies the raw value by the scale, then adds what stands behind the sign.",
        );
    } else if has(|one| one.shown.scale.is_some()) {
        reported.push("A host multiplies the raw value by the scale.");
    }
    if has(|one| !one.filter.invalid.is_empty()) {
        reported.push("The board does not report invalid raw values.");
    }
    if !reported.is_empty() {
        let _ = write!(out, "\n{}", wrapped(&reported.join(" "), WIDTH, "", ""));
    }
    for curve in part.values.iter().map(|one| &one.shown.curve).filter(|curve| !curve.is_empty()) {
        let points =
            curve.iter().map(|(x, y)| format!("{x} is {y}")).collect::<Vec<_>>().join(", ");
        let text = format!(
            "The curve goes straight from point to point and is level beyond the outer ones: {points}."
        );
        let _ = write!(out, "\n{}", wrapped(&text, WIDTH, "", ""));
    }
}

fn sources(out: &mut String, part: &PartFacts) {
    out.push_str("\n## Sources\n\n");
    if let Some(sheet) = &part.sheet {
        let text = match sheet.strip_prefix("none: ") {
            Some(why) => format!("No data sheet: {why}."),
            None => format!("Data sheet: {sheet}."),
        };
        out.push_str(&wrapped(&text, WIDTH, "- ", "  "));
    }
    let text = match &part.checked {
        Some(checked) => format!("Compared with a second text: {checked}."),
        None => "The figures were not compared with a second text.".to_owned(),
    };
    out.push_str(&wrapped(&text, WIDTH, "- ", "  "));
}

/// Text escaped so that it does not end its cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
