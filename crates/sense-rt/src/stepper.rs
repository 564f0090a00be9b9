//! The steps of a motor: from a target to when the next step is due, one step after the other.
//!
//! In: the host's targets, and word that an interval is over. Out: intervals of a timer, each with a step at its end or
//! without one. A step is counted when its interval is over, so the position is the number of steps that were made,
//! whatever the targets were in between. Along a ramp the square of the speed changes by twice the acceleration with
//! each step, which is exact, and the time of a step is that of its mean speed; so nothing adds up over a ramp.

use crate::convert::load_magnitude;
use crate::scalar::Scalar;

/// The highest `tick_hz`: the dividend of an interval then has 32 bits.
pub const TICK_HZ_MAX: u32 = 4_000_000;
/// The longest interval: a counter of 16 bits has it, and some ticks to spare.
const LONGEST: u32 = 0xC000;
/// A longer interval is cut into pieces of this length, so that a new target counts soon.
const PIECE: u32 = 0x8000;

/// What a motor can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotorConfig {
    /// Ticks per second of the timer; at most [`TICK_HZ_MAX`].
    pub tick_hz: u32,
    /// The greatest speed, in steps per second; 1 to 500000.
    pub speed: u32,
    /// The acceleration, in steps per second squared; 1 to 10000000.
    pub acceleration: u32,
    /// Whether targets are speeds; otherwise they are positions.
    pub is_velocity: bool,
}

/// A motor that is stepped; at the start it is at rest, at position 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stepper {
    /// Of the speed at the last step, in (steps/s)^2; 0 at rest. And at the next step.
    square: u64,
    next_square: u64,
    /// The roots of these, in 1/256 step/s.
    speed: u32,
    next_speed: u32,
    /// The interval under way; 0 if there is none.
    lap_ticks: u32,
    /// Ticks since the last step that are over, or since the start from rest.
    elapsed: u32,
    /// Of a tick, in 1/256, that the last step was early.
    fraction: u32,
    next_fraction: u32,
    is_step: bool,
    is_backward: bool,
    is_stopped: bool,
    position: i32,
    target: i32,
}

impl Stepper {
    /// At rest, at position 0.
    pub const NEW: Self = Self {
        square: 0,
        next_square: 0,
        speed: 0,
        next_speed: 0,
        lap_ticks: 0,
        elapsed: 0,
        fraction: 0,
        next_fraction: 0,
        is_step: false,
        is_backward: false,
        is_stopped: false,
        position: 0,
        target: 0,
    };

    /// The host's value. A speed greater than the greatest becomes that one. It counts from the next interval on.
    pub fn command(&mut self, motor: &MotorConfig, scalar: Scalar, element: &[u8]) {
        let (wanted, is_negative) = load_magnitude(scalar, element);
        let wanted = i64::try_from(wanted).unwrap_or(i64::MAX);
        let wanted = if is_negative { -wanted } else { wanted };
        let speed = i64::from(motor.speed);
        let (least, greatest) = if motor.is_velocity {
            (-speed, speed)
        } else {
            (i64::from(i32::MIN), i64::from(i32::MAX))
        };
        self.target = wanted.clamp(least, greatest) as i32;
        self.is_stopped = false;
    }

    /// Decelerates to a stop, and stays there until the next command. It counts from the next interval on.
    pub fn stop(&mut self) {
        self.is_stopped = true;
    }

    /// The interval under way is over, or there is none: counts its step, and begins the next one. Gives its ticks, at
    /// most 49152, or 0 at rest.
    pub fn advance(&mut self, motor: &MotorConfig) -> u32 {
        self.elapsed = self.elapsed.wrapping_add(self.lap_ticks);
        if self.lap_ticks != 0 && self.is_step {
            self.position = self.position.wrapping_add(if self.is_backward { -1 } else { 1 });
            self.square = self.next_square;
            self.speed = self.next_speed;
            self.fraction = self.next_fraction;
            self.elapsed = 0;
        }
        self.lap_ticks = 0;
        self.is_step = false;
        if !self.choose(motor) {
            self.elapsed = 0;
            self.fraction = 0;
            return 0;
        }
        // A new target may ask for a step that is due already.
        let left = self.interval(motor).saturating_sub(self.elapsed).max(1);
        self.is_step = left <= LONGEST;
        self.lap_ticks = if self.is_step { left } else { PIECE };
        self.lap_ticks
    }

    /// Whether there is a step at the end of the interval under way.
    #[must_use]
    pub const fn is_step(&self) -> bool {
        self.is_step
    }

    /// Whether an interval is under way.
    #[must_use]
    pub const fn is_under_way(&self) -> bool {
        self.lap_ticks != 0
    }

    /// The direction of the next step; it changes at rest alone.
    #[must_use]
    pub const fn is_backward(&self) -> bool {
        self.is_backward
    }

    /// The steps that were made; wraps.
    #[must_use]
    pub const fn position(&self) -> i32 {
        self.position
    }

    /// What the target asks for: steps ahead, or a speed; negative against the direction of the motion.
    fn wanted(&self, motor: &MotorConfig) -> i64 {
        let ahead = if self.is_stopped {
            0
        } else if motor.is_velocity {
            i64::from(self.target)
        } else {
            i64::from(self.target) - i64::from(self.position)
        };
        if self.is_backward { -ahead } else { ahead }
    }

    /// Decides direction and speed of the next step; false at rest.
    fn choose(&mut self, motor: &MotorConfig) -> bool {
        let change = 2 * u64::from(motor.acceleration);
        let mut ahead = self.wanted(motor);
        // A motor that is as slow as after its first step, or slower, may stand at once.
        if ahead <= 0 && self.square < change {
            self.square = 0;
            self.speed = 0;
            if ahead == 0 {
                return false;
            }
            self.is_backward = !self.is_backward;
            ahead = -ahead;
        }
        self.next_square = if motor.is_velocity {
            approach(self.square, square_of(ahead.max(0).unsigned_abs() as u32), change)
        } else {
            self.toward(motor, ahead, change)
        };
        true
    }

    /// The speed may grow, or stay, as long as the steps that are needed to stop are no more than those that are left.
    fn toward(&self, motor: &MotorConfig, ahead: i64, change: u64) -> u64 {
        let room = (ahead - 1).max(0).unsigned_abs() * change;
        let faster = (self.square + change).min(square_of(motor.speed));
        if faster <= room {
            faster
        } else if self.square <= room {
            self.square
        } else {
            self.square.saturating_sub(change)
        }
    }

    /// The ticks of the next step: one step over the mean of the speeds at its ends.
    fn interval(&mut self, motor: &MotorConfig) -> u32 {
        let dividend = motor.tick_hz.wrapping_mul(512);
        self.next_speed =
            if self.next_square == self.square { self.speed } else { root(self.next_square) };
        let mut sum = self.speed + self.next_speed;
        if sum == 0 {
            // From rest to rest: it is fastest in the middle.
            sum = root(motor.acceleration.into()).max(1);
        }
        let rest = (dividend % sum) / ((sum >> 8) + 1) + self.fraction;
        self.next_fraction = rest & 0xFF;
        dividend / sum + (rest >> 8)
    }
}

fn square_of(speed: u32) -> u64 {
    u64::from(speed) * u64::from(speed)
}

fn approach(square: u64, wanted: u64, change: u64) -> u64 {
    if square < wanted {
        (square + change).min(wanted)
    } else {
        square.saturating_sub(change).max(wanted)
    }
}

/// The root of a square, rounded down, in 1/256: 16 digits of it at least.
fn root(square: u64) -> u32 {
    let mut wide = square << 16;
    let mut shift = 0;
    while wide >> 32 != 0 {
        wide >>= 2;
        shift += 1;
    }
    let (mut number, mut found, mut bit) = (wide as u32, 0_u32, 1_u32 << 30);
    while bit != 0 {
        if number >= found + bit {
            number -= found + bit;
            found = (found >> 1) + bit;
        } else {
            found >>= 1;
        }
        bit >>= 2;
    }
    found << shift
}

#[cfg(test)]
mod tests {
    use super::{MotorConfig, Stepper};
    use crate::scalar::Scalar;

    const MOTOR: MotorConfig =
        MotorConfig { tick_hz: 1_000_000, speed: 4_000, acceleration: 20_000, is_velocity: false };

    /// The times of all steps in seconds, and the position at the end.
    fn run(stepper: &mut Stepper, motor: &MotorConfig, target: i32) -> (f64, usize, i32) {
        stepper.command(motor, Scalar::Int32, &target.to_be_bytes());
        let (mut ticks, mut steps) = (0_u64, 0);
        loop {
            let lap = stepper.advance(motor);
            if lap == 0 {
                return (ticks as f64 / f64::from(motor.tick_hz), steps, stepper.position());
            }
            ticks += u64::from(lap);
            steps += usize::from(stepper.is_step());
        }
    }

    #[test]
    fn a_move_takes_the_time_of_its_trapezoid() {
        let mut stepper = Stepper::NEW;
        // 0.2 s up, 0.2 s down over 800 steps, and the rest at full speed.
        let (seconds, steps, position) = run(&mut stepper, &MOTOR, 10_000);
        assert_eq!((steps, position), (10_000, 10_000));
        assert!((seconds - 2.7).abs() < 0.001, "{seconds}");
        // A triangle: 100 steps up and 100 down at 20000 steps/s^2.
        let (seconds, steps, position) = run(&mut stepper, &MOTOR, 9_800);
        assert_eq!((steps, position), (200, 9_800));
        assert!((seconds - 0.2).abs() < 0.001, "{seconds}");
        // One step, half of it up and half down.
        let (seconds, steps, position) = run(&mut stepper, &MOTOR, 9_801);
        assert_eq!((steps, position), (1, 9_801));
        assert!((seconds - 2.0 / 20_000_f64.sqrt()).abs() < 0.0001, "{seconds}");
    }

    #[test]
    fn a_slow_motor_is_cut_into_pieces_and_takes_a_new_target_soon() {
        let motor = MotorConfig { speed: 1, acceleration: 1, is_velocity: true, ..MOTOR };
        let mut stepper = Stepper::NEW;
        stepper.command(&motor, Scalar::Int8, &[1]);
        assert_eq!(stepper.advance(&motor), 0x8000);
        stepper.stop();
        assert_eq!((stepper.advance(&motor), stepper.position()), (0, 0));
    }
}
