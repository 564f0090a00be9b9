//! Trigger pulses of rangers, and which of them wait for each other.

use std::collections::BTreeMap;

use crate::{BoardJob, Cycle, JobConnection};

/// Wires that get pulses of the same length in the same cycle.
#[derive(Clone, Debug)]
pub struct Pulses<'a> {
    /// The cycle in which they are due.
    pub cycle: Cycle,
    /// The length of a pulse.
    pub pulse_us: u32,
    /// The identifier of the first device.
    pub id: u8,
    /// The wires, in the order of their pulses.
    pub lines: Vec<Line<'a>>,
}

/// A wire that gets a pulse.
#[derive(Clone, Debug)]
pub struct Line<'a> {
    /// The connection.
    pub wire: &'a JobConnection<'a>,
    /// The time from its pulse to the next; 0 if the next does not wait.
    pub apart_ms: u32,
    /// The group: rangers of the same group would hear each other.
    group: Option<&'a str>,
    measuring_ms: u32,
}

/// The pulses of a board, by cycle and length.
#[must_use]
pub fn pulses<'a>(job: &'a BoardJob<'a>) -> Vec<Pulses<'a>> {
    let mut classes: BTreeMap<(Cycle, u32), (u8, Vec<Line<'a>>)> = BTreeMap::new();
    for one in &job.devices {
        let device = one.device;
        let Some(pulse_us) = device.kind.pulse_us() else { continue };
        let first = || (device.id.value, Vec::new());
        for wire in job.wires_of(device) {
            let (_, lines) = classes.entry((one.cycle, pulse_us)).or_insert_with(first);
            lines.push(Line {
                wire,
                group: device.group.as_ref().map(|group| group.name.as_str()),
                measuring_ms: device.measuring_ms(),
                apart_ms: 0,
            });
        }
    }
    let pulses = classes.into_iter().map(|((cycle, pulse_us), (id, lines))| Pulses {
        cycle,
        pulse_us,
        id,
        lines: apart(lines),
    });
    pulses.collect()
}

/// Lines of one group wait for each other: elements of an array, and devices whose cycle is too short for taking turns.
fn apart(mut lines: Vec<Line<'_>>) -> Vec<Line<'_>> {
    // Lines of one group follow each other, so that none waits for a ranger that it does not hear.
    lines.sort_by(|a, b| a.group.cmp(&b.group));
    let next: Vec<Option<&str>> = lines.iter().skip(1).map(|line| line.group).collect();
    for (line, next) in lines.iter_mut().zip(next) {
        if line.group.is_some() && line.group == next {
            line.apart_ms = line.measuring_ms;
        }
    }
    lines
}
