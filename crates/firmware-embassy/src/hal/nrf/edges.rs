//! Digital inputs whose edges interrupt. The HAL has the one interrupt of all pins, and wakes a task for each.

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{EdgeInput, Edges, Watch, WatchedBy};
use crate::hal::contract::outputs::Pins as _;
use crate::missing::Printed;
use crate::section::Constructor;

impl Edges for Settings {
    fn watch(&self, _context: &Context<'_>, input: &EdgeInput<'_>) -> Printed<Watch> {
        let EdgeInput { pad, pull, trigger, kept, .. } = input;
        let name = pad.pin.name.as_str();
        let (port, number) = name.split_once('.').unwrap_or((name, "0"));
        let number = number.trim_start_matches('0');
        let number = if number.is_empty() { "0" } else { number };
        Ok(Watch {
            begin: format!("rt::edges::Pad(hal::pac::{port}, {number})"),
            made: Constructor {
                type_: "Input<'static>".to_owned(),
                make: format!("Input::new(p.{}, {pull})", self.pin(&pad.pin.name)),
            },
            by: WatchedBy::Task(format!(
                "rt::edges::watch(pin, rt::edges::Trigger::{trigger}, &{kept}).await;"
            )),
        })
    }
}
