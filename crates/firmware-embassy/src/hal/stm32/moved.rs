//! Units that move to other pins as a whole: the block of pins that each one has, and the HAL's type for it.

use std::collections::BTreeMap;

use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::UnitName;
use sensedsl_job::BoardJob;

use super::settings::{Remap, Settings};
use crate::context::Context;
use crate::names::numbered;

/// The lowest block of each unit that has all its pins. Units that do not move are left out.
fn blocks(job: &BoardJob<'_>) -> BTreeMap<UnitName, u8> {
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

impl Settings {
    /// The type of a unit's block of pins; `None` if every pin has a choice of its own.
    pub(super) fn block_type(&self, context: &Context<'_>, unit: &str) -> Option<String> {
        if !self.file.afio {
            return None;
        }
        let block = blocks(context.job).get(&UnitName::new(unit)).copied().unwrap_or(0);
        Some(match self.remap(numbered(unit)) {
            Some(Remap::Number) => format!("hal::gpio::AfioRemap<{block}>"),
            Some(Remap::Switch) => format!("hal::gpio::AfioRemapBool<{}>", block > 0),
            None => "hal::gpio::AfioRemapNotApplicable".to_owned(),
        })
    }

    /// The type arguments between a constructor of `unit` and its arguments: the constructor's `others`, and the type
    /// of the block where units move: `::<_, _, hal::gpio::AfioRemap<1>>`. Nothing if the compiler finds them out.
    pub(super) fn generics(&self, context: &Context<'_>, unit: &str, others: &[&str]) -> String {
        let moved = self.block_type(context, unit);
        let is_plain = others.iter().all(|one| *one == "_");
        let all: Vec<&str> = others.iter().copied().chain(moved.as_deref()).collect();
        if moved.is_none() && is_plain { String::new() } else { format!("::<{}>", all.join(", ")) }
    }
}
