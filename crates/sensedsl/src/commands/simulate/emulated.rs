//! A firmware image on an emulated MCU, as a board of the simulator.

use sensedsl_diagnostics::codes::e0550_pad_not_as_planned::not_as_planned;
use sensedsl_diagnostics::codes::e0553_no_watchdog::no_watchdog;
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_machine::{Event, ResetCause};
use sensedsl_twin::bench::{UncheckedIdentity, seconds};
use sensedsl_twin::commands::outputs::Outputs;
use sensedsl_twin::emulated::EmulatedBoard;

use super::board::{Board, failed};

impl Board for EmulatedBoard {
    fn run_until(&mut self, until_ns: u64) {
        EmulatedBoard::run_until(self, until_ns);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        EmulatedBoard::link_write(self, bytes);
    }

    fn link_open(&mut self, is_open: bool) {
        EmulatedBoard::link_open(self, is_open);
    }

    fn link_read(&mut self) -> Vec<u8> {
        EmulatedBoard::link_read(self)
    }

    fn outputs(&self) -> Outputs {
        EmulatedBoard::outputs(self)
    }

    fn halted(&self) -> Option<(u64, String)> {
        self.halt().map(|lockup| (u64::from(lockup.pc), lockup.why))
    }

    fn unasked(&self) -> Vec<UncheckedIdentity> {
        EmulatedBoard::unasked(self)
    }

    fn odd_transfers(&self) -> Vec<(String, String)> {
        EmulatedBoard::odd_transfers(self)
    }

    fn worked_ns(&self) -> Option<u64> {
        Some(EmulatedBoard::worked_ns(self))
    }

    fn instructions(&self) -> Option<u64> {
        Some(EmulatedBoard::instructions(self))
    }

    fn log(&self) -> Option<String> {
        EmulatedBoard::take_log(self)
    }

    fn wrongs(&mut self, at: Span) -> Vec<Diagnostic> {
        let now = format!("{:.3}", seconds(self.now_ns()));
        let reported = self.mismatches().into_iter();
        let reported = reported
            .map(|one| not_as_planned(at, &one.title, &one.place, &one.expected, &one.found, &now));
        let watchdog = self.unwatched().map(|found| no_watchdog(at, &found, &now));
        let program = self.trouble().map(|one| failed(at, &one));
        reported.chain(watchdog).chain(program).collect()
    }

    fn news(&mut self) -> Vec<String> {
        let reported = |event: Event| match event {
            Event::Reset { at_ns, cause } => {
                let cause = match cause {
                    ResetCause::Power => "the supply is back",
                    ResetCause::Watchdog => "the watchdog was not fed",
                    ResetCause::Software => "the firmware asked for it",
                };
                format!("{:.3} s: the MCU was reset: {cause}", seconds(at_ns))
            }
            Event::ClockOff { at_ns, address, pc } => format!(
                "{:.3} s: the firmware used a peripheral whose clock is off (0x{address:08X}, at 0x{pc:08X})",
                seconds(at_ns)
            ),
            Event::NotModelled { at_ns, address, pc } => format!(
                "{:.3} s: the firmware used what is not emulated (0x{address:08X}, at 0x{pc:08X})",
                seconds(at_ns)
            ),
        };
        self.events().into_iter().map(reported).collect()
    }
}
