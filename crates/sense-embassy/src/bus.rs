//! Parts on register buses: the runtime says what is to be sent and read, and a line does it.

use embassy_time::{Duration, Instant, Timer, with_timeout};
use embedded_hal_async::spi::SpiBus;
use sense_rt::{Chip, Outcome, Sink, Step};

use crate::devices::Report;
use crate::now_ms;

/// What a part is reached over: a bus, with whatever chooses the part.
pub trait Line {
    /// Makes one transfer, which takes `timeout` at most.
    #[expect(
        async_fn_in_trait,
        reason = "its tasks run in one executor, so no future is sent anywhere"
    )]
    async fn transfer(&mut self, address: u8, step: Step<'_>, timeout: Duration) -> Outcome;
}

/// A transfer of SPI, between which and others the caller chooses the part.
pub async fn exchange(bus: &mut impl SpiBus, step: Step<'_>, timeout: Duration) -> Outcome {
    let result = with_timeout(timeout, async {
        match step {
            Step::Write(bytes) => bus.write(bytes).await,
            Step::WriteRead(select, bytes) => {
                if !select.is_empty() {
                    bus.write(select).await?;
                }
                bus.read(bytes).await
            }
            Step::Exchange(sent, received) => bus.transfer(received, sent).await,
            Step::Wait(_) => Ok(()),
        }
    })
    .await;
    match result {
        Ok(Ok(())) => Outcome::Fresh,
        Ok(Err(_)) => Outcome::BusError,
        Err(_) => Outcome::TimedOut,
    }
}

/// A command as it was written last: the number of the host's value, and that of the chip's start.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Written {
    sequence: u32,
    starts: u32,
}

impl Written {
    /// Never.
    pub const NEW: Self = Self { sequence: 0, starts: 0 };
}

/// Makes all transfers of a chip that are due; returns how many milliseconds there is nothing to do.
pub async fn serve<L: Line>(
    line: &mut L,
    chip: &mut Chip,
    timeout: Duration,
    sink: &mut Sink<'_>,
) -> u32 {
    let address = chip.table().address;
    let mut has_failed = false;
    loop {
        let outcome = match chip.next(now_ms()) {
            Step::Wait(ms) => {
                // A chip that only takes commands says so of them.
                if has_failed && !chip.is_running() {
                    let fault = chip.fault();
                    chip.table()
                        .commands
                        .iter()
                        .for_each(|command| sink(command.item.into(), fault, &mut []));
                }
                return ms;
            }
            step @ (Step::Write(_) | Step::WriteRead(..) | Step::Exchange(..)) => {
                line.transfer(address, step, timeout).await
            }
        };
        chip.done(outcome, sink);
        has_failed |= !chip.is_running() && chip.fault() != Outcome::Nothing;
    }
}

/// Writes what the host has set since, or what a chip has forgotten. `value` is room for any value.
pub async fn write<L: Line>(
    line: &mut L,
    chip: &mut Chip,
    written: &mut [Written],
    timeout: Duration,
    board: &dyn Report,
    value: &mut [u8],
) {
    let table = chip.table();
    for (command, written) in table.commands.iter().zip(written) {
        if !chip.is_running() {
            return;
        }
        let index = usize::from(command.item);
        let now = Written { sequence: board.requested(index, value), starts: chip.counts().starts };
        if now.sequence == 0 || now == *written {
            continue;
        }
        let outcome = match chip.write(command, value) {
            Ok(step) => {
                let outcome = line.transfer(table.address, step, timeout).await;
                chip.done(outcome, &mut |_, _, _| {});
                outcome
            }
            Err(outcome) => outcome,
        };
        if matches!(outcome, Outcome::Fresh | Outcome::Invalid) {
            *written = now;
        }
        if outcome != Outcome::Fresh {
            board.report(None, index, outcome, &mut []);
        }
    }
}

/// Waits `idle_ms` in the grid of whole milliseconds, so that the time a cycle takes does not delay
/// the next one, and half a millisecond more: the reporter runs at whole milliseconds, and so always
/// finds the values that were read before it.
pub async fn rest(idle_ms: u32) {
    let begin_ms = Instant::now().as_millis() + u64::from(idle_ms.max(1));
    Timer::at(Instant::from_micros(begin_ms * 1_000 + 500)).await;
}
