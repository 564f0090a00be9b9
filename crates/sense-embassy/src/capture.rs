//! Edges and pulses that were captured, and pulses that make parts measure.

use core::cell::Cell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::{Duration, Timer, block_for};
use sense_rt::{Captured, Train};

/// An output that a pulse can be made with.
pub trait Pin {
    /// Sets its level.
    fn set(&mut self, is_high: bool);
}

/// What an interrupt or a task has captured, for the reporter to read; it is a `static`.
pub type SharedCapture = Mutex<CriticalSectionRawMutex, Cell<Captured>>;

/// Nothing was captured yet.
#[must_use]
pub const fn new_capture() -> SharedCapture {
    Mutex::new(Cell::new(Captured::NEW))
}

/// What was captured of a pulse train, for the reporter to read; it is a `static`.
pub type SharedTrain = Mutex<CriticalSectionRawMutex, Cell<Train>>;

/// Nothing was captured yet.
#[must_use]
pub const fn new_train() -> SharedTrain {
    Mutex::new(Cell::new(Train::NEW))
}

/// A shorter pulse is not worth a wait of the tasks.
const SHORT_US: u32 = 100;

/// Makes a pulse of at least that length.
pub async fn pulse(pin: &mut impl Pin, length_us: u32) {
    let length = Duration::from_micros(length_us.into());
    pin.set(true);
    if length_us < SHORT_US {
        block_for(length);
    } else {
        Timer::after(length).await;
    }
    pin.set(false);
}

/// Changes what was captured, in an interrupt or a task.
pub fn note(seen: &SharedCapture, change: impl FnOnce(&mut Captured)) {
    seen.lock(|cell| {
        let mut captured = cell.get();
        change(&mut captured);
        cell.set(captured);
    });
}
