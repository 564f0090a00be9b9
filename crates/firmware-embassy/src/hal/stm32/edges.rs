//! Digital inputs whose edges interrupt on an external line. The HAL leaves these interrupts to the project.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{EdgeInput, Edges, Watch, WatchedBy};
use crate::missing::{Missing, Printed};
use crate::section::Constructor;

impl Edges for Settings {
    fn watch(&self, context: &Context<'_>, input: &EdgeInput<'_>) -> Printed<Watch> {
        let EdgeInput { wire, pad, pull, trigger, .. } = input;
        let pin = &pad.pin.name;
        let line = pin.number().ok_or_else(|| Missing::wire("a pin of a port".to_owned()))?;
        let line = format!("EXTI{line}");
        let interrupt = context.interrupt(&line, "GLOBAL")?.to_owned();
        Ok(Watch {
            made: Constructor {
                type_: "hal::exti::ExtiInput<'static, hal::mode::Blocking>".to_owned(),
                make: format!(
                    "hal::exti::ExtiInput::new_blocking(p.{pin}, p.{line}, {pull}, hal::exti::TriggerEdge::{trigger})"
                ),
            },
            begin: format!("wiring.{}", wire.ident),
            by: WatchedBy::Handler(interrupt),
        })
    }
}
