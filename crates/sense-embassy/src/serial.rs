//! Serial devices: bytes of a port's interrupt become messages, and messages go out.

use core::sync::atomic::{AtomicBool, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use embassy_time::{Duration, Instant, Timer, with_deadline};
use sense_rt::{Bits, Compose, InitStep, MessageStart, MessageStream, Outcome, Schema, Sink};

use crate::devices::Report;
use crate::now_ms;

/// A device that says nothing for so long may have lost its supply, and its settings with it.
const FORGOTTEN_MS: u32 = 5_000;

/// What comes from a device and waits; it is a `static`.
pub struct RxQueue<const BYTES: usize> {
    bytes: Pipe<CriticalSectionRawMutex, BYTES>,
    has_fault: AtomicBool,
}

impl<const BYTES: usize> RxQueue<BYTES> {
    /// Empty.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        Self { bytes: Pipe::new(), has_fault: AtomicBool::new(false) }
    }

    /// In the port's interrupt: a character has come, if it was not lost, and whether all is well. `mask` has the bits
    /// that are data.
    pub fn take(&self, byte: Option<u8>, is_whole: bool, mask: u8) {
        let is_taken = byte.is_none_or(|byte| self.bytes.try_write(&[byte & mask]).is_ok());
        if !is_whole || !is_taken {
            self.has_fault.store(true, Ordering::Relaxed);
        }
    }

    /// Forgets what waits.
    pub(crate) fn clear(&self) {
        self.bytes.clear();
    }

    /// Waits for bytes.
    pub(crate) async fn read(&self, bytes: &mut [u8]) -> usize {
        self.bytes.read(bytes).await
    }

    /// Whether characters were damaged, or not taken in time, since the last call.
    fn take_fault(&self) -> bool {
        // Not a swap, which small cores lack: a fault between the two is one with the one before.
        let has_fault = self.has_fault.load(Ordering::Relaxed);
        self.has_fault.store(false, Ordering::Relaxed);
        has_fault
    }
}

/// A serial device that is heard.
pub struct Device<'a, const BYTES: usize> {
    queue: &'static RxQueue<BYTES>,
    stream: &'a mut MessageStream,
    gap_ms: u32,
    items: &'static [usize],
    /// The gap was found already.
    is_silent: bool,
    /// When something came last, in milliseconds that wrap.
    received_ms: u32,
}

impl<'a, const BYTES: usize> Device<'a, BYTES> {
    /// `queue`: where its port puts what comes. `gap_ms`: the line is silent for so long between two
    /// messages that nothing else tells apart; 0 for others. `items`: the items in its messages.
    pub fn new(
        queue: &'static RxQueue<BYTES>,
        stream: &'a mut MessageStream,
        gap_ms: u32,
        items: &'static [usize],
    ) -> Self {
        Self { queue, stream, gap_ms, items, is_silent: false, received_ms: now_ms() }
    }

    /// One cycle, up to `until`. Reports the first value of each item, because that is when it is
    /// due; for all items a fault if characters were damaged or lost since the last cycle.
    pub async fn cycle(&mut self, until: Instant, mut sink: impl FnMut(usize, Outcome, &mut [u8])) {
        if self.queue.take_fault() {
            self.items.iter().for_each(|index| sink(*index, Outcome::BusError, &mut []));
        }
        let mut reported = Bits::NONE;
        let mut first = |index: usize, outcome, value: &mut [u8]| {
            if outcome == Outcome::Fresh {
                if reported.has(index) {
                    return;
                }
                reported.set(index);
            }
            sink(index, outcome, value);
        };
        self.receive(until, &mut first).await;
    }

    /// Takes what comes up to then.
    async fn receive(&mut self, until: Instant, sink: &mut Sink<'_>) {
        while Instant::now() < until {
            let gap = Instant::now() + Duration::from_millis(self.gap_ms.into());
            let is_gap = self.gap_ms > 0 && gap <= until;
            let mut bytes = [0; 16];
            let end = if is_gap { gap } else { until };
            match with_deadline(end, self.queue.bytes.read(&mut bytes)).await {
                Ok(size) => {
                    self.received_ms = now_ms();
                    self.is_silent = false;
                    self.stream.feed(bytes.get(..size).unwrap_or_default(), sink);
                }
                Err(_) if is_gap && !self.is_silent => {
                    self.stream.gap();
                    self.is_silent = true;
                }
                Err(_) => {}
            }
        }
    }

    /// Whether the device has been silent for so long that it may have to be set up again.
    pub fn is_forgotten(&mut self, cycle_ms: u32) -> bool {
        let is_forgotten = now_ms().wrapping_sub(self.received_ms) >= FORGOTTEN_MS + cycle_ms;
        if is_forgotten {
            self.received_ms = now_ms();
        }
        is_forgotten
    }
}

/// What is to be sent to a device; it is a `static`.
pub type TxQueue<const BYTES: usize> = Pipe<CriticalSectionRawMutex, BYTES>;

/// Queues what is due of the steps that start a device.
pub async fn set_up<const BYTES: usize>(
    queue: &TxQueue<BYTES>,
    start: &mut MessageStart,
    init: &'static [InitStep],
) {
    while let Some(step) = start.next(init, now_ms()) {
        queue.write_all(step.bytes).await;
    }
}

/// Queues a message with a value of the host's, whole or not at all. `message` is room for it.
pub fn send<const BYTES: usize>(
    queue: &TxQueue<BYTES>,
    how: &Compose,
    schema: &Schema,
    index: usize,
    value: &[u8],
    message: &mut [u8],
    board: &dyn Report,
) {
    let size = schema.items.get(index).map_or(0, |item| how.write(item, value, message));
    let message = message.get(..size).unwrap_or_default();
    if size == 0 || queue.free_capacity() < size || !crate::queue(queue, message) {
        board.report(None, index, Outcome::BusError, &mut []);
    }
}

/// Sends what is queued, for ever: a character in the time that it takes. `put` waits for room in the port.
pub async fn transmit<const BYTES: usize>(
    mut put: impl FnMut(&[u8]),
    queue: &'static TxQueue<BYTES>,
    baud: u32,
) -> ! {
    // Twelve bits are the longest character.
    let character = Duration::from_micros(u64::from(12_000_000 / baud.max(1)) + 1);
    // The port is waited for, so at a fast one several go into a tenth of a millisecond.
    let together = (baud as usize / 120_000).clamp(1, 16);
    loop {
        let mut bytes = [0; 16];
        let room = bytes.get_mut(..together).unwrap_or_default();
        let size = queue.read(room).await;
        put(bytes.get(..size).unwrap_or_default());
        Timer::after(character).await;
    }
}
