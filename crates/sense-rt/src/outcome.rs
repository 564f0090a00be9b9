//! What a reading, a message or a transfer came to, and why.

/// What came of one attempt to get a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Not due, not ready, not measured: the last value remains valid.
    Nothing,
    /// A new value; a transfer that went through.
    Fresh,
    /// The device answered with something that is not a measurement.
    Invalid,
    /// Its answer was damaged on the way: the device's own checksum does not fit.
    WrongCrc,
    /// Nobody has its address, or a byte was refused.
    NotAcknowledged,
    /// A misplaced start or stop, an overrun, a DMA's failure, no such transfer.
    BusError,
    /// Somebody else drove the bus.
    ArbitrationLost,
    /// It did not end in time, or the bus hangs.
    TimedOut,
    /// Another device answers.
    WrongIdentity,
}

impl Outcome {
    /// How many there are.
    pub const COUNT: usize = 9;
}

/// Where values go: the index of the item in the schema, what its reading came to, and its bytes.
/// These are empty unless it is fresh, and may be changed (a filter does).
pub type Sink<'a> = dyn FnMut(usize, Outcome, &mut [u8]) + 'a;
