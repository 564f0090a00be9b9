//! How far inputs came: counted here, told by the fuzzer at its end.

use std::sync::atomic::{AtomicU64, Ordering};

/// The stages of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// An input was run.
    Run,
    /// It resolved to a design.
    Resolved,
    /// It was put to the solver.
    Solved,
    /// There was a wiring.
    Wired,
    /// `project` was called.
    Generate,
    /// Files came out.
    Files,
    /// A certificate was verified.
    Certified,
}

const NAMES: [&str; 7] =
    ["run", "well-formed", "asked the solver", "wired", "reached generate", "files", "certified"];

static COUNTS: [AtomicU64; 7] = [const { AtomicU64::new(0) }; 7];

/// Counts an input that came to a stage.
pub fn count(stage: Stage) {
    COUNTS[stage as usize].fetch_add(1, Ordering::Relaxed);
}

/// Of a hundred inputs, how many came to a stage.
#[must_use]
pub fn percent(stage: Stage) -> u64 {
    let of = |stage: Stage| COUNTS[stage as usize].load(Ordering::Relaxed);
    of(stage) * 100 / of(Stage::Run).max(1)
}

/// One line on all of them; none where nothing was counted.
#[must_use]
pub fn report() -> Option<String> {
    let counts = COUNTS.each_ref().map(|count| count.load(Ordering::Relaxed));
    let run = counts[0];
    if run == 0 {
        return None;
    }
    let part = |(name, count): (&str, u64)| format!("{name} {count}");
    let parts: Vec<String> = NAMES.into_iter().zip(counts).map(part).collect();
    let reached = percent(Stage::Generate);
    Some(format!("{} ({reached} % reach generate)", parts.join(", ")))
}
