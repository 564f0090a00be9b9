//! `ADCv1` (F0): inputs in the order of their channels, a common sampling time, twelve bits.

use askama::Template;
use sensedsl_diagnostics::Diagnostic;

use super::group::{Group, macro_cycles, member};
use super::plan;
use crate::context::Context;
use crate::section::Section;
use sensedsl_files::block;

#[derive(Template)]
#[template(path = "adc/v1.c.txt", escape = "none")]
struct Text<'a> {
    g: &'a Group,
    smpr: String,
    chselr: String,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    plan::plan(context, diagnostics, text, 4_095)
}

pub(super) fn text(g: &Group) -> String {
    let longest = g.longest().map(macro_cycles).unwrap_or_default();
    block(&Text {
        g,
        smpr: format!("ADC_SMPR_SMP_{longest}"),
        chselr: member(&g.channels("ADC_CHSELR_CHSEL{channel}")),
    })
}
