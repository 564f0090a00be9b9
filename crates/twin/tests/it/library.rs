//! Every driver of the library that measures: the value that a world gives its part comes back through the tables and
//! the runtime.

use sensedsl_job::BoardJob;
use sensedsl_model::facts;
use sensedsl_model::protocol::InitStep;
use sensedsl_wire::Direction;

use crate::run::{plainly, with_job};

/// All drivers are tried one by one, because no single board of the examples has all of them with all their values.
#[test]
fn every_driver_reports_what_the_world_does() {
    let mut tried = 0;
    let mut failed = Vec::new();
    for text in examples().into_iter().step_by(crate::step(4)) {
        let has_sensor = with_job(&text, |job| {
            job.devices.iter().any(|one| one.device.direction == Direction::Sensor)
        });
        if !has_sensor {
            continue;
        }
        tried += 1;
        // Some parts need seconds until they measure, and others may be asked but once in two.
        let run = plainly(&text, "", 3 + with_job(&text, pauses_s));
        let silent = run.judged.iter().filter(|one| one.reports == 0).map(|one| &one.name);
        let silent: Vec<_> = silent.collect();
        if !silent.is_empty() {
            failed.push(format!("silent: {silent:?} of {text}"));
        }
        if !run.wrong().is_empty() {
            failed.push(format!("{:#?} of {text}", run.wrong()));
        }
    }
    assert!(failed.is_empty(), "{} of {tried}: {}", failed.len(), failed.join("\n\n"));
    assert!(tried > 60 / crate::step(4), "{tried}");
}

/// The pauses while the parts of a board are set up, in whole seconds.
fn pauses_s(job: &BoardJob<'_>) -> u64 {
    let steps =
        job.parts.iter().filter_map(|one| one.part.chip.as_ref()).flat_map(|chip| &chip.init);
    let pauses = steps.map(|step| match step {
        InitStep::Wait { ms } => u64::from(*ms),
        InitStep::Write(_) => 0,
    });
    pauses.sum::<u64>().div_ceil(1_000)
}

/// A board with only one part, and all of its values, for each part.
fn examples() -> Vec<String> {
    let parts = facts::all();
    parts.iter().map(board).collect()
}

fn board(part: &facts::PartFacts) -> String {
    if let [only] = part.values.as_slice()
        && only.name.is_none()
    {
        return facts::example(part);
    }
    let address = match (part.address, part.addresses.first()) {
        (None, Some(first)) => format!("address = {first};"),
        (_, _) => String::new(),
    };
    let (name, board) = (&part.name, facts::example_board(part));
    let delay_ms = facts::delay_ms(part).unwrap_or(100);
    format!(
        "board B on {board} {{ chip Part {{ driver = {name}; {address} delay = {delay_ms} ms; }} }}"
    )
}
