//! The values and the health of all devices, shared by all tasks.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use sense_rt::{Filter, Health, Outcome, Record, Schema, Store};

use crate::now_ms;

struct Known<const VALUES: usize, const ITEMS: usize> {
    store: Store<[u8; VALUES]>,
    health: Health<[Record; ITEMS]>,
    /// How often the host has set each item; 0 for never.
    sets: [u32; ITEMS],
}

/// The values and the health of all devices; it is a `static`.
pub struct Devices<const VALUES: usize, const ITEMS: usize> {
    schema: &'static Schema,
    known: Mutex<CriticalSectionRawMutex, RefCell<Known<VALUES, ITEMS>>>,
}

impl<const VALUES: usize, const ITEMS: usize> Devices<VALUES, ITEMS> {
    /// Without values yet. `cycles_ms`: the cycle of each item; 0 if it comes by itself or is set.
    #[must_use]
    pub const fn new(schema: &'static Schema, cycles_ms: &'static [u32]) -> Self {
        let known =
            Known { store: Store::new(schema), health: Health::new(cycles_ms), sets: [0; ITEMS] };
        Self { schema, known: Mutex::new(RefCell::new(known)) }
    }

    /// Hands the store and the health to a task.
    pub fn with<R>(&self, task: impl FnOnce(&mut Store, &mut Health) -> R) -> R {
        self.known.lock(|known| {
            let mut known = known.borrow_mut();
            let Known { store, health, .. } = &mut *known;
            task(store, health)
        })
    }
}

/// The devices for tasks, independent of the sizes of a design.
pub trait Report: Sync {
    /// Reports the outcome of a reading, through the item's filter if it has one.
    fn report(&self, filter: Option<&mut Filter>, index: usize, outcome: Outcome, value: &mut [u8]);
    /// Stores the value to which the host has set an item.
    fn set(&self, index: usize, value: &[u8]);
    /// Copies the value to which the host has set an item. Returns how often the host has set it; 0 if never.
    fn requested(&self, index: usize, value: &mut [u8]) -> u32;
}

impl<const VALUES: usize, const ITEMS: usize> Report for Devices<VALUES, ITEMS> {
    fn report(
        &self,
        filter: Option<&mut Filter>,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
    ) {
        let now = now_ms();
        let reported = match filter {
            // Filters run outside the lock, which disables interrupts: a port would lose characters
            // during a median of many values.
            Some(filter) => Store::filtered(self.schema, filter, index, outcome, value, now),
            None => outcome,
        };
        self.with(|store, health| {
            store.record_filtered(health, index, (outcome, reported), value, now);
        });
    }

    fn set(&self, index: usize, value: &[u8]) {
        self.known.lock(|known| {
            let mut known = known.borrow_mut();
            let Known { store, health, sets } = &mut *known;
            store.put(index, value);
            health.note(index, Outcome::Fresh, now_ms());
            if let Some(sets) = sets.get_mut(index) {
                *sets = sets.wrapping_add(1).max(1);
            }
        });
    }

    fn requested(&self, index: usize, value: &mut [u8]) -> u32 {
        self.known.lock(|known| {
            let known = known.borrow();
            for (to, from) in value.iter_mut().zip(known.store.get(index).unwrap_or_default()) {
                *to = *from;
            }
            known.sets.get(index).copied().unwrap_or(0)
        })
    }
}
