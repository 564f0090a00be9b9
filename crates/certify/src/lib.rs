//! Certificates: an answer with data from which a small program of its own (crate `proof`) sees
//! that the wiring is valid and that none is better, or that there is none.
//!
//! A short proof is found anew, knowing the answer: a case distinction whose leaves are tolls that
//! every device pays for what it uses. Where none is short, the solver searches once more with the
//! answer as its limit and records how it splits, and by which prices it narrows and closes. Crate
//! `proof` says why both bound the objective. `docs/proofs.md` describes the text.

mod ascent;
mod case;
mod labels;
mod model;
mod search;
mod swaps;
mod tree;
mod write;

use sensedsl_solve::problem::{DeviceId, Problem};
use sensedsl_solve::{Answer, Cancel, Objective};

pub use labels::{AlternativeLabels, Labels, distinct};
pub use model::holders;
pub use sensedsl_proof::subject::sha256;

use case::Weighed;
use model::Model;
use tree::{Effort, GivenUp};
use write::{Proof, Writer};

/// Tolls that may be looked up for one certificate: some ten seconds.
const WORK_MAX: u64 = 1_000_000_000;
/// Tolls that may be looked up for one that a person can read: some hundredths of a second.
const WORK_SHORT: u64 = 3_000_000;

/// What the problem was made of, for whoever has to tell its certificate from others. Each text
/// has its SHA-256.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Subject {
    /// The program with its version.
    pub tool: String,
    /// The options of the call that change the problem.
    pub options: Vec<(String, String)>,
    /// The files that were read, by the names that the design gives them.
    pub files: Vec<(String, String)>,
    /// What is built in, by the arguments with which the program prints it.
    pub built_in: Vec<(String, String)>,
}

/// What a certificate is to prove.
#[derive(Clone, Copy, Debug)]
pub enum Claim<'a> {
    /// This answer is valid and none is better.
    Best(&'a Answer),
    /// There is no answer: these devices alone have none.
    NoWiring(&'a [DeviceId]),
}

/// Why there is no certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Uncertified {
    /// None was found within the effort.
    GivenUp,
    /// The caller's stop came before one was found.
    Stopped,
    /// The costs are too large to be weighed.
    TooLarge,
    /// The verifier does not believe it, for this reason.
    Refuted(String),
}

/// The certificate of a claim that the solver has proved by its own search. It has been read again
/// and verified.
///
/// The numbers of the claim and the labels must be those of the problem.
///
/// # Errors
/// [`Uncertified`]; this says nothing about the claim.
pub fn certify(
    problem: &Problem,
    labels: &Labels,
    subject: &Subject,
    claim: Claim<'_>,
    cancel: Cancel<'_>,
) -> Result<String, Uncertified> {
    of_case(problem, labels, claim, &|problem, labels, answer| {
        Case { problem, labels, subject, answer, cancel }.certify()
    })
}

/// As [`certify`], by the record of the search alone, however short another proof were.
///
/// # Errors
/// [`Uncertified`]; this says nothing about the claim.
pub fn certify_by_record(
    problem: &Problem,
    labels: &Labels,
    subject: &Subject,
    claim: Claim<'_>,
    cancel: Cancel<'_>,
) -> Result<String, Uncertified> {
    of_case(problem, labels, claim, &|problem, labels, answer| {
        Case { problem, labels, subject, answer, cancel }.by_record()
    })
}

type Certificate = Result<String, Uncertified>;

/// Leaves out the devices that a claim is not about.
fn of_case(
    problem: &Problem,
    labels: &Labels,
    claim: Claim<'_>,
    certify: &dyn Fn(&Problem, &Labels, Option<&Answer>) -> Certificate,
) -> Certificate {
    match claim {
        Claim::Best(answer) => certify(problem, labels, Some(answer)),
        Claim::NoWiring(devices) => {
            let devices: Vec<usize> = devices.iter().map(|device| device.0 as usize).collect();
            let mut part = problem.clone();
            part.devices = labels::pick(&problem.devices, &devices);
            certify(&part, &labels.with_devices(&devices), None)
        }
    }
}

/// A claim about all devices of a problem.
struct Case<'a> {
    problem: &'a Problem,
    labels: &'a Labels,
    subject: &'a Subject,
    answer: Option<&'a Answer>,
    cancel: Cancel<'a>,
}

impl Case<'_> {
    /// Short proofs first, which a person can read; then the record of the search; where that is not
    /// enough, longer proofs.
    fn certify(&self) -> Certificate {
        match self.by_tolls(WORK_SHORT) {
            Err(Uncertified::GivenUp | Uncertified::TooLarge) => {}
            done => return done,
        }
        match self.by_record() {
            Err(Uncertified::GivenUp | Uncertified::Refuted(_)) => self.by_tolls(WORK_MAX),
            done => done,
        }
    }

    /// Proofs that are looked for anew, for so many tolls.
    fn by_tolls(&self, work: u64) -> Certificate {
        let Self { problem, labels, subject, answer, cancel } = *self;
        let tasks = match answer {
            Some(answer) => tasks(&answer.objective).ok_or(Uncertified::TooLarge)?,
            None => {
                vec![Task { of: "existence", weights: Objective::default(), limit: 0, most: 1 }]
            }
        };
        let writer = Writer { problem, labels };
        let proofs = prove(&writer, &tasks, &mut Effort { work, cancel })?;
        let text = writer.certificate(subject, answer, &proofs, None);
        believed(&text, cancel).map(|()| text)
    }

    /// The record of the solver's own search.
    fn by_record(&self) -> Certificate {
        let Self { problem, labels, subject, answer, cancel } = *self;
        let unknown = if cancel.is_over() { Uncertified::Stopped } else { Uncertified::GivenUp };
        let search = self.recorded().ok_or(unknown)?;
        let text = Writer { problem, labels }.certificate(subject, answer, &[], Some(&search));
        believed(&text, cancel).map(|()| text)
    }

    /// The record of the search; none where it holds more than the format has.
    fn recorded(&self) -> Option<String> {
        let Self { problem, labels, answer, cancel, .. } = *self;
        let best = answer.map(|answer| answer.objective);
        let equal = sensedsl_solve::equal_boards(problem).ok()?;
        let swaps = equal.iter().enumerate().all(|(board, first)| {
            board == *first || swaps::Swap::of_boards(problem, (*first, board)).is_some()
        });
        let record = sensedsl_solve::record(problem, best, swaps, cancel).ok()??;
        search::Text::of(problem, &search::Places::new(problem, labels), &record)
    }
}

/// What is handed out has been verified.
fn believed(text: &str, cancel: Cancel<'_>) -> Result<(), Uncertified> {
    if sensedsl_proof::budget::fits(text).is_err() {
        return Err(Uncertified::GivenUp);
    }
    if cancel.is_over() {
        return Err(Uncertified::Stopped);
    }
    let certificate = sensedsl_proof::read(text).map_err(|error| Uncertified::Refuted(error.0))?;
    match sensedsl_proof::verify(&certificate) {
        Ok(_) => Ok(()),
        Err(refuted) if refuted.0 == sensedsl_proof::budget::TOO_LONG => Err(Uncertified::GivenUp),
        Err(refuted) => Err(Uncertified::Refuted(refuted.0)),
    }
}

/// The texts of the proofs.
fn prove(
    writer: &Writer<'_>,
    tasks: &[Task],
    effort: &mut Effort<'_>,
) -> Result<Vec<String>, Uncertified> {
    let model = Model::new(writer.problem, writer.labels);
    let mut proofs = Vec::new();
    for Task { of, weights, limit, most } in tasks {
        let weighed = Weighed::new(writer.problem, &model, *weights);
        let nodes = tree::prove(&weighed, (*limit, *most as f64), effort);
        let nodes =
            nodes.map_err(
                |GivenUp { stopped }| {
                    if stopped { Uncertified::Stopped } else { Uncertified::GivenUp }
                },
            )?;
        proofs.push(writer.proof(&Proof { of, weighed: &weighed, nodes }));
    }
    Ok(proofs)
}

/// A proof to be found.
struct Task {
    of: &'static str,
    weights: Objective,
    /// All wirings are to weigh more.
    limit: i64,
    /// What can be shown at most.
    most: i64,
}

/// For each part that is not 0 a proof that no wiring is lower in it while the parts before are
/// equal. These weigh just so much that nothing is won by giving one up.
fn tasks(objective: &Objective) -> Option<Vec<Task>> {
    const NAMES: [&str; 5] = ["moved", "violated", "shared", "cost", "spares"];
    let Objective { moved, violated, shared, cost, spares } = *objective;
    let parts = [moved, violated, shared, cost, spares];
    let mut tasks = Vec::new();
    for (place, of) in NAMES.into_iter().enumerate() {
        if parts.get(place) == Some(&0) {
            continue;
        }
        let mut weights = [0_u32; 5];
        // What the parts from here on weigh together.
        let mut together = 0_u32;
        for (at, (weight, part)) in weights.iter_mut().zip(parts).enumerate().take(place + 1).rev()
        {
            *weight = if at == place { 1 } else { together };
            together = together.checked_add(weight.checked_mul(part)?)?;
        }
        let [moved, violated, shared, cost, spares] = weights;
        let weights = Objective { moved, violated, shared, cost, spares };
        let most = i64::from(together);
        tasks.push(Task { of, weights, limit: most - 1, most });
    }
    // Sums of weights times the scale of a leaf stay below 63 bits.
    tasks.iter().all(|task| task.most < 1 << 31).then_some(tasks)
}
