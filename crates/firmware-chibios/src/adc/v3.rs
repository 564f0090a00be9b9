//! `ADCv3` (F3, G4, L4): a sequence, twelve bits.

use askama::Template;
use sensedsl_diagnostics::Diagnostic;

use super::group::{Group, element};
use super::plan;
use crate::context::Context;
use crate::section::Section;
use sensedsl_files::block;

#[derive(Template)]
#[template(path = "adc/v3.c.txt", escape = "none")]
struct Text<'a> {
    g: &'a Group,
    smpr: [String; 2],
    sqr: [String; 4],
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    plan::plan(context, diagnostics, text, 4_095)
}

pub(super) fn text(g: &Group) -> String {
    block(&Text {
        g,
        smpr: [
            element(&g.sampling("ADC_SMPR1_SMP_AN{channel}(ADC_SMPR_SMP_{cycles})", 0..=9)),
            element(&g.sampling("ADC_SMPR2_SMP_AN{channel}(ADC_SMPR_SMP_{cycles})", 10..=18)),
        ],
        sqr: [
            element(&g.sequence("SQR1", 1..=4)),
            element(&g.sequence("SQR2", 5..=9)),
            element(&g.sequence("SQR3", 10..=14)),
            element(&g.sequence("SQR4", 15..=16)),
        ],
    })
}
