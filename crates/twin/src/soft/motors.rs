//! Motors whose steps are pulses: the runtime says when the next step is due, and virtual time does what a timer does.

use std::collections::BTreeMap;

use sense_rt::{Item, MotorConfig, Repeat, Scalar, Stepper, TICK_HZ_MAX, store_count};
use sensedsl_job::BoardJob;
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::stepper::Mode;
use sensedsl_wire::Direction;

use crate::bench::Bench;
use crate::tables;

/// How often the reporter looks at a position, and reports one that stands.
const LOOK_MS: u64 = 10;
const REPEAT_MS: u32 = 1_000;

/// All motors of a board, with the devices that set them or tell where they are.
#[derive(Clone)]
pub(super) struct Motors {
    all: BTreeMap<ConnectionIndex, Motor>,
    /// By place in the schema: the motors of the elements.
    commands: BTreeMap<usize, (Scalar, Vec<ConnectionIndex>)>,
    readings: Vec<Reading>,
}

#[derive(Clone)]
struct Motor {
    config: MotorConfig,
    stepper: Stepper,
    /// The end of the interval under way.
    due_ns: u64,
    pulse_ns: u64,
    is_forward_high: bool,
    enabled: Option<bool>,
}

#[derive(Clone)]
struct Reading {
    index: usize,
    item: Item,
    of: Vec<ConnectionIndex>,
    repeat: Repeat,
    reported: Vec<i32>,
}

impl Motors {
    pub(super) fn new(job: &BoardJob<'_>) -> Self {
        let (mut commands, mut readings) = (BTreeMap::new(), Vec::new());
        let items = tables::schema(job).items;
        for (index, (one, item)) in job.devices.iter().zip(items).enumerate() {
            if one.device.kind.stepper().is_none() {
                continue;
            }
            let of: Vec<ConnectionIndex> =
                job.wires_of(one.device).into_iter().map(|wire| wire.index).collect();
            match one.device.direction {
                Direction::Actuator => drop(commands.insert(index, (item.scalar, of))),
                Direction::Sensor => {
                    let (repeat, reported) = (Repeat::NEW, Vec::new());
                    readings.push(Reading { index, item: *item, of, repeat, reported });
                }
            }
        }
        let motor = |one: &sensedsl_job::JobConnection<'_>| {
            let own = one.connection.kind.stepper()?;
            let config = MotorConfig {
                tick_hz: TICK_HZ_MAX,
                speed: own.speed,
                acceleration: own.acceleration,
                is_velocity: own.mode == Mode::Velocity,
            };
            let motor = Motor {
                config,
                stepper: Stepper::NEW,
                due_ns: 0,
                pulse_ns: 1_000 * u64::from(own.pulse_us),
                is_forward_high: own.is_forward_high,
                enabled: own.enabled,
            };
            Some((one.index, motor))
        };
        Self { all: job.connections.iter().filter_map(motor).collect(), commands, readings }
    }

    /// The board starts: no current, and the direction that is called forward.
    pub(super) fn start(&mut self, bench: &mut Bench, now_ns: u64) {
        for (at, motor) in &self.all {
            bench.drive_at(*at, Role::Dir, Some(motor.is_forward_high), now_ns);
            if let Some(enabled) = motor.enabled {
                bench.drive_at(*at, Role::Enable, Some(!enabled), now_ns);
            }
        }
    }

    /// The host has set a device.
    pub(super) fn set(&mut self, index: usize, value: &[u8], bench: &mut Bench, now_ns: u64) {
        let Some((scalar, of)) = self.commands.get(&index) else { return };
        for (at, element) in of.iter().zip(value.chunks(scalar.bytes())) {
            let Some(motor) = self.all.get_mut(at) else { continue };
            motor.stepper.command(&motor.config, *scalar, element);
            if let Some(enabled) = motor.enabled {
                bench.drive_at(*at, Role::Enable, Some(enabled), now_ns);
            }
            if !motor.stepper.is_under_way() {
                motor.due_ns = now_ns;
                motor.next(*at, bench);
            }
        }
    }

    /// The host is silent.
    pub(super) fn stop(&mut self) {
        self.all.values_mut().for_each(|motor| motor.stepper.stop());
    }

    /// Makes the steps of a millisecond. Gives the positions that are told then, by place in the schema.
    pub(super) fn step(
        &mut self,
        bench: &mut Bench,
        since_ms: u64,
        now_ns: u64,
    ) -> Vec<(usize, Vec<u8>)> {
        for (at, motor) in &mut self.all {
            motor.step(*at, bench, now_ns);
        }
        if !since_ms.is_multiple_of(LOOK_MS) {
            return Vec::new();
        }
        let all = &self.all;
        self.readings.iter_mut().filter_map(|reading| reading.look(all, since_ms)).collect()
    }
}

impl Motor {
    /// Makes the steps that are due up to a moment.
    fn step(&mut self, at: ConnectionIndex, bench: &mut Bench, now_ns: u64) {
        while self.stepper.is_under_way() && self.due_ns <= now_ns {
            if self.stepper.is_step() {
                let from_ns = self.due_ns.saturating_sub(self.pulse_ns);
                bench.step_at(at, from_ns, self.pulse_ns);
            }
            self.next(at, bench);
        }
    }

    /// Begins the next interval.
    fn next(&mut self, at: ConnectionIndex, bench: &mut Bench) {
        let ticks = self.stepper.advance(&self.config).max(self.least_ticks());
        let is_forward = !self.stepper.is_backward();
        bench.drive_at(at, Role::Dir, Some(is_forward == self.is_forward_high), self.due_ns);
        self.due_ns += u64::from(ticks) * (1_000_000_000 / u64::from(TICK_HZ_MAX));
    }

    /// A pulse, and the time before it.
    fn least_ticks(&self) -> u32 {
        let ticks = 2 * self.pulse_ns * u64::from(TICK_HZ_MAX) / 1_000_000_000;
        u32::try_from(ticks).unwrap_or(u32::MAX)
    }
}

impl Reading {
    /// The value, if it is told now.
    fn look(
        &mut self,
        motors: &BTreeMap<ConnectionIndex, Motor>,
        since_ms: u64,
    ) -> Option<(usize, Vec<u8>)> {
        let own = self.of.iter().filter_map(|at| motors.get(at));
        let now: Vec<i32> = own.map(|motor| motor.stepper.position()).collect();
        let since_ms = u32::try_from(since_ms & u64::from(u32::MAX)).unwrap_or(0);
        if !self.repeat.is_due(now != self.reported, REPEAT_MS, since_ms) {
            return None;
        }
        let mut value = vec![0; self.item.bytes()];
        for (target, position) in value.chunks_mut(self.item.scalar.bytes()).zip(&now) {
            store_count(self.item.scalar, i64::from(*position), target);
        }
        self.reported = now;
        Some((self.index, value))
    }
}
