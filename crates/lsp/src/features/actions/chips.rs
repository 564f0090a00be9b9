//! Chips: devices that are values of one part, put into one `chip`, so that they share its address and its transfers.
//!
//! Two devices with one address are two parts to the tool (W0609). Whoever means one part selects them.

use std::collections::BTreeSet;
use std::ops::Range as Bytes;

use sensedsl_model::design::Design;
use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::edit::indent;

use super::changes::Changes;
use super::offer::{REWRITE, action, property, written};
use crate::context::{Context, bytes};
use crate::edits::removed;
use crate::protocol::CodeAction;

/// What a device of a chip says itself; everything else is the chip's.
const OF_VALUE: &[&str] = &[
    "id",
    "delay",
    "prio",
    "group",
    "reading",
    "failsafe",
    "initial",
    "label",
    "quantity",
    "scale",
    "offset",
    "min",
    "max",
    "curve",
    "invalid",
    "median",
    "smooth",
    "change",
    "heartbeat",
];

/// Puts the selected devices into a chip.
pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Option<CodeAction> {
    let devices = selected(cx, range);
    let (first, others) = devices.split_first().filter(|(_, others)| !others.is_empty())?;
    let design = cx.analysis.snapshot.sound()?.design;
    let driver = driver_of(first)?;
    // A device with rules stays alone: they may be about it and not about the part.
    let is_like_first = |one: &ast::Device| {
        one.syntax().parent() == first.syntax().parent() && driver_of(one) == Some(driver.clone())
    };
    if !others.iter().all(is_like_first) || devices.iter().any(|one| one.rules().next().is_some()) {
        return None;
    }
    let name = name_of_chip(design, &driver);
    let chip = chip(&name, &devices)?;
    let mut changes = Changes::of(cx.file, (bytes(first.range()), chip));
    for other in others {
        changes.add(cx.file, removed(cx.text, other.syntax()));
    }
    let after = changes.sound(cx)?;
    let same = |design: &Design| -> BTreeSet<_> {
        let all = design.devices.iter();
        all.map(|one| {
            (one.name.value.clone(), one.id.value, one.value.value.to_string(), one.kind.name())
        })
        .collect()
    };
    let after = after.sound()?.design;
    let is_one_part = after.parts.len() + others.len() == design.parts.len();
    if same(design) != same(after) || !is_one_part {
        return None;
    }
    action(
        cx,
        format!("Make a chip `{name}` of these {} devices", devices.len()),
        REWRITE,
        &changes,
    )
}

/// The devices that a selection is in; those of chips are not among them.
fn selected(cx: &Context<'_>, range: &Bytes<usize>) -> Vec<ast::Device> {
    let tree = cx.ast();
    let boards = tree.boards().flat_map(|board| board.devices().collect::<Vec<_>>());
    let all = tree.devices().chain(boards);
    let is_selected = |one: &ast::Device| {
        let own = bytes(one.range());
        own.start < range.end && range.start < own.end
    };
    let mut found: Vec<ast::Device> = all.filter(is_selected).collect();
    found.sort_by_key(|one| one.range().start());
    found
}

fn driver_of(device: &ast::Device) -> Option<String> {
    Some(written(property(device.properties(), "driver")?.value()?.syntax()))
}

/// A chip with these devices in it; none if they differ in what a chip says once.
fn chip(name: &str, devices: &[ast::Device]) -> Option<String> {
    let outer = indent(devices.first()?.syntax());
    let (mut of_chip, mut blocks): (Vec<ast::Property>, Vec<String>) = (Vec::new(), Vec::new());
    for device in devices {
        let is_own =
            |one: &ast::Property| one.name().is_some_and(|name| OF_VALUE.contains(&name.text()));
        for other in device.properties().filter(|one| !is_own(one)) {
            let name = other.name()?;
            match property(of_chip.iter().cloned(), name.text()) {
                Some(known) if value_of(&known) == value_of(&other) => {}
                Some(_) => return None,
                None => of_chip.push(other),
            }
        }
        let own: Vec<String> =
            device.properties().filter(is_own).map(|one| written(one.syntax())).collect();
        blocks.push(format!("{} {{ {} }}", head(device.syntax())?, own.join(" ")));
    }
    let lines = of_chip.iter().map(|one| written(one.syntax())).chain(blocks);
    let lines: String = lines.map(|line| format!("\n{outer}    {line}")).collect();
    Some(format!("chip {name} {{{lines}\n{outer}}}"))
}

fn value_of(property: &ast::Property) -> Option<String> {
    Some(written(property.value()?.syntax()))
}

/// What stands before the block of a device: `sensor NAME returns TYPE`.
fn head(device: &SyntaxNode) -> Option<String> {
    let text = written(device);
    Some(text.split_once('{')?.0.trim().to_owned())
}

/// A name for a chip, after its driver, that nothing else has.
fn name_of_chip(design: &Design, driver: &str) -> String {
    let words = driver.trim_matches('"').split(|one: char| !one.is_ascii_alphanumeric());
    let camel: String = words.map(super::offer::capital).collect();
    let first = camel.starts_with(|one: char| one.is_ascii_alphabetic());
    let camel = if first { camel } else { format!("Chip{camel}") };
    let devices = design.devices.iter().map(|one| one.name.value.to_lowercase());
    let parts = design.parts.iter().map(|one| one.name.value.to_lowercase());
    let taken: BTreeSet<String> = devices.chain(parts).collect();
    let numbered = (2..).map(|number| format!("{camel}{number}"));
    let mut names = std::iter::once(camel.clone()).chain(numbered);
    names.find(|name| !taken.contains(&name.to_lowercase())).unwrap_or(camel)
}
