//! Verifies certificates: that a wiring is valid and no better one exists, or that there is none.
//!
//! A certificate is one JSON text ([`mod@format`]) with the whole problem in names, the answer, and
//! proofs. This crate reads nothing else, shares no code with the solver and does not search:
//! 1. `wiring` goes through the rules for the one wiring given and adds up what it costs;
//! 2. `tree` walks each proof's case distinction and sees that no case is left out;
//! 3. `leaf` computes, from the tolls that the certificate proposes, a weight below which no
//!    wiring of that case can be.
//!
//! `budget` bounds how much it reads and how many steps it takes; `subject` compares files with what
//! the problem was made of.
//!
//! The objective is (moved, violated, shared, cost, spares), the first difference decides. There is a
//! proof for each part that is not 0: no wiring that equals the claim in the parts before is lower
//! in this one. It gives each part a weight, none to the parts after, and shows that every wiring
//! weighs more than one that were lower by 1 in its part. Any weights do: with unsuitable ones the
//! proof does not come out.

pub mod budget;
pub mod format;
mod leaf;
mod search;
pub mod subject;
mod tree;
mod wiring;

use budget::Budget;
use format::{Alternative, Answer, Certificate, Objective, Part, Problem, Proof};
use serde::Deserialize;
use std::borrow::Borrow;
use std::collections::BTreeMap;
use std::fmt;

/// What a certificate was found to prove.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verified {
    /// The wiring is valid and none is better.
    Best(Objective),
    /// There is no wiring.
    NoWiring,
}

impl fmt::Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Best(objective) => {
                write!(f, "the wiring is valid and none is better: {objective}")
            }
            Self::NoWiring => f.write_str("there is no wiring"),
        }
    }
}

/// Why a text is not a certificate of this format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unusable(pub String);

/// Why a certificate does not prove what it claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refuted(pub String);

impl fmt::Display for Unusable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unusable {}
impl std::error::Error for Refuted {}

/// Reads a certificate.
///
/// # Errors
/// What keeps the text from being one.
pub fn read(text: &str) -> Result<Certificate, Unusable> {
    /// What can be read of any version.
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
    let Certificate { format: _, subject: _, problem, answer, proofs, search } = certificate;
    named(problem)?;
    let mut parts = proofs.iter().enumerate().map(|(at, proof)| (at, proof.of));
    let twice = parts.find(|(at, of)| proofs.iter().take(*at).any(|before| before.of == *of));
    ensure(twice.is_none(), || "two proofs are of one part".into())?;
    let budget = &mut Budget::new();
    if let Some(search) = search {
        ensure(proofs.is_empty(), || "there are proofs beside the search".into())?;
        let claimed = answer.as_ref().map(|answer| answer.objective);
        if let Some(answer) = answer {
            let actual = wiring::objective(problem, answer)?;
            let claimed = answer.objective;
            ensure(actual == claimed, || format!("the wiring has {actual}, not {claimed}"))?;
        }
        search::check(problem, search, claimed, budget)?;
        return Ok(claimed.map_or(Verified::NoWiring, Verified::Best));
    }
    match answer {
        Some(answer) => best(problem, answer, proofs, budget),
        None => no_wiring(problem, proofs, budget),
    }
}

fn best(
    problem: &Problem,
    answer: &Answer,
    proofs: &[Proof],
    budget: &mut Budget,
) -> Result<Verified, Refuted> {
    let claimed = answer.objective;
    let actual = wiring::objective(problem, answer)?;
    ensure(actual == claimed, || format!("the wiring has {actual}, not {claimed}"))?;
    for (place, part) in Part::OF_OBJECTIVE.into_iter().enumerate() {
        let value = claimed.parts().get(place).copied().unwrap_or(0);
        if value == 0 {
            continue; // Nothing is lower than 0.
        }
        let proof = find(proofs, part)?;
        let weights = proof.weights.parts();
        let mut after = weights.iter().skip(place + 1);
        let own = i128::from(weights.get(place).copied().unwrap_or(0));
        ensure(own > 0, || format!("the proof of {part} gives it no weight"))?;
        ensure(after.all(|weight| *weight == 0), || {
            format!("the proof of {part} weighs later parts")
        })?;
        tree::check(problem, proof, proof.weights.weigh(claimed) - own, budget)?;
    }
    Ok(Verified::Best(claimed))
}

/// Without weights every wiring weighs 0: a proof that all weigh more leaves none.
fn no_wiring(
    problem: &Problem,
    proofs: &[Proof],
    budget: &mut Budget,
) -> Result<Verified, Refuted> {
    let proof = find(proofs, Part::Existence)?;
    ensure(proof.weights == Objective::default(), || "a proof of existence has weights".into())?;
    tree::check(problem, proof, 0, budget)?;
    Ok(Verified::NoWiring)
}

fn find(proofs: &[Proof], part: Part) -> Result<&Proof, Refuted> {
    let found = proofs.iter().find(|proof| proof.of == part);
    found.ok_or_else(|| Refuted(format!("there is no proof of `{part}`")))
}

/// Checks that only boards, pins and peripherals are named that are there.
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

/// The thing of that name.
fn known<'m, K: Borrow<str> + Ord, T>(
    things: &'m BTreeMap<K, T>,
    kind: &str,
    name: &str,
) -> Result<&'m T, Refuted> {
    things.get(name).ok_or_else(|| Refuted(format!("there is no {kind} {name:?}")))
}

/// Makes a [`Refuted`] of a condition that does not hold.
fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), Refuted> {
    if holds { Ok(()) } else { Err(Refuted(otherwise())) }
}
