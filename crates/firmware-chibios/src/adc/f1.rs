//! The driver of the STM32F1: one unit, a sequence, twelve bits.

use askama::Template;
use sensedsl_diagnostics::Diagnostic;

use super::group::{Group, member};
use super::plan;
use crate::context::Context;
use crate::section::Section;
use sensedsl_files::block;

#[derive(Template)]
#[template(path = "adc/f1.c.txt", escape = "none")]
struct Text<'a> {
    g: &'a Group,
    smpr1: String,
    smpr2: String,
    sqr1: String,
    sqr2: String,
    sqr3: String,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    plan::plan(context, diagnostics, text, 4_095)
}

pub(super) fn text(g: &Group) -> String {
    let count = format!("ADC_SQR1_NUM_CH({}U)", g.inputs.len());
    block(&Text {
        g,
        smpr1: member(&g.sampling("ADC_SMPR1_SMP_AN{channel}(ADC_SAMPLE_{cycles})", 10..=15)),
        smpr2: member(&g.sampling("ADC_SMPR2_SMP_AN{channel}(ADC_SAMPLE_{cycles})", 0..=9)),
        sqr1: member(&[vec![count], g.sequence("SQR1", 13..=16)].concat()),
        sqr2: member(&g.sequence("SQR2", 7..=12)),
        sqr3: member(&g.sequence("SQR3", 1..=6)),
    })
}
