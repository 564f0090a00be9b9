//! Inputs with a memory: their edges interrupt, or the reporter looks at them in each cycle.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_time::Instant;
use sense_rt::{Contact, ContactConfig, ContactTold, Scalar, store_count};

use crate::hal::gpio::Input;

/// Microseconds, which wrap.
fn now_us() -> u32 {
    Instant::now().as_micros() as u32
}

/// A pin that can be looked at.
pub trait Level {
    fn level(&self) -> bool;

    /// Whether an edge of it is what interrupted, which is forgotten by that.
    fn take_edge(&mut self) -> bool {
        true
    }
}

impl Level for Input<'static> {
    fn level(&self) -> bool {
        self.is_high()
    }
}

/// A pin with what was seen of it; it is a `static`.
pub struct Kept<P> {
    config: ContactConfig,
    seen: Mutex<CriticalSectionRawMutex, RefCell<Option<(P, Contact)>>>,
}

/// An input that is looked at.
pub type Looked = Kept<Input<'static>>;

impl<P: Level> Kept<P> {
    pub const fn new(config: ContactConfig) -> Self {
        Self { config, seen: Mutex::new(RefCell::new(None)) }
    }

    /// Takes the pin, and looks at it for the first time.
    pub fn begin(&self, pin: P) {
        self.seen.lock(|seen| *seen.borrow_mut() = Some((pin, Contact::NEW)));
        let _ = self.look();
    }

    /// Looks at the pin; returns what was seen so far.
    pub fn look(&self) -> Contact {
        self.seen.lock(|seen| match &mut *seen.borrow_mut() {
            Some((pin, contact)) => {
                contact.look(&self.config, pin.level(), now_us());
                *contact
            }
            None => Contact::NEW,
        })
    }

    /// Looks at a pin whose edges do not interrupt.
    pub fn sample(&self) {
        self.seen.lock(|seen| {
            if let Some((pin, contact)) = &mut *seen.borrow_mut() {
                contact.sample(&self.config, pin.level(), now_us());
            }
        });
    }

    /// The level that has lasted.
    pub fn level(&self) -> bool {
        self.seen.lock(|seen| seen.borrow().as_ref().is_some_and(|(_, contact)| contact.level()))
    }

    /// Where an edge has interrupted; others may share the interrupt.
    pub fn on_interrupt(&self) {
        self.seen.lock(|seen| {
            let Some((pin, contact)) = &mut *seen.borrow_mut() else { return };
            if pin.take_edge() {
                contact.on_edge(&self.config, pin.level(), now_us());
            }
        });
    }

    /// Looks at the pin: stores its level, or what was counted, as one element; true when it is news.
    pub fn take(&self, told: &mut Told, scalar: Scalar, is_low_active: bool, element: &mut [u8]) -> bool {
        let contact = self.look();
        if scalar == Scalar::Bool {
            let news = told.level.tell(&self.config, &contact);
            told.last = news.unwrap_or(told.last);
            scalar.store(u64::from(told.last != is_low_active), element);
            news.is_some()
        } else {
            let is_news = contact.edges() != told.edges;
            told.edges = contact.edges();
            store_count(scalar, i64::from(told.edges), element);
            is_news
        }
    }
}

/// What was told of an input.
#[derive(Clone, Copy)]
pub struct Told {
    level: ContactTold,
    last: bool,
    edges: u32,
}

impl Told {
    /// Nothing.
    pub const NEW: Self = Self { level: ContactTold::NEW, last: false, edges: 0 };
}
