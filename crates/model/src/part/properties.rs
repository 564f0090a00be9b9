//! The properties that devices and chips have in common: the fields of a block in; identifier, pace, group, level and
//! presentation out.

use sensedsl_diagnostics::Span;
use sensedsl_syntax::ast;
use sensedsl_wire::Direction;

use super::coding;
use crate::design::protocol::Filter;
use crate::design::{Group, Level, Presentation};
use crate::fields::Fields;
use crate::kind::Kind;
use crate::spanned::Spanned;

/// The properties of every device, except those that show its value.
pub(crate) const COMMON_PROPERTIES: &[&str] = &[
    "id", "type", "driver", "delay", "prio", "group", "unit", "side", "header", "together",
    "sequence", "level", "divider",
];
/// The properties for how a host shows a value.
pub(crate) const PRESENTATION: &[&str] =
    &["label", "quantity", "scale", "offset", "min", "max", "curve"];

/// The properties with which a driver describes its part.
pub(crate) const ABOUT_PART: &[&str] = &[
    "part",
    "about",
    "aliases",
    "sheet",
    "checked",
    "supply",
    "connector",
    "note",
    "addresses",
    "speed_max",
    "clock_max",
];

/// Cycle time if the file gives none (the paper, section 3.2).
const DELAY_DEFAULT_MS: u32 = 1_000;
/// Longest cycle time: an hour.
const DELAY_MAX_MS: u32 = 3_600_000;
/// The highest voltage allowed in a file.
const LEVEL_MAX_MV: u32 = 1_000_000;

/// Whether a property of a driver describes the part and is only for its page. For some kinds,
/// `pull` is a resistor in the MCU.
pub(crate) fn is_about_part(name: &str) -> bool {
    ABOUT_PART.contains(&name)
}

/// The direction of a device.
pub(crate) fn direction(node: &ast::Device) -> Option<Direction> {
    Some(match node.direction()? {
        ast::Direction::Sensor => Direction::Sensor,
        ast::Direction::Actuator => Direction::Actuator,
    })
}

/// The properties that a device has whatever it is connected to.
pub(crate) struct Own {
    pub(crate) id: Option<Spanned<u8>>,
    pub(crate) delay_ms: Option<u32>,
    pub(crate) delay_span: Option<Span>,
    pub(crate) prio: i8,
    pub(crate) prio_span: Option<Span>,
    pub(crate) group: Option<Group>,
    pub(crate) shown: Presentation,
    pub(crate) filter: Filter,
}

/// Reads the properties that a device has whatever it is connected to.
pub(crate) fn own(fields: &mut Fields<'_>) -> Own {
    let id = fields.integer("id", 1..=254);
    let (delay_span, delay) = (fields.own_span("delay"), fields.time_ms("delay", 1..=DELAY_MAX_MS));
    let prio_span = fields.own_span("prio");
    let prio = fields.integer("prio", -60..=60).and_then(|n| i8::try_from(n.value).ok());
    Own {
        id: id.and_then(|id| Some(Spanned { value: u8::try_from(id.value).ok()?, span: id.span })),
        delay_ms: delay.map(|delay| delay.value),
        delay_span,
        prio: prio.unwrap_or(0),
        prio_span,
        group: group(fields),
        shown: presentation(fields),
        filter: coding::filter(fields),
    }
}

/// The cycle time; if the file gives none, one that leaves the part alone for as long as it needs.
pub(crate) fn delay_ms(stated_ms: Option<u32>, kind: &Kind) -> u32 {
    let rest_ms = kind.onewire().map_or(0, |own| own.rest_us.div_ceil(1_000));
    stated_ms.unwrap_or_else(|| DELAY_DEFAULT_MS.max(rest_ms))
}

/// Adjusts the scale so that the host undoes the voltage divider. Only what a converter samples becomes less by it: the
/// time of an echo is the same behind two resistors.
pub(crate) fn divided(mut shown: Presentation, kind: &Kind, level: Option<&Level>) -> Presentation {
    let divider = level.filter(|_| kind.is_sampled()).and_then(|level| level.divider);
    if let Some([upper, lower]) = divider {
        let ratio = (f64::from(upper) + f64::from(lower)) / f64::from(lower);
        shown.scale = Some(shown.scale.unwrap_or(1.0) * ratio);
    }
    shown
}

/// The group of devices that never measure at the same time; `none` overrides a driver's group.
fn group(fields: &mut Fields<'_>) -> Option<Group> {
    let own = fields.own_span("group").is_some();
    let name = fields.name("group", "the name of a group, or none")?;
    (name.value != "none").then_some(Group { name: name.value, span: name.span, own })
}

/// The voltage that the device puts on its wires.
pub(crate) fn level(fields: &mut Fields<'_>) -> Option<Level> {
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
    let (min, max) = (unless_taken(fields, "min"), unless_taken(fields, "max"));
    if let (Some(min), Some(max)) = (min, max)
        && min.value >= max.value
    {
        fields.contradiction(min.span, "max", "`min` is not below `max`");
    }
    Presentation {
        label: fields.text("label").map(|text| text.value),
        quantity: fields.text("quantity").map(|text| text.value),
        scale: fields.number("scale").map(|number| number.value),
        offset: fields.number("offset").map(|number| number.value),
        min: min.map(|one| one.value),
        max: max.map(|one| one.value),
        bare: None,
        bounds: [min.map(|one| one.span), max.map(|one| one.span)],
        curve: coding::curve(fields),
    }
}

/// For a pwm device, `min` and `max` are pulses, which its kind has already read.
fn unless_taken(fields: &mut Fields<'_>, name: &str) -> Option<Spanned<f64>> {
    let free = fields.rest().iter().any(|field| field.name == name);
    if free { fields.bound(name) } else { None }
}
