//! The outcome of a reading, a message or a transfer.

/// The outcome of one attempt to get a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Not due, not ready, not measured: the last value remains valid.
    Nothing,
    /// A new value, or a transfer that succeeded.
    Fresh,
    /// The device answered with something that is not a measurement.
    Invalid,
    /// The answer was damaged on the way: the device's own checksum is wrong.
    WrongCrc,
    /// No device has the address, or a byte was refused.
    NotAcknowledged,
    /// A misplaced start or stop, an overrun, a DMA failure, or an impossible transfer.
    BusError,
    /// Another master took the bus.
    ArbitrationLost,
    /// A time-out, or the bus hangs.
    TimedOut,
    /// Another device answered.
    WrongIdentity,
}

impl Outcome {
    /// The number of outcomes.
    pub const COUNT: usize = 9;
}

/// The receiver of values: the index of the item in the schema, the outcome of its reading, and its
/// bytes. These are empty unless it is fresh, and may be changed in place (a filter does).
pub type Sink<'a> = dyn FnMut(usize, Outcome, &mut [u8]) + 'a;
