//! From one signed value to the two or three outputs of an H-bridge.
//!
//! The sign is the direction, the magnitude the strength; it saturates at full scale. The outputs
//! are written one after the other in the order given: the two inputs of the bridge are then never
//! driven at the same time, and no direction is driven with the strength meant for the other.

use crate::convert::load_magnitude;
use crate::scalar::Scalar;

/// The way a bridge is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BridgeMode {
    /// Outputs: 0 magnitude (PWM), 1 in1 (high: forward), 2 in2 (high: backward).
    DirectionPins,
    /// Outputs: 0 magnitude (PWM), 1 direction (high: backward).
    DirectionPin,
    /// Outputs: 0 forward (PWM), 1 backward (PWM).
    TwoPwm,
}

/// A bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bridge {
    /// The way it is driven.
    pub mode: BridgeMode,
    /// The greatest magnitude, in the unit of the PWM outputs (that of their items).
    pub full: u32,
}

/// The last direction written; none at the start, so that the first value writes every output.
#[derive(Clone, Copy, Debug, Default)]
pub struct BridgeState {
    direction: Option<i8>,
}

/// One output to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Write {
    /// The output's number, as in [`BridgeMode`].
    pub output: u8,
    /// The magnitude, 0 to `full`, or the level of a pin, 0 or 1.
    pub value: u32,
}

/// The writes for one value, in this order.
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

    /// The writes, in order.
    #[must_use]
    pub fn as_slice(&self) -> &[Write] {
        self.all.get(..self.count).unwrap_or_default()
    }
}

impl BridgeState {
    /// The state at the start.
    pub const NEW: Self = Self { direction: None };
}

impl Bridge {
    /// The writes for an element (NaN is 0). With direction pins, a new direction first writes the
    /// magnitude 0, then the pin that goes low, then the one that goes high, then the magnitude;
    /// both pins are low at 0. With one
    /// pin, the magnitude is 0 while the pin changes; the pin is low at 0. With two PWM outputs, the one that goes to 0 is written first.
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
            BridgeMode::DirectionPin => direction_pin(is_turning, direction, magnitude),
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

fn direction_pin(is_turning: bool, direction: i8, magnitude: u32) -> Writes {
    let mut writes = Writes::default();
    if is_turning {
        writes.put(0, 0);
        writes.put(1, u32::from(direction < 0));
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
