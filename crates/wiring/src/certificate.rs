//! The certificate of an answer, or the report that there is none.

use sensedsl_certify::{Claim, Subject, Uncertified, certify};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0403_no_certificate;
use sensedsl_solve::{Experience, Fault, Outcome};

use crate::labels::labels;
use crate::wiring::Wiring;

impl Wiring<'_> {
    /// The certificate of what the solver found; `None` if it failed.
    pub(crate) fn certificate(
        &self,
        outcome: &Result<Outcome, Fault>,
        learned: &Experience,
        subject: &Subject,
    ) -> Option<Result<String, Box<Diagnostic>>> {
        let claim = match outcome {
            Ok(Outcome::Solved(answer)) => Claim::Best(answer, learned),
            Ok(Outcome::Infeasible(conflict)) => Claim::NoWiring(&conflict.devices),
            Ok(Outcome::Stopped { .. }) => {
                return Some(Err(self.uncertified(&Uncertified::Stopped)));
            }
            Err(_) => return None,
        };
        let labels = labels(self.design, &self.formulation);
        let text = certify(&self.formulation.problem, &labels, subject, claim, self.cancel);
        Some(text.map_err(|why| self.uncertified(&why)))
    }

    fn uncertified(&self, why: &Uncertified) -> Box<Diagnostic> {
        let why = match why {
            Uncertified::Incomplete => "the proof is longer than a certificate may be",
            Uncertified::Stopped => "time ran out before the proof was complete",
            Uncertified::Refuted(why) => return Box::new(self.disagrees(why)),
        };
        Box::new(e0403_no_certificate::no_certificate(self.place(), why))
    }
}
