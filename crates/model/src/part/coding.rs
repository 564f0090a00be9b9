//! The properties for how a value is coded, filtered and initialized: fields in, [`Coding`],
//! [`Filter`] and [`Protocol`] out.

use sensedsl_diagnostics::Span;
use sensedsl_diagnostics::codes::{e0211_out_of_range, e0229_wrong_driver};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use crate::design::protocol::{
    Coding, Crc, Drive, Filter, Format, Formula, Identity, InitStep, Output, Protocol, TextField,
};
use crate::fields::{
    Codes, Fields, name_or_text, plain_integer, plain_number, points, with_address,
};
use crate::kind::uart::{SUMS_BEHIND, exchange::ADDRESS};
use crate::kind::{Kind, KindName};
use crate::part::reach;
use crate::spanned::Spanned;
use crate::value::{Dimension, Value};

/// The properties that filter a value.
pub(crate) const FILTER: &[&str] = &["invalid", "median", "smooth", "change", "heartbeat"];
/// The properties of a reading or command, besides those of its kind.
pub(crate) const CODING: &[&str] = &[
    "bits",
    "signed",
    "elements",
    "crc",
    "packed",
    "byte",
    "sentence",
    "field",
    "separator",
    "format",
    "decimals",
    "exchange",
    "output",
    "drive",
    "failsafe",
    "initial",
    "via",
];
/// The properties of a chip's protocol.
pub(crate) const PROTOCOL: &[&str] = &[
    "init",
    "init_checksum",
    "identity",
    "identity_mask",
    "register_size",
    "read_mask",
    "burst",
    "calibration",
    "compensate",
    "parameters",
];

/// The words after `crc`.
pub(crate) const CRCS: [(&str, Crc); 1] = [("sensirion", Crc::Sensirion)];
/// How a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Written {
    /// In a text.
    Text(Format),
    /// Two decimal digits a byte.
    Bcd,
    /// A sign and a magnitude in place of the two's complement.
    Magnitude,
}

/// The words after `format`.
pub(crate) const FORMATS: [(&str, Written); 5] = [
    ("decimal", Written::Text(Format::Decimal)),
    ("degrees", Written::Text(Format::Degrees)),
    ("hex", Written::Text(Format::Hex)),
    ("bcd", Written::Bcd),
    ("sign_magnitude", Written::Magnitude),
];
/// The words after `drive`.
pub(crate) const DRIVES: [(&str, Drive); 3] = [
    ("direction_pins", Drive::DirectionPins),
    ("direction_pin", Drive::DirectionPin),
    ("two_pwm", Drive::TwoPwm),
];

/// Most raw values or ranges that mean "no measurement".
const INVALID_MAX: usize = 16;
/// Most steps of an initialization.
const INIT_MAX: usize = 128;

/// Reads how the value is coded.
pub(crate) fn coding(fields: &mut Fields<'_>, of: ValueType, formula: Option<Formula>) -> Coding {
    // With `bit`, `bits` is a number of bits, which the kind has already read.
    let bits = if fields.has("bit") { None } else { fields.integer_range("bits", 0..=63) };
    let bits = bits.map(|Spanned { value: (high, low), .. }| (high.max(low), high.min(low)));
    let signed = fields.boolean("signed").map(|word| word.value);
    let elements = elements(fields, of);
    let crc = fields.word("crc", &CRCS).map(|word| word.value);
    let packed = fields.integer("packed", 1..=32).and_then(|n| u8::try_from(n.value).ok());
    let byte = fields.integer("byte", 0..=1_023).and_then(|n| u16::try_from(n.value).ok());
    let format = fields.word("format", &FORMATS).map(|word| word.value);
    let of_text = match format {
        Some(Written::Text(format)) => Some(format),
        Some(Written::Bcd | Written::Magnitude) | None => None,
    };
    let text = text(fields, of_text);
    let exchange = fields.bytes("exchange", 1..=255).map(|bytes| bytes.value).unwrap_or_default();
    let output = output(fields, formula);
    let drive = fields.word("drive", &DRIVES).map(|word| word.value);
    Coding {
        reading: None,
        of: Some(of),
        bits,
        signed,
        elements,
        crc,
        packed_bits: packed,
        byte: byte.unwrap_or(0),
        text,
        bcd: format == Some(Written::Bcd),
        is_magnitude: format == Some(Written::Magnitude),
        exchange,
        output,
        drive,
        failsafe: None,
        initial: None,
    }
}

/// Reads an actuator's failsafe value, unless its kind has done so, as a code that the type holds
/// and the part takes.
pub(crate) fn failsafe(
    fields: &mut Fields<'_>,
    direction: Direction,
    of: ValueType,
    range: Option<(f64, f64)>,
) -> Option<f64> {
    let field = fields.rest().into_iter().find(|field| field.name == "failsafe")?;
    if direction == Direction::Sensor {
        fields.take("failsafe");
        fields.needs_direction(field.value_span, "failsafe", Direction::Actuator);
        return None;
    }
    if of.scalar != ScalarType::Bool && !fields.shows_the_code() {
        let is_whole = of.scalar.integer_range().is_some();
        let codes = Codes { range, is_whole, pulses_us: None };
        return fields.code("failsafe", codes).map(|code| code.value);
    }
    fields.take("failsafe");
    let word = name_or_text(&field.value);
    let number = match word.as_deref() {
        Some("true") if of.scalar == ScalarType::Bool => Some(1.0),
        Some("false") if of.scalar == ScalarType::Bool => Some(0.0),
        _ => fields.plain_or_raw(&field),
    };
    let Some(number) = number else {
        let takes = if of.scalar == ScalarType::Bool { "`true` or `false`" } else { "a number" };
        fields.wrong(&field, takes);
        return None;
    };
    if let Some(range) = unheld(of.scalar, number) {
        let (at, found) = (field.value_span, number.to_string());
        fields.say(e0211_out_of_range::out_of_range(at, "failsafe", &found, &range));
        return None;
    }
    Some(number)
}

/// The values that a type can hold, if the number is not one of them.
fn unheld(scalar: ScalarType, number: f64) -> Option<String> {
    if scalar == ScalarType::Bool {
        let is_held = number == 0.0 || number == 1.0;
        return (!is_held).then(|| "`true`, `false`, 1 or 0".to_owned());
    }
    if scalar == ScalarType::Float32 {
        let is_held = number.abs() <= f64::from(f32::MAX);
        return (!is_held).then(|| "a number that a float32 can hold".to_owned());
    }
    let (least, greatest) = scalar.integer_range()?;
    #[expect(
        clippy::cast_precision_loss,
        reason = "the ends of 64 bits are as near as a number gets"
    )]
    let is_held = number.fract() == 0.0 && (least as f64..=greatest as f64).contains(&number);
    (!is_held).then(|| format!("a whole number from {least} to {greatest}"))
}

/// Reads the initial and the failsafe value of a chip's command.
pub(crate) fn commanded(
    fields: &mut Fields<'_>,
    coding: &mut Coding,
    direction: Direction,
    of: ValueType,
    (name, of_bus): (KindName, Option<&Kind>),
) {
    let range = reach::of_codes(name, coding, of);
    coding.failsafe = failsafe(fields, direction, of, range);
    coding.initial = initial(fields, of_bus, direction, of);
}

/// Reads whether an output of a chip on a bus is on from the start. Other kinds of wires have their
/// own `initial`.
fn initial(
    fields: &mut Fields<'_>,
    of_bus: Option<&Kind>,
    direction: Direction,
    of: ValueType,
) -> Option<bool> {
    let is_switch = of.scalar == ScalarType::Bool && of.count() == 1;
    if !is_switch || of_bus.and_then(Kind::register_access).is_none() {
        if let Some(field) = fields.take("initial") {
            fields.wrong(&field, "`true` or `false`, and a command of one `bool` on I2C or SPI");
        }
        return None;
    }
    let word = fields.boolean("initial")?;
    if direction == Direction::Sensor {
        fields.needs_direction(word.span, "initial", Direction::Actuator);
        return None;
    }
    Some(word.value)
}

fn elements(fields: &mut Fields<'_>, of: ValueType) -> Vec<u8> {
    let Some(Spanned { value, span }) = fields.bytes("elements", 1..=255) else {
        return Vec::new();
    };
    if value.len() != of.count() {
        fields.say(e0211_out_of_range::wrong_count(span, "elements", value.len(), of.count()));
        return Vec::new();
    }
    value
}

fn text(fields: &mut Fields<'_>, format: Option<Format>) -> Option<TextField> {
    let sentence = fields.text("sentence").map(|text| text.value);
    let field = fields.integer("field", 0..=63).and_then(|n| u8::try_from(n.value).ok());
    let separator = fields.bytes("separator", 1..=1).and_then(|one| one.value.first().copied());
    let decimals = fields.integer("decimals", 0..=18).and_then(|n| u8::try_from(n.value).ok());
    let format = format?;
    Some(TextField {
        separator: separator.or(sentence.is_some().then_some(b',')),
        sentence,
        field: field.unwrap_or(0),
        format,
        decimals: decimals.unwrap_or(0),
    })
}

/// The output of the chip's formula: the one named, or the one with the reading's name.
fn output(fields: &mut Fields<'_>, formula: Option<Formula>) -> Option<Output> {
    let of = formula?;
    let outputs = of.outputs();
    let named = fields.name("output", "an output of the formula");
    let wanted = named.as_ref().map_or_else(|| fields.reading_name(), |one| one.value.clone());
    let found = outputs.iter().position(|one| *one == wanted);
    if let (None, Some(named)) = (found, &named) {
        let words = outputs.iter().zip(0..).map(|(word, at): (_, u8)| (*word, at));
        fields.unknown_word(named.span, "output", &named.value, &words.collect::<Vec<_>>());
    }
    Some(Output { of, number: u8::try_from(found?).ok()? })
}

/// Reads how the value is filtered on the board.
pub(crate) fn filter(fields: &mut Fields<'_>) -> Filter {
    let invalid_span = fields.own_span("invalid");
    let invalid = invalid(fields);
    let median = fields.integer("median", 3..=15);
    if let Some(Spanned { value, span }) = median
        && value % 2 == 0
    {
        let (found, range) = (value.to_string(), "an odd number from 3 to 15");
        fields.say(e0211_out_of_range::out_of_range(span, "median", &found, range));
    }
    let smooth = fields.time_ms("smooth", 1..=3_600_000);
    let change = fields.number("change");
    if let Some(Spanned { value, span }) = change
        && value <= 0.0
    {
        let found = value.to_string();
        fields.say(e0211_out_of_range::out_of_range(span, "change", &found, "more than 0"));
    }
    let heartbeat = fields.time_ms("heartbeat", 1..=3_600_000);
    if let (None, Some(heartbeat)) = (&change, &heartbeat) {
        let why = "`heartbeat` is for what is reported only when it has changed: `change = 3;`";
        fields.contradiction(heartbeat.span, "change", why);
    }
    Filter {
        invalid,
        invalid_span,
        median: median.and_then(|n| u8::try_from(n.value).ok()).unwrap_or(0),
        smooth_ms: smooth.map_or(0, |time| time.value),
        change: change.map(|number| number.value),
        heartbeat_ms: heartbeat.map_or(0, |time| time.value),
    }
}

/// A number, a range, or a list of them.
fn invalid(fields: &mut Fields<'_>) -> Vec<(f64, f64)> {
    let Some(field) = fields.take("invalid") else { return Vec::new() };
    let one = |value: &Value| match value.range() {
        Some([first, last]) => {
            let (first, last) = (plain_number(&first.value)?, plain_number(&last.value)?);
            Some((first.min(last), first.max(last)))
        }
        None => plain_number(value).map(|number| (number, number)),
    };
    let all = match field.value.list() {
        Some(list) => list.iter().map(|value| one(&value.value)).collect(),
        None => one(&field.value).map(|one| vec![one]),
    };
    match all {
        Some(all) if all.len() <= INVALID_MAX => all,
        Some(all) => {
            let (found, range) = (format!("{} values", all.len()), format!("up to {INVALID_MAX}"));
            let at = field.value_span;
            fields.say(e0211_out_of_range::out_of_range(at, "invalid", &found, &range));
            Vec::new()
        }
        None => {
            fields.wrong(&field, "a number, a range such as 0..3, or a list of them");
            Vec::new()
        }
    }
}

/// The points of a curve: pairs whose first numbers ascend.
pub(crate) fn curve(fields: &mut Fields<'_>) -> Vec<(f64, f64)> {
    const TAKES: &str = "a list of pairs such as [[0.4, 80], [1.3, 20]], the first numbers rising";
    fields.read("curve", TAKES, points).map(|points| points.value).unwrap_or_default()
}

/// Reads how a chip is started and how its values are computed.
pub(crate) fn protocol(fields: &mut Fields<'_>) -> Protocol {
    let formulas = Formula::ALL.map(|one| (one.name(), one));
    let formula = fields.word("compensate", &formulas);
    let register_bytes = fields.integer("register_size", 1..=2).map_or(1, |n| n.value);
    let read_mask = fields.integer("read_mask", 0..=255).map_or(0, |n| n.value);
    let is_burst = fields.boolean("burst").is_none_or(|word| word.value);
    let calibration = calibration(fields);
    let parameters = parameters(fields);
    if let Some(Spanned { value: formula, span }) = formula {
        let (bytes, _, count) = formula.needs();
        let found: u16 = calibration.iter().map(|(_, count)| count).sum();
        let message = if found != bytes {
            Some(format!(
                "{} needs {bytes} bytes of `calibration`, and there are {found}",
                formula.name()
            ))
        } else if parameters.len() != count {
            let there = parameters.len();
            Some(format!("{} needs {count} `parameters`, and there are {there}", formula.name()))
        } else {
            None
        };
        if let Some(message) = message {
            fields.say(e0229_wrong_driver::wrong_driver(span, &message));
        }
    }
    Protocol {
        init: init(fields),
        identity: identity(fields),
        register_bytes: u8::try_from(register_bytes).unwrap_or(1),
        read_mask: u8::try_from(read_mask).unwrap_or(0),
        is_one_by_one: !is_burst,
        calibration,
        formula: formula.map(|word| word.value),
        parameters,
    }
}

fn init(fields: &mut Fields<'_>) -> Vec<InitStep> {
    const TAKES: &str = "a list of byte lists and times such as [[0x6B, 0x80], 100 ms]";
    let sum = fields.word("init_checksum", SUMS_BEHIND).map(|word| word.value).unwrap_or_default();
    let Some(field) = fields.take("init") else { return Vec::new() };
    let address = fields.peek_integer(ADDRESS).and_then(|number| u8::try_from(number).ok());
    let from = fields.peek_integer("checksum_from").and_then(|from| usize::try_from(from).ok());
    let framed = |mut bytes: Vec<u8>| {
        bytes.extend(sum.of(&bytes, from.unwrap_or(0)));
        InitStep::Write(bytes)
    };
    let step = |value: &Value| match value {
        Value::List(_) => {
            let value = with_address(value, address);
            let byte = |one: &Spanned<Value>| u8::try_from(plain_integer(&one.value)?).ok();
            let bytes: Option<Vec<u8>> = value.list()?.iter().map(byte).collect();
            bytes.filter(|bytes| (1..=252).contains(&bytes.len())).map(framed)
        }
        Value::Text(text) if !text.is_empty() && text.len() <= 255 => {
            Some(InitStep::Write(text.bytes().collect()))
        }
        Value::Number(number) if number.dimension() == Dimension::TIME => {
            let ms = (number.in_base_units() * 1e3).ceil();
            let ms = if (1.0..=65_535.0).contains(&ms) { ms } else { return None };
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "compared with the range of u16 just before"
            )]
            Some(InitStep::Wait { ms: ms as u16 })
        }
        Value::Number(_) | Value::Name(_) | Value::Text(_) | Value::Range(_) | Value::Unknown => {
            None
        }
    };
    let texts = field.value.list().unwrap_or_default();
    if texts.iter().any(|one| fields.spells("init", &one.value, one.span)) {
        return Vec::new();
    }
    let steps: Option<Vec<InitStep>> =
        field.value.list().and_then(|list| list.iter().map(|one| step(&one.value)).collect());
    match steps {
        Some(steps) if steps.len() <= INIT_MAX => steps,
        Some(_) | None => {
            fields.wrong(&field, TAKES);
            Vec::new()
        }
    }
}

fn identity(fields: &mut Fields<'_>) -> Option<Identity> {
    let mask = fields.bytes("identity_mask", 1..=32);
    let field = fields.take("identity")?;
    let whole = |value: &Spanned<Value>| u16::try_from(plain_integer(&value.value)?).ok();
    let list = field.value.list().filter(|list| list.len() >= 2);
    let numbers: Option<Vec<u16>> = list.and_then(|list| list.iter().map(whole).collect());
    let Some([register, expected @ ..]) = numbers.as_deref() else {
        fields.wrong(
            &field,
            "a register and the bytes that must be read there, such as [0x75, 0x68]",
        );
        return None;
    };
    let bytes: Result<Vec<u8>, _> = expected.iter().map(|one| u8::try_from(*one)).collect();
    let Ok(expected) = bytes else {
        fields.never(field.value_span, "a byte is at most 0xFF: write each byte for itself");
        return None;
    };
    let mask = mask.map(|mask| (mask.value, mask.span));
    if let Some((mask, span)) = &mask {
        if mask.len() != expected.len() {
            fields.never(*span, "the mask needs as many bytes as are expected");
            return None;
        }
        if expected.iter().zip(mask).any(|(byte, mask)| byte & !mask != 0) {
            fields.never(field.value_span, "it expects bits that the mask leaves out");
        }
    }
    Some(Identity {
        register: *register,
        expected,
        mask: mask.map(|one| one.0).unwrap_or_default(),
    })
}

impl Fields<'_> {
    fn never(&mut self, at: Span, why: &str) {
        let message = format!("this identity can never match: {why}");
        self.say(e0229_wrong_driver::wrong_driver(at, &message));
    }
}

fn calibration(fields: &mut Fields<'_>) -> Vec<(u16, u16)> {
    let pair = |value: &Value| {
        let [register, count] = value.list()? else { return None };
        let register = u16::try_from(plain_integer(&register.value)?).ok()?;
        let count = u16::try_from(plain_integer(&count.value)?).ok()?;
        (1..=255).contains(&count).then_some((register, count))
    };
    let takes = "a list of registers and counts such as [[0x88, 24], [0xA1, 1]]";
    fields.list("calibration", takes, pair)
}

/// Reads whole numbers; resistances are in ohms.
fn parameters(fields: &mut Fields<'_>) -> Vec<i32> {
    let one = |value: &Value| {
        let base = value.number()?.in_base_units().round();
        #[expect(clippy::cast_possible_truncation, reason = "compared with the range just before")]
        (base.abs() <= f64::from(i32::MAX)).then_some(base as i32)
    };
    fields.list("parameters", "a list of numbers such as [3950, 10 kOhm, 10 kOhm]", one)
}
