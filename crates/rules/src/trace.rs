//! Signals as they were sampled.

/// The samples of one signal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signal {
    /// Time in nanoseconds and value, in the order of time. Of two at one time the later one counts.
    pub samples: Vec<(u64, f64)>,
}

/// All signals of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// By the numbers that terms name.
    pub signals: Vec<Signal>,
    /// The end of the run, in nanoseconds.
    pub end_ns: u64,
}
