//! What a driver says of its part for the people who wire it: a driver in, its [`Module`] out.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_syntax::ast::AstNode as _;

use super::Driver;
use super::known::Known;
use crate::design::Module;
use crate::fields::{Fields, name_or_text};
use crate::spanned::span;

/// The properties that say it.
const MODULE: [&str; 3] = ["part", "connector", "note"];

/// The part that a driver is for.
pub(crate) fn of(driver: Option<&Driver>, known: Known<'_>) -> Option<Module> {
    // Mistakes in them are reported once for the driver, not for each device.
    Some(of_driver(driver?, known, &mut Vec::new()))
}

/// Like [`of`], but also reports mistakes.
pub(crate) fn of_driver(
    driver: &Driver,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Module {
    let at = span(driver.file, driver.node.range());
    let is_one = |name: &str| MODULE.contains(&name);
    let own = driver.node.properties();
    let own = own.filter(|one| one.name().is_some_and(|name| is_one(name.text())));
    let reported = (known.constants, diagnostics);
    read(&mut Fields::new(own, driver.file, "a driver", at, reported))
}

/// Takes the properties that say it.
pub(crate) fn read(fields: &mut Fields<'_>) -> Module {
    let title = fields.text("part").map(|text| text.value).unwrap_or_default();
    let [entries, notes] = ["connector", "note"].map(|name| texts(fields, name));
    let (connector, contacts) = contacts(entries);
    Module { title, connector, contacts, notes }
}

/// The contacts of a connector, and the wires that are stated at them: `RPWM = forward`.
fn contacts(entries: Vec<String>) -> (Vec<String>, Vec<(String, String)>) {
    let mut wires = Vec::new();
    let contact = |entry: String| match entry.split_once(" = ") {
        Some((contact, wire)) => {
            wires.push((wire.trim().to_owned(), contact.trim().to_owned()));
            contact.trim().to_owned()
        }
        None => entry,
    };
    (entries.into_iter().map(contact).collect(), wires)
}

/// Reads a text or a list of texts.
pub(crate) fn texts(fields: &mut Fields<'_>, name: &str) -> Vec<String> {
    let Some(field) = fields.take(name) else { return Vec::new() };
    let found = match field.value.list() {
        Some(list) => list.iter().map(|one| name_or_text(&one.value)).collect(),
        None => name_or_text(&field.value).map(|one| vec![one]),
    };
    if found.is_none() {
        fields.wrong(&field, "a text, or a list of texts");
    }
    found.unwrap_or_default()
}
