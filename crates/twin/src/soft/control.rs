//! The user's code on a board: the newest values in, what its steps set out. The code itself runs elsewhere.

use sense_rt::{Outcome, Status};
use sensedsl_job::{BoardJob, JobDevice, Owner};
use sensedsl_wire::{Direction, ValueType};

use super::core::{Core, wrapped};
use crate::tables;

/// The user's code of a board, as something that can be stepped: a program, or a function of a test.
pub trait UserCode {
    /// Begins anew, as after a reset of the board.
    ///
    /// # Errors
    /// Why the code cannot run, for people.
    fn restart(&mut self) -> Result<(), String>;

    /// Runs a step of the controller `which`, in the order of the job's. `request` and `answer` are as
    /// `sensedsl-code` describes them, with all numbers in network byte order.
    ///
    /// # Errors
    /// Why there is no answer, for people.
    fn step(&mut self, which: u8, request: &[u8], answer: &mut [u8]) -> Result<(), String>;
}

/// How often an unchanged count is reported.
const REPEAT_MS: u64 = 1_000;

/// A controller's cycle and its devices, by place in the schema.
#[derive(Clone, Debug)]
struct Loop {
    every_ms: u64,
    own: usize,
    reads: Vec<Input>,
    sets: Vec<(usize, usize)>,
}

/// A device that is read.
#[derive(Clone, Copy, Debug)]
struct Input {
    index: usize,
    bytes: usize,
    /// Whether its value is always there, because no hardware is behind it.
    is_code: bool,
}

/// The controllers of a board.
#[derive(Clone, Debug)]
pub(super) struct Controllers {
    all: Vec<Loop>,
    pub(super) owners: Vec<Owner>,
    /// The values that devices of code have at the start, by place in the schema.
    first: Vec<(usize, Vec<u8>)>,
}

/// What a step has set, by place in the schema.
pub(super) type Set = Vec<(usize, Vec<u8>)>;

impl Controllers {
    pub(super) fn new(job: &BoardJob<'_>) -> Self {
        let bytes = |index: usize| {
            let value = job.devices.get(index).map(|one| one.device.value.value);
            value.map_or(0, ValueType::size_bytes)
        };
        let is_code = |index: usize| {
            let device = job.devices.get(index).map(|one| one.device);
            device.is_some_and(|device| {
                device.kind.code().is_some() || device.direction == Direction::Actuator
            })
        };
        let of = |one: &sensedsl_job::JobController<'_>| Loop {
            every_ms: u64::from(one.controller.every_ms.max(1)),
            own: one.own,
            reads: one
                .reads
                .iter()
                .map(|&index| Input { index, bytes: bytes(index), is_code: is_code(index) })
                .collect(),
            sets: one.sets.iter().map(|&index| (index, bytes(index))).collect(),
        };
        Self {
            all: job.controllers.iter().map(of).collect(),
            owners: (0..job.devices.len()).map(|index| job.owner(index)).collect(),
            first: job.devices.iter().enumerate().filter_map(first).collect(),
        }
    }

    /// Gives devices of code their first values.
    pub(super) fn begin(&self, core: &mut Core) {
        for (index, value) in &self.first {
            core.record(*index, Outcome::Fresh, &mut value.clone());
        }
    }

    /// Runs the steps that begin in this millisecond.
    ///
    /// # Errors
    /// Why the code has not answered, for people.
    pub(super) fn step(
        &self,
        code: &mut dyn UserCode,
        core: &mut Core,
        since_ms: u64,
    ) -> Result<Set, String> {
        let mut set = Vec::new();
        for (one, which) in self.all.iter().zip(0..) {
            if !since_ms.is_multiple_of(one.every_ms) {
                continue;
            }
            let dt_us = if since_ms == 0 { 0 } else { wrapped(one.every_ms * 1_000) };
            let request = one.request(core, dt_us);
            let mut answer = vec![0; one.sets.iter().map(|(_, bytes)| 1 + bytes).sum()];
            code.step(which, &request, &mut answer)?;
            set.extend(one.answered(&answer));
            one.count(core, since_ms);
        }
        Ok(set)
    }
}

impl Loop {
    /// A step was in time. What counts those that were not is told now and then, though nothing has changed.
    fn count(&self, core: &mut Core, since_ms: u64) {
        let steps = REPEAT_MS.div_ceil(self.every_ms);
        let late = core.store.get(self.own).map(<[u8]>::to_vec);
        match late.filter(|_| (since_ms / self.every_ms).is_multiple_of(steps)) {
            Some(mut late) => core.record(self.own, Outcome::Fresh, &mut late),
            None => core.health.note(self.own, Outcome::Fresh, core.now_ms),
        }
    }

    fn request(&self, core: &Core, dt_us: u32) -> Vec<u8> {
        let mut bytes = dt_us.to_be_bytes().to_vec();
        for input in &self.reads {
            let row = core.health.row(input.index, core.now_ms);
            let value = core.store.get(input.index);
            let is_valid = value.is_some() && (input.is_code || row.status == Status::Good);
            bytes.push(u8::from(is_valid));
            bytes.extend(row.age_ms.saturating_mul(1_000).to_be_bytes());
            match value {
                Some(value) => bytes.extend(value),
                None => bytes.resize(bytes.len() + input.bytes, 0),
            }
        }
        bytes
    }

    fn answered(&self, answer: &[u8]) -> Set {
        let mut rest = answer;
        let mut set = Vec::new();
        for &(index, bytes) in &self.sets {
            let Some((own, after)) = rest.split_at_checked(1 + bytes) else { return set };
            rest = after;
            if let Some((1.., value)) = own.split_first() {
                set.push((index, value.to_vec()));
            }
        }
        set
    }
}

/// The value that a device of code has at the start.
fn first((index, one): (usize, &JobDevice<'_>)) -> Option<(usize, Vec<u8>)> {
    let code = one.device.kind.code()?;
    let value = one.device.value.value;
    Some((index, tables::value(tables::scalar(value.scalar), code.default).repeat(value.count())))
}
