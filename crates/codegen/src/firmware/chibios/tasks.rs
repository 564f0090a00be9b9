//! Threads: one for each driver, cycle time and priority.

use super::analog::AnalogPlan;
use super::i2c::I2cPlan;
use super::icu::PulsePlan;

/// Bytes of a thread's stack: the deepest path of the runtime, interrupts' frames, and room for a
/// user's transform that calls a mathematical function.
const STACK_BYTES: u32 = 768;

/// What devices must have in common to be served by one thread.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Cycle {
    pub(super) unit: String,
    pub(super) delay_ms: u32,
    pub(super) prio: i8,
    /// When the first cycle begins, so that devices of a group take turns.
    pub(super) start_ms: u32,
}

/// One thread.
#[derive(Clone, Debug)]
pub(super) struct TaskPlan {
    pub(super) index: usize,
    /// `ADC1 60 ms +2`
    pub(super) name: String,
    /// The runtime's function and the table it works on.
    pub(super) function: &'static str,
    pub(super) work: String,
    pub(super) delay_ms: u32,
    pub(super) prio: i8,
    pub(super) start_ms: u32,
    pub(super) stack_bytes: u32,
}

impl Cycle {
    /// For a comment and a thread's name.
    pub(super) fn title(&self) -> String {
        let Self { unit, delay_ms, prio, start_ms } = self;
        let cycle =
            sensedsl_timing::Cycle { delay_ms: *delay_ms, prio: *prio, start_ms: *start_ms };
        cycle.title(unit)
    }
}

pub(super) fn plan(analog: &AnalogPlan, i2c: &I2cPlan, pulses: &[PulsePlan]) -> Vec<TaskPlan> {
    let groups =
        analog.groups.iter().map(|group| ("up_adc_cycle", "adc", group.index, &group.cycle));
    let classes =
        i2c.classes.iter().map(|class| ("up_i2c_cycle", "i2c", class.index, &class.cycle));
    let pulses = pulses.iter().map(|pulse| ("up_pulse_cycle", "pulse", pulse.index, &pulse.cycle));
    let all = groups.chain(classes).chain(pulses).enumerate();
    all.map(|(index, (function, table, number, cycle))| TaskPlan {
        index,
        name: cycle.title(),
        function,
        work: format!("{table}_{number}"),
        delay_ms: cycle.delay_ms,
        prio: cycle.prio,
        start_ms: cycle.start_ms,
        stack_bytes: STACK_BYTES,
    })
    .collect()
}
