//! The values and the health of a board's devices, and the time that all parts of it count in.

use std::collections::BTreeMap;

use sense_rt::{Filter, FilterTable, Health, Outcome, Record, Schema, Store};
use sensedsl_job::Cycle;

type Values = Store<[u8; 16_384]>;
type Records = Health<[Record; 256]>;
type AnyFilter = Filter<[u8; 49_152]>;

/// The values and the health of the devices.
pub(super) struct Core {
    pub(super) store: Box<Values>,
    pub(super) health: Box<Records>,
    filters: BTreeMap<usize, Box<AnyFilter>>,
    pub(super) now_ms: u32,
}

impl Core {
    /// Nothing is measured yet. The filters are by the place of their device in the schema.
    pub(super) fn new(
        schema: &'static Schema,
        cycles_ms: &'static [u32],
        filters: &BTreeMap<usize, &'static FilterTable>,
    ) -> Self {
        let filters = filters.iter().map(|(index, table)| (*index, Box::new(Filter::new(table))));
        Self {
            store: Box::new(Store::new(schema)),
            health: Box::new(Health::new(cycles_ms)),
            filters: filters.collect(),
            now_ms: 0,
        }
    }

    /// Takes what a device has measured; its filter may change the value.
    pub(super) fn record(&mut self, index: usize, outcome: Outcome, value: &mut [u8]) {
        let filter = self.filters.get_mut(&index).map(|filter| &mut ***filter);
        self.store.record(&mut self.health, filter, index, outcome, value, self.now_ms);
    }
}

/// Milliseconds as the runtime counts them: they wrap at 32 bits.
pub(super) fn wrapped(ms: u64) -> u32 {
    u32::try_from(ms & u64::from(u32::MAX)).unwrap_or(0)
}

/// Whether a cycle begins in this millisecond.
pub(super) const fn begins(since_ms: u64, cycle: Cycle) -> bool {
    let start = cycle.start_ms as u64;
    let delay = if cycle.delay_ms == 0 { 1 } else { cycle.delay_ms as u64 };
    since_ms >= start && (since_ms - start).is_multiple_of(delay)
}
