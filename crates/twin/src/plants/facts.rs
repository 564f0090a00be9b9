//! What a world says of its plants: plain data, with devices by their places in the design.

use std::sync::Arc;

use sensedsl_model::design::DeviceIndex;
use sensedsl_plants::{
    BalancerFacts, BatteryFacts, DriveFacts, HeaterFacts, Map, MotorFacts, Pose, ServoFacts,
};

use crate::world::Course;

/// A plant of a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// Its name in the world.
    pub name: String,
    pub(crate) what: What,
}

impl Plant {
    /// The command of a program that is a plant, and the name under which it is attached; `None` for other plants.
    #[must_use]
    pub fn command(&self) -> Option<&[String]> {
        match &self.what {
            What::Process(process) => Some(&process.command),
            What::Motor(_)
            | What::Servo(_)
            | What::Robot(_)
            | What::Balancer(_)
            | What::Heater(_)
            | What::Battery(_) => None,
        }
    }
}

impl Plant {
    /// All sensors that it feeds.
    pub(crate) fn feeds(&self) -> Vec<Feed> {
        let mut all = Vec::new();
        match &self.what {
            What::Motor(motor) => {
                all.extend(motor.encoder.iter().chain(&motor.tachometer));
                all.extend(motor.current.iter().chain(&motor.temperature));
            }
            What::Servo(servo) => all.extend(&servo.angle),
            What::Robot(robot) => {
                all.extend(robot.line.iter().flat_map(|line| &line.feeds));
                all.extend(robot.rangers.iter().map(|ranger| &ranger.feed));
                all.extend(&robot.bumper);
                all.extend(robot.gyro.iter().chain(&robot.accelerometer).flatten());
                let others = robot.heading.iter().chain(&robot.odometer);
                all.extend(others.chain(&robot.speedometer));
            }
            What::Balancer(robot) => {
                all.extend(&robot.angle);
                all.extend(robot.gyro.iter().chain(&robot.accelerometer).flatten());
            }
            What::Heater(heater) => all.extend(&heater.temperatures),
            What::Battery(battery) => all.extend(battery.voltage.iter().chain(&battery.current)),
            What::Process(process) => all.extend(process.sensors.iter().flat_map(|one| &one.1)),
        }
        all.into_iter().cloned().collect()
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum What {
    Motor(MotorPlant),
    Servo(ServoPlant),
    Robot(Box<RobotPlant>),
    Balancer(Box<BalancerPlant>),
    Heater(HeaterPlant),
    Battery(BatteryPlant),
    Process(ProcessPlant),
}

/// An element of an actuator, which drives a plant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Source {
    pub(crate) device: DeviceIndex,
    pub(crate) element: usize,
    /// The value at full drive, as it is shown.
    pub(crate) full: f64,
}

/// An element of a sensor, which a plant feeds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Feed {
    pub(crate) device: DeviceIndex,
    pub(crate) element: usize,
    pub(crate) course: Course,
    pub(crate) shows: Shows,
    /// The greatest deviation by chance, up or down, as it is shown.
    pub(crate) noise: f64,
}

/// How the sensor shows what the plant gives: a straight line, within a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shows {
    pub(crate) factor: f64,
    pub(crate) offset: f64,
    pub(crate) range: Option<(f64, f64)>,
    /// Whether it counts edges, whichever way a wheel turns.
    pub(crate) is_counter: bool,
}

impl Feed {
    /// The plant gives a value, in its own unit.
    pub(crate) fn put(&self, at_ns: u64, value: f64) {
        self.put_shown(at_ns, self.shows.factor * value + self.shows.offset);
    }

    /// The plant gives a value as it is shown.
    pub(crate) fn put_shown(&self, at_ns: u64, shown: f64) {
        let within = self.shows.range.map_or(shown, |(low, high)| shown.max(low).min(high));
        self.course.push(at_ns, within);
    }

    /// The plant has turned: from where it began, and both ways together.
    pub(crate) fn turned(&self, at_ns: u64, (angle, travel): (f64, f64)) {
        self.put(at_ns, if self.shows.is_counter { travel } else { angle });
    }
}

/// Feeds of the axes of something that measures along three: forwards, to the left, upwards.
pub(crate) type Vector = [Option<Feed>; 3];

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MotorPlant {
    pub(crate) source: Source,
    pub(crate) is_reversed: bool,
    pub(crate) facts: MotorFacts,
    pub(crate) encoder: Option<Feed>,
    pub(crate) tachometer: Option<Feed>,
    pub(crate) current: Option<Feed>,
    pub(crate) temperature: Option<Feed>,
}

/// What an actuator tells a servo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// The angles at the least and the greatest value, and these values as they are shown.
    Between { angles: (f64, f64), ends: (f64, f64) },
    /// The angle itself, in radians for each unit that is shown.
    Angle(f64),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ServoPlant {
    pub(crate) source: Source,
    pub(crate) goal: Goal,
    pub(crate) facts: ServoFacts,
    pub(crate) start: f64,
    pub(crate) angle: Option<Feed>,
}

/// Sensors in a row over the floor, from left to right.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LineSensors {
    pub(crate) feeds: Vec<Feed>,
    pub(crate) forwards_m: f64,
    pub(crate) pitch_m: f64,
    pub(crate) spot_radius_m: f64,
}

/// A sensor of distance to walls.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ranger {
    pub(crate) feed: Feed,
    pub(crate) forwards_m: f64,
    pub(crate) left_m: f64,
    pub(crate) heading: f64,
    pub(crate) most_m: f64,
    pub(crate) opening: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RobotPlant {
    /// The names of its motors, left and right.
    pub(crate) motors: [String; 2],
    pub(crate) facts: DriveFacts,
    pub(crate) map: Arc<Map>,
    pub(crate) start: Pose,
    pub(crate) line: Option<LineSensors>,
    pub(crate) rangers: Vec<Ranger>,
    pub(crate) bumper: Option<Feed>,
    pub(crate) gyro: Vector,
    pub(crate) accelerometer: Vector,
    pub(crate) heading: Option<Feed>,
    pub(crate) odometer: Option<Feed>,
    pub(crate) speedometer: Option<Feed>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BalancerPlant {
    /// The names of its motors, left and right.
    pub(crate) motors: [String; 2],
    pub(crate) facts: BalancerFacts,
    pub(crate) wheel_m: f64,
    pub(crate) lean: f64,
    pub(crate) angle: Option<Feed>,
    pub(crate) gyro: Vector,
    pub(crate) accelerometer: Vector,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HeaterPlant {
    pub(crate) source: Source,
    pub(crate) facts: HeaterFacts,
    pub(crate) start: f64,
    pub(crate) temperatures: Vec<Feed>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BatteryPlant {
    pub(crate) facts: BatteryFacts,
    pub(crate) left: f64,
    /// What the rest of the robot draws, in amperes.
    pub(crate) draws: f64,
    /// The names of the motors and heaters that it supplies.
    pub(crate) supplies: Vec<String>,
    pub(crate) voltage: Option<Feed>,
    pub(crate) current: Option<Feed>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ProcessPlant {
    pub(crate) command: Vec<String>,
    pub(crate) step_ns: u64,
    /// The actuators that it is told of, with their names and numbers of elements.
    pub(crate) sets: Vec<(String, DeviceIndex, usize)>,
    /// The sensors that it gives, a feed for each element, in the order of the world.
    pub(crate) sensors: Vec<(String, Vec<Feed>)>,
}
