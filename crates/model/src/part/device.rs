//! A device on its own: from its block to a part with one value.

use sensedsl_diagnostics::codes::{
    e0207_unknown_kind, e0211_out_of_range, e0214_wrong_direction, e0220_impossible_type,
    e0229_wrong_driver, h0703_default_protocol,
};
use sensedsl_diagnostics::{Diagnostic, FileId, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::{Direction, ValueType};

use crate::design::protocol::{Coding, Protocol};
use crate::design::{BoardIndex, Connection, ConnectionIndex, Device, Part};
use crate::driver::known::Known;
use crate::driver::{DEFAULT_RANGER, Driver, Drivers, RANGER_ADDRESSES, bounds, module};
use crate::fields::{Field, Fields, name_or_text};
use crate::kind::{Kind, KindName, i2c};
use crate::part::block::{Next, ReadPart};
use crate::part::coding;
use crate::part::properties::{
    delay_ms as paced_ms, direction, divided, is_about_part, level, own,
};
use crate::part::{chip, placement, reach, stranger, words};
use crate::rule;
use crate::spanned::{Spanned, named, span};
use crate::value::types;

/// Most elements of an array with a wire each, which is more than any part has of one kind.
const WIRES_MAX: u16 = 128;

/// Reads the device `node` of `file`; none when too little of it is understood. A device without an
/// identifier has 0 until all are known.
pub(crate) fn read(
    (file, next): (FileId, Next),
    node: &ast::Device,
    board: Option<BoardIndex>,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ReadPart> {
    let name = named(file, &node.name()?);
    let direction = direction(node)?;
    if let Some(driver) = driver_with_values(file, node, known) {
        return chip::of_device((file, next), node, driver, board, known, diagnostics);
    }
    let value = types::read(file, node.ty(), (known.constants, diagnostics));
    let owner = format!("the {} `{}`", direction.name(), name.value);
    let (wishes, allows) =
        rule::of_device(file, node.rules(), node.range(), (known.constants, diagnostics));
    let reported = (known.constants, &mut *diagnostics);
    let mut fields = Fields::new(node.properties(), file, &owner, name.span, reported);
    let kind_name = kind_name(&mut fields, direction, known.drivers)?;
    fields.rename_owner(kind_name.value.with_article());
    let driver = take_driver(&mut fields, kind_name, known, &name.value);
    let value = value?;
    accept(&mut fields, kind_name.value, value)?;
    let kind = kind_name.value.read(&mut fields, direction, value.value);
    let own = own(&mut fields);
    let placements = placement::read(&mut fields, &kind, direction, value.value);
    let mut coding = coding::coding(&mut fields, value.value, None);
    let range = reach::of_codes(kind_name.value, &coding, value.value);
    coding.failsafe = coding::failsafe(&mut fields, direction, value.value, range);
    let level = level(&mut fields);
    let mut shown = divided(own.shown, &kind, level.as_ref());
    shown.bare = fields.take_bare();
    if let Err(message) = words::check(&kind, &coding, value.value, &Protocol::default()) {
        fields.say(e0229_wrong_driver::wrong_driver(name.span, &message));
    }
    outside(&mut fields, (&kind, &coding), direction, &name);
    leftovers(&mut fields, kind_name.value);
    let block = span(file, node.range());
    let is_array = kind_name.value.spec().values.wires(value.value).is_some();
    let connections = placements.into_iter().zip(0..).map(|(placement, element)| Connection {
        part: next.part,
        name: None,
        element: is_array.then_some(element),
        device: next.device,
        kind: kind.clone(),
        direction,
        board,
        placement,
        wishes: wishes.clone(),
        level,
    });
    let connections: Vec<Connection> = connections.collect();
    let delay_ms = paced_ms(own.delay_ms, &kind);
    let device = Device {
        part: next.part,
        name: name.clone(),
        block,
        id: own.id.unwrap_or(Spanned { value: 0, span: name.span }),
        direction,
        value,
        delay_ms,
        kind,
        kind_span: kind_name.span,
        delay_span: own.delay_span,
        prio: own.prio,
        prio_span: own.prio_span,
        group: own.group,
        shown,
        coding,
        filter: own.filter,
        connections: (next.connection.0..).take(connections.len()).map(ConnectionIndex).collect(),
    };
    let found = driver.as_deref().and_then(|name| known.drivers.look_up(name));
    let (bounds, module) = (bounds::of(found, known), module::of(found, known));
    let part = Part { name, block, board, driver, allows, chip: None, bounds, module };
    Some(ReadPart { part, devices: vec![device], connections, controller: None })
}

/// The driver that the device names, if that driver names several values.
fn driver_with_values<'d>(
    file: FileId,
    node: &ast::Device,
    known: Known<'d>,
) -> Option<&'d Driver> {
    let named = node.properties().find(|one| one.name().is_some_and(|n| n.text() == "driver"))?;
    let (constants, reported) = (known.constants, &mut Vec::new());
    let value = crate::value::Evaluator::new(file, constants, reported).value(&named.value()?);
    let driver = known.drivers.look_up(&name_or_text(&value)?)?;
    driver.has_values().then_some(driver)
}

/// Whether devices of the kind can have the type; if not, that is reported.
fn accept(fields: &mut Fields<'_>, kind: KindName, value: Spanned<ValueType>) -> Option<()> {
    let wires = kind.spec().values.wires(value.value);
    if wires.is_some_and(|wires| wires > WIRES_MAX) {
        let range = format!("1 to {WIRES_MAX}, because each element has a wire of its own");
        let length = wires.unwrap_or_default().to_string();
        fields.say(e0211_out_of_range::out_of_range(value.span, "array length", &length, &range));
        return None;
    }
    if let Err(can) = kind.spec().values.accept(value.value) {
        let (kind, found) = (kind.with_article(), value.value.to_string());
        fields.say(e0220_impossible_type::impossible_type(value.span, &kind, &found, can));
    }
    Some(())
}

/// The kind that `type`, or otherwise the driver, states.
fn kind_name(
    fields: &mut Fields<'_>,
    direction: Direction,
    drivers: &Drivers,
) -> Option<Spanned<KindName>> {
    let Some(written) = fields.name("type", "a kind of device") else {
        if fields.has("type") {
            return None;
        }
        return of_driver(fields, direction, drivers);
    };
    let Some(kind) = KindName::from_name(&written.value) else {
        let report = match drivers.look_up(&written.value) {
            Some(driver) => {
                let (at, part) = (written.span, &driver.name.value);
                e0207_unknown_kind::driver_as_kind(at, &written.value, part)
            }
            None => {
                let meant = nearest(&written.value, KindName::ALL.map(KindName::name));
                let list = KindName::list();
                e0207_unknown_kind::unknown_kind(written.span, &written.value, &list, meant)
            }
        };
        fields.say(report);
        return None;
    };
    check_direction(fields, Spanned { value: kind, span: written.span }, direction);
    Some(Spanned { value: kind, span: written.span })
}

/// The kind that the driver is for, if the device does not state one.
fn of_driver(
    fields: &mut Fields<'_>,
    direction: Direction,
    drivers: &Drivers,
) -> Option<Spanned<KindName>> {
    let Some(at) = fields.value_span("driver") else {
        let example = match direction {
            Direction::Sensor => "type = analog;",
            Direction::Actuator => "type = digital;",
        };
        fields.missing("type", example);
        return None;
    };
    let wanted = Spanned { value: fields.peek_name("driver")?, span: at };
    let mut reports = Vec::new();
    let kind = drivers.find(&wanted, &mut reports).and_then(|driver| driver.kind);
    reports.into_iter().for_each(|report| fields.say(report));
    let kind = Spanned { value: kind?, span: at };
    check_direction(fields, kind, direction);
    Some(kind)
}

fn check_direction(fields: &mut Fields<'_>, written: Spanned<KindName>, direction: Direction) {
    let kind = written.value;
    if !kind.spec().directions.contains(&direction) {
        let can: Vec<&str> = kind
            .spec()
            .directions
            .iter()
            .map(|direction| match direction {
                Direction::Sensor => "a sensor",
                Direction::Actuator => "an actuator",
            })
            .collect();
        let can = can.join(" or ");
        fields.say(e0214_wrong_direction::wrong_direction(
            written.span,
            &kind.with_article(),
            &can,
        ));
    }
}

/// Inherits the properties of the driver that the device names, or of the one its address implies.
fn take_driver(
    fields: &mut Fields<'_>,
    kind: Spanned<KindName>,
    known: Known<'_>,
    device: &str,
) -> Option<String> {
    let driver = if fields.has("driver") {
        let wanted = fields.name("driver", "the name of a driver")?;
        let mut reports = Vec::new();
        let driver = known.drivers.find_for(&wanted, kind, &mut reports);
        reports.into_iter().for_each(|report| fields.say(report));
        driver?
    } else if kind.value == KindName::I2c && is_bare_ranger(fields) {
        let driver = known.drivers.library(DEFAULT_RANGER)?;
        let at = fields.value_span("address")?;
        fields.say(h0703_default_protocol::default_protocol(at, device, DEFAULT_RANGER));
        driver
    } else {
        return None;
    };
    // Properties that describe the part are for its page.
    let about = |one: &ast::Property| one.name().is_some_and(|name| is_about_part(name.text()));
    let properties = driver.node.properties().filter(|one| !about(one));
    fields.drivers_follow();
    fields.inherit(properties, driver.file);
    fields.set_addresses(bounds::of(Some(driver), known).addresses);
    Some(driver.name.value.clone())
}

/// Whether this is an i2c device at the address of a Devantech ranger, without any protocol.
fn is_bare_ranger(fields: &mut Fields<'_>) -> bool {
    if i2c::PROTOCOL.iter().any(|name| fields.has(name)) {
        return false;
    }
    fields
        .peek_integer("address")
        .is_some_and(|address| RANGER_ADDRESSES.contains(&address) && address % 2 == 0)
}

/// Reports a value that ends after the message that it is in.
fn outside(
    fields: &mut Fields<'_>,
    (kind, coding): (&Kind, &Coding),
    direction: Direction,
    name: &Spanned<String>,
) {
    let at = fields.value_span("byte").unwrap_or(name.span);
    let name = format!("`{}`", name.value);
    if let Some(report) = words::outside((at, &name), (kind, coding), kind)
        && direction == Direction::Sensor
    {
        fields.say(report);
    }
}

/// Reports properties that nothing of the device has read.
fn leftovers(fields: &mut Fields<'_>, kind: KindName) {
    for field in fields.rest() {
        if fields.is_inherited(&field) {
            continue;
        }
        let Field { name, name_span, .. } = field;
        let report = stranger::of_device(&name, name_span, kind);
        fields.say(report);
    }
}
