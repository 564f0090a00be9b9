//! The PID of a world in the place of a controller's code.
//!
//! In: the newest values of what the controller reads, as its code gets them. Out: what it sets. As long as a value is
//! missing or not good, what is made of it is not set.

use sensedsl_host::Scale;
use sensedsl_job::BoardJob;
use sensedsl_model::design::{DeviceIndex, SignalOf, TestUnit};
use sensedsl_model::{Expression, unit_of_device};
use sensedsl_wire::{Scalar, ScalarType};

use super::UserCode;
use crate::tables;
use crate::truth::{real, scale_of};
use crate::world::{Pid, StandIn};

/// A device as it travels to and from code.
struct Field {
    index: DeviceIndex,
    scalar: ScalarType,
    count: usize,
    scale: Scale,
    unit: TestUnit,
}

/// A loop, and what it remembers.
struct Loop {
    pid: Pid,
    integral: f64,
    before: Option<f64>,
}

/// A controller: what it gets and sets, in the order in which it travels.
struct Controller {
    reads: Vec<Field>,
    sets: Vec<Field>,
    loops: Vec<Loop>,
}

/// Stands in for the code of a board's controllers. One that the world has no block for sets nothing.
pub struct StandIns(Vec<Controller>);

impl StandIns {
    /// For a board's job.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, of: &[StandIn]) -> Self {
        let field = |index: &usize| {
            let device = job.devices.get(*index)?;
            Some(Field {
                index: device.index,
                scalar: device.device.value.value.scalar,
                count: device.device.value.value.count(),
                scale: scale_of(&device.device.shown),
                unit: unit_of_device(device.index, device.device),
            })
        };
        let controller = |one: &sensedsl_job::JobController<'_>| {
            let own = of.iter().filter(|block| block.controller == one.controller.device);
            let loops = own.flat_map(|block| &block.loops);
            Controller {
                reads: one.reads.iter().filter_map(field).collect(),
                sets: one.sets.iter().filter_map(field).collect(),
                loops: loops
                    .map(|pid| Loop { pid: pid.clone(), integral: 0.0, before: None })
                    .collect(),
            }
        };
        Self(job.controllers.iter().map(controller).collect())
    }
}

impl UserCode for StandIns {
    fn restart(&mut self) -> Result<(), String> {
        for one in self.0.iter_mut().flat_map(|one| &mut one.loops) {
            (one.integral, one.before) = (0.0, None);
        }
        Ok(())
    }

    fn step(&mut self, which: u8, request: &[u8], answer: &mut [u8]) -> Result<(), String> {
        let own = self.0.get_mut(usize::from(which)).ok_or("there is no such controller")?;
        let told = own.step(request);
        for (to, from) in answer.iter_mut().zip(told) {
            *to = from;
        }
        Ok(())
    }
}

impl Controller {
    fn step(&mut self, request: &[u8]) -> Vec<u8> {
        let (dt_us, mut rest) = request.split_first_chunk::<4>().unwrap_or((&[0; 4], &[]));
        let dt_s = f64::from(u32::from_be_bytes(*dt_us)) / 1e6;
        let mut values: Vec<(DeviceIndex, Vec<f64>)> = Vec::new();
        for field in &self.reads {
            let bytes = field.count * field.scalar.size_bytes();
            let Some((head, after)) = rest.split_first_chunk::<5>() else { break };
            let Some((own, after)) = after.split_at_checked(bytes) else { break };
            rest = after;
            if head.first() == Some(&1) {
                values.push((field.index, field.shown(own)));
            }
        }
        let mut set = Vec::new();
        for one in &mut self.loops {
            if let Some(output) = one.output(&values, dt_s) {
                set.push((one.pid.device, one.pid.element, output));
            }
        }
        self.sets.iter().flat_map(|field| field.told(&set)).collect()
    }
}

impl Field {
    fn shown(&self, bytes: &[u8]) -> Vec<f64> {
        let each = bytes.chunks_exact(self.scalar.size_bytes());
        let number = |raw: &[u8]| match self.scalar.read(raw) {
            Some(Scalar::Bool(flag)) => f64::from(u8::from(flag)),
            Some(raw) => self.scale.shown(real(raw)),
            None => f64::NAN,
        };
        each.map(number).collect()
    }

    /// Whether it is set, and the value: of an array all elements or none.
    fn told(&self, set: &[(DeviceIndex, usize, f64)]) -> Vec<u8> {
        let mut bytes = vec![1];
        for element in 0..self.count {
            let own = set.iter().find(|one| one.0 == self.index && one.1 == element);
            let Some((_, _, shown)) = own else {
                return vec![0; 1 + self.count * self.scalar.size_bytes()];
            };
            let shown = if self.unit.is_of_ten_thousand { shown * 100.0 } else { *shown };
            bytes.extend(tables::value(tables::scalar(self.scalar), self.code(shown)));
        }
        bytes
    }

    /// The number on the wire.
    fn code(&self, shown: f64) -> f64 {
        if self.scalar == ScalarType::Bool {
            return f64::from(u8::from(shown >= 0.5));
        }
        let raw = self.scale.raw(shown);
        match self.scalar.integer_range() {
            #[expect(clippy::cast_precision_loss, reason = "the ends of 64 bits are rounded")]
            Some((least, most)) => libm::round(raw).clamp(least as f64, most as f64),
            None => raw,
        }
    }
}

impl Loop {
    /// The output, in the unit of the device that is set; `None` where something that it is made of is not known.
    fn output(&mut self, values: &[(DeviceIndex, Vec<f64>)], dt_s: f64) -> Option<f64> {
        let base = match &self.pid.feedforward {
            Some(feedforward) => shown(feedforward, values)?,
            None => 0.0,
        };
        let (least, most) = self.pid.range;
        let Some((measured, setpoint)) = &self.pid.error else {
            return Some(base.clamp(least, most));
        };
        let error = shown(setpoint, values)? - shown(measured, values)?;
        let before = self.before.replace(error).unwrap_or(error);
        let slope = if dt_s > 0.0 { (error - before) / dt_s } else { 0.0 };
        let integral = self.integral + error * dt_s;
        let with = |integral: f64| {
            base + self.pid.kp * error + self.pid.ki * integral + self.pid.kd * slope
        };
        let output = with(integral).clamp(least, most);
        // What is at its limit is not wound up further.
        if output == with(integral) || (with(integral) - output) * self.pid.ki * error < 0.0 {
            self.integral = integral;
        }
        Some(output)
    }
}

/// The value of an expression, in the unit in which people read it.
fn shown(of: &Expression, values: &[(DeviceIndex, Vec<f64>)]) -> Option<f64> {
    let signal = |number: usize| {
        let signal = of.signals.get(number)?;
        let SignalOf::Value(element) = signal.of else { return None };
        let (_, own) = values.iter().find(|(index, _)| *index == signal.device)?;
        own.get(element).map(|value| signal.unit.computed(*value))
    };
    of.term.at(&signal).filter(|value| value.is_finite()).map(|value| of.unit.shown(value))
}
