//! Bytes between the reporter, which never waits, and a port or an endpoint, which does.

use core::sync::atomic::{AtomicBool, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use sense_rt::Channel;

use super::queue;

/// Bytes of a host that wait.
const HEARD: usize = 256;

/// The two queues of a link; they are a `static`.
pub struct Link<const SAID: usize> {
    pub said: Pipe<CriticalSectionRawMutex, SAID>,
    pub heard: Pipe<CriticalSectionRawMutex, HEARD>,
    /// Somebody listens.
    pub is_open: AtomicBool,
    /// Bytes have left the queue and not the chip.
    pub is_sending: AtomicBool,
}

impl<const SAID: usize> Link<SAID> {
    pub const fn new() -> Self {
        Self {
            said: Pipe::new(),
            heard: Pipe::new(),
            is_open: AtomicBool::new(false),
            is_sending: AtomicBool::new(false),
        }
    }
}

/// The reporter's end.
pub struct Near<const SAID: usize>(pub &'static Link<SAID>);

impl<const SAID: usize> Channel for Near<SAID> {
    fn is_open(&mut self) -> bool {
        self.0.is_open.load(Ordering::Relaxed)
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        self.0.heard.try_read(bytes).unwrap_or(0)
    }

    fn room(&mut self) -> usize {
        self.0.said.free_capacity()
    }

    fn is_empty(&mut self) -> bool {
        self.0.said.is_empty() && !self.0.is_sending.load(Ordering::Relaxed)
    }

    fn write(&mut self, bytes: &[u8]) -> bool {
        queue(&self.0.said, bytes)
    }
}
