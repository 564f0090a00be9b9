//! Drivers: what a device says of how its part is talked to, put into a `driver`, which other devices can name as well.

use std::collections::BTreeSet;
use std::ops::Range as Bytes;

use sensedsl_model::design::{Design, Device};
use sensedsl_model::facts;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_syntax::TextRange;
use sensedsl_syntax::ast::{self, AstNode as _};

use super::changes::Changes;
use super::offer::{EXTRACT, action, part_at, part_of, property, written};
use crate::context::{Context, bytes};
use crate::edits::removed;
use crate::protocol::CodeAction;

/// The kinds whose properties are those of a part.
const KINDS: [KindName; 5] =
    [KindName::I2c, KindName::Spi, KindName::Uart, KindName::Can, KindName::Analog];

/// What is of one device and not of its part, although a kind has it.
const OF_DEVICE: [&str; 3] = ["address", "node", "exclusive"];

/// What shows a value: the part has it, but it alone is no protocol.
const SHOWN: [&str; 6] = ["quantity", "scale", "offset", "min", "max", "curve"];

pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Option<CodeAction> {
    let ast::Item::Device(device) = part_at(cx, range)? else { return None };
    let design = cx.analysis.snapshot.sound()?.design;
    let (_, part) = part_of(cx, &design.parts, device.syntax())?;
    let ty = property(device.properties(), "type")?;
    let kind = KindName::from_name(written(ty.value()?.syntax()).trim_matches('"'))?;
    if part.driver.is_some()
        || property(device.properties(), "driver").is_some()
        || !KINDS.contains(&kind)
    {
        return None;
    }
    let of_part =
        |one: &ast::Property| one.name().is_some_and(|name| is_of_part(name.text(), kind));
    let moved: Vec<ast::Property> = device.properties().filter(of_part).collect();
    let is_protocol =
        |one: &ast::Property| one.name().is_some_and(|name| !SHOWN.contains(&name.text()));
    if !moved.iter().any(is_protocol) {
        return None;
    }
    let name = name_of_driver(cx, &part.name.value);
    let lines: String =
        moved.iter().map(|one| format!("    {}\n", written(one.syntax()))).collect();
    let driver = format!("driver {name} for {} {{\n{lines}}}\n", kind.name());
    let top = device.syntax().ancestors().filter(|one| one.parent().is_some()).last()?;
    let above = start_with_comments(cx.text, top.text_range());
    let mut changes = Changes::of(cx.file, (above..above, driver));
    changes.add(cx.file, (bytes(ty.range()), format!("driver = {name};")));
    for one in &moved {
        changes.add(cx.file, removed(cx.text, one.syntax()));
    }
    let after = changes.sound(cx)?;
    is_same(design, after.sound()?.design).then_some(())?;
    action(cx, format!("Extract a driver `{name}`"), EXTRACT, &changes)
}

/// Whether a property belongs to a part, whichever device has it.
fn is_of_part(name: &str, kind: KindName) -> bool {
    let is_wire = Role::ALL.iter().any(|role| role.property() == name);
    // The bytes that begin a measurement have the name of a wire of another kind.
    let is_wire = is_wire && !(name == "trigger" && kind != KindName::Icu);
    let of_kind = kind.spec().properties.contains(&name) && !is_wire && !OF_DEVICE.contains(&name);
    of_kind || SHOWN.contains(&name)
}

/// Whether two designs have the same devices that talk to their parts in the same way.
fn is_same(before: &Design, after: &Design) -> bool {
    let of = |one: &Device| {
        let talks = (one.kind.name(), one.coding.clone(), one.filter.clone());
        let shown = (one.shown.scale, one.shown.offset, one.shown.min, one.shown.max);
        (one.name.value.clone(), one.id.value, one.value.value, one.delay_ms, talks, shown)
    };
    let same = before.devices.iter().map(of).eq(after.devices.iter().map(of));
    same && before.parts.len() == after.parts.len()
}

/// Where an item begins, with the comments that stand directly above it.
fn start_with_comments(text: &str, item: TextRange) -> usize {
    let mut start = bytes(item).start;
    start = text.get(..start).and_then(|before| before.rfind('\n')).map_or(0, |at| at + 1);
    while let Some(before) = text.get(..start).and_then(|before| before.strip_suffix('\n')) {
        let line = before.rsplit('\n').next().unwrap_or_default();
        if !line.trim_start().starts_with("//") {
            break;
        }
        start -= line.len() + 1;
    }
    start
}

/// A name for a driver, after the device, that no other driver has.
fn name_of_driver(cx: &Context<'_>, device: &str) -> String {
    let mut snake = String::new();
    for (at, letter) in device.char_indices() {
        let follows = device.get(..at).is_some_and(|before| {
            before.ends_with(|one: char| one.is_ascii_lowercase() || one.is_ascii_digit())
        });
        if letter.is_ascii_uppercase() && follows {
            snake.push('_');
        }
        snake.push(letter.to_ascii_lowercase());
    }
    let trees = cx.analysis.snapshot.trees().iter();
    let own = trees.flat_map(|(_, tree)| tree.ast().drivers().collect::<Vec<_>>());
    let own = own.filter_map(|one| one.name()).map(|name| name.text().to_lowercase());
    let library = facts::names().map(str::to_lowercase);
    let taken: BTreeSet<String> = own.chain(library).collect();
    let numbered = (2..).map(|number| format!("{snake}_{number}"));
    let mut names = std::iter::once(snake.clone()).chain(numbered);
    names.find(|name| !taken.contains(name)).unwrap_or(snake)
}
