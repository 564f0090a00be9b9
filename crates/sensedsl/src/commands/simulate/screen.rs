//! A board's reports, for people: a table that is refreshed in place, and lines.

use std::collections::BTreeMap;

use sensedsl_host::Scale;
use sensedsl_job::BoardJob;
use sensedsl_model::design::Device;
use sensedsl_twin::truth::{real, scale_of};
use sensedsl_wire::{Direction, Scalar, ScalarType};

use sensedsl_report::columns::table;

/// The most characters shown of a value; arrays can be longer.
const VALUE_CHARS: usize = 40;

/// The latest value of each device.
pub(super) struct Screen {
    rows: Vec<Row>,
    lines: usize,
}

struct Row {
    id: u8,
    name: String,
    quantity: String,
    scale: Scale,
    scalar: ScalarType,
    direction: Direction,
    value: Option<(u64, Vec<Scalar>)>,
    reports: u64,
}

impl Screen {
    pub(super) fn new(job: &BoardJob<'_>) -> Self {
        let rows = job.devices.iter().map(|one| Row::new(one.device)).collect();
        Self { rows, lines: 0 }
    }

    /// Takes a report, or values that the host has set.
    pub(super) fn take(&mut self, now_ns: u64, values: &[(u8, Vec<Scalar>)], direction: Direction) {
        let new: BTreeMap<u8, &Vec<Scalar>> = values.iter().map(|(id, one)| (*id, one)).collect();
        for row in self.rows.iter_mut().filter(|row| row.direction == direction) {
            if let Some(value) = new.get(&row.id) {
                row.value = Some((now_ns, (*value).clone()));
                row.reports += 1;
            }
        }
    }

    /// The table, printed over the previous one.
    pub(super) fn refreshed(&mut self, now_ns: u64) -> String {
        let text = self.table(now_ns);
        let lines: Vec<String> = text.lines().map(|line| format!("{line}\x1b[K\n")).collect();
        let up = if self.lines > 0 { format!("\x1b[{}A", self.lines) } else { String::new() };
        self.lines = lines.len();
        format!("{up}{}", lines.concat())
    }

    /// The table of the latest values.
    pub(super) fn table(&self, now_ns: u64) -> String {
        let rows: Vec<[String; 5]> = self.rows.iter().map(|row| row.cells(now_ns)).collect();
        let heads = ["Device", ">Value", "", ">Age", ">Reports"];
        let head = format!("{:.1} s\n", sensedsl_twin::bench::seconds(now_ns));
        format!("{head}{}", table(heads, &rows))
    }

    /// A report as one line.
    pub(super) fn line(&self, now_ns: u64, values: &[(u8, Vec<Scalar>)]) -> String {
        let shown = values.iter().filter_map(|(id, value)| {
            let sensor = |row: &&Row| row.id == *id && row.direction == Direction::Sensor;
            let row = self.rows.iter().find(sensor)?;
            let quantity = if row.quantity.is_empty() { "" } else { " " };
            Some(format!("{} {}{quantity}{}", row.name, row.shown(value), row.quantity))
        });
        let shown: Vec<String> = shown.collect();
        format!("{:.3} s  {}\n", sensedsl_twin::bench::seconds(now_ns), shown.join("  "))
    }
}

impl Row {
    fn new(device: &Device) -> Self {
        Self {
            id: device.id.value,
            name: device.name.value.clone(),
            quantity: device.shown.quantity.clone().unwrap_or_default(),
            scale: scale_of(&device.shown),
            scalar: device.value.value.scalar,
            direction: device.direction,
            value: None,
            reports: 0,
        }
    }

    fn cells(&self, now_ns: u64) -> [String; 5] {
        let Some((at_ns, value)) = &self.value else {
            let waits = match self.direction {
                Direction::Sensor => "-",
                Direction::Actuator => "not set",
            };
            return [self.name.clone(), waits.into(), String::new(), String::new(), "0".into()];
        };
        let mut shown = self.shown(value);
        if shown.chars().count() > VALUE_CHARS {
            shown = shown.chars().take(VALUE_CHARS - 2).chain([' ', '…']).collect();
        }
        let age = (now_ns - at_ns) / 1_000_000;
        let (name, quantity) = (self.name.clone(), self.quantity.clone());
        [name, shown, quantity, format!("{age} ms"), self.reports.to_string()]
    }

    /// All elements, in the device's own unit.
    fn shown(&self, value: &[Scalar]) -> String {
        let all: Vec<String> = value.iter().map(|one| self.element(*one)).collect();
        all.join(" ")
    }

    fn element(&self, value: Scalar) -> String {
        if let Scalar::Bool(flag) = value {
            return flag.to_string();
        }
        let raw = real(value);
        digits(self.scale.shown(raw), self.scale.shown_step(raw), self.scalar)
    }
}

/// A number with as many digits as its step justifies.
pub(super) fn digits(number: f64, step: f64, scalar: ScalarType) -> String {
    let is_real = matches!(scalar, ScalarType::Float32 | ScalarType::Float64);
    if !is_real && step.fract() == 0.0 && number.fract() == 0.0 {
        return format!("{number}");
    }
    let step = if is_real { number.abs() / 10_000.0 } else { step };
    let digits = [(0.5, 0), (0.05, 1), (0.005, 2), (0.000_5, 3), (0.000_05, 4)];
    let digits = digits.into_iter().find(|(least, _)| step >= *least).map_or(6, |(_, all)| all);
    format!("{number:.digits$}")
}
