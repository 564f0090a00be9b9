//! The streams: results go to the standard output, messages to the standard error.

use std::io::{self, IsTerminal as _, Write as _};

use anstream::{AutoStream, ColorChoice};
use sensedsl_diagnostics::{Diagnostic, Severity, SourceMap, render, visible, visible_lines};

use crate::files::Refused;

/// The most diagnostics that are shown at once. People start with the first ones, and a file that is not in the
/// language at all has thousands.
const SHOWN_MAX: usize = 100;

/// The width of a progress bar in characters.
const BAR_WIDTH: usize = 40;

/// The two streams, and how much is printed.
pub(crate) struct Terminal {
    quiet: bool,
    verbose: bool,
}

impl Terminal {
    pub(crate) fn new(quiet: bool, verbose: bool) -> Self {
        Self { quiet, verbose }
    }

    /// Whether tables may be coloured.
    pub(crate) fn colour(&self) -> bool {
        AutoStream::choice(&io::stdout()) != ColorChoice::Never && io::stdout().is_terminal()
    }

    /// Whether only errors and the result are wanted.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Whether more output than usual is wanted.
    pub(crate) fn verbose(&self) -> bool {
        self.verbose
    }

    /// Prints the result.
    pub(crate) fn result(&self, text: &str) -> io::Result<()> {
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes())?;
        out.flush()
    }

    /// Whether people see the result as it is written.
    pub(crate) fn is_watched(&self) -> bool {
        !self.quiet && io::stdout().is_terminal()
    }

    /// Whether the terminal has pages to draw on, as far as it says.
    pub(crate) fn has_pages(&self) -> bool {
        std::env::var_os("TERM").is_none_or(|name| name != "dumb")
    }

    /// Whether the terminal has letters for bars and dots: the consoles of Linux have few beyond those of Latin.
    pub(crate) fn has_shapes(&self) -> bool {
        std::env::var_os("TERM").is_none_or(|name| name != "linux")
    }

    /// Prints a line before the whole result is known.
    pub(crate) fn passing(&self, line: &str) -> io::Result<()> {
        let mut out = io::stdout().lock();
        writeln!(out, "{}", visible(line))?;
        out.flush()
    }

    /// Prints a result that only people read: dropped when quiet.
    pub(crate) fn note(&self, text: &str) -> io::Result<()> {
        self.coloured_note(&visible_lines(text))
    }

    /// Prints a note with our own colours; texts of others in it have been made visible already.
    pub(crate) fn coloured_note(&self, text: &str) -> io::Result<()> {
        if self.quiet { Ok(()) } else { self.result(text) }
    }

    /// Prints a line about the result, which goes with the messages: dropped when quiet.
    pub(crate) fn aside(&self, line: &str) -> io::Result<()> {
        if self.quiet { Ok(()) } else { writeln!(io::stderr().lock(), "{}", visible(line)) }
    }

    /// Shows the progress of a long task if people can see it; removed when it is done.
    pub(crate) fn progress(&self, what: &str, done: usize, total: usize) {
        if self.quiet || !io::stderr().is_terminal() {
            return;
        }
        let text = if done >= total {
            "\r\x1b[K".to_owned()
        } else {
            let filled = "#".repeat(BAR_WIDTH * done / total);
            format!("\r[{filled:.<BAR_WIDTH$}] {done} of {total} {what}")
        };
        // There is nowhere to report a failure to report.
        let _ = io::stderr().lock().write_all(text.as_bytes());
    }

    /// Prints diagnostics for people; hints and warnings are dropped when quiet.
    pub(crate) fn diagnostics(
        &self,
        diagnostics: &[Diagnostic],
        sources: &SourceMap,
    ) -> io::Result<()> {
        let wanted =
            diagnostics.iter().filter(|one| !self.quiet || one.severity == Severity::Error);
        let all = wanted.clone().count();
        let is_error = |one: &&Diagnostic| one.severity == Severity::Error;
        // An error after many warnings is the reason why the command fails: it must be among those shown.
        let mut room = SHOWN_MAX.saturating_sub(wanted.clone().filter(is_error).count());
        let fits = |one: &&Diagnostic| {
            let others = room;
            room = room.saturating_sub(usize::from(!is_error(one)));
            is_error(one) || others > 0
        };
        let shown: Vec<Diagnostic> = wanted.filter(fits).take(SHOWN_MAX).cloned().collect();
        let coloured = AutoStream::choice(&io::stderr()) != ColorChoice::Never;
        let mut text = render::human(&shown, sources, coloured);
        if all > shown.len() {
            let more = all - shown.len();
            text.push_str(&format!("and {more} more (`check --format json` has them all)\n"));
        }
        io::stderr().lock().write_all(text.as_bytes())
    }

    /// Reports that a file from the command line was not read.
    pub(crate) fn refusal(&self, refused: &Refused) {
        // There is nowhere to report a failure to report.
        let _ = self.diagnostics(std::slice::from_ref(&*refused.diagnostic), &refused.sources);
    }

    /// Reports that the call or the machine is wrong.
    pub(crate) fn failure(&self, error: &anyhow::Error) {
        // There is nowhere to report a failure to report.
        let _ = writeln!(io::stderr().lock(), "error: {}", visible(&format!("{error:#}")));
    }
}

/// Whether the reader of our output has gone (`sensedsl … | head`), which is not a failure.
pub(crate) fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
