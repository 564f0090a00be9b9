//! Priorities: tasks of the lowest run in the main loop, those of each higher one in an interrupt that nothing else
//! uses.

use std::collections::BTreeSet;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;

use super::context::Context;
use super::hal::contract::Project;
use super::section::Start;

/// A priority above the lowest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Level {
    /// The priority of the tasks in the file.
    pub(super) prio: i8,
    /// The interrupt that its tasks run in.
    pub(super) interrupt: String,
    /// The priority of the interrupt: one with a lower number is more urgent.
    pub(super) number: usize,
}

/// The levels, from the lowest up.
pub(super) fn levels(
    context: &Context<'_>,
    project: &dyn Project,
    starts: &[Start],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Level> {
    let prios: BTreeSet<i8> = starts.iter().filter_map(Start::prio).chain([0]).collect();
    let last = project.last_priority(context);
    let spare = &context.names.line.spare;
    let above: Vec<i8> = prios.into_iter().skip(1).collect();
    if above.len() > spare.len().min(last) {
        let name = &context.job.board.name;
        let most = spare.len().min(last) + 1;
        let message = format!("{} priorities on {}, which has {most}", above.len() + 1, name.value);
        let help = "give devices that may wait for each other the same `prio`";
        diagnostics.push(e0506_hardware_limit::hardware_limit(name.span, &message, help));
    }
    let levels = above.into_iter().zip(spare).enumerate();
    let level = |(at, (prio, interrupt)): (usize, (i8, &String))| Level {
        prio,
        interrupt: interrupt.clone(),
        number: last - at.min(last),
    };
    levels.map(level).collect()
}

/// The statements of `main` that start tasks: each task in the executor of its priority.
pub(super) fn statements(starts: &[Start], levels: &[Level]) -> Vec<String> {
    let by = |prio: i8| match levels.iter().position(|level| level.prio == prio) {
        Some(at) => format!("level_{at}"),
        None => "spawner".to_owned(),
    };
    let statement = |start: &Start| match start {
        Start::Make(code) => code.clone(),
        Start::Task(prio, call) => format!("start!({}, {call});", by(*prio)),
    };
    starts.iter().map(statement).collect()
}
