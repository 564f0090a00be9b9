//! Devices on register buses, the same for I2C and SPI: which thread serves which chip, and in which order.
//!
//! A single device is a chip with one reading or one command; its tables are those of its part ([`super::parts`]).

use std::collections::BTreeMap;

use askama::Template;

use super::context::Context;
use super::section::Work;
use super::stacks::Depth;
use sensedsl_files::block;
use sensedsl_job::part::BusPlan;
use sensedsl_job::snake;
use sensedsl_job::{BoardJob, Cycle, JobConnection};

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [560, 444], filtered: [688, 472] };

/// The work of one thread on one bus.
pub(super) struct Thread {
    /// `i2c1_10ms`
    ident: String,
    unit: String,
    cycle: Cycle,
    chips: Vec<Served>,
}

/// A chip that the thread serves.
struct Served {
    name: String,
    /// The prefix of the names of its tables.
    ident: String,
    /// The number of commands.
    commands: usize,
    id: u8,
}

#[derive(Template)]
#[template(path = "chips.c.txt", escape = "none")]
struct Tables<'a> {
    threads: &'a [Thread],
}

/// The threads of a bus, one per cycle; each serves its chips in the design's order.
pub(super) fn threads(
    context: &Context<'_>,
    unit: &str,
    on_bus: &[&JobConnection<'_>],
) -> Vec<Thread> {
    let mut cycles: BTreeMap<Cycle, Vec<Served>> = BTreeMap::new();
    for one in on_bus {
        // A connection without a table carries no value.
        let Some(plan) = plan_of(context.job, one) else { continue };
        cycles.entry(one.cycle).or_default().push(Served {
            name: one.part.name.value.clone(),
            ident: plan.prefix.clone(),
            commands: plan.commands.len(),
            id: context.id_of(one),
        });
    }
    let thread = |(cycle, chips): (Cycle, Vec<Served>)| Thread {
        ident: cycle.ident(unit),
        unit: unit.to_owned(),
        cycle,
        chips,
    };
    cycles.into_iter().map(thread).collect()
}

/// The C code of the threads' tables.
pub(super) fn tables(threads: &[Thread]) -> String {
    block(&Tables { threads })
}

/// The tables of the part that a connection belongs to.
pub(super) fn plan_of<'a>(
    job: &'a BoardJob<'_>,
    connection: &JobConnection<'_>,
) -> Option<&'a BusPlan> {
    job.bus_of(connection)
}

/// What a connection needs and there is no code for; `None` if there is code for everything.
pub(super) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    job.lacks_on_buses(connection)
}

impl Thread {
    /// The work of the thread, for the plan.
    pub(super) fn work(&self) -> Work {
        Work {
            unit: self.unit.clone(),
            cycle: self.cycle,
            function: "up_chips_cycle",
            table: self.ident.clone(),
            device: self.chips.first().map_or(0, |one| one.id),
            depth: DEPTH,
        }
    }

    /// The bus that it works on.
    fn bus(&self) -> String {
        format!("{}_bus", snake(&self.unit))
    }

    /// The title, for a comment.
    fn title(&self) -> String {
        self.cycle.title(&self.unit)
    }

    /// The names of its chips, for a comment.
    fn names(&self) -> String {
        let names: Vec<&str> = self.chips.iter().map(|one| one.name.as_str()).collect();
        names.join(", ")
    }
}
