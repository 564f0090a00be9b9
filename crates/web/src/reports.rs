//! Reports of a wiring, as the commands print them.

use sensedsl_model::design::Design;
use sensedsl_report::{capacity, diff, human, json as answers, sheet, timing, why};
use sensedsl_timing::timing as timing_of;
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Wiring, capacity as capacity_of};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::request::Request;

/// The reports that need nothing but the wiring.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kind {
    /// `sensedsl solve`.
    Solve,
    /// The page of the wiring for the bench, in HTML.
    Sheet,
    /// `sensedsl capacity`.
    Capacity,
    /// `sensedsl explain timing`.
    Timing,
}

/// A report for people and, where the command has one, for programs.
pub(crate) fn report(of: &Request, kind: Kind) -> Value {
    told(of, |design, wiring| Some(made(kind, design, wiring)))
}

fn made(kind: Kind, design: &Design, wiring: &Assignment) -> (String, Value) {
    match kind {
        Kind::Solve => (human::human(design, wiring, false), answers::wired(design, wiring)),
        Kind::Sheet => (sheet::html::html(design, wiring), Value::Null),
        Kind::Capacity => {
            let found = capacity_of(design, wiring, false, Cancel::NEVER);
            (capacity::human(design, &found), capacity::value(design, &found))
        }
        Kind::Timing => {
            let found = timing_of(design, wiring);
            (timing::human(design, &found), timing::value(design, &found))
        }
    }
}

/// Why a device or a chip is on its pins.
pub(crate) fn why(of: &Request, name: &str) -> Value {
    if let Some(unknown) = unknown(of, name) {
        return unknown;
    }
    told(of, |design, wiring| {
        let connections = why::connections(design, name).ok()?;
        let found = Wiring::new(design, None).why(wiring, &connections);
        let text = why::summary(design, wiring, &found.all, "");
        Some((text, why::value(name, &found)))
    })
}

/// The answer about a device or a chip that the design does not have.
fn unknown(of: &Request, name: &str) -> Option<Value> {
    let snapshot = of.snapshot();
    let why = why::connections(snapshot.design()?, name).err()?;
    Some(json!({ "error": why }))
}

/// Each pin that the wires of a device or a chip could have, with what it would cost.
pub(crate) fn places(of: &Request, name: &str) -> Value {
    if let Some(unknown) = unknown(of, name) {
        return unknown;
    }
    of.of_wiring("places", |design, wiring, _| {
        let connections = why::connections(design, name).ok()?;
        let found = Wiring::new(design, None).why(wiring, &connections);
        Some(why::places(design, wiring, &found.all))
    })
}

/// What changes from an earlier answer to the wiring of this text.
pub(crate) fn changes(of: &Request, old: &Value) -> Value {
    told(of, |design, wiring| {
        let (old, new) = (diff::wires(old)?, diff::wires(&answers::wired(design, wiring))?);
        let changes = diff::changes(&old, &new);
        let text = if changes.is_empty() {
            "nothing changes\n".to_owned()
        } else {
            diff::human(&changes, new.len())
        };
        Some((text, diff::value(&changes)))
    })
}

fn told(of: &Request, made: impl FnOnce(&Design, &Assignment) -> Option<(String, Value)>) -> Value {
    let found = of.of_wiring("report", |design, wiring, _| {
        made(design, wiring).map(|(text, value)| json!([text, value]))
    });
    let [text, value] = [0, 1].map(|at| found.pointer(&format!("/report/{at}")).cloned());
    json!({ "diagnostics": found.get("diagnostics"), "text": text, "value": value })
}
