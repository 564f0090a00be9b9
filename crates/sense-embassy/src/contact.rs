//! Contacts: inputs that are debounced and counted. Their edges interrupt, or the reporter samples them in each cycle.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::Instant;
use embedded_hal_async::digital::Wait;
use sense_rt::{Contact, ContactConfig, ContactReport, Scalar, store_count};

/// Microseconds, which wrap.
fn now_us() -> u32 {
    Instant::now().as_micros() as u32
}

/// A pin whose level can be read.
pub trait Level {
    /// Whether it is high.
    fn level(&self) -> bool;

    /// Whether an edge of this pin caused the interrupt. The call clears its flag.
    fn take_edge(&mut self) -> bool {
        true
    }
}

/// A pin and the state of its contact; it is a `static`.
pub struct Watched<P> {
    config: ContactConfig,
    seen: Mutex<CriticalSectionRawMutex, RefCell<Option<(P, Contact)>>>,
}

impl<P: Level> Watched<P> {
    /// Without a pin yet; [`Self::begin`] takes it.
    pub const fn new(config: ContactConfig) -> Self {
        Self { config, seen: Mutex::new(RefCell::new(None)) }
    }

    /// Takes the pin and reads it for the first time.
    pub fn begin(&self, pin: P) {
        self.seen.lock(|seen| *seen.borrow_mut() = Some((pin, Contact::NEW)));
        let _ = self.look();
    }

    /// Reads the pin; returns the contact so far.
    pub fn look(&self) -> Contact {
        self.seen.lock(|seen| match &mut *seen.borrow_mut() {
            Some((pin, contact)) => {
                contact.look(&self.config, pin.level(), now_us());
                *contact
            }
            None => Contact::NEW,
        })
    }

    /// Reads a pin whose edges do not interrupt.
    pub fn sample(&self) {
        self.seen.lock(|seen| {
            if let Some((pin, contact)) = &mut *seen.borrow_mut() {
                contact.sample(&self.config, pin.level(), now_us());
            }
        });
    }

    /// The debounced level.
    pub fn level(&self) -> bool {
        self.seen.lock(|seen| seen.borrow().as_ref().is_some_and(|(_, contact)| contact.level()))
    }

    /// Handles an interrupt that several pins may share.
    pub fn on_interrupt(&self) {
        self.seen.lock(|seen| {
            let Some((pin, contact)) = &mut *seen.borrow_mut() else { return };
            if pin.take_edge() {
                contact.on_edge(&self.config, pin.level(), now_us());
            }
        });
    }

    /// Reads the pin and stores its level, or its count, as one element; true if it has changed since `reported`.
    pub fn take(
        &self,
        reported: &mut Reported,
        scalar: Scalar,
        is_low_active: bool,
        element: &mut [u8],
    ) -> bool {
        let contact = self.look();
        if scalar == Scalar::Bool {
            let news = reported.level.record(&self.config, &contact);
            reported.last = news.unwrap_or(reported.last);
            scalar.store(u64::from(reported.last != is_low_active), element);
            news.is_some()
        } else {
            let is_news = contact.edges() != reported.edges;
            reported.edges = contact.edges();
            store_count(scalar, i64::from(reported.edges), element);
            is_news
        }
    }
}

/// The edges that count.
#[derive(Clone, Copy)]
pub enum Trigger {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Both of them.
    Any,
}

/// Waits for edges of a pin whose interrupt is the HAL's, for ever. Edges between one and the look at it are one with
/// it. No HAL here fails to wait; one that does is asked again.
pub async fn watch<P: Level>(
    mut pin: impl Wait,
    trigger: Trigger,
    contact: &'static Watched<P>,
) -> ! {
    loop {
        let edge = match trigger {
            Trigger::Rising => pin.wait_for_rising_edge().await,
            Trigger::Falling => pin.wait_for_falling_edge().await,
            Trigger::Any => pin.wait_for_any_edge().await,
        };
        if edge.is_ok() {
            contact.on_interrupt();
        }
    }
}

/// What was reported last of an input.
#[derive(Clone, Copy)]
pub struct Reported {
    level: ContactReport,
    last: bool,
    edges: u32,
}

impl Reported {
    /// Nothing was reported yet.
    pub const NEW: Self = Self { level: ContactReport::NEW, last: false, edges: 0 };
}
