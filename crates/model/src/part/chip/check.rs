//! Mistakes in the drivers of a file: drivers in, reports out, whether anything names the drivers or not.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0206_missing_property, e0229_wrong_driver};
use sensedsl_syntax::ast::AstNode as _;

use super::reader::{ChipReader, DriverValue};
use super::sockets::Socket;
use super::values::RequestedValue;
use super::{protocol, values_and_sockets};
use crate::driver::known::Known;
use crate::driver::{Driver, bounds, module};
use crate::kind::KindName;
use crate::part::block::Next;
use crate::part::coding::{CODING, FILTER, PROTOCOL};
use crate::part::properties::{ABOUT_PART, COMMON_PROPERTIES, PRESENTATION};
use crate::part::stranger;
use crate::rule::ranges;
use crate::spanned::{Spanned, span};

/// Reports mistakes in the drivers of the file.
pub(crate) fn drivers(known: Known<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for driver in known.drivers.own() {
        check_driver(driver, known, diagnostics);
    }
}

/// Reports mistakes in a driver of the file.
fn check_driver(driver: &Driver, known: Known<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some((given, sockets)) = values_and_sockets(driver, known, diagnostics) else { return };
    protocol(driver.file, driver, &[], known, diagnostics);
    bounds::of_driver(driver, known, diagnostics);
    contacts(driver, &sockets, known, diagnostics);
    let kinds: Vec<KindName> = sockets.iter().map(|socket| socket.kind).collect();
    let blocks = driver.node.connections().flat_map(|one| one.properties().collect::<Vec<_>>());
    let of_part = driver.node.properties().map(|one| (one, true));
    let of_values = given.iter().flat_map(|one| one.properties.iter().cloned());
    let all = of_part.chain(blocks.chain(of_values).map(|one| (one, false)));
    for (property, is_of_part) in all {
        let Some(name) = property.name() else { continue };
        let of_kinds = kinds.iter().flat_map(|kind| kind.spec().properties);
        let shared = COMMON_PROPERTIES.iter().chain(PRESENTATION).chain(FILTER);
        let is_for = |one: &&&str| kinds.iter().any(|kind| stranger::is_for(one, *kind));
        let coded = CODING.iter().chain(PROTOCOL).filter(is_for);
        let about = ABOUT_PART.iter().chain(&["pull"]).filter(|_| is_of_part);
        let known: Vec<&str> = of_kinds.chain(shared).chain(coded).chain(about).copied().collect();
        if !known.contains(&name.text()) {
            let at = span(driver.file, name.range());
            let of = driver.what();
            diagnostics.push(stranger::report((name.text(), at), &of, &kinds, &known));
        }
    }
    twice(driver, &given, diagnostics);
    values(driver, &given, sockets, known, diagnostics);
}

/// Reads each value as a device of the value's own type, so that its mistakes are told at the driver, and whether anything
/// uses it or not. What a design has to add, such as an address, is not missed here.
fn values(
    driver: &Driver,
    given: &[DriverValue],
    mut sockets: Vec<Socket>,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let block = span(driver.file, driver.node.range());
    let asked = given.iter().map(|one| RequestedValue {
        name: Spanned { value: one.name.clone(), span: one.span },
        block,
        own: Vec::new(),
        value: Spanned { value: one.value, span: one.span },
        given: one.clone(),
    });
    let whole = ChipReader {
        file: driver.file,
        next: Next::FIRST,
        name: driver.name.clone(),
        block,
        driver,
        known,
        properties: Vec::new(),
        protocol: protocol(driver.file, driver, &[], known, &mut Vec::new()),
        given: given.to_vec(),
    };
    let mut found = Vec::new();
    let devices = whole.devices(asked.collect(), None, &mut sockets, &mut found);
    found.extend(devices.iter().filter_map(ranges::beyond));
    let is_missing = |one: &Diagnostic| one.code == e0206_missing_property::CODE;
    let is_here = |one: &Diagnostic| {
        let at = one.primary.span;
        at.file == block.file && at.start >= block.start && at.end <= block.end
    };
    for mistake in found.into_iter().filter(|one| !is_missing(one) && is_here(one)) {
        // The devices that use the value have the same mistake, and say it less well.
        diagnostics.retain(|one| one.code != mistake.code || one.message != mistake.message);
        diagnostics.push(mistake);
    }
}

/// Reports contacts of the connector at wires that the part has not.
fn contacts(
    driver: &Driver,
    sockets: &[Socket],
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let module = module::of_driver(driver, known, diagnostics);
    let wires: Vec<String> = sockets.iter().flat_map(Socket::wires).collect();
    let names = || wires.iter().map(String::as_str).chain(["supply", "ground"]);
    for (wire, contact) in &module.contacts {
        if names().all(|name| name != wire) {
            let has = names().collect::<Vec<_>>().join(", ");
            let message = format!("`{contact} = {wire}` in `connector`: the wires are {has}");
            diagnostics.push(e0229_wrong_driver::wrong_driver(driver.name.span, &message));
        }
    }
}

/// Reports readings of the same bits of the same register.
fn twice(driver: &Driver, given: &[DriverValue], diagnostics: &mut Vec<Diagnostic>) {
    const PLACE: [&str; 9] =
        ["register", "trigger", "exchange", "byte", "bits", "output", "sentence", "field", "via"];
    let place = |one: &DriverValue| {
        let words = one.properties.iter().filter_map(|property| {
            let (name, value) = (property.name()?, property.value()?);
            PLACE
                .contains(&name.text())
                .then(|| format!("{} {}", name.text(), value.syntax().text()))
        });
        let mut words: Vec<String> = words.collect();
        words.sort();
        (one.direction, words)
    };
    for (at, one) in given.iter().enumerate() {
        let own = place(one);
        let has_register = own.1.iter().any(|word| word.starts_with("register "));
        let before = given.iter().take(at).find(|other| place(other) == own);
        if let Some(before) = before.filter(|_| has_register) {
            let message = format!("`{}` and `{}` are the same register", before.name, one.name);
            diagnostics.push(e0229_wrong_driver::wrong_driver(driver.name.span, &message));
        }
    }
}
