//! Where a whole unit is moved to other pins: the block of pins that each has, and the HAL's type for it.

use std::collections::BTreeMap;

use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::UnitName;

use super::context::Context;
use sensedsl_job::BoardJob;

/// The lowest block of each unit that all its pins are in; a unit without blocks is not there.
pub(super) fn blocks(job: &BoardJob<'_>) -> BTreeMap<UnitName, u8> {
    let mut sets: BTreeMap<UnitName, Option<Blocks>> = BTreeMap::new();
    let linked = job.link.iter().map(|link| (Some(link.unit), &link.pads));
    let wired = job.connections.iter().map(|one| (one.unit, &one.pads));
    for (unit, pads) in wired.chain(linked) {
        for usage in pads.iter().filter_map(|pad| pad.usage) {
            let (Some(unit), Some(blocks)) = (unit, usage.blocks) else { continue };
            let known = sets.entry(UnitName::new(unit)).or_insert(Some(blocks));
            *known = known.and_then(|known| known.and(blocks));
        }
    }
    sets.into_iter().filter_map(|(unit, set)| Some((unit, set?.first()))).collect()
}

impl Context<'_> {
    /// What stands between a constructor of `unit` and its arguments: nothing, or where units move the type of the
    /// block behind the constructor's `others`: `::<_, _, hal::gpio::AfioRemap<1>>`.
    pub(super) fn generics(&self, unit: &str, others: &[&str]) -> String {
        let block = self.blocks.get(&UnitName::new(unit)).copied().unwrap_or(0);
        let moved = self.names.remap(unit, block);
        let is_plain = others.iter().all(|one| *one == "_");
        let all: Vec<&str> = others.iter().copied().chain(moved.as_deref()).collect();
        if moved.is_none() && is_plain { String::new() } else { format!("::<{}>", all.join(", ")) }
    }
}
