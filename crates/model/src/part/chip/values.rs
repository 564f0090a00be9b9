//! The values of a chip: those that its driver names, and which of them the chip's devices are.

use sensedsl_diagnostics::codes::{
    e0220_impossible_type, e0229_wrong_driver, e0230_unknown_reading,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_limits::DRIVER_VALUES_MAX;
use sensedsl_syntax::ast::{self, AstNode as _, Property};
use sensedsl_wire::{Direction, ValueType};

use super::reader::{ChipReader, DriverValue};
use crate::driver::Driver;
use crate::fields::Fields;
use crate::part::coding::PROTOCOL;
use crate::part::properties::{direction, is_about_part};
use crate::rule::names::folded;
use crate::spanned::{Spanned, span};
use crate::value::constants::Constants;
use crate::value::types;

/// A device of a chip, and the driver's value that it is.
pub(super) struct RequestedValue {
    pub(super) name: Spanned<String>,
    pub(super) block: Span,
    pub(super) own: Vec<Property>,
    pub(super) value: Spanned<ValueType>,
    pub(super) given: DriverValue,
}

/// The properties that a driver gives for all its values, without those of the part itself and of
/// its start.
pub(super) fn shared(driver: &Driver) -> impl Iterator<Item = Property> {
    let own = |one: &Property| {
        one.name().is_some_and(|name| {
            !is_about_part(name.text()) && !PROTOCOL.contains(&name.text()) && name.text() != "pull"
        })
    };
    driver.node.properties().filter(own)
}

/// Whether the chip's formula computes the value from its bytes: true of a sensor that states
/// nothing else.
pub(super) fn is_computed(given: &DriverValue) -> bool {
    given.direction == Direction::Sensor
}

/// The readings and commands of a driver. If it has none, the one value that all its devices have.
pub(super) fn given(
    driver: &Driver,
    sockets: &[Option<&str>],
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Vec<DriverValue> {
    let readings = driver.node.readings().map(|one| {
        let properties: Vec<Property> = one.properties().collect();
        (one.name(), one.ty(), properties, Direction::Sensor)
    });
    let commands = driver.node.commands().map(|one| {
        let properties: Vec<Property> = one.properties().collect();
        (one.name(), one.ty(), properties, Direction::Actuator)
    });
    let mut all: Vec<DriverValue> = Vec::new();
    for (name, ty, properties, direction) in readings.chain(commands) {
        let Some(name) = name else { continue };
        if all.len() >= DRIVER_VALUES_MAX {
            let at = span(driver.file, name.range());
            let message = format!("it has more than {DRIVER_VALUES_MAX} values");
            diagnostics.push(e0229_wrong_driver::wrong_driver(at, &message));
            break;
        }
        let value = types::read(driver.file, ty, (constants, diagnostics));
        let at = span(driver.file, name.range());
        if all.iter().any(|one| folded(&one.name) == folded(name.text())) {
            let message = format!("it has two values `{}`", name.text());
            diagnostics.push(e0229_wrong_driver::wrong_driver(at, &message));
            continue;
        }
        let reported = (constants, &mut *diagnostics);
        let via = via((driver.file, at), &properties, sockets, reported);
        let (Some(value), Some(via)) = (value, via) else { continue };
        let (name, value) = (name.text().to_owned(), value.value);
        all.push(DriverValue { name, span: at, direction, value, properties, via });
    }
    all
}

/// The connections that a reading or command goes over: those that it names, or the only one there
/// is.
fn via(
    (file, at): (FileId, Span),
    properties: &[Property],
    sockets: &[Option<&str>],
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Option<Vec<usize>> {
    let is_via = |one: &&Property| one.name().is_some_and(|name| name.text() == "via");
    let own = properties.iter().filter(is_via).cloned();
    let mut fields = Fields::new(own, file, "a reading", at, (constants, diagnostics));
    let Some(names) = fields.names("via", "the name of a connection, or a list of them") else {
        if sockets.len() == 1 {
            return Some(vec![0]);
        }
        let message = "it must say which connection it goes over: `via = NAME;`";
        fields.say(e0229_wrong_driver::wrong_driver(at, message));
        return None;
    };
    let mut found = Vec::new();
    for name in names {
        match sockets.iter().position(|one| *one == Some(name.value.as_str())) {
            Some(number) => found.push(number),
            None => {
                let message = format!("it has no connection `{}`", name.value);
                fields.say(e0229_wrong_driver::wrong_driver(name.span, &message));
                return None;
            }
        }
    }
    (!found.is_empty()).then_some(found)
}

/// All values of the driver as devices of the chip.
pub(super) fn all(
    whole: &ChipReader<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<RequestedValue> {
    let given = whole.given.clone();
    if given.is_empty() {
        let name = &whole.driver.name.value;
        let message = format!("`{name}` does not say what values there are");
        let report = e0230_unknown_reading::unknown_reading;
        let at = whole.name.span;
        diagnostics.push(report(at, &message, "", None).help(format!(
            "write a device in it: `sensor {}Value returns uint16 {{ }}`",
            whole.name.value
        )));
    }
    let asked = given.into_iter().map(|given| {
        let words = given.name.split('_').map(|word| {
            let mut letters = word.chars();
            let first = letters.next().map(|letter| letter.to_ascii_uppercase());
            first.into_iter().chain(letters).collect::<String>()
        });
        let value = format!("{}{}", whole.name.value, words.collect::<String>());
        RequestedValue {
            name: Spanned { value, span: whole.name.span },
            block: whole.block,
            own: Vec::new(),
            value: Spanned { value: given.value, span: whole.name.span },
            given,
        }
    });
    asked.collect()
}

/// The driver's value that a device is.
pub(super) fn stated(
    whole: &ChipReader<'_>,
    node: &ast::Device,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<RequestedValue> {
    let name = node.name()?;
    let name = Spanned { value: name.text().to_owned(), span: span(whole.file, name.range()) };
    let direction = direction(node)?;
    let constants = whole.known.constants;
    let value = types::read(whole.file, node.ty(), (constants, diagnostics))?;
    let all = &whole.given;
    let own: Vec<Property> = node.properties().collect();
    let given = if all.is_empty() && !whole.driver.has_values() {
        // A driver of the first edition: one value, which has no name.
        let (name, properties) = (String::new(), Vec::new());
        let span = whole.driver.name.span;
        DriverValue { name, span, direction, value: value.value, properties, via: vec![0] }
    } else {
        choose(whole, all, (&name, direction), &own, diagnostics)?
    };
    if given.value.count() != value.value.count() {
        let what = format!("`{}` of `{}`", given.name, whole.driver.name.value);
        let can = match given.value.length {
            None => "one number".to_owned(),
            Some(length) => format!("{length} elements, as {}", given.value),
        };
        let wrong = e0220_impossible_type::impossible_type;
        diagnostics.push(wrong(value.span, &what, &value.value.to_string(), &can));
        return None;
    }
    let block = span(whole.file, node.range());
    Some(RequestedValue { name, block, own, value, given })
}

fn choose(
    whole: &ChipReader<'_>,
    all: &[DriverValue],
    (name, direction): (&Spanned<String>, Direction),
    own: &[Property],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<DriverValue> {
    let is_reading = |one: &&Property| one.name().is_some_and(|name| name.text() == "reading");
    let constants = whole.known.constants;
    let stated = own.iter().filter(is_reading).cloned();
    let reported = (constants, &mut *diagnostics);
    let mut fields = Fields::new(stated, whole.file, "a device", name.span, reported);
    let stated = fields.name("reading", "the name of a reading or command");
    let fitting: Vec<&DriverValue> = all.iter().filter(|one| one.direction == direction).collect();
    let wanted = stated.as_ref().unwrap_or(name);
    let called = fitting.iter().find(|one| folded(&one.name) == folded(&wanted.value));
    let only = match fitting.as_slice() {
        [only] if stated.is_none() => Some(only),
        _ => None,
    };
    if let Some(found) = called.or(only) {
        return Some((*found).clone());
    }
    let names: Vec<&str> = fitting.iter().map(|one| one.name.as_str()).collect();
    let what = match direction {
        Direction::Sensor => "reading",
        Direction::Actuator => "command",
    };
    let driver = &whole.driver.name.value;
    let message = if names.is_empty() {
        format!(
            "`{driver}` has no {what}s: `{}` cannot be {}",
            name.value,
            match direction {
                Direction::Sensor => "a sensor",
                Direction::Actuator => "an actuator",
            }
        )
    } else {
        format!("`{driver}` has no {what} `{}`", wanted.value)
    };
    let others = all.iter().map(|one| one.name.as_str());
    let has = if names.is_empty() { others.collect::<Vec<_>>() } else { names.clone() }.join(", ");
    let meant = nearest(&wanted.value, names.iter().copied()).filter(|_| stated.is_some());
    diagnostics.push(e0230_unknown_reading::unknown_reading(wanted.span, &message, &has, meant));
    None
}
