//! `DACv1`: a driver object for each output, set without DMA.

use askama::Template;
use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{Kind, KindName, Role};

use crate::context::Context;
use crate::names::Setting;
use crate::section::{Apply, Failsafe, Section};
use sensedsl_files::block;
use sensedsl_job::{JobConnection, JobDevice};

/// The greatest code of an output.
const FULL: f64 = 4095.0;

/// All outputs.
#[derive(Template)]
#[template(path = "dac/v1.c.txt", escape = "none")]
struct Tables {
    outputs: Vec<Output>,
}

/// One output.
struct Output {
    ident: String,
    /// Device, pin and signal, for a comment.
    place: String,
    field: String,
    element: u16,
    driver: String,
    /// The options that turn it on.
    settings: Vec<Setting>,
    /// The code at the start: the failsafe value, or no voltage.
    init: u16,
    /// The code that the output takes when the host is silent.
    failsafe: Option<u16>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut outputs = Vec::new();
    for wired in context.connections(KindName::Dac) {
        let (Some(device), Some(pad)) = (context.device_of(wired), wired.pad(Role::Out)) else {
            continue;
        };
        let Some(output) = output(context, wired, device) else { continue };
        section.pads.extend(context.pad(pad, "PAL_MODE_INPUT_ANALOG", diagnostics));
        outputs.push(output);
    }
    let truth = if outputs.is_empty() { "FALSE" } else { "TRUE" };
    section.switch = Some(Setting::new("HAL_USE_DAC", truth));
    if outputs.is_empty() {
        return section;
    }
    section.mcu = outputs.iter().flat_map(|one| one.settings.clone()).collect();
    let start = |one: &Output| format!("(void)dacStart(&{}, &{}_config);", one.driver, one.ident);
    section.starts = outputs.iter().map(start).collect();
    section.applies = applies(&outputs);
    let failsafe = |one: &Output| {
        let line = format!("(void)dacPutChannelX(&{}, 0U, {}U);", one.driver, one.failsafe?);
        Some(Failsafe { field: Some(one.field.clone()), line })
    };
    section.failsafes = outputs.iter().filter_map(failsafe).collect();
    section.tables = block(&Tables { outputs });
    section
}

fn output(
    context: &Context<'_>,
    wired: &JobConnection<'_>,
    device: &JobDevice<'_>,
) -> Option<Output> {
    let Kind::Dac(dac) = &wired.connection.kind else { return None };
    let usage = wired.pad(Role::Out)?.usage?;
    let Function::Dac { channel, .. } = usage.signal.function() else { return None };
    let (driver, settings) = context.names.dac(wired.unit?, *channel)?;
    let failsafe = dac.failsafe.map(code);
    Some(Output {
        ident: wired.ident.clone(),
        place: wired.place(),
        field: device.name().to_owned(),
        element: wired.element(),
        driver,
        settings,
        init: failsafe.unwrap_or(0),
        failsafe,
    })
}

/// The code nearest to a value.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0 to 4095")]
fn code(value: f64) -> u16 {
    value.round().clamp(0.0, FULL) as u16
}

/// The lines that set each output of a field.
fn applies(outputs: &[Output]) -> Vec<Apply> {
    let mut applies: Vec<Apply> = Vec::new();
    for one in outputs {
        let line = format!("up_dac_set(&{}, field, value, {}U);", one.driver, one.element);
        match applies.iter_mut().find(|apply| apply.field == one.field) {
            Some(apply) => apply.line.push_str(&format!("\n      {line}")),
            None => applies.push(Apply { field: one.field.clone(), line }),
        }
    }
    applies
}

#[cfg(test)]
mod tests {
    use super::code;

    #[test]
    fn codes_of_values_there_are_none_of() {
        let all = [-1.0, 0.4, 0.5, 2047.6, 4095.4, 1e300, f64::NAN].map(code);
        assert_eq!(all, [0, 0, 1, 2048, 4095, 4095, 0]);
    }
}
