//! Digital inputs whose edges interrupt. The HAL has the one interrupt of all pins, and wakes a task for each.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{EdgeInput, Edges, Watch, WatchedBy};
use crate::missing::Printed;
use crate::section::Constructor;

impl Edges for Settings {
    fn watch(&self, _context: &Context<'_>, input: &EdgeInput<'_>) -> Printed<Watch> {
        let EdgeInput { pad, pull, trigger, kept, .. } = input;
        let pin = pad.pin.name.as_str();
        Ok(Watch {
            begin: format!("rt::edges::Pad({})", pin.trim_start_matches("GPIO")),
            made: Constructor {
                type_: "Input<'static>".to_owned(),
                make: format!("Input::new(p.{pin}, {pull})"),
            },
            by: WatchedBy::Task(format!(
                "rt::edges::watch(pin, rt::edges::Trigger::{trigger}, &{kept}).await;"
            )),
        })
    }
}
