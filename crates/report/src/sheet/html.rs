//! The sheet as a page to print: one page a board, with its picture.

use std::fmt::Write as _;

use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::{Assignment, SharedPin};

use super::{BoardSheet, Line, PartSheet, sheets};
use crate::markup::{escaped, noted};
use crate::svg;

const STYLE: &str = "\
body { font: 14px/1.4 Helvetica, Arial, sans-serif; margin: 2em auto; max-width: 60em; color: #1b2733; background: #fff }
section { break-after: page }
section:last-of-type { break-after: auto }
article { break-inside: avoid }
table { border-collapse: collapse; width: 100% }
th, td { border: 1px solid #aab4be; padding: .25em .5em; text-align: left; vertical-align: top }
th { background: #eef1f4 }
td.tick { width: 1.2em }
td.tick::before { content: \"\\2610\" }
h3 { margin: 1.2em 0 .3em }
svg { max-width: 100%; height: auto }
@page { size: A4; margin: 15mm }
@media print { body { margin: 0; max-width: none; font-size: 11px } }
@media screen and (prefers-color-scheme: dark) {
  body { background: #14191f; color: #dfe6ee }
  th { background: #232b34 }
  th, td { border-color: #4a5662 }
}
";

/// A page with the sheets of all boards, and the picture.
#[must_use]
pub fn html(design: &Design, assignment: &Assignment) -> String {
    let mut out = String::new();
    for sheet in sheets(design, assignment) {
        section(&mut out, &sheet);
    }
    let picture = svg::svg(design, assignment);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Wiring</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n{out}<section>\n{picture}</section>\n</body>\n</html>\n"
    )
}

fn section(out: &mut String, sheet: &BoardSheet<'_>) {
    let board = sheet.board;
    let what = escaped(&sheet.what());
    // Writing to a String cannot fail.
    let _ = writeln!(out, "<section>\n<h1>{}{what}</h1>", escaped(&board.name.value));
    let needs: Vec<String> = sheet.needs.iter().map(|need| escaped(need)).collect();
    let _ = writeln!(out, "<p>To build it, besides the parts: {}.</p>", needs.join("; "));
    sheet.parts.iter().for_each(|part| article(out, part));
    for SharedPin { pin, with } in &sheet.wiring.shared {
        let Some(pin) = board.table.pins.get(*pin) else { continue };
        let (pin, with) = (escaped(pin.name.as_str()), escaped(with));
        let _ = writeln!(out, "<p>{pin} is shared with {with}.</p>");
    }
    out.push_str("</section>\n");
}

fn article(out: &mut String, PartSheet { name, about, lines, notes }: &PartSheet) {
    let about = if about.is_empty() { String::new() } else { format!(": {}", escaped(about)) };
    let _ = writeln!(out, "<article>\n<h3>{}{about}</h3>", escaped(name));
    if !lines.is_empty() {
        table(out, lines);
    }
    if !notes.is_empty() {
        let code = |text: &str| format!("<code>{}</code>", escaped(text));
        let notes = notes.iter().map(|note| format!("<li>{}</li>\n", noted(note, escaped, code)));
        let _ = writeln!(out, "<ul>\n{}</ul>", notes.collect::<String>());
    }
    out.push_str("</article>\n");
}

fn table(out: &mut String, lines: &[Line]) {
    out.push_str("<table>\n");
    out.push_str(
        "<tr><th></th><th>At the part</th><th>Goes to</th><th>Pin</th><th>For</th></tr>\n",
    );
    for line in lines {
        let cells = [&line.at_part, &line.to, &line.pin, &line.purpose];
        let cells = cells.map(|text| format!("<td>{}</td>", escaped(text)));
        let _ = writeln!(out, "<tr><td class=\"tick\"></td>{}</tr>", cells.concat());
    }
    out.push_str("</table>\n");
}
