//! One device: from its block to a checked [`Device`].

use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0207_unknown_kind, e0208_unknown_type, e0211_out_of_range,
    e0213_property_of_other_kind, e0214_wrong_direction, e0220_impossible_type,
    h0703_default_protocol,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use crate::design::{
    BoardIndex, Connection, ConnectionIndex, Device, DeviceIndex, Group, Level, Part, PartIndex,
    Presentation, Spanned,
};
use crate::drivers::{DEFAULT_RANGER, Drivers, RANGER_ADDRESSES};
use crate::fields::{Field, Fields, span};
use crate::kind::{KindName, i2c};
use crate::parts::ReadPart;
use crate::placement;
use crate::rules;

/// The properties of every device, but for those that show its value.
pub(crate) const COMMON_PROPERTIES: &[&str] = &[
    "id", "type", "driver", "delay", "prio", "group", "unit", "side", "header", "together",
    "sequence", "level", "divider",
];
/// The properties by which a host shows a value.
pub(crate) const PRESENTATION: &[&str] = &["label", "quantity", "scale", "offset", "min", "max"];

/// Cycle time where the file says nothing (the paper, section 3.2).
const DELAY_DEFAULT_MS: u32 = 1_000;
/// Longest cycle time: an hour.
const DELAY_MAX_MS: u32 = 3_600_000;
/// Highest voltage that may stand in a file.
const LEVEL_MAX_MV: u32 = 1_000_000;
/// Most elements of an array.
const ARRAY_MAX: u64 = 1_024;
/// Most elements of an array of wires: more than any part has of one kind.
const WIRES_MAX: u16 = 128;

/// Reads the device `node` of `file`; none when too little of it is understood.
pub(crate) fn read(
    file: FileId,
    node: &ast::Device,
    board: Option<BoardIndex>,
    drivers: &Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ReadPart> {
    let name = node.name()?;
    let name = Spanned { value: name.text().to_owned(), span: span(file, name.range()) };
    let direction = match node.direction()? {
        ast::Direction::Sensor => Direction::Sensor,
        ast::Direction::Actuator => Direction::Actuator,
    };
    let value = value_type(file, node, diagnostics);
    let owner = format!("the {} `{}`", direction.name(), name.value);
    let (wishes, allows) = rules::of_device(file, node, diagnostics);
    let mut fields = Fields::new(node.properties(), file, &owner, name.span, diagnostics);
    let id = fields.required_integer("id", 1..=254, "id = 17;");
    let kind_name = kind_name(&mut fields, direction)?;
    fields.rename_owner(kind_name.value.with_article());
    let driver = take_driver(&mut fields, kind_name.value, drivers, &name.value);
    let value = value?;
    let wires = kind_name.value.spec().values.wires(value.value);
    if wires.is_some_and(|wires| wires > WIRES_MAX) {
        let range = format!("1 to {WIRES_MAX}, because each element has a wire of its own");
        let length = wires.unwrap_or_default().to_string();
        fields.say(e0211_out_of_range::out_of_range(value.span, "array length", &length, &range));
        return None;
    }
    if let Err(can) = kind_name.value.spec().values.accept(value.value) {
        let (kind, found) = (kind_name.value.with_article(), value.value.to_string());
        fields.say(e0220_impossible_type::impossible_type(value.span, &kind, &found, can));
    }
    let kind = kind_name.value.read(&mut fields, direction, value.value);
    let (delay_span, delay) = (fields.own_span("delay"), fields.time_ms("delay", 1..=DELAY_MAX_MS));
    let prio_span = fields.own_span("prio");
    let prio = fields.integer("prio", -60..=60).and_then(|n| i8::try_from(n.value).ok());
    let group = group(&mut fields);
    let placements = placement::read(&mut fields, &kind, direction, value.value);
    let mut shown = presentation(&mut fields);
    let level = level(&mut fields);
    if let Some([upper, lower]) = level.as_ref().and_then(|level| level.divider) {
        let ratio = (f64::from(upper) + f64::from(lower)) / f64::from(lower);
        shown.scale = Some(shown.scale.unwrap_or(1.0) * ratio);
    }
    leftovers(&mut fields, kind_name.value);
    let id = id?;
    let id = Spanned { value: u8::try_from(id.value).ok()?, span: id.span };
    let block = span(file, node.range());
    let is_array = kind_name.value.spec().values.wires(value.value).is_some();
    let connections = placements.into_iter().zip(0..).map(|(placement, element)| Connection {
        part: PartIndex(0),
        name: None,
        element: is_array.then_some(element),
        device: DeviceIndex(0),
        kind: kind.clone(),
        direction,
        board,
        placement,
        wishes: wishes.clone(),
        level,
    });
    let connections: Vec<Connection> = connections.collect();
    let device = Device {
        part: PartIndex(0),
        name: name.clone(),
        block,
        id,
        direction,
        value,
        kind,
        kind_span: kind_name.span,
        delay_ms: delay.map_or(DELAY_DEFAULT_MS, |delay| delay.value),
        delay_span,
        prio: prio.unwrap_or(0),
        prio_span,
        group,
        shown,
        connections: (0..connections.len()).map(ConnectionIndex).collect(),
    };
    let part = Part { name, block, board, driver, allows };
    Some(ReadPart { part, devices: vec![device], connections })
}

fn value_type(
    file: FileId,
    node: &ast::Device,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Spanned<ValueType>> {
    let ty = node.ty()?;
    let scalar = ty.scalar()?;
    let at = span(file, scalar.range());
    let Some(found) = ScalarType::from_name(scalar.text()) else {
        let meant = nearest(scalar.text(), ScalarType::ALL.map(ScalarType::name));
        diagnostics.push(e0208_unknown_type::unknown_type(at, scalar.text(), meant));
        return None;
    };
    let span_all = span(file, ty.range());
    if !ty.is_array() {
        return Some(Spanned { value: ValueType::scalar(found), span: span_all });
    }
    let (length, range) = ty.length()?;
    if !(1..=ARRAY_MAX).contains(&length) {
        diagnostics.push(e0211_out_of_range::out_of_range(
            span(file, range),
            "array length",
            &length.to_string(),
            &format!("1 to {ARRAY_MAX}"),
        ));
        return None;
    }
    let value = ValueType { scalar: found, length: u16::try_from(length).ok() };
    Some(Spanned { value, span: span_all })
}

fn kind_name(fields: &mut Fields<'_>, direction: Direction) -> Option<Spanned<KindName>> {
    if !fields.has("type") {
        fields.missing("type", "type = analog;");
        return None;
    }
    let written = fields.name("type", "a kind of device")?;
    let Some(kind) = KindName::from_name(&written.value) else {
        let meant = nearest(&written.value, KindName::ALL.map(KindName::name));
        fields.say(e0207_unknown_kind::unknown_kind(
            written.span,
            &written.value,
            &KindName::list(),
            meant,
        ));
        return None;
    };
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
    Some(Spanned { value: kind, span: written.span })
}

/// Takes over the properties of the driver that the device names, or of the one its address tells.
fn take_driver(
    fields: &mut Fields<'_>,
    kind: KindName,
    drivers: &Drivers,
    device: &str,
) -> Option<String> {
    let driver = if fields.has("driver") {
        let wanted = fields.name("driver", "the name of a driver")?;
        let mut reports = Vec::new();
        let driver = drivers.find(&wanted, kind, &mut reports);
        reports.into_iter().for_each(|report| fields.say(report));
        driver?
    } else if kind == KindName::I2c && is_bare_ranger(fields) {
        let driver = drivers.library(DEFAULT_RANGER)?;
        let at = fields.value_span("address")?;
        fields.say(h0703_default_protocol::default_protocol(at, device, DEFAULT_RANGER));
        driver
    } else {
        return None;
    };
    fields.inherit(driver.node.properties(), driver.file);
    Some(driver.name.value.clone())
}

/// True for an i2c device without any protocol at the address of a Devantech ranger.
fn is_bare_ranger(fields: &mut Fields<'_>) -> bool {
    if i2c::PROTOCOL.iter().any(|name| fields.has(name)) {
        return false;
    }
    fields
        .peek_integer("address")
        .is_some_and(|address| RANGER_ADDRESSES.contains(&address) && address % 2 == 0)
}

/// The devices that never measure at the same time; `none` takes a driver's group back.
fn group(fields: &mut Fields<'_>) -> Option<Group> {
    let own = fields.own_span("group").is_some();
    let name = fields.name("group", "the name of a group, or none")?;
    (name.value != "none").then_some(Group { name: name.value, span: name.span, own })
}

/// The voltage that the device puts on its wires.
fn level(fields: &mut Fields<'_>) -> Option<Level> {
    let divider = fields.resistances_ohm("divider");
    let level = fields.voltage_mv("level", 1..=LEVEL_MAX_MV);
    if let (Some(divider), None) = (&divider, &level) {
        let what = "a divider needs the voltage that it divides: `level = 5 V;`";
        fields.contradiction(divider.span, "level", what);
    }
    let Spanned { value: mv, span } = level?;
    Some(Level { mv, divider: divider.map(|divider| divider.value), span })
}

fn presentation(fields: &mut Fields<'_>) -> Presentation {
    Presentation {
        label: fields.text("label").map(|text| text.value),
        quantity: fields.text("quantity").map(|text| text.value),
        scale: fields.number("scale").map(|number| number.value),
        offset: fields.number("offset").map(|number| number.value),
        min: unless_taken(fields, "min"),
        max: unless_taken(fields, "max"),
    }
}

/// `min` and `max` of a pwm device are pulses, which its kind has read already.
fn unless_taken(fields: &mut Fields<'_>, name: &str) -> Option<f64> {
    let free = fields.rest().iter().any(|field| field.name == name);
    if free { fields.number(name).map(|number| number.value) } else { None }
}

/// Reports what no part of the device has read.
fn leftovers(fields: &mut Fields<'_>, kind: KindName) {
    for Field { name, name_span, inherited, .. } in fields.rest() {
        if inherited {
            continue;
        }
        let report = unknown(&name, name_span, kind);
        fields.say(report);
    }
}

fn unknown(name: &str, at: Span, kind: KindName) -> Diagnostic {
    let others: Vec<&str> = KindName::ALL
        .into_iter()
        .filter(|other| *other != kind && other.spec().properties.contains(&name))
        .map(KindName::name)
        .collect();
    if others.is_empty() {
        let common = COMMON_PROPERTIES.iter().chain(PRESENTATION);
        let known = kind.spec().properties.iter().chain(common).copied();
        let meant = nearest(name, known);
        return e0201_unknown_property::unknown_property(at, name, &kind.with_article(), meant);
    }
    e0213_property_of_other_kind::property_of_other_kind(
        at,
        name,
        &kind.with_article(),
        &others.join(", "),
    )
}
