//! What the search for a neat wiring asks the solver: whether there is a wiring within the limit in
//! what is left.

use super::pins::PinSet;
use crate::domains::Pruned;
use crate::model::{Choices, Model};
use crate::problem::DeviceId;
use crate::search::{Effort, Engine};

/// The work of taking pins from a part, about 20 us.
const LEAVE: u64 = 400;

/// The work that one question is worth, about 10 ms.
const ONE: u64 = 200_000;

/// The answer to a question.
pub(super) enum Reply {
    /// A wiring.
    Yes(Choices),
    /// There is none.
    No,
    /// It would take too much effort to find out.
    Unknown,
}

impl Engine<'_> {
    /// Leaves these devices only these pins.
    pub(super) fn leave_pins(
        &mut self,
        devices: &[DeviceId],
        pins: &PinSet,
        limit: u64,
    ) -> Result<(), Pruned> {
        let model = self.model;
        self.progress.work += LEAVE;
        for alt in devices.iter().flat_map(|device| model.alts.of(*device)) {
            for id in model.alt_cands(alt) {
                if !pins.has(model.cand[id].pin) {
                    self.domains.remove_cand(model, id)?;
                }
            }
        }
        self.settle()?;
        if self.bound() > limit { Err(Pruned) } else { Ok(()) }
    }

    /// Whether a wiring is still possible.
    pub(super) fn allows(&self, choices: &Choices) -> bool {
        let model: &Model = self.model;
        choices.iter().all(|chosen| {
            self.domains.has_alt(chosen.alt)
                && chosen.cands.iter().all(|id| self.domains.has_cand(model, *id))
        })
    }

    /// A wiring that weighs at most so much, near the known one if there is one there.
    pub(super) fn wiring_within(&mut self, limit: u64, known: &Choices) -> Reply {
        let saved = self.flow.save();
        let mark = self.domains.mark();
        self.progress.effort = Effort::Work(self.progress.work + ONE);
        let near = self.search_near(limit + 1, known);
        let found = near.or_else(|| {
            self.narrow_once(limit + 1).ok()?;
            self.search(limit + 1, true)
        });
        self.back(mark, &saved);
        let is_unknown = self.progress.stopped;
        self.progress.effort = Effort::Any;
        self.progress.stopped = self.cancel.is_over();
        match found {
            Some((_, choices)) => Reply::Yes(choices),
            None if is_unknown => Reply::Unknown,
            None => Reply::No,
        }
    }
}
