//! A wire on the pin that somebody chose: the property that fixes it is changed, or added.

use sensedsl_diagnostics::Severity;
use sensedsl_model::design::{Connection, ConnectionIndex, Design, PartIndex};
use sensedsl_model::kind::Role;
use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wiring::assignment::Assignment;

use super::changes::{Changes, node};
use super::offer::wired;
use super::pins::{blocks_of, write};
use crate::answer::Refusal;
use crate::context::{Context, bytes};
use crate::protocol::{PinParams, WorkspaceEdit};

/// A wire of the design.
struct Wire<'a> {
    index: ConnectionIndex,
    of: &'a Connection,
    role: Role,
}

/// The changes that put a wire of a device or a chip on a pin.
///
/// # Errors
/// There is no wiring or no such wire, or the design would have a new error.
pub(crate) fn placed(
    cx: &Context<'_>,
    PinParams { name, wire, pin, .. }: &PinParams,
) -> Result<WorkspaceEdit, Refusal> {
    let no = |why: String| Refusal::Impossible(why);
    let found = wired(cx).ok_or_else(|| no("there is no wiring yet".to_owned()))?;
    let (design, wiring) =
        found.wired().ok_or_else(|| no("nothing is wired: mend the mistakes first".to_owned()))?;
    let (part, own) =
        wire_of(design, name, wire).ok_or_else(|| no(format!("{name} has no wire `{wire}`")))?;
    let unwritten = || no(format!("{name} is not written in a way that can be changed here"));
    let block = design.part(part).map(|part| part.block).ok_or_else(unwritten)?;
    let node = node(cx, block).ok_or_else(unwritten)?;
    let pins = pins(design, wiring, &own, pin);
    let mut changes = Changes::default();
    let is_changed = match written(&node, &own) {
        Some(property) => {
            let value = property.value().ok_or_else(unwritten)?;
            let text = match own.of.element {
                None => pin.clone(),
                Some(_) => format!("[{}]", list(&pins, own.role)),
            };
            changes.add(block.file, (bytes(value.syntax().text_range()), text))
        }
        None => write(design, part, &node, &pins, &mut changes).is_some(),
    };
    if !is_changed {
        return Err(unwritten());
    }
    if changes.sound(cx).is_none() {
        let why = first_error(cx, &changes).unwrap_or_default();
        return Err(no(format!("{pin} cannot be `{wire}` of {name}{why}")));
    }
    changes.edit(cx).ok_or_else(|| no(format!("`{wire}` of {name} is fixed at {pin} already")))
}

/// What is wrong with the design after changes, to follow a sentence.
fn first_error(cx: &Context<'_>, changes: &Changes) -> Option<String> {
    let after = changes.snapshot(cx)?;
    let mut errors = after.diagnostics().iter().filter(|one| one.severity == Severity::Error);
    errors.next().map(|error| format!(": {}", error.message))
}

/// The wire of that name of a device or a chip, and its part.
fn wire_of<'a>(design: &'a Design, name: &str, wire: &str) -> Option<(PartIndex, Wire<'a>)> {
    let device = design.devices.iter().find(|one| one.name.value == name);
    let is_named = |part: PartIndex| design.part(part).is_some_and(|one| one.name.value == name);
    let all = (0..).map(ConnectionIndex).zip(&design.connections);
    let mut own = all.filter(|(index, one)| {
        is_named(one.part) || device.is_some_and(|device| device.connections.contains(index))
    });
    own.find_map(|(index, of)| {
        let roles = of.kind.roles(of.direction);
        let role = roles.into_iter().find(|role| of.wire_name(*role) == wire)?;
        Some((of.part, Wire { index, of, role }))
    })
}

/// The pins to write: of an array all elements, as one list has them all.
fn pins(
    design: &Design,
    wiring: &Assignment,
    own: &Wire<'_>,
    pin: &str,
) -> Vec<(ConnectionIndex, Vec<(Role, String)>)> {
    if own.of.element.is_none() {
        return vec![(own.index, vec![(own.role, pin.to_owned())])];
    }
    let all = (0..).map(ConnectionIndex).zip(&design.connections);
    let elements = all.filter(|(_, one)| one.part == own.of.part && one.element.is_some());
    let place = |index: ConnectionIndex| {
        let (on, found) = wiring.connection(index)?;
        let wire = found.wires.iter().find(|wire| wire.role == own.role)?;
        Some(wire.pin(design.board(on)?)?.name.to_string())
    };
    let chosen = elements.filter_map(|(index, _)| {
        let at = if index == own.index { pin.to_owned() } else { place(index)? };
        Some((index, vec![(own.role, at)]))
    });
    chosen.collect()
}

fn list(pins: &[(ConnectionIndex, Vec<(Role, String)>)], role: Role) -> String {
    let all = pins.iter().flat_map(|(_, pins)| pins).filter(|(of, _)| *of == role);
    all.map(|(_, pin)| pin.as_str()).collect::<Vec<_>>().join(", ")
}

/// The property that fixes the wire.
fn written(block: &SyntaxNode, own: &Wire<'_>) -> Option<ast::Property> {
    let is_single = own.of.kind.roles(own.of.direction).len() == 1;
    let fixes = |property: &ast::Property| {
        property.name().is_some_and(|name| match &own.of.name {
            Some(of_chip) => is_single && name.text() == of_chip,
            None => name.text() == own.role.property(),
        })
    };
    let in_block = || block.children().filter_map(ast::Property::cast).find(fixes);
    let in_connection = || {
        let mut own_blocks = blocks_of(block, own.of);
        let is_role =
            |one: &ast::Property| one.name().is_some_and(|name| name.text() == own.role.property());
        own_blocks.find_map(|one| one.properties().find(is_role))
    };
    in_connection().or_else(in_block)
}
