//! `SPIv1`: frames have 8 or 16 bits.

use sensedsl_diagnostics::Diagnostic;

use super::bus::{self, Clock, sum};
use crate::context::Context;
use crate::section::Section;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    bus::plan(context, config, diagnostics)
}

fn config(clock: &Clock) -> Vec<String> {
    vec![format!(".cr1 = {},", cr1(clock))]
}

/// The first register, which is the same in both versions.
pub(super) fn cr1(clock: &Clock) -> String {
    // The field's 0 is a clock that is halved once.
    let divider = clock.halvings.saturating_sub(1);
    let bits = [(4, "SPI_CR1_BR_2"), (2, "SPI_CR1_BR_1"), (1, "SPI_CR1_BR_0")];
    let bits = bits.into_iter().filter(|(bit, _)| divider & bit != 0).map(|(_, name)| name);
    let polarity = clock.is_idle_high.then_some("SPI_CR1_CPOL");
    let phase = clock.is_second_edge.then_some("SPI_CR1_CPHA");
    let all: Vec<&str> = bits.chain(polarity).chain(phase).collect();
    sum(&all)
}
