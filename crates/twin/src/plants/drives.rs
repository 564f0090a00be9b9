//! What an actuator does, read from the wires of the board: pulses, levels, voltages. Nothing here is shared with the
//! board that drives them.
//!
//! What a part was told over a bus is not read from the bus: the board in this program says it, and an image does not.

use std::collections::BTreeMap;

use sensedsl_host::Scale;
use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::{ConnectionIndex, DeviceIndex};
use sensedsl_model::kind::{Interface, Role};
use sensedsl_model::protocol;

use crate::arith::number;
use crate::commands::outputs::Outputs;
use crate::truth::scale_of;

/// The code of the longest pulse.
const FULL_LEVEL: f64 = 10_000.0;
/// The code of a converter's reference voltage, and that voltage.
const CODES: f64 = 4_096.0;
const REFERENCE_MV: f64 = 3_300.0;

/// The codes that parts on buses were told, an element each.
pub(crate) type Told = BTreeMap<DeviceIndex, Vec<f64>>;

/// An element of an actuator on a board.
#[derive(Clone, Debug)]
pub(crate) struct Drive {
    device: DeviceIndex,
    element: usize,
    scale: Scale,
    how: How,
}

#[derive(Clone, Debug)]
enum How {
    Wire(Wire),
    Bridge(protocol::Drive, Vec<Wire>),
    Told,
}

#[derive(Clone, Copy, Debug)]
enum Wire {
    Pulses { at: ConnectionIndex, least_ns: f64, span_ns: f64 },
    Level { at: ConnectionIndex, is_active_low: bool },
    Volts { at: ConnectionIndex },
}

impl Drive {
    /// The element of a device of the board; `None` if the board does not have it.
    pub(crate) fn of(job: &BoardJob<'_>, device: DeviceIndex, element: usize) -> Option<Self> {
        let one = job.devices.iter().find(|one| one.index == device)?;
        let wires = job.wires_of(one.device);
        let how = match one.device.coding.drive {
            Some(drive) => How::Bridge(drive, wires.iter().filter_map(|at| wire(at)).collect()),
            None => {
                let own = wires.iter().find(|at| usize::from(at.element()) == element);
                own.and_then(|at| wire(at)).map_or(How::Told, How::Wire)
            }
        };
        Some(Self { device, element, scale: scale_of(&one.device.shown), how })
    }

    /// Whether only the board itself can say what it does.
    pub(crate) const fn is_told(&self) -> bool {
        matches!(self.how, How::Told)
    }

    /// What it does, as the device shows it; `None` if there are no pulses, or nobody has set it.
    pub(super) fn shown(&self, outputs: &Outputs, told: &Told) -> Option<f64> {
        self.code(outputs, told).map(|code| self.scale.shown(code))
    }

    /// What its wires do, as the device shows it, to the nearest code: a timer has fewer steps than there are codes.
    pub(crate) fn on_wires(&self, outputs: &Outputs) -> Option<f64> {
        self.code(outputs, &Told::new()).map(|code| self.scale.shown(code.round()))
    }

    fn code(&self, outputs: &Outputs, told: &Told) -> Option<f64> {
        match &self.how {
            How::Wire(wire) => wire.code(outputs),
            How::Bridge(drive, wires) => {
                let inputs: Vec<f64> =
                    wires.iter().map(|wire| wire.code(outputs).unwrap_or(0.0)).collect();
                Some(bridged(*drive, &inputs))
            }
            How::Told => told.get(&self.device).and_then(|all| all.get(self.element)).copied(),
        }
    }
}

/// The command of a bridge whose inputs have these codes.
fn bridged(drive: protocol::Drive, inputs: &[f64]) -> f64 {
    let on = |place: usize| inputs.get(place).copied().unwrap_or(0.0);
    match drive {
        // Both directions at once, or none, is a brake.
        protocol::Drive::DirectionPins => match (on(1) != 0.0, on(2) != 0.0) {
            (true, false) => on(0),
            (false, true) => -on(0),
            (true, true) | (false, false) => 0.0,
        },
        protocol::Drive::DirectionPin if on(1) != 0.0 => -on(0),
        protocol::Drive::DirectionPin => on(0),
        protocol::Drive::TwoPwm => on(0) - on(1),
    }
}

fn wire(one: &JobConnection<'_>) -> Option<Wire> {
    let at = one.index;
    Some(match one.connection.kind.interface() {
        Interface::Digital(own) => Wire::Level { at, is_active_low: own.active_low },
        Interface::Pwm(own) => {
            let period_ns = 1e9 / f64::from(own.frequency_hz.max(1));
            let least_ns = own.min_us.map_or(0.0, |us| 1e3 * f64::from(us));
            let most_ns = own.max_us.map_or(period_ns, |us| 1e3 * f64::from(us));
            Wire::Pulses { at, least_ns, span_ns: most_ns - least_ns }
        }
        Interface::Dac(_) => Wire::Volts { at },
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => return None,
    })
}

impl Wire {
    /// The code that the wire carries now; `None` without pulses or a level.
    fn code(self, outputs: &Outputs) -> Option<f64> {
        match self {
            Self::Pulses { at, least_ns, span_ns } => {
                let (_, width_ns) = outputs.pulses(at)?;
                // No pulse is a width of 0 where that means something, and silence elsewhere.
                if width_ns == 0 && least_ns > 0.0 {
                    return None;
                }
                Some((number(width_ns) - least_ns) / span_ns.max(1.0) * FULL_LEVEL)
            }
            Self::Level { at, is_active_low } => {
                let level = outputs.level(at, Role::Out)?;
                Some(f64::from(u8::from(level != is_active_low)))
            }
            Self::Volts { at } => Some(outputs.millivolts(at)? / REFERENCE_MV * CODES),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bridge_goes_where_its_inputs_say() {
        use protocol::Drive::{DirectionPin, DirectionPins, TwoPwm};
        for (drive, inputs, wanted) in [
            (DirectionPins, &[4e3, 1.0, 0.0][..], 4e3),
            (DirectionPins, &[4e3, 0.0, 1.0], -4e3),
            (DirectionPins, &[4e3, 1.0, 1.0], 0.0),
            (DirectionPin, &[4e3, 0.0], 4e3),
            (DirectionPin, &[4e3, 1.0], -4e3),
            (TwoPwm, &[4e3, 0.0], 4e3),
            (TwoPwm, &[0.0, 4e3], -4e3),
            (TwoPwm, &[], 0.0),
        ] {
            assert_eq!(bridged(drive, inputs), wanted, "{drive:?} {inputs:?}");
        }
    }
}
