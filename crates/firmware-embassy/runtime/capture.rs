//! Edges and pulses: what was captured of them, and pulses that make parts measure.

use core::cell::Cell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::{Duration, Timer, block_for};
use sense_rt::{Captured, Train};

use crate::hal::gpio::Output;

/// What was captured so far; it stands in a `static`.
pub type Seen = Mutex<CriticalSectionRawMutex, Cell<Captured>>;

pub const fn nothing() -> Seen {
    Mutex::new(Cell::new(Captured::NEW))
}

/// What was seen of a pulse train; it stands in a `static`.
pub type SeenTrain = Mutex<CriticalSectionRawMutex, Cell<Train>>;

pub const fn no_train() -> SeenTrain {
    Mutex::new(Cell::new(Train::NEW))
}

/// A shorter pulse is not worth a wait of the tasks.
const SHORT_US: u32 = 100;

/// A pulse of at least that length.
pub async fn pulse(pin: &mut Output<'static>, length_us: u32) {
    let length = Duration::from_micros(length_us.into());
    pin.set_high();
    if length_us < SHORT_US {
        block_for(length);
    } else {
        Timer::after(length).await;
    }
    pin.set_low();
}

/// Notes what was captured.
pub fn note(seen: &Seen, change: impl FnOnce(&mut Captured)) {
    seen.lock(|cell| {
        let mut captured = cell.get();
        change(&mut captured);
        cell.set(captured);
    });
}
