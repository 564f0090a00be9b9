//! What a run of plants came to, for people: paths over maps, courses, and figures in words.

use std::sync::Arc;

use sensedsl_plants::Map;

use super::on_wheels::RobotRun;
use super::run::{Plants, SharedPlants};
use crate::bench::Bench;
use crate::world::Course;

/// A point of a path: the time in nanoseconds, then metres to the right and upwards.
pub type Path = Vec<(u64, f64, f64)>;

/// A map and the path of the robot on it.
#[derive(Clone, Debug)]
pub struct Floor {
    /// The name of the robot.
    pub name: String,
    /// The map.
    pub map: Arc<Map>,
    /// Where the middle of its axle was.
    pub path: Path,
    /// The radius of its body in metres.
    pub body_m: f64,
    /// The direction that it looks in at the end, to the right and upwards, with a length of 1.
    pub looks: (f64, f64),
}

/// A device and what it came to.
#[derive(Clone, Debug)]
pub struct Told {
    /// Its name.
    pub name: String,
    /// The place of the element, if it is one of an array.
    pub element: Option<usize>,
    /// The unit that it shows; empty for none.
    pub unit: String,
    /// Whether it is an actuator.
    pub is_actuator: bool,
    /// Whether it is only on or off.
    pub is_switch: bool,
    /// Its values.
    pub course: Course,
}

/// What a run came to.
#[derive(Clone, Debug, Default)]
pub struct Story {
    /// Robots on their maps.
    pub floors: Vec<Floor>,
    /// What actuators did, then what sensors were given.
    pub courses: Vec<Told>,
    /// Figures in words, a line each.
    pub figures: Vec<String>,
    /// The end.
    pub end_ns: u64,
}

/// Where a robot is now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The middle of its axle, in metres to the right and upwards.
    pub at: (f64, f64),
    /// The direction that it looks in, to the right and upwards, with a length of 1.
    pub looks: (f64, f64),
}

impl Bench {
    /// Where each robot of the world is now, in the order of [`Story::floors`].
    #[must_use]
    pub fn stands(&self) -> Vec<Stand> {
        let Some(plants) = &self.plants else { return Vec::new() };
        let stand = |robot: &RobotRun| {
            let pose = robot.drive.pose();
            Stand { at: (pose.at.x, pose.at.y), looks: looks(pose.heading) }
        };
        plants.lock().robots.iter().map(stand).collect()
    }

    /// What the plants of the world have come to so far, in words, a line each.
    #[must_use]
    pub fn figures(&self) -> Vec<String> {
        self.plants.as_ref().map(|plants| figures(&plants.lock())).unwrap_or_default()
    }

    /// What the plants of the world have come to so far; `None` if it has none.
    #[must_use]
    pub fn story(&self, design: &sensedsl_model::design::Design) -> Option<Story> {
        self.plants.as_ref().map(|plants| story(plants, design))
    }
}

fn story(plants: &SharedPlants, design: &sensedsl_model::design::Design) -> Story {
    let plants = plants.lock();
    let named = |device, element: usize, course: &Course, is_actuator| {
        let device = design.device(device)?;
        let name = &device.name.value;
        let is_array = device.value.value.length.is_some();
        Some(Told {
            name: name.clone(),
            element: is_array.then_some(element),
            unit: device.shown.quantity.clone().unwrap_or_default(),
            is_actuator,
            is_switch: device.value.value.scalar == sensedsl_wire::ScalarType::Bool,
            course: course.clone(),
        })
    };
    let driven = plants.driven();
    let driven =
        driven.filter_map(|one| named(one.source.device, one.source.element, &one.course, true));
    let fed = plants.feeds.iter();
    let fed = fed.filter_map(|one| named(one.device, one.element, &one.course, false));
    let floors = plants.robots.iter().map(|robot| Floor {
        name: robot.name.clone(),
        map: Arc::clone(&robot.plant.map),
        path: robot.path.iter().map(|(at_ns, pose)| (*at_ns, pose.at.x, pose.at.y)).collect(),
        body_m: robot.plant.facts.body_m,
        looks: looks(robot.drive.pose().heading),
    });
    Story {
        floors: floors.collect(),
        courses: driven.chain(fed).collect(),
        figures: figures(&plants),
        end_ns: plants.now_ns,
    }
}

fn looks(heading: f64) -> (f64, f64) {
    (libm::cos(heading), libm::sin(heading))
}

fn figures(plants: &Plants) -> Vec<String> {
    let mut all = Vec::new();
    for robot in &plants.robots {
        let mut words = vec![format!("{:.2} m", robot.drive.travelled_m())];
        if let Some(last_ns) = robot.laps_ns.last() {
            let (count, seconds) = (robot.laps_ns.len(), crate::bench::seconds(*last_ns));
            let each = seconds / f64::from(u32::try_from(count).unwrap_or(u32::MAX));
            let laps = if count == 1 { "lap" } else { "laps" };
            words.push(format!("{count} {laps} of {each:.1} s"));
        }
        if robot.plant.map.begin().is_some() {
            words.push(format!("at most {:.1} mm off the line", 1e3 * robot.off_line_m));
        }
        if robot.clearance_m.is_finite() {
            words.push(format!("at least {:.0} mm from walls", 1e3 * robot.clearance_m.max(0.0)));
        }
        all.push(format!("{}: {}", robot.name, words.join(", ")));
    }
    for balancer in &plants.balancers {
        let (stood, lean) = (balancer.stood_s, balancer.most_lean.to_degrees());
        let ended = if balancer.balancer.has_fallen() { "fell after" } else { "stood for" };
        all.push(format!(
            "{}: {ended} {stood:.1} s, at most {lean:.1} deg, {:.2} m away",
            balancer.name, balancer.travelled_m
        ));
    }
    all
}
