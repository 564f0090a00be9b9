//! Neat among the cheapest: the solver's answer in, one as good out whose parts use fewer sides of
//! connectors.

use sensedsl_solve::neat::{self, neaten};
use sensedsl_solve::{Answer, Fault, Outcome};

use crate::answers::{Search, Solved};
use crate::assignment::{Assignment, Bound, Neatness, Plain};
use crate::read_back;
use crate::wiring::Wiring;

/// What the search for a neat wiring has shown: whether none is neater, how neat the first one was,
/// and its steps. None if there was no search.
#[derive(Clone, Copy)]
pub(crate) struct Shown(Option<(bool, Plain, u64)>);

impl Shown {
    /// Adds it to the wiring.
    pub(crate) fn note(self, mut solved: Solved) -> Solved {
        if let (Solved::Wired(assignment), Some((is_proved, plain, steps))) = (&mut solved, self.0)
        {
            assignment.neatness.is_proved = is_proved;
            assignment.neatness.before = Some(plain);
            assignment.neatness.steps = steps;
            if assignment.rise() > 0 {
                let Assignment { moved, violated, shared, .. } = **assignment;
                assignment.bound = Some(Bound { moved, violated, shared, cost: plain.cost });
            }
        }
        solved
    }
}

impl Wiring<'_> {
    /// How neat an answer is. No other is neater if nothing is on a connector.
    pub(crate) fn neatness(&self, answer: &Answer) -> Neatness {
        let layout = &self.formulation.layout;
        let neat::Neatness { sides, span } = layout.neatness(self.problem(), answer);
        Neatness { sides, span, is_proved: layout.is_empty(), ..Neatness::default() }
    }

    /// Puts the neatest wiring that is found in the place of the first of the best.
    pub(crate) fn neatened(
        &self,
        outcome: Result<Outcome, Fault>,
        search: &Search,
    ) -> (Result<Outcome, Fault>, Shown) {
        let layout = &self.formulation.layout;
        let best = match &outcome {
            Ok(Outcome::Solved(best)) if !search.any && !layout.is_empty() => best,
            _ => return (outcome, Shown(None)),
        };
        let neat::Neatness { sides, span } = layout.neatness(self.problem(), best);
        let plain = Plain { sides, span, cost: best.objective.cost };
        let neat = match self.neatest(best, search.rise) {
            Ok(neat) => neat,
            Err(fault) => return (Err(fault), Shown(None)),
        };
        // The converters may find no streams beside the neat wiring.
        if read_back::read_back(self.design, &self.formulation, &neat.answer).is_none() {
            return (outcome, Shown(Some((false, plain, neat.steps))));
        }
        (Ok(Outcome::Solved(neat.answer)), Shown(Some((neat.is_proved, plain, neat.steps))))
    }

    /// The neatest that costs no more, then the neatest that may.
    fn neatest(&self, best: &Answer, rise: u32) -> Result<neat::Neat, Fault> {
        let layout = &self.formulation.layout;
        let neat = neaten(self.problem(), layout, best, 0, self.cancel)?;
        if rise == 0 {
            return Ok(neat);
        }
        let dearer = neaten(self.problem(), layout, &neat.answer, rise, self.cancel)?;
        Ok(neat::Neat { steps: neat.steps + dearer.steps, ..dearer })
    }
}
