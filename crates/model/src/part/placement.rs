//! What a block fixes of its wiring: pins, units, places, and what the elements of an array have in
//! common.

use sensedsl_diagnostics::codes::{e0209_wrong_value, e0211_out_of_range};
use sensedsl_wire::{Direction, ValueType};

use crate::design::{PinRef, Placement, Together};
use crate::fields::{Fields, name_or_text};
use crate::kind::{Kind, Role};
use crate::spanned::Spanned;
use crate::value::Value;

/// The words after `together`.
pub(crate) const TOGETHER: [(&str, Together); 3] = [
    (Together::Unit.name(), Together::Unit),
    (Together::Header.name(), Together::Header),
    (Together::Side.name(), Together::Side),
];

/// The words after `sequence`.
pub(crate) const SEQUENCE: [(&str, ()); 1] = [("header", ())];

/// Reads the placement of a device: one for each set of wires, of which an array has several.
pub(crate) fn read(
    fields: &mut Fields<'_>,
    kind: &Kind,
    direction: Direction,
    value: ValueType,
) -> Vec<Placement> {
    let count = kind.name().spec().values.wires(value);
    let unit = fields.name("unit", "a peripheral such as ADC1");
    let (together, sequence) = in_common(fields, count.is_some());
    let common = Placement {
        pins: Vec::new(),
        unit: unit.map(|unit| Spanned { value: unit.value.to_uppercase(), span: unit.span }),
        side: fields.name("side", "the name of a side"),
        header: fields.name("header", "the name of a header"),
        together,
        sequence,
    };
    let mut placements = vec![common; usize::from(count.unwrap_or(1))];
    for role in kind.roles(direction) {
        match count {
            None => {
                if let (Some(pin), Some(one)) = (pin(fields, role), placements.first_mut()) {
                    one.pins.push((role, pin));
                }
            }
            Some(count) => {
                for (pin, one) in pins(fields, role, count).into_iter().zip(&mut placements) {
                    one.pins.push((role, pin));
                }
            }
        }
    }
    placements
}

fn pin(fields: &mut Fields<'_>, role: Role) -> Option<Spanned<PinRef>> {
    let Spanned { value, span } = fields.name(role.property(), "a pin such as PA1")?;
    Some(Spanned { value: PinRef::unbound(&value), span })
}

/// The pins of one role of an array: as many as it has elements.
fn pins(fields: &mut Fields<'_>, role: Role, count: u16) -> Vec<Spanned<PinRef>> {
    let Some(field) = fields.take(role.property()) else { return Vec::new() };
    let takes = format!("a list of {count} pins such as [PA0, PA1]");
    let Value::List(list) = &field.value else {
        fields.wrong(&field, &takes);
        return Vec::new();
    };
    let mut pins = Vec::new();
    for Spanned { value, span: at } in list {
        let at = *at;
        let Some(name) = name_or_text(value) else {
            let property = role.property();
            fields.say(e0209_wrong_value::wrong_value(at, property, "a pin", "another value"));
            return Vec::new();
        };
        pins.push(Spanned { value: PinRef::unbound(&name), span: at });
    }
    if pins.len() != usize::from(count) {
        let (at, property) = (field.value_span, role.property());
        let report = e0211_out_of_range::wrong_count;
        fields.say(report(at, property, pins.len(), usize::from(count)));
        return Vec::new();
    }
    pins
}

/// Reads what the elements of an array have in common.
fn in_common(
    fields: &mut Fields<'_>,
    is_array: bool,
) -> (Vec<Spanned<Together>>, Option<sensedsl_diagnostics::Span>) {
    let together = fields.word("together", &TOGETHER);
    let sequence = fields.word("sequence", &SEQUENCE).map(|word| word.span);
    if !is_array {
        let written = together.iter().map(|one| (one.span, "together"));
        let written = written.chain(sequence.map(|span| (span, "sequence")));
        for (span, name) in written.collect::<Vec<_>>() {
            fields.needs_array(span, name);
        }
        return (Vec::new(), None);
    }
    (together.into_iter().collect(), sequence)
}
