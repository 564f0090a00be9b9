//! Values as text for programs: a JSON object, or rows of CSV.
//!
//! Numbers are written in full. What is no number (a floating point sensor may send that) is `null` in JSON, and an
//! empty cell in CSV.

use std::fmt::Write as _;
use std::time::Duration;

use sensedsl_host::{Board, Device};
use sensedsl_wire::{Scalar, ScalarType, Stamp};
use serde_json::{Map, Value, json};

/// The first row of the CSV.
pub const CSV_HEAD: &str = "time_s,device,element,raw,value,unit\n";

/// A raw element: whole numbers of any size.
#[must_use]
pub fn raw(scalar: Scalar) -> Value {
    match scalar {
        Scalar::Bool(flag) => flag.into(),
        Scalar::Unsigned(number) => number.into(),
        Scalar::Signed(number) => number.into(),
        // The shortest text that gives the same number: `0.1`, not what it is as a double.
        Scalar::Float32(number) => {
            number.to_string().parse::<f64>().unwrap_or(f64::from(number)).into()
        }
        Scalar::Float64(number) => number.into(),
    }
}

/// A shown element.
#[must_use]
pub fn shown(device: &Device, scalar: Scalar) -> Value {
    if device.value.scalar == ScalarType::Bool { raw(scalar) } else { device.shown(scalar).into() }
}

/// All elements: an array for an array, the one of another device.
#[must_use]
pub fn elements(device: &Device, value: &[Scalar], one: impl Fn(Scalar) -> Value) -> Value {
    let all: Vec<Value> = value.iter().map(|scalar| one(*scalar)).collect();
    match (device.value.length, all.as_slice()) {
        (None, [one]) => one.clone(),
        _ => Value::Array(all),
    }
}

/// A value as an object of `ndjson`.
#[must_use]
pub fn object(
    board: &Board,
    device: &Device,
    run: Duration,
    value: &[Scalar],
    stamp: Option<Stamp>,
) -> Value {
    let mut object = Map::new();
    object.insert("time_s".into(), json!(seconds(run)));
    object.insert("board".into(), json!(board.name));
    object.insert("device".into(), json!(device.name));
    object.insert("raw".into(), elements(device, value, raw));
    object.insert("value".into(), elements(device, value, |one| shown(device, one)));
    object.insert("unit".into(), json!(device.quantity));
    if let Some(Stamp { time_us, counter }) = stamp {
        object.insert("stamp_us".into(), json!(time_us));
        object.insert("counter".into(), json!(counter));
    }
    Value::Object(object)
}

/// Seconds, to the microsecond.
fn seconds(run: Duration) -> f64 {
    (run.as_secs_f64() * 1e6).round() / 1e6
}

/// A value as rows of CSV, one an element. The prefix stands before the device's name.
#[must_use]
pub fn rows(device: &Device, prefix: &str, run: Duration, value: &[Scalar]) -> String {
    let unit = cell(device.quantity.as_deref().unwrap_or_default());
    let mut rows = String::new();
    for (element, one) in value.iter().enumerate() {
        let (time_s, name) = (run.as_secs_f64(), &device.name);
        let (raw, shown) = (number(&raw(*one)), number(&shown(device, *one)));
        let _ = writeln!(rows, "{time_s:.6},{prefix}{name},{element},{raw},{shown},{unit}");
    }
    rows
}

/// A number of JSON as a cell.
pub(crate) fn number(value: &Value) -> String {
    if value.is_null() { String::new() } else { value.to_string() }
}

/// A text as a cell.
pub(crate) fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
