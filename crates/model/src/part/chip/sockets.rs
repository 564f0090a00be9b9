//! The connections of a chip: those that its driver names, with what the chip adds to each.

use std::iter;

use sensedsl_diagnostics::codes::{
    e0204_duplicate_name, e0209_wrong_value, e0229_wrong_driver, e0230_unknown_reading,
};
use sensedsl_diagnostics::{Diagnostic, nearest};
use sensedsl_syntax::ast::{self, AstNode as _, Property};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use super::reader::{ChipReader, DriverValue};
use super::values;
use crate::design::{DeviceIndex, Level, PinRef, Placement};
use crate::driver::{Driver, bounds, kind_of};
use crate::fields::{Fields, name_or_text};
use crate::kind::{Kind, KindName, Role};
use crate::part::{placement, properties};
use crate::spanned::{Spanned, span};

/// A connection that a driver has.
pub(super) struct Socket {
    /// Its name; none where the driver is for one kind.
    pub(super) name: Option<String>,
    pub(super) kind: KindName,
    pub(super) direction: Direction,
    /// The first device whose value goes over it, if there is one.
    pub(super) device: Option<DeviceIndex>,
    /// Whether a device of the chip, or every chip with this driver, needs it.
    pub(super) is_used: bool,
    /// Whether a reading or command of the driver goes over it.
    pub(super) is_of_a_value: bool,
    value: ValueType,
    /// The driver's block for it.
    node: Option<ast::Connection>,
    /// The chip's block for it.
    block: Option<ast::Connection>,
}

/// Adds the chip's blocks for its connections.
pub(super) fn describe(
    sockets: &mut [Socket],
    whole: &ChipReader<'_>,
    blocks: Vec<ast::Connection>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for block in blocks {
        let Some(name) = block.name() else { continue };
        let at = span(whole.file, name.range());
        let names = || sockets.iter().filter_map(|socket| socket.name.as_deref());
        let Some(number) = names().position(|one| one == name.text()) else {
            let has = names().collect::<Vec<_>>().join(", ");
            let driver = &whole.driver.name.value;
            let message = format!("`{driver}` has no connection `{}`", name.text());
            let meant = nearest(name.text(), names());
            let report = e0230_unknown_reading::unknown_reading;
            diagnostics.push(report(at, &message, &has, meant));
            continue;
        };
        let Some(socket) = sockets.get_mut(number) else { continue };
        if let Some(first) = socket.block.as_ref().and_then(ast::Connection::name) {
            let first = span(whole.file, first.range());
            let twice = e0204_duplicate_name::duplicate_name;
            diagnostics.push(twice(at, "connection", name.text(), first, None));
            continue;
        }
        socket.block = Some(block);
    }
}

/// The connections that a driver names, or one without a name if the driver is for one kind.
pub(super) fn of_driver(driver: &Driver, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Socket>> {
    let mut sockets: Vec<Socket> = Vec::new();
    if let Some(kind) = driver.kind {
        sockets.push(Socket::new(None, kind, None));
    }
    for node in driver.node.connections() {
        let (Some(name), Some(kind)) = (node.name(), node.kind()) else { continue };
        let at = span(driver.file, name.range());
        if sockets.iter().any(|one| one.name.as_deref() == Some(name.text())) {
            let message = format!("it has two connections `{}`", name.text());
            diagnostics.push(e0229_wrong_driver::wrong_driver(at, &message));
            continue;
        }
        let Some(kind) = kind_of(driver.file, &kind, diagnostics) else { continue };
        sockets.push(Socket::new(Some(name.text().to_owned()), kind, Some(node)));
    }
    if sockets.is_empty() {
        let message = format!(
            "`{}` has no connection: write `driver NAME for KIND`, or `connection NAME for KIND {{ }}` in it",
            driver.name.value
        );
        diagnostics.push(e0229_wrong_driver::wrong_driver(driver.name.span, &message));
        return None;
    }
    Some(sockets)
}

impl Socket {
    fn new(name: Option<String>, kind: KindName, node: Option<ast::Connection>) -> Self {
        Self {
            name,
            kind,
            // A connection that carries no value is held at a level.
            direction: kind.spec().directions.last().copied().unwrap_or(Direction::Actuator),
            device: None,
            is_used: false,
            is_of_a_value: false,
            value: ValueType::scalar(ScalarType::Uint16),
            node,
            block: None,
        }
    }

    /// The names that its wires can have in a driver's `connector`: `sda`, `pwm_a`, `encoder.a`.
    pub(super) fn wires(&self) -> Vec<String> {
        let properties = self.kind.spec().properties;
        let roles = Role::ALL.into_iter().filter(|role| properties.contains(&role.property()));
        let Some(name) = &self.name else { return roles.map(|role| role.to_string()).collect() };
        let qualified = roles.map(|role| format!("{name}.{role}"));
        iter::once(name.clone()).chain(qualified).collect()
    }

    /// Records that a device's value goes over it.
    pub(super) fn take(&mut self, device: DeviceIndex, given: &DriverValue) {
        if !self.is_used {
            self.device = Some(device);
            self.direction = given.direction;
            let one = given.via.len() == 1;
            self.value = if one { given.value } else { ValueType::scalar(ScalarType::Uint16) };
        }
        self.is_used = true;
        self.is_of_a_value = true;
    }

    /// The properties in the chip's block for it.
    pub(super) fn block_properties(&self) -> impl Iterator<Item = Property> {
        self.block.iter().flat_map(|node| node.properties().collect::<Vec<_>>())
    }

    /// The properties in the driver's block for it.
    pub(super) fn driver_properties(&self) -> impl Iterator<Item = Property> {
        self.node.iter().flat_map(|node| node.properties().collect::<Vec<_>>())
    }

    /// Its kind, and the fixed placement of its wires.
    pub(super) fn read(
        &self,
        whole: &ChipReader<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> (Kind, Placement, Option<Level>) {
        let reported = (whole.known.constants, &mut *diagnostics);
        let owner = self.kind.with_article();
        let at = whole.name.span;
        let mut fields = Fields::new(self.block_properties(), whole.file, &owner, at, reported);
        fields.inherit(whole.properties_for(self.kind), whole.file);
        fields.drivers_follow();
        fields.inherit(self.driver_properties(), whole.driver.file);
        fields.inherit(values::shared(whole.driver), whole.driver.file);
        if !whole.given.is_empty() {
            fields.set_reading("value");
        }
        fields.set_register_bytes(whole.protocol.register_bytes);
        fields.set_addresses(bounds::of(Some(whole.driver), whole.known).addresses);
        let kind = self.kind.read(&mut fields, self.direction, self.value);
        let placements = placement::read(&mut fields, &kind, self.direction, whole_value());
        let level = properties::level(&mut fields);
        let mut placement = placements.into_iter().next().unwrap_or_default();
        self.short_pin(whole, &kind, &mut placement, diagnostics);
        (kind, placement, level)
    }

    /// `in1 = PA3;` in a chip fixes the pin of its connection `in1`.
    fn short_pin(
        &self,
        whole: &ChipReader<'_>,
        kind: &Kind,
        placement: &mut Placement,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let Some(name) = &self.name else { return };
        let is_named = |one: &&Property| one.name().is_some_and(|own| own.text() == name);
        let Some(property) = whole.properties.iter().find(is_named) else { return };
        let Some(value) = property.value() else { return };
        let (file, constants) = (whole.file, whole.known.constants);
        let at = span(file, value.range());
        let found = crate::value::Evaluator::new(file, constants, diagnostics).value(&value);
        let roles = kind.roles(self.direction);
        let wrong = e0209_wrong_value::wrong_value;
        match (roles.as_slice(), name_or_text(&found)) {
            ([role], Some(pin)) => {
                placement.pins.push((*role, Spanned { value: PinRef::unbound(&pin), span: at }));
            }
            ([_], None) => diagnostics.push(wrong(at, name, "a pin such as PA1", "something else")),
            (roles, _) => {
                let lines = roles.iter().map(|role| format!("{} = PIN;", role.property()));
                let lines = lines.collect::<Vec<_>>().join(" ");
                let takes = format!(
                    "a block, because it has several wires: `connection {name} {{ {lines} }}`"
                );
                diagnostics.push(wrong(at, name, &takes, "a value"));
            }
        }
    }
}

/// A single number: one set of wires, whatever the value.
fn whole_value() -> ValueType {
    ValueType::scalar(ScalarType::Uint16)
}
