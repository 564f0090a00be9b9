//! The bytes between a board and its host: what waits on either side, and what is on the line.

use std::collections::VecDeque;

use sense_rt::Channel;

/// The bytes that a link accepts at once.
pub(super) const QUEUE_BYTES: usize = 16_384;

/// The bytes between board and host.
#[derive(Default)]
pub(super) struct Link {
    pub(super) inbox: VecDeque<u8>,
    pub(super) queue: VecDeque<u8>,
    pub(super) sent: VecDeque<u8>,
    /// The thousandths of a byte that the line may still carry.
    pub(super) credit: u64,
    /// Whether the host has closed its port, on a link that can tell.
    pub(super) is_closed: bool,
}

impl Channel for Link {
    fn is_open(&mut self) -> bool {
        !self.is_closed
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        let count = bytes.len().min(self.inbox.len());
        for (place, byte) in bytes.iter_mut().zip(self.inbox.drain(..count)) {
            *place = byte;
        }
        count
    }

    fn room(&mut self) -> usize {
        QUEUE_BYTES - self.queue.len().min(QUEUE_BYTES)
    }

    fn is_empty(&mut self) -> bool {
        self.queue.is_empty()
    }

    fn write(&mut self, bytes: &[u8]) -> usize {
        self.queue.extend(bytes);
        bytes.len()
    }
}
