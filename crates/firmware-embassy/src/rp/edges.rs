//! Digital inputs whose edges interrupt: a task for each, as the HAL has the interrupt of all pins.

use sensedsl_model::kind::digital::Digital;

use crate::contacts;
use crate::context::Context;
use crate::item::{Item, Task};
use crate::section::{Section, Start};
use sensedsl_job::{JobConnection, Pad};

/// The static's kind, the type of what the wiring hands over, and what that is made of.
pub(crate) fn input(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    (pad, own): (&Pad<'_>, &Digital),
    prio: i8,
    trigger: &str,
    section: &mut Section,
) -> (&'static str, String, String) {
    let (ident, pin) = (&wire.ident, context.pin(&pad.pin.name));
    let kept = contacts::name(wire);
    let mut task = Task::new(format!("{}: its edges", wire.place()), format!("{ident}_edges"));
    task.parameters.push("pin: Input<'static>".to_owned());
    task.before
        .push(format!("rt::edges::watch(pin, rt::edges::Trigger::{trigger}, &{kept}).await;"));
    section.items.push(Item::Task(task));
    section
        .begins
        .push(format!("{kept}.begin(rt::edges::Pad({}));", pin.trim_start_matches("PIN_")));
    section.starts.push(Start::Task(prio, format!("{ident}_edges(wiring.{ident})")));
    let pull = contacts::pull(own);
    (
        "rt::edges::InterruptInput",
        "Input<'static>".to_owned(),
        format!("Input::new(p.{pin}, {pull})"),
    )
}
