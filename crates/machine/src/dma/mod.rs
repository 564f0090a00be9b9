//! The DMA controllers, with a file for each version of the block.
//!
//! In: writes to a controller's registers, and the items that `transfer.rs` has moved. Out: the next item of each
//! stream, and the streams that hold their interrupts. The manuals call the streams of some versions channels; here
//! they all are streams, numbered as the manual does. Moving takes no time.

mod v1;
mod v2;

/// The direction of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    FromPeripheral,
    ToPeripheral,
    Memory,
}

/// One end of a transfer: the address of the next item there, and its size in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct End {
    pub address: u32,
    pub bytes: u32,
}

/// The next item that a stream moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Item {
    pub direction: Direction,
    pub peripheral: End,
    pub memory: End,
    /// The number of items left, with this one.
    pub left: u32,
    /// The number of the requests that the stream serves; 0 where streams have only one set of them.
    pub channel: u32,
}

/// A DMA controller.
pub(crate) trait Dma: Send {
    fn read(&self, offset: u32) -> u32;
    fn write(&mut self, offset: u32, value: u32, mask: u32);
    /// Whether a register only clears flags: a write to it is harmless while the clock is off.
    fn clears_flags(&self, offset: u32) -> bool;
    /// The streams that are enabled, one bit each.
    fn enabled(&self) -> u32;
    /// The streams that hold their interrupts, one bit each.
    fn held(&self) -> u32;
    /// The next item of a stream.
    fn item(&self, stream: usize) -> Item;
    /// Counts an item that was moved.
    fn count(&mut self, stream: usize);
    /// Sets the channel of a stream, where a multiplexer does.
    fn select(&mut self, _stream: usize, _channel: u32) {}
    /// Stops a stream because there is nothing at an address.
    fn fail(&mut self, stream: usize);
}

/// One more than the highest number of a stream, in any version.
pub(crate) const STREAMS: usize = 9;

/// A controller in its state after a reset.
pub(crate) fn new(block: &str) -> Box<dyn Dma> {
    match block {
        "bdma_v1" => Box::<v1::Controller>::default(),
        _ => Box::<v2::Controller>::default(),
    }
}
