//! The sheet as a netlist of KiCad: boards and parts as components, each net with all its contacts.
//!
//! The form is that of Eeschema's export, version E, which Pcbnew and other programs read.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::Assignment;

use super::{BoardSheet, sheets};

/// A contact: the reference of its component, and its name there.
type Node = (String, String);

/// The netlist of all boards.
#[must_use]
pub fn kicad(design: &Design, assignment: &Assignment) -> String {
    let (mut components, mut nets) = (String::new(), BTreeMap::<String, Vec<Node>>::new());
    let mut parts = 0;
    let all = sheets(design, assignment);
    for (number, sheet) in all.iter().enumerate() {
        let board = format!("A{}", number + 1);
        let make = sheet.board.facts.as_ref().map(|facts| facts.name.as_str());
        component(&mut components, &board, make.unwrap_or(&sheet.board.name.value));
        let prefix =
            if all.len() > 1 { format!("{}.", sheet.board.name.value) } else { String::new() };
        of_board(&mut components, &mut nets, (sheet, &board, &prefix), &mut parts);
    }
    let mut list = String::new();
    for (code, (name, nodes)) in (1..).zip(&nets) {
        let _ = write!(list, "    (net (code \"{code}\") (name {})", quoted(name));
        for (component, contact) in nodes {
            let _ = write!(
                list,
                "\n      (node (ref {}) (pin {}))",
                quoted(component),
                quoted(contact)
            );
        }
        list.push_str(")\n");
    }
    format!(
        "(export (version \"E\")\n  (design (tool \"sensedsl\"))\n  (components\n{components}  )\n  (nets\n{list}  )\n)\n"
    )
}

fn of_board(
    components: &mut String,
    nets: &mut BTreeMap<String, Vec<Node>>,
    (sheet, board, prefix): (&BoardSheet<'_>, &str, &str),
    parts: &mut usize,
) {
    for part in sheet.parts.iter().filter(|part| !part.lines.is_empty()) {
        *parts += 1;
        let reference = format!("M{parts}");
        let value = if part.about.is_empty() {
            part.name.clone()
        } else {
            format!("{}: {}", part.name, part.about)
        };
        component(components, &reference, &value);
        for line in &part.lines {
            let Some(end) = &line.end else { continue };
            let nodes = nets.entry(format!("{prefix}{}", end.net)).or_default();
            let of_board = end.contact.clone().unwrap_or_else(|| end.net.clone());
            for node in [(board.to_owned(), of_board), (reference.clone(), line.at_part.clone())] {
                if !nodes.contains(&node) {
                    nodes.push(node);
                }
            }
        }
    }
}

fn component(out: &mut String, reference: &str, value: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(out, "    (comp (ref {}) (value {}))", quoted(reference), quoted(value));
}

/// A text in quotes, with hidden characters as codes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", visible(text).replace('\\', "\\\\").replace('"', "\\\""))
}
