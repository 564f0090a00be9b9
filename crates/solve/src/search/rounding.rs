//! A primal heuristic: the values of the linear program in, a wiring near them kept if it is better.

use super::Engine;
use crate::domains::Pruned;
use crate::index::{AltId, Ids};

/// Values nearer to a whole number than this count as whole.
pub(super) const WHOLE: f64 = 0.01;

impl Engine<'_> {
    /// Gives devices the alternatives that the linear program assigns to them as a whole, and reads
    /// off the wiring that the flow then has.
    pub(super) fn round(&mut self) {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        if self.decide_whole().is_ok()
            && self.settle().is_ok()
            && self.bound() < self.goal.limit
            && let Ok(choices) = self.read()
        {
            self.goal.offer((self.model.evaluate(&choices), choices));
        }
        self.back(mark, &saved);
    }

    /// Gives each alternative as many devices of a group as the whole part of its value.
    fn decide_whole(&mut self) -> Result<(), Pruned> {
        let model = self.model;
        let Some(pricing) = &self.pricing else { return Err(Pruned) };
        for group in pricing.relaxation.groups() {
            for alt in group.first().map_or(Ids::default(), |&leader| model.alts.of(leader)) {
                let Some(pricing) = &self.pricing else { return Err(Pruned) };
                let twins: Vec<AltId> = group.iter().map(|&d| model.twin_alt(alt, d)).collect();
                let decided = |alt: AltId| self.domains.decided(model.alt_device[alt]);
                let have = twins.iter().filter(|&&twin| decided(twin) == Some(twin)).count();
                let whole = (pricing.relaxation.value(model, alt) + WHOLE) as usize;
                let can = |&twin: &AltId| self.domains.has_alt(twin) && decided(twin).is_none();
                let missing = whole.saturating_sub(have);
                let open: Vec<AltId> = twins.iter().copied().filter(can).take(missing).collect();
                for alt in open {
                    self.domains.choose_alt(model, alt)?;
                }
            }
        }
        Ok(())
    }
}
