//! From one signed value to the two or three outputs of an H-bridge.
//!
//! The sign is the direction and the magnitude how strongly; it saturates at full scale. The outputs
//! are written one after the other in the order given: then the two inputs of the bridge are never
//! both driven, and no direction is driven with the strength meant for the other.

use crate::convert::load_magnitude;
use crate::scalar::Scalar;

/// How a bridge is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BridgeMode {
    /// Outputs: 0 magnitude (PWM), 1 in1 (high: forward), 2 in2 (high: backward).
    DirectionPins,
    /// Outputs: 0 forward (PWM), 1 backward (PWM).
    TwoPwm,
}

/// A bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bridge {
    /// How it is driven.
    pub mode: BridgeMode,
    /// The greatest magnitude, in the unit of the PWM outputs (as their items take it).
    pub full: u32,
}

/// What was written last; at the start nothing, and then the first value writes every output.
#[derive(Clone, Copy, Debug, Default)]
pub struct BridgeState {
    direction: Option<i8>,
}

/// One output to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Write {
    /// See [`BridgeMode`].
    pub output: u8,
    /// A magnitude of 0 to `full`, or 0 and 1 of a pin.
    pub value: u32,
}

/// What one value writes, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Writes {
    all: [Write; 4],
    count: usize,
}

impl Writes {
    fn put(&mut self, output: u8, value: u32) {
        if let Some(write) = self.all.get_mut(self.count) {
            *write = Write { output, value };
            self.count += 1;
        }
    }

    /// In order.
    #[must_use]
    pub fn as_slice(&self) -> &[Write] {
        self.all.get(..self.count).unwrap_or_default()
    }
}

impl BridgeState {
    /// At the start.
    pub const NEW: Self = Self { direction: None };
}

impl Bridge {
    /// What is to be written for an element (not a number is 0). Direction pins: with a new direction
    /// first the magnitude 0, then the pin that goes low, then the one that goes high, then the
    /// magnitude; both pins are low at 0. Two PWM: first the one that goes to 0.
    #[must_use]
    pub fn drive(&self, state: &mut BridgeState, scalar: Scalar, element: &[u8]) -> Writes {
        let (asked, is_negative) = load_magnitude(scalar, element);
        let magnitude = asked.min(u64::from(self.full)) as u32;
        let direction = match (magnitude, is_negative) {
            (0, _) => 0,
            (_, true) => -1,
            (_, false) => 1,
        };
        let is_turning = state.direction != Some(direction);
        state.direction = Some(direction);
        match self.mode {
            BridgeMode::TwoPwm => two_pwm(direction, magnitude),
            BridgeMode::DirectionPins => direction_pins(is_turning, direction, magnitude),
        }
    }
}

fn direction_pins(is_turning: bool, direction: i8, magnitude: u32) -> Writes {
    let (low, other) = if direction > 0 { (2, 1) } else { (1, 2) };
    let mut writes = Writes::default();
    if is_turning {
        writes.put(0, 0);
        writes.put(low, 0);
        writes.put(other, u32::from(direction != 0));
        if direction == 0 {
            return writes;
        }
    }
    writes.put(0, magnitude);
    writes
}

fn two_pwm(direction: i8, magnitude: u32) -> Writes {
    let (idle, other) = if direction > 0 { (1, 0) } else { (0, 1) };
    let mut writes = Writes::default();
    writes.put(idle, 0);
    writes.put(other, magnitude);
    writes
}
