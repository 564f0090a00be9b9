//! What a simulation runs with: its arguments, the board's job and the terminal in, diagnostics in their place out.

use anyhow::Result;
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};
use sensedsl_job::BoardJob;

use crate::cli::SimulateArgs;
use crate::terminal::Terminal;

/// The context of the simulation.
pub(super) struct Simulation<'a> {
    pub(super) args: &'a SimulateArgs,
    pub(super) terminal: &'a Terminal,
    pub(super) job: &'a BoardJob<'a>,
    /// The place for diagnostics that concern the whole, and its text.
    pub(super) at: Span,
    pub(super) sources: &'a SourceMap,
    /// The length of the recorded run that is its world.
    pub(super) lasts_ns: Option<u64>,
}

impl Simulation<'_> {
    pub(super) fn say(&self, why: Diagnostic) -> Result<()> {
        Ok(self.terminal.diagnostics(&[why], self.sources)?)
    }
}
