//! What a simulation runs with: its arguments, the board's job and the terminal in, diagnostics in their place out.

use std::cell::RefCell;

use anyhow::Result;
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};
use sensedsl_job::BoardJob;
use sensedsl_report::junit::{Case, Failure};

use crate::cli::SimulateArgs;
use crate::files::shown;
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
    /// The description of all boards, for a record.
    pub(super) schema_json: Option<String>,
    /// What was said of the run so far.
    pub(super) said: RefCell<Vec<Diagnostic>>,
    /// What was checked so far, for `--junit`.
    pub(super) cases: RefCell<Vec<Case>>,
}

impl Simulation<'_> {
    pub(super) fn say(&self, why: Diagnostic) -> Result<()> {
        self.terminal.diagnostics(std::slice::from_ref(&why), self.sources)?;
        self.said.borrow_mut().push(why);
        Ok(())
    }

    /// Notes that something was checked: what it is, and the code and the words of what is wrong with it.
    pub(super) fn case(&self, name: &str, failure: Option<(&str, String)>) {
        let failure = failure.map(|(code, message)| Failure {
            code: code.to_owned(),
            message,
            text: String::new(),
        });
        let name = name.to_owned();
        let case = Case { name, file: self.file(), failure, output: String::new() };
        self.cases.borrow_mut().push(case);
    }

    /// The design, as it is shown.
    pub(super) fn file(&self) -> String {
        shown(&self.args.file)
    }
}
