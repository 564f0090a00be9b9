//! The plan in Python's words.

use sensedsl_job::host::{BoardPlan, HostPlan, MessagePlan, Names, Scaling};
use sensedsl_wire::{Direction, ScalarType};

use crate::names::{literal, names, package};

/// A design.
pub(super) struct DesignView {
    /// The design's name as a literal.
    pub(super) name: String,
    /// The name of the package.
    pub(super) package: String,
    /// The name of the distribution.
    pub(super) distribution: String,
    pub(super) boards: Vec<BoardView>,
}

/// A board.
pub(super) struct BoardView {
    pub(super) ident: String,
    pub(super) name: String,
    pub(super) checksum: &'static str,
    pub(super) stamp: &'static str,
    pub(super) baud: u32,
    pub(super) silence_ms: String,
    pub(super) messages: Vec<MessageView>,
    /// The identifiers in the file's order, which the schema has.
    pub(super) order: String,
}

/// A message.
pub(super) struct MessageView {
    pub(super) ident: String,
    pub(super) doc: String,
    pub(super) value_type: String,
    pub(super) raw_type: String,
    pub(super) item: String,
    pub(super) scaling: String,
    pub(super) unit: String,
    pub(super) min: String,
    pub(super) max: String,
    pub(super) cycle_ms: String,
    pub(super) is_sensor: bool,
    pub(super) id: u8,
    pub(super) table_type: String,
}

impl DesignView {
    pub(super) fn new(plan: &HostPlan) -> Self {
        let mut names = names();
        let boards = plan.boards.iter().map(|board| BoardView::new(board, &mut names)).collect();
        let package = package(&plan.name);
        let distribution = package.replace('_', "-");
        Self { name: literal(&plan.name), package, distribution, boards }
    }

    /// All messages, in the order of the boards.
    pub(super) fn messages(&self) -> impl Iterator<Item = &MessageView> {
        self.boards.iter().flat_map(|board| &board.messages)
    }

    /// The first sensor, for examples.
    pub(super) fn sensor(&self) -> Option<&MessageView> {
        self.messages().find(|message| message.is_sensor)
    }

    /// The first actuator, for examples.
    pub(super) fn actuator(&self) -> Option<&MessageView> {
        self.messages().find(|message| !message.is_sensor)
    }

    /// The first board, for examples.
    pub(super) fn board(&self) -> &str {
        self.boards.first().map_or("Board", |board| &board.ident)
    }
}

impl BoardView {
    fn new(plan: &BoardPlan, names: &mut Names) -> Self {
        let ident = names.take(&plan.name);
        let messages: Vec<MessageView> =
            plan.messages().map(|message| MessageView::new(message, names)).collect();
        let in_order = plan.devices.iter().filter_map(|device| {
            let found = messages.iter().find(|message| {
                message.id == device.id
                    && message.is_sensor == (device.direction == Direction::Sensor)
            })?;
            Some(format!("\n        {}.FACTS.item,", found.ident))
        });
        Self {
            ident,
            name: literal(&plan.name),
            checksum: plan.checksum.name(),
            stamp: boolean(plan.has_stamp),
            baud: plan.baud,
            silence_ms: optional(plan.silence_ms),
            order: in_order.collect(),
            messages,
        }
    }
}

impl MessageView {
    fn new(plan: &MessagePlan, names: &mut Names) -> Self {
        let scalar = plan.value.scalar;
        let raw = match scalar {
            ScalarType::Bool => "bool",
            ScalarType::Float32 | ScalarType::Float64 => "float",
            ScalarType::Uint8
            | ScalarType::Int8
            | ScalarType::Uint16
            | ScalarType::Int16
            | ScalarType::Uint32
            | ScalarType::Int32
            | ScalarType::Uint64
            | ScalarType::Int64 => "int",
        };
        let scaling = plan.scaling.as_ref().filter(|_| scalar != ScalarType::Bool);
        let scaling = scaling.filter(|one| **one != Scaling::default());
        let value = if scaling.is_some() { "float" } else { raw };
        let of = |element: &str| match plan.value.length {
            None => element.to_owned(),
            Some(_) => format!("Tuple[{element}, ...]"),
        };
        let is_sensor = plan.direction == Direction::Sensor;
        let length = plan.value.length.map_or("None".to_owned(), |length| length.to_string());
        let item = format!(
            "Item({}, {}, {}, \"{}\", {length})",
            plan.id,
            literal(&plan.name),
            boolean(is_sensor),
            scalar.name()
        );
        let unit = plan.quantity.as_deref().map_or("None".to_owned(), literal);
        let kind = if is_sensor { "sensor" } else { "actuator" };
        let label = plan.label.as_deref().map_or(String::new(), |label| format!(": {label}"));
        let shown_in = plan.quantity.as_ref().map_or(String::new(), |unit| format!(" in {unit}"));
        Self {
            ident: names.take(&plan.name),
            doc: literal(&format!(
                "The {kind} {}{label}; `value`{shown_in}, `raw` as {}.",
                plan.name, plan.value
            )),
            value_type: of(value),
            raw_type: of(raw),
            item,
            scaling: scaling.map_or("None".to_owned(), scaling_literal),
            unit,
            min: optional_real(plan.limits.min),
            max: optional_real(plan.limits.max),
            cycle_ms: optional(plan.cycle_ms),
            is_sensor,
            id: plan.id,
            table_type: plan.value.to_string(),
        }
    }
}

fn scaling_literal(scaling: &Scaling) -> String {
    let points = scaling.curve.iter().map(|(x, y)| format!("({x:?}, {y:?}), "));
    let curve: String = points.collect();
    format!("Scaling({:?}, {:?}, ({}))", scaling.scale, scaling.offset, curve.trim_end())
}

fn boolean(is_true: bool) -> &'static str {
    if is_true { "True" } else { "False" }
}

fn optional(number: Option<u32>) -> String {
    number.map_or("None".to_owned(), |number| number.to_string())
}

fn optional_real(number: Option<f64>) -> String {
    number.map_or("None".to_owned(), |number| format!("{number:?}"))
}
