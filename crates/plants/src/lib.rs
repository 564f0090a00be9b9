//! What a robot's outputs do to the world that its sensors measure.
//!
//! In: what motors, servos and heaters are driven with, for a step of time. Out: speeds, angles, temperatures, a pose on
//! a map, and what sensors on the robot would see there. Everything is in SI units, but turns for wheels and degrees
//! Celsius for temperatures; a share of full drive goes from -1 to 1. The crate knows no devices, files or clocks, and
//! takes its mathematics from `libm`, so that a run is the same on every machine.

mod balancer;
mod battery;
mod drive;
mod heater;
mod map;
mod motor;
mod servo;
mod shapes;

pub use balancer::{Balancer, BalancerFacts};
pub use battery::{Battery, BatteryFacts};
pub use drive::{Drive, DriveFacts, Pose};
pub use heater::{Heater, HeaterFacts};
pub use map::{Map, Point, Stroke};
pub use motor::{Motor, MotorFacts};
pub use servo::{Servo, ServoFacts};
pub use shapes::{MapError, read};
