//! An image of firmware on an emulated MCU, in the same bench.

use std::sync::{Arc, Mutex, PoisonError};

use sensedsl_codegen::job::BoardJob;
use sensedsl_model::design::Transport;
use sensedsl_twin::bench::{Bench, number_of, seconds};
use sensedsl_twin::machine::{Event, LinkPort, Machine, Settings};

use super::board::Board;

/// The crystal of the boards that have this MCU.
const CRYSTAL_HZ: u64 = 8_000_000;
/// Garbage comes a byte a millisecond.
const MS_NS: u64 = 1_000_000;

/// The MCU with what is around it.
pub(super) struct Emulated {
    machine: Machine,
    bench: Arc<Mutex<Bench>>,
    garbage: Vec<u8>,
    garbage_ms: u64,
}

impl Emulated {
    /// Puts an image into the MCU's flash.
    ///
    /// # Errors
    /// Why it is not for this MCU.
    pub(super) fn new(job: &BoardJob<'_>, bench: Bench, image: &[u8]) -> Result<Self, String> {
        let unit = job.link.as_ref().and_then(|link| number_of(link.unit));
        let link = match (job.board.link.transport, unit) {
            (Transport::Uart, Some(unit)) => LinkPort::Serial(unit),
            (_, _) => LinkPort::Usb,
        };
        let bench = Arc::new(Mutex::new(bench));
        let mut machine =
            Machine::new(Settings { crystal_hz: CRYSTAL_HZ, link }, Arc::clone(&bench) as _);
        machine.load(image).map_err(|error| error.to_string())?;
        Ok(Self { machine, bench, garbage: Vec::new(), garbage_ms: 0 })
    }
}

impl Board for Emulated {
    fn run_until(&mut self, until_ns: u64) {
        self.machine.run_until(until_ns);
        let bench = self.bench.lock().unwrap_or_else(PoisonError::into_inner);
        while self.garbage_ms < until_ns / MS_NS {
            self.garbage_ms += 1;
            self.garbage.extend(bench.garbage(self.garbage_ms * MS_NS));
        }
    }

    fn link_write(&mut self, bytes: &[u8]) {
        self.machine.link_write(bytes);
    }

    fn link_read(&mut self) -> Vec<u8> {
        let mut bytes = std::mem::take(&mut self.garbage);
        bytes.extend(self.machine.link_read().into_iter().map(|(_, byte)| byte));
        bytes
    }

    fn received(&mut self) -> Vec<(usize, Vec<u8>)> {
        Vec::new()
    }

    fn halted(&self) -> Option<(u64, String)> {
        self.machine.halt().map(|lockup| (u64::from(lockup.pc), lockup.why))
    }

    fn news(&mut self) -> Vec<String> {
        let told = |event: Event| match event {
            Event::Reset { at_ns, cause } => {
                format!("{:.3} s: the MCU was reset ({cause:?})", seconds(at_ns))
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
        self.machine.events().into_iter().map(told).collect()
    }
}
