//! `SPIv2`: the frame size is in the second register.

use sensedsl_diagnostics::Diagnostic;

use super::bus::{self, Clock};
use super::v1::cr1;
use crate::context::Context;
use crate::section::Section;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    bus::plan(context, config, diagnostics)
}

fn config(clock: &Clock) -> Vec<String> {
    vec![
        format!(".cr1 = {},", cr1(clock)),
        ".cr2 = SPI_CR2_DS_2 | SPI_CR2_DS_1 | SPI_CR2_DS_0,".to_owned(),
    ]
}
