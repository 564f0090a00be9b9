//! A robot with a driven wheel on either side, on a map.

use libm::{cos, sin};

use crate::map::{Map, Point};

/// What is known of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveFacts {
    /// The diameter of its wheels in metres.
    pub wheel_m: f64,
    /// From wheel to wheel, in metres.
    pub track_m: f64,
    /// The radius of its body in metres: it stops where that touches a wall.
    pub body_m: f64,
}

/// Where it is, and where it looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// The middle of its axle.
    pub at: Point,
    /// Radians, counter-clockwise from the right.
    pub heading: f64,
}

/// A robot that drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    facts: DriveFacts,
    pose: Pose,
    speed: f64,
    push: f64,
    turn: f64,
    travelled_m: f64,
    is_touching: bool,
}

impl Drive {
    /// A robot that stands.
    #[must_use]
    pub const fn new(facts: DriveFacts, pose: Pose) -> Self {
        let (speed, push, turn) = (0.0, 0.0, 0.0);
        Self { facts, pose, speed, push, turn, travelled_m: 0.0, is_touching: false }
    }

    /// Drives for `dt_s` seconds while its wheels turn so often in it.
    pub fn step(&mut self, dt_s: f64, left_turns: f64, right_turns: f64, map: &Map) {
        if dt_s <= 0.0 {
            return;
        }
        let around = core::f64::consts::PI * self.facts.wheel_m;
        let (left, right) = (left_turns * around, right_turns * around);
        let way = (left + right) / 2.0;
        let turn = if self.facts.track_m > 0.0 { (right - left) / self.facts.track_m } else { 0.0 };
        // The chord of the arc, which is exact for wheels that turn evenly.
        let half = turn / 2.0;
        let chord = if half.abs() > 1e-9 { way * sin(half) / half } else { way };
        let heading = self.pose.heading + half;
        let next = Point {
            x: self.pose.at.x + chord * cos(heading),
            y: self.pose.at.y + chord * sin(heading),
        };
        self.pose.heading += turn;
        let (before, after) = (map.clearance(self.pose.at), map.clearance(next));
        self.is_touching = after < self.facts.body_m && after < before;
        let speed = if self.is_touching { 0.0 } else { way / dt_s };
        if !self.is_touching {
            self.pose.at = next;
            self.travelled_m += way.abs();
        }
        self.push = (speed - self.speed) / dt_s;
        self.speed = speed;
        self.turn = turn / dt_s;
    }

    /// Where it is.
    #[must_use]
    pub const fn pose(&self) -> Pose {
        self.pose
    }

    /// Metres a second, forwards positive.
    #[must_use]
    pub const fn speed(&self) -> f64 {
        self.speed
    }

    /// Metres a second squared, forwards positive.
    #[must_use]
    pub const fn push(&self) -> f64 {
        self.push
    }

    /// Radians a second, counter-clockwise positive.
    #[must_use]
    pub const fn turn(&self) -> f64 {
        self.turn
    }

    /// The length of its way in metres.
    #[must_use]
    pub const fn travelled_m(&self) -> f64 {
        self.travelled_m
    }

    /// Whether its body is at a wall that it drives against.
    #[must_use]
    pub const fn is_touching(&self) -> bool {
        self.is_touching
    }

    /// The place of something on the robot: metres forwards and to the left of the middle of its axle.
    #[must_use]
    pub fn place(&self, forwards_m: f64, left_m: f64) -> Point {
        let (x, y) = (cos(self.pose.heading), sin(self.pose.heading));
        Point {
            x: self.pose.at.x + forwards_m * x - left_m * y,
            y: self.pose.at.y + forwards_m * y + left_m * x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Piece;
    use core::f64::consts::{FRAC_PI_2, PI, TAU};

    const FACTS: DriveFacts = DriveFacts { wheel_m: 0.06, track_m: 0.15, body_m: 0.08 };

    /// A circle is closed, however long the steps are.
    #[test]
    fn it_drives_circles() {
        let radius = 0.5;
        for steps in [8_u32, 100, 5_000] {
            let mut robot = Drive::new(FACTS, Pose::default());
            let around = TAU / f64::from(steps);
            let turns = |side: f64| (radius + side) * around / (PI * FACTS.wheel_m);
            let (left, right) = (turns(-0.075), turns(0.075));
            (0..steps / 4).for_each(|_| robot.step(0.01, left, right, &Map::default()));
            let at = robot.pose().at;
            assert!(
                (at.x - radius).abs() < 1e-9 && (at.y - radius).abs() < 1e-9,
                "{steps}: {at:?}"
            );
            (0..steps - steps / 4).for_each(|_| robot.step(0.01, left, right, &Map::default()));
            let at = robot.pose().at;
            assert!(at.x.abs() < 1e-9 && at.y.abs() < 1e-9, "{steps}: {at:?}");
            assert!((robot.travelled_m() - TAU * radius).abs() < 1e-9);
        }
    }

    #[test]
    fn a_wall_stops_it_and_a_ray_measures_it() {
        let wall = Piece { from: Point { x: 1.0, y: -1.0 }, to: Point { x: 1.0, y: 1.0 } };
        let map = Map { walls: vec![wall], ..Map::default() };
        let mut robot = Drive::new(FACTS, Pose::default());
        assert_eq!(map.ray(robot.place(0.05, 0.0), 0.0, 4.0), Some(0.95));
        assert_eq!(map.ray(robot.place(0.05, 0.0), 0.0, 0.9), None);
        assert_eq!(map.ray(Point::default(), FRAC_PI_2, 4.0), None);
        (0..1_000).for_each(|_| robot.step(0.01, 0.05, 0.05, &map));
        assert!(robot.is_touching() && robot.speed() == 0.0);
        assert!((robot.pose().at.x - 0.92).abs() < 0.01, "{:?}", robot.pose());
        (0..10).for_each(|_| robot.step(0.01, -0.05, -0.05, &map));
        assert!(!robot.is_touching() && robot.pose().at.x < 0.85);
    }
}
