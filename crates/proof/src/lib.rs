//! Verifies certificates: that a wiring is valid and no better one exists, or that there is none.
//!
//! A certificate is one JSON text ([`mod@format`]) with the whole problem in names, the answer, and
//! the record of a search. This crate reads nothing else, shares no code with the solver and does
//! not search:
//! 1. `wiring` checks the given wiring against the rules and adds up what it costs;
//! 2. `search` walks through the record's cases, checks that none is left out, and computes from
//!    the stated multipliers a weight; no wiring of the case has a lower one.
//!
//! `budget` bounds how much it reads and how long it takes; `subject` compares files with the
//! sources of the problem.
//!
//! The objective is (moved, violated, shared, cost, spares); the first difference decides.
//!
//! # Example
//!
//! ```
//! use sensedsl_proof::{Verified, read, verify};
//!
//! // Light can be on PA1, which costs 1, or on PA2, which costs 2.
//! let text = r#"{"format": "SenseDSL certificate 4",
//! "subject": {"tool": "example", "options": {}, "files": {}, "built_in": {}},
//! "problem": {"boards": {"B": false}, "pins": {"PA1": 1, "PA2": 2}, "shared": [], "dma": {},
//!   "devices": {"Light": {"ADC1": {"board": "B", "roles": {"in": {
//!     "IN1": {"pin": "PA1", "signal": "IN1"}, "IN2": {"pin": "PA2", "signal": "IN2"}}}}}}},
//! "answer": {"objective": {"moved": 0, "violated": 0, "shared": 0, "cost": 1, "spares": 0},
//!   "wiring": {"Light": {"takes": "ADC1", "wires": {"in": "IN1"}}}, "streams": {}},
//! "search": {"weights": [1000, 200, 40, 1, 1], "facilities": [], "covers": [], "swaps": [],
//!   "steps": [{"closed": {"scale": 1}}]}}"#;
//! let Ok(Verified::Best(best)) = verify(&read(text).unwrap()) else { panic!("it is a proof") };
//! assert_eq!(best.cost, 1);
//!
//! let worse = text.replace(r#"{"in": "IN1"}"#, r#"{"in": "IN2"}"#);
//! let worse = worse.replace(r#""cost": 1"#, r#""cost": 2"#);
//! let refuted = verify(&read(&worse).unwrap()).unwrap_err();
//! assert_eq!(refuted.to_string(), "step 0 does not show what it has to");
//! ```

pub mod budget;
pub mod format;
mod search;
pub mod subject;
mod verdict;
mod wiring;

use budget::Budget;
use format::{Alternative, Certificate, Problem};
use serde::Deserialize;
use std::collections::BTreeMap;
use verdict::ensure;

pub use verdict::{Refuted, Unusable, Verified};

/// Reads a certificate.
///
/// # Errors
/// The reason why the text is not one.
pub fn read(text: &str) -> Result<Certificate, Unusable> {
    /// The part that every version has.
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    budget::fits(text)?;
    let unusable = |error: serde_json::Error| Unusable(error.to_string());
    let Head { format } = serde_json::from_str(text).map_err(unusable)?;
    if format != format::NAME {
        return Err(Unusable(format!("the format is {format:?}, not {:?}", format::NAME)));
    }
    serde_json::from_str(text).map_err(unusable)
}

/// Verifies a certificate.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn verify(certificate: &Certificate) -> Result<Verified, Refuted> {
    let Certificate { format: _, subject: _, problem, answer, search } = certificate;
    named(problem)?;
    let claimed = answer.as_ref().map(|answer| answer.objective);
    if let Some(answer) = answer {
        let actual = wiring::objective(problem, answer)?;
        let claimed = answer.objective;
        ensure(actual == claimed, || format!("the wiring has {actual}, not {claimed}"))?;
    }
    search::check(problem, search, claimed, &mut Budget::new())?;
    Ok(claimed.map_or(Verified::NoWiring, Verified::Best))
}

/// Checks that all boards, pins and peripherals that are named exist.
fn named(problem: &Problem) -> Result<(), Refuted> {
    for pin in &problem.shared {
        known(&problem.pins, "pin", pin)?;
    }
    for Alternative { board, dma, roles, .. } in problem.devices.values().flat_map(|d| d.values()) {
        known(&problem.boards, "board", board)?;
        for user in dma {
            known(&problem.dma, "dma", user)?;
        }
        for candidate in roles.values().flat_map(|role| role.values()) {
            known(&problem.pins, "pin", &candidate.pin)?;
        }
    }
    Ok(())
}

/// Checks that there is a thing with that name.
fn known<T>(things: &BTreeMap<String, T>, kind: &str, name: &str) -> Result<(), Refuted> {
    ensure(things.contains_key(name), || format!("there is no {kind} {name:?}"))
}
