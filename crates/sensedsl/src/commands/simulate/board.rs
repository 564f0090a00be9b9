//! The simulated board: its job in this program, or a firmware image on an emulated MCU.

use sensedsl_diagnostics::codes::{e0536_user_code_stopped, e0573_process_failed};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::{Bench, UncheckedIdentity};
use sensedsl_twin::commands::outputs::Outputs;
use sensedsl_twin::plants::Trouble;
use sensedsl_twin::soft::{SoftBoard, UserCode};

/// A board, however it is simulated.
pub(super) trait Board {
    /// Runs until the given time.
    fn run_until(&mut self, until_ns: u64);
    /// The host sends bytes.
    fn link_write(&mut self, bytes: &[u8]);
    /// The host opens or closes its port, over a link that can tell.
    fn link_open(&mut self, is_open: bool);
    /// The bytes that have arrived at the host since the last call.
    fn link_read(&mut self) -> Vec<u8>;
    /// The values that the host has set since the last call: the device's place in the schema, and the value's bytes.
    fn received(&mut self) -> Vec<(usize, Vec<u8>)> {
        Vec::new()
    }
    /// The outputs of the board.
    fn outputs(&self) -> Outputs;
    /// The address at which the firmware is stuck, and the reason.
    fn halted(&self) -> Option<(u64, String)> {
        None
    }
    /// The firmware's errors since the last call, reported at a place in the file.
    fn wrongs(&mut self, _: Span) -> Vec<Diagnostic> {
        Vec::new()
    }
    /// The events since the last call that matter to a user.
    fn news(&mut self) -> Vec<String> {
        Vec::new()
    }
    /// The parts on buses that the board has read without asking for their identity.
    fn unasked(&self) -> Vec<UncheckedIdentity>;
    /// The parts on buses that the board has treated in a way that their drivers do not describe, each with what
    /// happened.
    fn odd_transfers(&self) -> Vec<(String, String)>;
    /// The time that its processor has worked so far, if it is known.
    fn worked_ns(&self) -> Option<u64> {
        None
    }
    /// The number of instructions that the firmware has executed, if they are counted.
    fn instructions(&self) -> Option<u64> {
        None
    }
    /// The log of everything that has left the MCU, if one is kept.
    fn log(&self) -> Option<String> {
        None
    }
}

/// A program of the world has failed.
pub(super) fn failed(at: Span, trouble: &Trouble) -> Diagnostic {
    let seconds = moment(trouble.at_ns);
    e0573_process_failed::process_failed(at, &trouble.plant, &seconds, &trouble.why)
}

fn moment(ns: u64) -> String {
    format!("{}.{:03} s", ns / 1_000_000_000, ns / 1_000_000 % 1_000)
}

impl Board for SoftBoard {
    fn run_until(&mut self, until_ns: u64) {
        SoftBoard::run_until(self, until_ns);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        SoftBoard::link_write(self, bytes);
    }

    fn link_open(&mut self, is_open: bool) {
        SoftBoard::link_open(self, is_open);
    }

    fn link_read(&mut self) -> Vec<u8> {
        SoftBoard::link_read(self)
    }

    fn received(&mut self) -> Vec<(usize, Vec<u8>)> {
        let all = SoftBoard::received(self).into_iter();
        all.map(|(_, index, value)| (index, value)).collect()
    }

    fn wrongs(&mut self, at: Span) -> Vec<Diagnostic> {
        let report = |(ns, why): (u64, String)| {
            e0536_user_code_stopped::user_code_stopped(at, &moment(ns), &why)
        };
        let code = self.code_ended().map(report);
        code.into_iter().chain(self.bench().trouble().map(|one| failed(at, &one))).collect()
    }

    fn outputs(&self) -> Outputs {
        self.bench().outputs().clone()
    }

    fn unasked(&self) -> Vec<UncheckedIdentity> {
        self.bench().unasked()
    }

    fn odd_transfers(&self) -> Vec<(String, String)> {
        self.bench().odd_transfers()
    }
}

/// The board's job in this program, with the code of its controllers, if there is any.
pub(super) fn soft(
    job: &BoardJob<'_>,
    bench: Bench,
    code: Option<Box<dyn UserCode>>,
) -> Box<dyn Board> {
    let board = SoftBoard::new(job, bench);
    Box::new(match code {
        Some(code) => board.with_code(code),
        None => board,
    })
}
