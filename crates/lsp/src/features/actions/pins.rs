//! Pins: those that the tool has chosen, written into the file; and those that the file fixes, taken out again.

use std::collections::BTreeMap;
use std::ops::Range as Bytes;

use sensedsl_model::design::{Connection, ConnectionIndex, Design, Part, PartIndex};
use sensedsl_model::kind::Role;
use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wiring::assignment::Assignment;

use super::changes::{Changes, node};
use super::offer::{REWRITE, action, name_of, part_at, part_of, wired, written};
use crate::context::Context;
use crate::edits::{added, removed};
use crate::protocol::CodeAction;

pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Vec<CodeAction> {
    let found = wired(cx);
    let wiring = found.as_ref().and_then(|found| found.wired());
    match (part_at(cx, range), wiring) {
        (Some(part), wiring) => {
            let fixed = wiring.and_then(|wiring| fix(cx, wiring, &part));
            fixed.into_iter().chain(release(cx, &part)).collect()
        }
        (None, Some(wiring)) => fix_all(cx, wiring).into_iter().collect(),
        (None, None) => Vec::new(),
    }
}

/// Writes the pins of a part.
fn fix(
    cx: &Context<'_>,
    (design, wiring): (&Design, &Assignment),
    part: &ast::Item,
) -> Option<CodeAction> {
    let (index, _) = part_of(cx, &design.parts, part.syntax())?;
    let mut changes = Changes::default();
    write(design, index, part.syntax(), &free_pins(design, wiring, index), &mut changes)?;
    changes.sound(cx)?;
    let wires: usize =
        design.connections_of(index).map(|one| one.kind.roles(one.direction).len()).sum();
    let what = if wires == 1 { "pin" } else { "all pins" };
    action(cx, format!("Fix {what} of {}", name_of(part)?.text()), REWRITE, &changes)
}

/// Writes the pins of all parts of the file.
fn fix_all(cx: &Context<'_>, (design, wiring): (&Design, &Assignment)) -> Option<CodeAction> {
    let mut changes = Changes::default();
    for (index, part) in (0..).map(PartIndex).zip(&design.parts) {
        if part.block.file == cx.file {
            let node = node(cx, part.block)?;
            write(design, index, &node, &free_pins(design, wiring, index), &mut changes)?;
        }
    }
    changes.sound(cx)?;
    action(cx, "Fix all pins".to_owned(), REWRITE, &changes)
}

/// Takes out the pins that a part fixes.
fn release(cx: &Context<'_>, part: &ast::Item) -> Option<CodeAction> {
    let design = cx.analysis.snapshot.sound()?.design;
    let (index, _) = part_of(cx, &design.parts, part.syntax())?;
    let of_pins = |one: &Connection| one.placement.pins.iter().map(|(role, _)| *role).collect();
    let changes = freed(cx, design, index, of_pins, &[])?;
    changes.sound(cx)?;
    let name = name_of(part)?;
    action(cx, format!("Release pins of {}", name.text()), REWRITE, &changes)
}

/// Takes out what fixes wires of a part: the properties of roles, and those of the other names.
pub(super) fn freed(
    cx: &Context<'_>,
    design: &Design,
    part: PartIndex,
    roles: impl Fn(&Connection) -> Vec<Role>,
    others: &[&str],
) -> Option<Changes> {
    let block = node(cx, design.part(part)?.block)?;
    let file = design.part(part)?.block.file;
    let text = cx.analysis.snapshot.sources().text(file);
    let mut changes = Changes::default();
    for one in design.connections_of(part) {
        let roles = roles(one);
        let fixes = |property: &ast::Property| {
            let name = property.name();
            name.is_some_and(|name| {
                let name = name.text();
                let is_wire = roles.iter().any(|role| role.property() == name);
                is_wire
                    || others.contains(&name)
                    || !roles.is_empty() && one.name.as_deref() == Some(name)
            })
        };
        for property in block.children().filter_map(ast::Property::cast).filter(fixes) {
            changes.add(file, removed(text, property.syntax()));
        }
        for own in blocks_of(&block, one) {
            let (gone, kept): (Vec<ast::Property>, Vec<ast::Property>) =
                own.properties().partition(fixes);
            if kept.is_empty() && !gone.is_empty() {
                changes.add(file, removed(text, own.syntax()));
                continue;
            }
            for property in gone {
                changes.add(file, removed(text, property.syntax()));
            }
        }
    }
    Some(changes)
}

/// The blocks of a chip for one of its connections.
pub(super) fn blocks_of(
    chip: &SyntaxNode,
    of: &Connection,
) -> impl Iterator<Item = ast::Connection> {
    let name = of.name.clone();
    let all = chip.children().filter_map(ast::Connection::cast);
    all.filter(move |one| name.is_some() && one.name().map(|name| name.text().to_owned()) == name)
}

/// The wires of a part that the file does not fix, with the pins that were chosen.
fn free_pins(
    design: &Design,
    wiring: &Assignment,
    part: PartIndex,
) -> Vec<(ConnectionIndex, Vec<(Role, String)>)> {
    let all = (0..).map(ConnectionIndex).zip(&design.connections);
    let own = all.filter(|(_, one)| one.part == part);
    own.map(|one| (one.0, free_wires(design, wiring, one))).collect()
}

/// Adds the statements that fix wires of a part at pins.
pub(super) fn write(
    design: &Design,
    index: PartIndex,
    block: &SyntaxNode,
    pins: &[(ConnectionIndex, Vec<(Role, String)>)],
    changes: &mut Changes,
) -> Option<()> {
    let part: &Part = design.part(index)?;
    let mut own: Vec<String> = Vec::new();
    // The pins of an array's elements, by the property that lists them.
    let mut lists: BTreeMap<Role, Vec<String>> = BTreeMap::new();
    for (number, pins) in pins {
        let one = design.connection(*number)?;
        let pins = pins.clone();
        if one.element.is_some() {
            for (role, pin) in pins {
                lists.entry(role).or_default().push(pin);
            }
            continue;
        }
        let is_single = one.kind.roles(one.direction).len() == 1;
        let line = |(role, pin): &(Role, String)| format!("{} = {pin};", role.property());
        match &one.name {
            None => own.extend(pins.iter().map(line)),
            Some(name) if is_single => {
                own.extend(pins.iter().map(|(_, pin)| format!("{name} = {pin};")));
            }
            Some(_) if pins.is_empty() => {}
            Some(name) => {
                let lines: Vec<String> = pins.iter().map(line).collect();
                match blocks_of(block, one).next() {
                    Some(block) => {
                        let lines = joined(block.syntax(), &lines);
                        changes.add(part.block.file, added(block.syntax(), &lines)?);
                    }
                    None => own.push(format!("connection {name} {{ {} }}", lines.join(" "))),
                }
            }
        }
    }
    own.extend(
        lists
            .into_iter()
            .map(|(role, pins)| format!("{} = [{}];", role.property(), pins.join(", "))),
    );
    if !own.is_empty() {
        changes.add(part.block.file, added(block, &joined(block, &own))?);
    }
    Some(())
}

/// The wires of a connection that the file does not fix, with the pins that were chosen.
fn free_wires(
    design: &Design,
    wiring: &Assignment,
    (number, one): (ConnectionIndex, &Connection),
) -> Vec<(Role, String)> {
    let Some((on, found)) = wiring.connection(number) else { return Vec::new() };
    let Some(board) = design.board(on) else { return Vec::new() };
    let is_free = |role: Role| one.placement.pins.iter().all(|(fixed, _)| *fixed != role);
    let free = found.wires.iter().filter(|wire| is_free(wire.role));
    free.filter_map(|wire| Some((wire.role, wire.pin(board)?.name.to_string()))).collect()
}

/// Statements as one, on lines of their own where the block has lines.
fn joined(block: &SyntaxNode, statements: &[String]) -> String {
    let is_line = !written(block).contains('\n');
    statements.join(if is_line { " " } else { "\n" })
}
