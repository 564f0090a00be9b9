//! What drives on wheels while a board runs: robots on maps, and robots that must be balanced.

use std::f64::consts::TAU;

use sensedsl_plants::{Balancer, Drive, Pose};

use super::run::MotorRun;
use super::{BalancerPlant, Feed, LineSensors, Ranger, RobotPlant, Vector};

/// Metres a second squared.
const GRAVITY: f64 = 9.81;
/// The time between two points of a path, and the points that are kept of it.
const PATH_NS: u64 = 20_000_000;
const PATH_POINTS: usize = 1 << 16;
/// Rays of the cone of a ranger.
const RAYS: u8 = 5;

pub(super) struct RobotRun {
    pub(super) name: String,
    pub(super) plant: RobotPlant,
    pub(super) drive: Drive,
    /// Where it was, with times.
    pub(super) path: Vec<(u64, Pose)>,
    path_ns: u64,
    /// The greatest distance of its axle from the middle of a line so far.
    pub(super) off_line_m: f64,
    /// The least distance of its body from a wall so far.
    pub(super) clearance_m: f64,
    /// The times at which it came past its start again, forwards.
    pub(super) laps_ns: Vec<u64>,
    /// How far in front of its start it was, along the way that it looked there.
    ahead_m: f64,
    /// Whether it has been elsewhere since it was at its start.
    is_away: bool,
}

impl RobotRun {
    pub(super) fn new(name: String, plant: &RobotPlant) -> Self {
        let drive = Drive::new(plant.facts, plant.start);
        Self {
            name,
            plant: plant.clone(),
            drive,
            path: vec![(0, plant.start)],
            path_ns: PATH_NS,
            off_line_m: 0.0,
            clearance_m: f64::INFINITY,
            laps_ns: Vec::new(),
            ahead_m: 0.0,
            is_away: false,
        }
    }

    pub(super) fn step(&mut self, dt_s: f64, next_ns: u64, motors: &[MotorRun]) {
        let [left, right] = turned(motors, &self.plant.motors);
        self.drive.step(dt_s, left, right, &self.plant.map);
        let (pose, map) = (self.drive.pose(), &self.plant.map);
        let off_line_m = map.off_line(pose.at);
        if off_line_m.is_finite() {
            self.off_line_m = self.off_line_m.max(off_line_m);
        }
        let clearance_m = map.clearance(pose.at) - self.plant.facts.body_m;
        self.clearance_m = self.clearance_m.min(clearance_m);
        self.pass(next_ns, pose);
        if next_ns.is_multiple_of(self.path_ns) {
            self.path.push((next_ns, pose));
            if self.path.len() >= PATH_POINTS {
                // Half of the points, and from now on half as many.
                let mut place = 0_usize;
                self.path.retain(|_| {
                    place += 1;
                    place % 2 == 1
                });
                self.path_ns *= 2;
            }
        }
    }

    /// Counts when it comes past its start, forwards and not far beside it.
    fn pass(&mut self, next_ns: u64, pose: Pose) {
        let start = self.plant.start;
        let (x, y) = (libm::cos(start.heading), libm::sin(start.heading));
        let (dx, dy) = (pose.at.x - start.at.x, pose.at.y - start.at.y);
        let (ahead_m, beside_m) = (dx * x + dy * y, dy * x - dx * y);
        let is_there = beside_m.abs() < self.plant.facts.track_m;
        let is_forwards = libm::cos(pose.heading - start.heading) > 0.5;
        // Who goes to and fro at the start makes no laps.
        self.is_away |= libm::hypot(dx, dy) > 4.0 * self.plant.facts.track_m;
        if self.ahead_m < 0.0 && ahead_m >= 0.0 && is_there && is_forwards && self.is_away {
            self.laps_ns.push(next_ns);
            self.is_away = false;
        }
        self.ahead_m = ahead_m;
    }

    pub(super) fn tell(&self, at_ns: u64) {
        let (plant, drive) = (&self.plant, &self.drive);
        let put = |feed: &Option<Feed>, value: f64| {
            if let Some(feed) = feed {
                feed.put(at_ns, value);
            }
        };
        if let Some(line) = &plant.line {
            self.look_down(at_ns, line);
        }
        for ranger in &plant.rangers {
            ranger.feed.put(at_ns, self.distance(ranger));
        }
        put(&plant.bumper, f64::from(u8::from(drive.is_touching())));
        put_all(&plant.gyro, at_ns, [0.0, 0.0, drive.turn()]);
        let inwards = drive.speed() * drive.turn();
        put_all(&plant.accelerometer, at_ns, [drive.push(), inwards, GRAVITY]);
        // A compass counts clockwise from the top of the map.
        let north = TAU / 4.0 - drive.pose().heading;
        put(&plant.heading, north - TAU * libm::floor(north / TAU));
        put(&plant.odometer, drive.travelled_m());
        put(&plant.speedometer, drive.speed());
    }

    /// How dark it is under each sensor of the row.
    fn look_down(&self, at_ns: u64, line: &LineSensors) {
        let count = u32::try_from(line.feeds.len()).unwrap_or(u32::MAX);
        let middle = f64::from(count.saturating_sub(1)) / 2.0;
        for (place, feed) in (0_u32..).zip(&line.feeds) {
            let left_m = (middle - f64::from(place)) * line.pitch_m;
            let at = self.drive.place(line.forwards_m, left_m);
            feed.put(at_ns, self.plant.map.darkness(at, line.spot_radius_m));
        }
    }

    /// The distance of the nearest wall in the cone of a ranger.
    fn distance(&self, ranger: &Ranger) -> f64 {
        let from = self.drive.place(ranger.forwards_m, ranger.left_m);
        let heading = self.drive.pose().heading + ranger.heading;
        let rays = if ranger.opening > 0.0 { RAYS } else { 1 };
        let between = ranger.opening / f64::from(RAYS - 1);
        let first = if rays > 1 { -ranger.opening / 2.0 } else { 0.0 };
        let ray = |number: u8| {
            let beside = first + f64::from(number) * between;
            self.plant.map.ray(from, heading + beside, ranger.most_m)
        };
        (0..rays).filter_map(ray).fold(ranger.most_m, f64::min)
    }
}

fn put_all(feeds: &Vector, at_ns: u64, values: [f64; 3]) {
    for (feed, value) in feeds.iter().zip(values) {
        if let Some(feed) = feed {
            feed.put(at_ns, value);
        }
    }
}

/// The turns of two motors in the last step.
fn turned(motors: &[MotorRun], names: &[String; 2]) -> [f64; 2] {
    names.each_ref().map(|name| {
        motors.iter().find(|motor| motor.name == *name).map_or(0.0, |motor| motor.turned)
    })
}

pub(super) struct BalancerRun {
    pub(super) name: String,
    plant: BalancerPlant,
    pub(super) balancer: Balancer,
    speed: f64,
    push: f64,
    /// The time for which it has stood.
    pub(super) stood_s: f64,
    /// Its greatest lean so far.
    pub(super) most_lean: f64,
    pub(super) travelled_m: f64,
}

impl BalancerRun {
    pub(super) fn new(name: String, plant: &BalancerPlant) -> Self {
        let balancer = Balancer::new(plant.facts, plant.lean);
        Self {
            name,
            plant: plant.clone(),
            balancer,
            speed: 0.0,
            push: 0.0,
            stood_s: 0.0,
            most_lean: plant.lean.abs(),
            travelled_m: 0.0,
        }
    }

    pub(super) fn step(&mut self, dt_s: f64, motors: &[MotorRun]) {
        let [left, right] = turned(motors, &self.plant.motors);
        let around = std::f64::consts::PI * self.plant.wheel_m;
        let way = (left + right) / 2.0 * around;
        let speed = way / dt_s;
        (self.push, self.speed) = ((speed - self.speed) / dt_s, speed);
        self.balancer.step(dt_s, speed);
        self.most_lean = self.most_lean.max(self.balancer.lean().abs());
        if !self.balancer.has_fallen() {
            self.stood_s += dt_s;
            self.travelled_m += way;
        }
    }

    pub(super) fn tell(&self, at_ns: u64) {
        let lean = self.balancer.lean();
        if let Some(feed) = &self.plant.angle {
            feed.put(at_ns, lean);
        }
        // Forwards is a turn about the axis to the left.
        put_all(&self.plant.gyro, at_ns, [0.0, self.balancer.rate(), 0.0]);
        let push = if self.balancer.has_fallen() { 0.0 } else { self.push };
        let (sin, cos) = libm::sincos(lean);
        let [forwards, up] = [push * cos - GRAVITY * sin, push * sin + GRAVITY * cos];
        put_all(&self.plant.accelerometer, at_ns, [forwards, 0.0, up]);
    }
}
