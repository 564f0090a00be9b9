//! Bytes between the reporter, which never waits, and a port or an endpoint, which does.

use core::sync::atomic::{AtomicBool, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use sense_rt::Channel;

use crate::queue;

/// Bytes from the host that wait.
const RX_BYTES: usize = 256;

/// The two queues of a link; they are a `static`.
pub struct Link<const TX_BYTES: usize> {
    /// To the host.
    pub tx: Pipe<CriticalSectionRawMutex, TX_BYTES>,
    /// From the host.
    pub rx: Pipe<CriticalSectionRawMutex, RX_BYTES>,
    /// A host has the port open.
    pub is_open: AtomicBool,
    /// Bytes have left the queue and not the chip.
    pub is_sending: AtomicBool,
}

impl<const TX_BYTES: usize> Link<TX_BYTES> {
    /// Empty, and nobody listens.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        Self {
            tx: Pipe::new(),
            rx: Pipe::new(),
            is_open: AtomicBool::new(false),
            is_sending: AtomicBool::new(false),
        }
    }
}

/// The reporter's end.
pub struct Near<const TX_BYTES: usize>(pub &'static Link<TX_BYTES>);

impl<const TX_BYTES: usize> Channel for Near<TX_BYTES> {
    fn is_open(&mut self) -> bool {
        self.0.is_open.load(Ordering::Relaxed)
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        self.0.rx.try_read(bytes).unwrap_or(0)
    }

    fn room(&mut self) -> usize {
        self.0.tx.free_capacity()
    }

    fn is_empty(&mut self) -> bool {
        self.0.tx.is_empty() && !self.0.is_sending.load(Ordering::Relaxed)
    }

    fn write(&mut self, bytes: &[u8]) -> usize {
        if queue(&self.0.tx, bytes) { bytes.len() } else { 0 }
    }
}
