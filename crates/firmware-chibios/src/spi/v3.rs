//! `SPIv3`: clock and frame size are in the first configuration register, polarity and phase in the second. The unit
//! keeps its pads while it is off, so that the clock line does not move when the mode changes.

use sensedsl_diagnostics::Diagnostic;

use super::bus::{self, Clock, sum};
use crate::context::Context;
use crate::section::Section;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    bus::plan(context, config, diagnostics)
}

fn config(clock: &Clock) -> Vec<String> {
    let divider = 1_u32 << clock.halvings;
    let polarity = clock.is_idle_high.then_some("SPI_CFG2_CPOL");
    let phase = clock.is_second_edge.then_some("SPI_CFG2_CPHA");
    let edges: Vec<&str> = ["SPI_CFG2_AFCNTR"].into_iter().chain(polarity).chain(phase).collect();
    vec![
        format!(".cfg1 = SPI_CFG1_MBR_DIV{divider} | SPI_CFG1_DSIZE_8BITS,"),
        format!(".cfg2 = {},", sum(&edges)),
    ]
}
