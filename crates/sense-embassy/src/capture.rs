//! Edges and pulses that were captured, and pulses that make parts measure.

use core::cell::Cell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::{Duration, Timer, block_for};
use sense_rt::{Captured, Train, TrainConfig};

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

/// The edges that count.
#[derive(Clone, Copy)]
pub enum Edges {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Both of them.
    Both,
}

/// An input whose edges have times.
#[allow(async_fn_in_trait, reason = "tasks of firmware are on one core")]
pub trait Timed {
    /// The time of the next edge in ticks, which wraps, and the level after it.
    async fn edge(&mut self) -> (u32, bool);
}

/// Measures the widths of pulses and, of those that begin with an edge that was seen, their periods, for ever.
/// `is_high`: the level of a pulse. A pulse that ended before its beginning was looked at is left out.
pub async fn pulses(mut timer: impl Timed, is_high: bool, seen: &SharedCapture) -> ! {
    // When the last pulse began, and whether it is under way.
    let (mut began, mut is_open) = (None, false);
    loop {
        let (now, level) = timer.edge().await;
        match (level == is_high, began) {
            (true, before) => {
                let is_whole = !is_open;
                if let (true, Some(before)) = (is_whole, before) {
                    note(seen, |captured| captured.on_period(now.wrapping_sub(before)));
                }
                (began, is_open) = (Some(now), true);
            }
            (false, Some(begin)) if is_open => {
                note(seen, |captured| captured.on_width(now.wrapping_sub(begin), false));
                is_open = false;
            }
            // Two edges were one: it is not known when the pulse began.
            (false, _) => (began, is_open) = (None, false),
        }
    }
}

/// Measures the periods between edges of one direction, for ever.
pub async fn periods(mut timer: impl Timed, seen: &SharedCapture) -> ! {
    let (mut last, _) = timer.edge().await;
    loop {
        let (now, _) = timer.edge().await;
        note(seen, |captured| captured.on_period(now.wrapping_sub(last)));
        last = now;
    }
}

/// Measures the intervals of a pulse train, for ever.
pub async fn train(mut timer: impl Timed, config: &TrainConfig, seen: &SharedTrain) -> ! {
    let (mut last, _) = timer.edge().await;
    loop {
        let (now, _) = timer.edge().await;
        seen.lock(|cell| {
            let mut train = cell.get();
            train.on_interval(config, now.wrapping_sub(last));
            cell.set(train);
        });
        last = now;
    }
}
