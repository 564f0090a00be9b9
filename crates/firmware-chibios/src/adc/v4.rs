//! `ADCv4` (H7): a sequence, preselected inputs, sixteen bits.
//!
//! Sixteen bits, because all revisions of the silicon encode these in the same way; twelve bits have another code from
//! revision V on.

use askama::Template;
use sensedsl_diagnostics::Diagnostic;

use super::group::{Group, element, member};
use super::plan;
use crate::context::Context;
use crate::section::Section;
use sensedsl_files::block;

#[derive(Template)]
#[template(path = "adc/v4.c.txt", escape = "none")]
struct Text<'a> {
    g: &'a Group,
    pcsel: String,
    smpr: [String; 2],
    sqr: [String; 4],
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    plan::plan(context, diagnostics, text, 65_535)
}

pub(super) fn text(g: &Group) -> String {
    block(&Text {
        g,
        pcsel: member(&g.channels("ADC_SELMASK_IN{channel}")),
        smpr: [
            element(&g.sampling("ADC_SMPR1_SMP_AN{channel}(ADC_SMPR_SMP_{cycles})", 0..=9)),
            element(&g.sampling("ADC_SMPR2_SMP_AN{channel}(ADC_SMPR_SMP_{cycles})", 10..=19)),
        ],
        sqr: [
            element(&g.sequence("SQR1", 1..=4)),
            element(&g.sequence("SQR2", 5..=9)),
            element(&g.sequence("SQR3", 10..=14)),
            element(&g.sequence("SQR4", 15..=16)),
        ],
    })
}
