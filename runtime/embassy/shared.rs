//! The values of all devices and how the devices are, for all tasks.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use sense_rt::{Filter, Health, Outcome, Record, Schema, Store};

use super::now_ms;

struct Known<const VALUES: usize, const ITEMS: usize> {
    store: Store<[u8; VALUES]>,
    health: Health<[Record; ITEMS]>,
}

/// See above; it stands in a `static`.
pub struct Shared<const VALUES: usize, const ITEMS: usize> {
    known: Mutex<CriticalSectionRawMutex, RefCell<Known<VALUES, ITEMS>>>,
}

impl<const VALUES: usize, const ITEMS: usize> Shared<VALUES, ITEMS> {
    pub const fn new(schema: &'static Schema, cycles_ms: &'static [u32]) -> Self {
        let known = Known { store: Store::new(schema), health: Health::new(cycles_ms) };
        Self { known: Mutex::new(RefCell::new(known)) }
    }

    /// Hands the store and the health to a task.
    pub fn with<R>(&self, task: impl FnOnce(&mut Store, &mut Health) -> R) -> R {
        self.known.lock(|known| {
            let mut known = known.borrow_mut();
            let Known { store, health } = &mut *known;
            task(store, health)
        })
    }
}

/// What takes the results of readings, whatever the sizes.
pub trait Tell: Sync {
    /// What a reading came to.
    fn tell(&self, filter: Option<&mut Filter>, index: usize, outcome: Outcome, value: &mut [u8]);
}

impl<const VALUES: usize, const ITEMS: usize> Tell for Shared<VALUES, ITEMS> {
    fn tell(&self, filter: Option<&mut Filter>, index: usize, outcome: Outcome, value: &mut [u8]) {
        self.with(|store, health| store.tell(health, filter, index, outcome, value, now_ms()));
    }
}
