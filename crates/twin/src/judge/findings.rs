//! What can be wrong with a board, and the findings about one of its devices.
//!
//! In: disagreements, as each part of the judge notices them. Out: their number, and the worst. All parts of the judge
//! use these, and the spans of time that they are measured in.

pub(super) const MS: u64 = 1_000_000;
pub(super) const SECOND: u64 = 1_000 * MS;

/// A disagreement between a board and its world.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// The time at which it was noticed.
    pub at_ns: u64,
    /// The kind of disagreement.
    pub finding: Finding,
    /// How far it is off, in tolerances.
    pub off: f64,
}

/// The kinds of disagreement, with values in the device's own unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// A value is not in the range that the world had.
    Value {
        /// The element of the value.
        element: usize,
        /// The range, from and to, in which it should have been.
        expected: (f64, f64),
        /// The reported value.
        got: f64,
    },
    /// Nothing came for this many seconds.
    Silence(f64),
    /// Reports come too fast or too slowly. The times are nanoseconds between two of them, on average.
    Pace {
        /// The range, from and to, in which it should have been.
        expected_ns: (u64, u64),
        /// The measured time.
        got_ns: u64,
    },
    /// A count is reported too late. The times are nanoseconds after its change, on average.
    Late {
        /// The longest delay allowed.
        most_ns: u64,
        /// The measured delay.
        got_ns: u64,
    },
    /// A contact changed for a little longer than its debounce time, several times, and none of the changes was
    /// reported.
    Unseen {
        /// The number of changes.
        count: u64,
        /// The debounce time.
        lasting_ns: u64,
    },
    /// A count that has not changed is reported again too early: after this many nanoseconds.
    Again(u64),
    /// A value that is `invalid` was reported.
    Invalid(f64),
    /// A value was reported that differs from the one before it by less than `change`.
    Unchanged {
        /// The value.
        got: f64,
        /// The one before it.
        before: f64,
    },
    /// The board reports a fault of the device although nothing in the world is wrong with it.
    Health(String),
    /// The board treats the part on its bus in the wrong way.
    Transfer(String),
}

/// The findings about a device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceFindings {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub quantity: String,
    /// The number of values that were compared.
    pub reports: u64,
    /// The number of values during and right after a fault that concerns the device; they are not compared.
    pub excused: u64,
    /// The number of wrong values and of silences.
    pub wrong: u64,
    /// The worst finding.
    pub worst: Option<Disagreement>,
    /// The greatest age of a value.
    pub age_ns: u64,
    /// The average time from one report to the next; `None` if too few came.
    pub every_ns: Option<u64>,
}

impl DeviceFindings {
    pub(super) fn new(name: String, quantity: Option<String>) -> Self {
        Self { name, quantity: quantity.unwrap_or_default(), ..Self::default() }
    }

    /// Counts a finding, and keeps the worst.
    pub(super) fn note(&mut self, wrong: Option<Disagreement>) {
        let Some(wrong) = wrong else { return };
        self.wrong += 1;
        if self.worst.as_ref().is_none_or(|worst| worst.off < wrong.off) {
            self.worst = Some(wrong);
        }
    }
}
