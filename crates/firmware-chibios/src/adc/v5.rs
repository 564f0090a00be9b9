//! `ADCv5` (G0): inputs in the order of their channels, two sampling times, twelve bits.

use askama::Template;
use sensedsl_diagnostics::Diagnostic;

use super::group::{Group, macro_cycles, member};
use super::plan;
use crate::context::Context;
use crate::section::Section;
use sensedsl_files::block;

#[derive(Template)]
#[template(path = "adc/v5.c.txt", escape = "none")]
struct Text<'a> {
    g: &'a Group,
    smpr: String,
    chselr: String,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    plan::plan(context, diagnostics, text, 4_095)
}

pub(super) fn text(g: &Group) -> String {
    block(&Text { g, smpr: smpr(g), chselr: member(&g.channels("ADC_CHSELR_CHSEL_N({channel}U)")) })
}

/// The first sampling time is the shortest requested one; the second is the longest, which all other inputs get.
fn smpr(g: &Group) -> String {
    let (shortest, longest) = (g.shortest(), g.longest());
    let first = shortest.map(macro_cycles).unwrap_or_default();
    let second = longest.map(macro_cycles).unwrap_or_default();
    let mut terms = vec![format!("ADC_SMPR_SMP1_{first}")];
    if shortest != longest {
        terms.push(format!("ADC_SMPR_SMP2_{second}"));
        let longer = g.inputs.iter().filter(|one| Some(one.cycles) != shortest);
        terms.extend(longer.map(|one| format!("ADC_SMPR_SMPSEL{}", one.channel)));
    }
    member(&terms)
}
