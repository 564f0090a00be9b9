//! The setup of pins besides their modes: on some MCUs the peripheral selects its pins.

mod v1;

use super::context::{Context, PadPlan};
use super::section::{Peripheral, Section, Version, nothing};
use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Diagnostic;

/// The pins. The modes themselves are in `context.rs`.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "GPIO",
    kind: None,
    version: |drivers| &drivers.gpio,
    versions: &[
        Version { name: "GPIOv1", plan: v1::plan },
        Version { name: "GPIOv2", plan: by_pin },
        Version { name: "GPIOv3", plan: by_pin },
    ],
    lacks: nothing,
    core: &[],
    runtime: &[],
};

/// Every pin has its own alternate function number: its mode is sufficient.
fn by_pin(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    Section { pads: released(context), ..Section::default() }
}

/// Pins that the folder of another board in the tree sets up as outputs, and that nothing here drives.
fn released(context: &Context<'_>) -> Vec<PadPlan> {
    let is_free = |pin: &&PinName| context.job.all_pads().all(|pad| pad.pin.name != **pin);
    let pins = context.chibios.released.iter().filter(is_free);
    let pads = pins.filter_map(|pin| {
        let line = context.line(pin)?;
        Some(PadPlan { pin: pin.clone(), line, mode: "PAL_MODE_INPUT".to_owned(), is_high: false })
    });
    pads.collect()
}
