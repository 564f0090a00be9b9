//! A controller's block in; the device that it is to the host, and the names that it reads and sets, out.

use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0209_wrong_value, e0211_out_of_range, e0630_step_too_long,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use crate::design::protocol::{Coding, Filter};
use crate::design::{
    BoardIndex, Bounds, Connection, ConnectionIndex, Device, Part, Placement, Presentation,
};
use crate::driver::known::Known;
use crate::fields::{Fields, name_or_text};
use crate::kind::{Kind, KindName};
use crate::part::block::{Next, ReadPart};
use crate::rule;
use crate::spanned::{Spanned, named, span};
use crate::value::written::shown_us;
use crate::value::{Dimension, Evaluator, Measure, Value};

/// The properties of a controller.
pub(crate) const PROPERTIES: &[&str] = &["reads", "sets", "prio", "takes", "host", "id", "label"];
/// Whether the host may set what the code sets.
pub(crate) const HOST: [(&str, bool); 2] = [("refused", false), ("override", true)];
/// The longest cycle: a minute.
const EVERY_MAX_MS: u32 = 60_000;
/// What a cycle may be, for messages.
const EVERY: &str = "1 ms to 60 s, in whole milliseconds";

/// A controller whose devices are names yet.
#[derive(Clone, Debug)]
pub(crate) struct Unbound {
    pub(crate) every_ms: u32,
    pub(crate) every_span: Span,
    pub(crate) reads: Vec<Spanned<String>>,
    pub(crate) sets: Vec<Spanned<String>>,
    pub(crate) takes_us: Option<u32>,
    pub(crate) host_overrides: bool,
}

/// Reads the controller `node` of `file`; none when too little of it is understood. A controller without an identifier
/// has 0 until all are known.
pub(crate) fn read(
    (file, next): (FileId, Next),
    node: &ast::Controller,
    board: Option<BoardIndex>,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ReadPart> {
    let name = named(file, &node.name()?);
    let every = every(file, node, (known, diagnostics));
    let (_, allows) =
        rule::of_device(file, node.rules(), node.range(), (known.constants, diagnostics));
    let owner = format!("the controller `{}`", name.value);
    let reported = (known.constants, &mut *diagnostics);
    let mut fields = Fields::new(node.properties(), file, &owner, name.span, reported);
    let own = Own::read(&mut fields);
    leftovers(&mut fields);
    let every = every?;
    if let Some(takes) = own.takes_us
        && u64::from(takes.value) >= u64::from(every.value) * 1_000
    {
        let (takes, at) = (shown_us(takes.value), takes.span);
        let every_shown = shown_us(every.value.saturating_mul(1_000));
        let report = e0630_step_too_long::step_too_long;
        diagnostics.push(report(at, &name.value, &takes, &every_shown, every.span));
    }
    let unbound = Unbound {
        every_ms: every.value,
        every_span: every.span,
        reads: own.reads,
        sets: own.sets,
        takes_us: own.takes_us.map(|takes| takes.value),
        host_overrides: own.host_overrides,
    };
    let device = Seen { name: &name, id: own.id, label: own.label, prio: own.prio, every };
    let block = span(file, node.range());
    let (devices, connections) = device.seen(next, block, board);
    let part = Part {
        name,
        block,
        board,
        driver: None,
        allows,
        chip: None,
        bounds: Bounds::default(),
        module: None,
    };
    Some(ReadPart { part, devices, connections, controller: Some(unbound) })
}

/// The properties of a controller.
struct Own {
    id: Option<Spanned<u8>>,
    label: Option<String>,
    prio: i8,
    reads: Vec<Spanned<String>>,
    sets: Vec<Spanned<String>>,
    takes_us: Option<Spanned<u32>>,
    host_overrides: bool,
}

impl Own {
    fn read(fields: &mut Fields<'_>) -> Self {
        let id = fields.integer("id", 1..=254);
        let prio = fields.integer("prio", -60..=60).and_then(|n| i8::try_from(n.value).ok());
        let host = fields.word("host", &HOST);
        Self {
            id: id.and_then(|id| {
                Some(Spanned { value: u8::try_from(id.value).ok()?, span: id.span })
            }),
            label: fields.text("label").map(|text| text.value),
            prio: prio.unwrap_or(0),
            reads: devices(fields, "reads"),
            sets: devices(fields, "sets"),
            takes_us: fields.time_us("takes", 1..=60_000_000),
            host_overrides: host.is_some_and(|host| host.value),
        }
    }
}

/// The names of devices in a property: a list, or one of them.
fn devices(fields: &mut Fields<'_>, name: &str) -> Vec<Spanned<String>> {
    let Some(field) = fields.take(name) else { return Vec::new() };
    let takes = format!("a list of devices such as `{name} = [Left, Right];`");
    let one = |value: &Value, span: Span| Some(Spanned { value: name_or_text(value)?, span });
    let found: Option<Vec<_>> = match field.value.list() {
        Some(list) => list.iter().map(|item| one(&item.value, item.span)).collect(),
        None => one(&field.value, field.value_span).map(|one| vec![one]),
    };
    if found.is_none() {
        fields.wrong(&field, &takes);
    }
    found.unwrap_or_default()
}

/// The time after `every`.
fn every(
    file: FileId,
    node: &ast::Controller,
    (known, diagnostics): (Known<'_>, &mut Vec<Diagnostic>),
) -> Option<Spanned<u32>> {
    let written = node.every()?;
    let at = span(file, written.range());
    let value = Evaluator::new(file, known.constants, diagnostics).value(&written);
    let number = match &value {
        Value::Unknown => return None,
        Value::Number(number) => *number,
        Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Range(_) => {
            diagnostics.push(e0209_wrong_value::wrong_value(
                at,
                "every",
                "a time such as 5 ms",
                "no number",
            ));
            return None;
        }
    };
    let ms = match number.measure {
        Measure::Bare => number.value,
        _ if number.dimension() == Dimension::TIME => number.in_base_units() * 1e3,
        Measure::Unit(_) | Measure::Derived(_) | Measure::Raw => {
            let found = format!("{} {}", number.value, number.unit_name());
            diagnostics.push(e0209_wrong_value::wrong_value(
                at,
                "every",
                "a time such as 5 ms",
                &found,
            ));
            return None;
        }
    };
    let whole =
        (ms.round() - ms).abs() < 1e-6 && (1.0..=f64::from(EVERY_MAX_MS)).contains(&ms.round());
    if !whole {
        let found = format!("{ms} ms");
        diagnostics.push(e0211_out_of_range::out_of_range(at, "every", &found, EVERY));
        return None;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, and in the range"
    )]
    Some(Spanned { value: ms.round() as u32, span: at })
}

/// A controller as the host sees it: a sensor that counts its steps that were late or too long.
struct Seen<'a> {
    name: &'a Spanned<String>,
    id: Option<Spanned<u8>>,
    label: Option<String>,
    prio: i8,
    every: Spanned<u32>,
}

impl Seen<'_> {
    fn seen(
        self,
        next: Next,
        block: Span,
        board: Option<BoardIndex>,
    ) -> (Vec<Device>, Vec<Connection>) {
        let (kind, direction) = (Kind::plain(KindName::Code, 0), Direction::Sensor);
        let connection = Connection {
            part: next.part,
            name: None,
            element: None,
            device: next.device,
            kind: kind.clone(),
            direction,
            board,
            placement: Placement::default(),
            wishes: Vec::new(),
            level: None,
        };
        let (value, coding) = (ValueType::scalar(ScalarType::Uint32), Coding::default());
        let device = Device {
            part: next.part,
            name: self.name.clone(),
            block,
            id: self.id.unwrap_or(Spanned { value: 0, span: self.name.span }),
            direction,
            value: Spanned { value, span: self.name.span },
            kind,
            kind_span: self.name.span,
            delay_ms: self.every.value,
            // These are not properties that could be left out.
            delay_span: None,
            prio: self.prio,
            prio_span: None,
            group: None,
            shown: Presentation { label: self.label, ..Presentation::default() },
            coding,
            filter: Filter::default(),
            connections: vec![ConnectionIndex(next.connection.0)],
        };
        (vec![device], vec![connection])
    }
}

/// Reports properties that no controller has.
fn leftovers(fields: &mut Fields<'_>) {
    const OTHER_WORDS: &[(&str, &str)] = &[
        ("inputs", "reads"),
        ("outputs", "sets"),
        ("priority", "prio"),
        ("read", "reads"),
        ("set", "sets"),
        ("uses", "reads"),
        ("wcet", "takes"),
        ("writes", "sets"),
    ];
    for field in fields.rest() {
        let other = OTHER_WORDS.iter().find(|(word, _)| *word == field.name);
        let meant = other.map(|(_, meant)| *meant);
        let meant = meant.or_else(|| nearest(&field.name, PROPERTIES.iter().copied()));
        let report = e0201_unknown_property::unknown_property;
        fields.say(report(field.name_span, &field.name, "a controller", meant));
    }
}
