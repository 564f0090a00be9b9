//! The board that is simulated: its job in this program, or an image of firmware on an emulated MCU.

use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::{Bench, Unasked};
use sensedsl_twin::commands::outputs::Outputs;
use sensedsl_twin::soft::SoftBoard;

/// What a board does, whatever it is.
pub(super) trait Board {
    /// Goes on to a time.
    fn run_until(&mut self, until_ns: u64);
    /// The host sends bytes.
    fn link_write(&mut self, bytes: &[u8]);
    /// The host opens its port, or closes it, over a link that can tell.
    fn link_open(&mut self, is_open: bool);
    /// What has arrived at the host since the last call.
    fn link_read(&mut self) -> Vec<u8>;
    /// What the host has set since the last call: the device's place in the schema, and the bytes of its value.
    fn received(&mut self) -> Vec<(usize, Vec<u8>)>;
    /// What comes out of it.
    fn outputs(&self) -> Outputs;
    /// Where and why the firmware does not run any more.
    fn halted(&self) -> Option<(u64, String)>;
    /// What the firmware has done wrong since the last call, told of the file.
    fn wrongs(&mut self, at: Span) -> Vec<Diagnostic>;
    /// What a user wants to hear of since the last call.
    fn news(&mut self) -> Vec<String>;
    /// The parts on buses that it has read without asking who they are.
    fn unasked(&self) -> Vec<Unasked>;
    /// The parts on buses with which it has done something that their drivers do not say, and what.
    fn odd_transfers(&self) -> Vec<(String, String)>;
    /// For how long its processor has worked so far, where that is known.
    fn worked_ns(&self) -> Option<u64>;
    /// Instructions that the firmware has executed, where they are counted.
    fn instructions(&self) -> Option<u64>;
    /// What has come out of the MCU, where it is written down.
    fn log(&self) -> Option<String>;
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

    fn outputs(&self) -> Outputs {
        self.bench().outputs().clone()
    }

    fn halted(&self) -> Option<(u64, String)> {
        None
    }

    fn wrongs(&mut self, _: Span) -> Vec<Diagnostic> {
        Vec::new()
    }

    fn news(&mut self) -> Vec<String> {
        Vec::new()
    }

    fn unasked(&self) -> Vec<Unasked> {
        self.bench().unasked()
    }

    fn odd_transfers(&self) -> Vec<(String, String)> {
        self.bench().odd_transfers()
    }

    fn worked_ns(&self) -> Option<u64> {
        None
    }

    fn instructions(&self) -> Option<u64> {
        None
    }

    fn log(&self) -> Option<String> {
        None
    }
}

/// The board's job in this program.
pub(super) fn soft(job: &BoardJob<'_>, bench: Bench) -> Box<dyn Board> {
    Box::new(SoftBoard::new(job, bench))
}
