//! Certificates: an answer with data from which a small separate program (crate `proof`) verifies
//! that the wiring is valid and that none is better, or that there is none.
//!
//! The solver searches once more with the answer as its limit and records how it splits, and by
//! which prices it narrows and closes. Crate `proof` explains why these bound the objective.
//! `docs/proofs.md` describes the text.
//!
//! # Example
//!
//! ```
//! use sensedsl_certify::{AlternativeLabels, Claim, Labels, Subject, certify};
//! use sensedsl_proof::{read, verify};
//! # use sensedsl_solve::problem::{Board, BoardId, Pin, Problem};
//! # use sensedsl_solve::problem::{Alternative, Candidate, Device, PinId, Role, SignalId};
//! use sensedsl_solve::{Cancel, Options, Outcome, solve_and_learn};
//!
//! # let device = |pins: [u32; 2]| {
//! #     let candidate = |pin| Candidate::new(PinId(pin), SignalId(pin));
//! #     let roles = vec![Role { candidates: pins.map(candidate).to_vec() }];
//! #     let board = BoardId(0);
//! #     let way = Alternative { board, claims: vec![], violates: vec![], dma: vec![], roles };
//! #     Device { alternatives: vec![way] }
//! # };
//! # let problem = Problem {
//! #     boards: vec![Board { spare: false }],
//! #     pins: [1, 2].map(|cost| Pin { board: BoardId(0), cost, shared: false }).to_vec(),
//! #     devices: vec![device([0, 1])],
//! #     ..Problem::default()
//! # };
//! // `problem` has one device, which takes one of two pins.
//! let way = AlternativeLabels { name: "ADC1".into(), roles: vec!["in".into()] };
//! let labels = Labels {
//!     boards: vec!["Rover".into()],
//!     pins: vec!["PA1".into(), "PA2".into()],
//!     devices: vec!["Light".into()],
//!     alternatives: vec![vec![way]],
//!     signals: [(0, "ADC1_IN1".into()), (1, "ADC1_IN2".into())].into(),
//!     ..Labels::default()
//! };
//!
//! let (outcome, learned) = solve_and_learn(&problem, &Options::default()).unwrap();
//! let Outcome::Solved(best) = outcome else { panic!("there is an answer") };
//! let claim = Claim::Best(&best, &learned);
//! let text = certify(&problem, &labels, &Subject::default(), claim, Cancel::NEVER).unwrap();
//! let verified = verify(&read(&text).unwrap()).unwrap();
//! assert!(verified.to_string().starts_with("the wiring is valid and none is better"));
//! ```

mod labels;
mod search;
mod swaps;
mod write;

use sensedsl_solve::problem::{DeviceId, Problem};
use sensedsl_solve::{Answer, Cancel, Experience};

pub use labels::{AlternativeLabels, Labels, distinct};
pub use sensedsl_proof::subject::sha256;
pub use write::holders;

use write::Writer;

/// The sources from which the problem was made, by which its certificate can be told from others.
/// Each text has its SHA-256.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Subject {
    /// The program with its version.
    pub tool: String,
    /// The options of the call that change the problem.
    pub options: Vec<(String, String)>,
    /// The files that were read, by the names that the design gives them.
    pub files: Vec<(String, String)>,
    /// The built-in texts, by the arguments with which the program prints them.
    pub built_in: Vec<(String, String)>,
}

/// The claim that a certificate must prove.
#[derive(Clone, Copy, Debug)]
pub enum Claim<'a> {
    /// This answer is valid and none is better; with the experience of the search that found it.
    Best(&'a Answer, &'a Experience),
    /// There is no answer: these devices alone have none.
    NoWiring(&'a [DeviceId]),
}

/// Why there is no certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Uncertified {
    /// No certificate was found within the effort.
    Incomplete,
    /// The caller stopped the search before one was found.
    Stopped,
    /// The verifier rejects it, for this reason.
    Refuted(String),
}

/// The certificate of a claim that the solver has proved by its own search. It has been read again
/// and verified.
///
/// The numbers of the claim and the labels must be those of the problem.
///
/// # Errors
/// [`Uncertified`], which says nothing about the claim.
pub fn certify(
    problem: &Problem,
    labels: &Labels,
    subject: &Subject,
    claim: Claim<'_>,
    cancel: Cancel<'_>,
) -> Result<String, Uncertified> {
    match claim {
        Claim::Best(answer, learned) => {
            Case { problem, labels, subject, answer: Some(answer), learned, cancel }.certify()
        }
        Claim::NoWiring(devices) => {
            let devices: Vec<usize> = devices.iter().map(|device| device.0 as usize).collect();
            let mut part = problem.clone();
            part.devices = labels::pick(&problem.devices, &devices);
            let labels = &labels.with_devices(&devices);
            let learned = &Experience::default();
            Case { problem: &part, labels, subject, answer: None, learned, cancel }.certify()
        }
    }
}

/// A claim about all devices of a problem.
struct Case<'a> {
    problem: &'a Problem,
    labels: &'a Labels,
    subject: &'a Subject,
    answer: Option<&'a Answer>,
    learned: &'a Experience,
    cancel: Cancel<'a>,
}

impl Case<'_> {
    fn certify(&self) -> Result<String, Uncertified> {
        let Self { problem, labels, subject, answer, cancel, .. } = *self;
        let unknown = if cancel.is_over() { Uncertified::Stopped } else { Uncertified::Incomplete };
        let search = self.recorded().ok_or(unknown)?;
        let text = Writer { problem, labels }.certificate(subject, answer, &search);
        believed(&text, cancel).map(|()| text)
    }

    /// The record of the search; `None` if it holds something that the format cannot hold.
    fn recorded(&self) -> Option<String> {
        let Self { problem, labels, answer, learned, cancel, .. } = *self;
        let best = answer.map(|answer| answer.objective);
        let equal = sensedsl_solve::equal_boards(problem).ok()?;
        let swaps = equal.iter().enumerate().all(|(board, first)| {
            board == *first || swaps::Swap::of_boards(problem, (*first, board)).is_some()
        });
        let record = sensedsl_solve::record(problem, best, swaps, learned, cancel).ok()??;
        search::Text::of(problem, &search::Places::new(problem, labels), &record)
    }
}

/// Verifies a text before it is handed out.
fn believed(text: &str, cancel: Cancel<'_>) -> Result<(), Uncertified> {
    if sensedsl_proof::budget::fits(text).is_err() {
        return Err(Uncertified::Incomplete);
    }
    if cancel.is_over() {
        return Err(Uncertified::Stopped);
    }
    let certificate = sensedsl_proof::read(text).map_err(|error| Uncertified::Refuted(error.0))?;
    match sensedsl_proof::verify(&certificate) {
        Ok(_) => Ok(()),
        Err(refuted) if refuted.0 == sensedsl_proof::budget::TOO_LONG => {
            Err(Uncertified::Incomplete)
        }
        Err(refuted) => Err(Uncertified::Refuted(refuted.0)),
    }
}
