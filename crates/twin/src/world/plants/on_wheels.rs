//! Robots on two wheels, on a map or to be balanced: their keys, and what stands for those that are not given.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use sensedsl_diagnostics::Span;
use sensedsl_diagnostics::codes::e0571_not_for_this_plant::does_not_fit;
use sensedsl_diagnostics::codes::e0572_not_a_map::not_a_map;
use sensedsl_plants::{BalancerFacts, DriveFacts, Map, Point, Pose};
use sensedsl_wire::ScalarType;

use super::super::units::Sort;
use super::Failed;
use super::table::{Keys, Value};
use crate::plants::{
    BalancerPlant, Feed, LineSensors, MotorPlant, Plant, Ranger, RobotPlant, What,
};

/// What sensors of a line show over a bright floor and over a line, as codes of a converter.
const BRIGHT: f64 = 300.0;
const DARK: f64 = 3_200.0;

impl<'i> Keys<'_, 'i> {
    pub(super) fn robot(&mut self) -> Result<RobotPlant, Failed> {
        let wheel_m = self.positive("wheel", Sort::Length, 0.065)?;
        let motors = self.motors(wheel_m)?;
        let facts = DriveFacts {
            wheel_m,
            track_m: self.positive("track", Sort::Length, 0.15)?,
            body_m: self.quantity("body", Sort::Length, 0.09)?,
        };
        let map = Arc::new(self.map()?);
        let start = self.start(&map)?;
        let line = self.line()?;
        let mut rangers = Vec::new();
        for value in self.list("ranger") {
            rangers.push(self.ranger(value, facts.body_m)?);
        }
        let bumper = self.feed("bumper", Sort::Contact, Some((0.0, 1.0)))?;
        let gyro = self.vector("gyro", Sort::Turning, 2)?;
        let accelerometer = self.vector("accelerometer", Sort::Acceleration, 0)?;
        let heading = self.feed("heading", Sort::Angle, Some((0.0, TAU)))?;
        let odometer = self.feed("odometer", Sort::Length, None)?;
        let speedometer = self.feed("speedometer", Sort::Speed, None)?;
        Ok(RobotPlant {
            motors,
            facts,
            map,
            start,
            line,
            rangers,
            bumper,
            gyro,
            accelerometer,
            heading,
            odometer,
            speedometer,
        })
    }

    pub(super) fn balancer(&mut self) -> Result<BalancerPlant, Failed> {
        let wheel_m = self.positive("wheel", Sort::Length, 0.08)?;
        let motors = self.motors(wheel_m)?;
        let fallen = self.positive("fallen", Sort::Angle, PI / 4.0)?;
        let height_m = self.positive("height", Sort::Length, 0.1)?;
        Ok(BalancerPlant {
            motors,
            facts: BalancerFacts { height_m, fallen },
            wheel_m,
            lean: self.quantity("lean", Sort::Angle, PI / 90.0)?,
            angle: self.feed("angle", Sort::Angle, Some((-fallen, fallen)))?,
            gyro: self.vector("gyro", Sort::Turning, 1)?,
            accelerometer: self.vector("accelerometer", Sort::Acceleration, 0)?,
        })
    }

    /// The names of the motors left and right. An actuator in the place of a motor gets one, which the table describes.
    fn motors(&mut self, wheel_m: f64) -> Result<[String; 2], Failed> {
        let encoders = self.encoders()?;
        let mut names = [String::new(), String::new()];
        let places = names.iter_mut().zip(["left", "right"]).zip(encoders);
        for ((name, key), encoder) in places {
            let example = format!("{key} = \"{}\"", if key == "left" { "Left" } else { "Right" });
            let Some((text, span)) = self.text(key, &example)? else {
                return Err(self.missing(key, &example));
            };
            if self.known.motors().any(|motor| motor == text) {
                if encoder.is_some() {
                    let why = format!("`{text}` is a motor with an encoder of its own");
                    let help = "write `encoder` in the table of the motor, and not here";
                    return Err(does_not_fit(span, &why, help).into());
                }
                text.clone_into(name);
                continue;
            }
            *name = format!("{}.{key}", self.name);
            let motor = self.wheel(text, span, (wheel_m, encoder))?;
            self.known.plants.push(Plant { name: name.clone(), what: What::Motor(motor) });
        }
        Ok(names)
    }

    /// The motor of a wheel, as the robot's own table describes it.
    fn wheel(
        &self,
        text: &str,
        span: Span,
        (wheel_m, encoder): (f64, Option<Feed>),
    ) -> Result<MotorPlant, Failed> {
        let source = self.source_of(text, span)?;
        let (facts, is_reversed) = self.motor_facts(Some(wheel_m))?;
        let (tachometer, current, temperature) = (None, None, None);
        Ok(MotorPlant { source, is_reversed, facts, encoder, tachometer, current, temperature })
    }

    /// The encoders of both wheels: an array of two, or a list of two sensors.
    fn encoders(&mut self) -> Result<[Option<Feed>; 2], Failed> {
        let list = self.list("encoders");
        let mut feeds = Vec::new();
        for value in &list {
            feeds.extend(self.feeds_of(value, Sort::Angle, None)?);
        }
        let count = feeds.len();
        match <[Feed; 2]>::try_from(feeds) {
            Ok(both) => Ok(both.map(Some)),
            Err(_) if list.is_empty() => Ok([None, None]),
            Err(_) => {
                let span = self.get("encoders").map_or(self.span, |value| self.span_of(value));
                let why = format!("a robot has two encoders, left and right, and here are {count}");
                let help = "write `encoders = [\"LeftWheel\", \"RightWheel\"]`, or an array of two";
                Err(does_not_fit(span, &why, help).into())
            }
        }
    }

    /// The map; an empty one without a name.
    fn map(&self) -> Result<Map, Failed> {
        let Some((file, span)) = self.text("map", "map = \"oval.svg\"")? else {
            return Ok(Map::default());
        };
        let failed = |why: &str| Box::new(not_a_map(span, file, why));
        let text = (self.reader.scene.samples)(file).map_err(|why| failed(&why))?;
        sensedsl_plants::read(&text).map_err(|error| {
            let before = text.get(..error.at).unwrap_or_default();
            let line = before.matches('\n').count() + 1;
            failed(&format!("{} (line {line})", error.why))
        })
    }

    /// Where it stands at the start: as the world says, at the begin of the first line, or in the middle. The world
    /// counts from the lower left corner of the drawing, the engine from the upper one.
    fn start(&mut self, map: &Map) -> Result<Pose, Failed> {
        let (width, height) = map.size;
        let middle = Pose { at: Point { x: width / 2.0, y: -height / 2.0 }, heading: 0.0 };
        let usual = map.begin().map_or(middle, |(at, heading)| Pose { at, heading });
        let Some(value) = self.get("start") else { return Ok(usual) };
        let Some(keys) = self.within(value) else {
            return Err(self.no_table(
                value,
                "start",
                "start = { x = \"0.3 m\", y = \"0.2 m\", heading = \"90 deg\" }",
            ));
        };
        let x = keys.quantity("x", Sort::Length, usual.at.x)?;
        let y = keys.quantity("y", Sort::Length, usual.at.y + height)? - height;
        let heading = keys.quantity("heading", Sort::Angle, usual.heading)?;
        keys.finish("`start`")?;
        Ok(Pose { at: Point { x, y }, heading })
    }

    /// The row of sensors over the floor.
    fn line(&mut self) -> Result<Option<LineSensors>, Failed> {
        let Some(value) = self.get("line") else { return Ok(None) };
        if value.get_ref().as_str().is_some() {
            return self.row(value, None, None, (0.07, 0.0095, 0.004)).map(Some);
        }
        let Some(mut keys) = self.within(value) else {
            return Err(self.no_table(
                value,
                "line",
                "line = { sensors = \"Line\", forwards = \"70 mm\" }",
            ));
        };
        let Some(sensors) = keys.get("sensors") else {
            return Err(keys.missing("sensors", "sensors = \"Line\""));
        };
        let places = (
            keys.quantity("forwards", Sort::Length, 0.07)?,
            keys.quantity("pitch", Sort::Length, 0.0095)?,
            keys.quantity("spot", Sort::Length, 0.008)? / 2.0,
        );
        let (bright, dark) = (keys.plain("bright")?, keys.plain("dark")?);
        let row = keys.row(sensors, bright, dark, places)?;
        keys.finish("`line`")?;
        Ok(Some(row))
    }

    fn row(
        &mut self,
        value: &Value<'i>,
        bright: Option<f64>,
        dark: Option<f64>,
        (forwards_m, pitch_m, spot_radius_m): (f64, f64, f64),
    ) -> Result<LineSensors, Failed> {
        let items: Vec<&Value<'i>> = match value.get_ref().as_array() {
            Some(list) => list.iter().collect(),
            None => vec![value],
        };
        let mut feeds = Vec::new();
        for item in items {
            for mut feed in self.feeds_of(item, Sort::Share, None)? {
                let ends = self.floor(&feed, bright, dark, self.span_of(item))?;
                feed.shows.offset = ends.0;
                feed.shows.factor = ends.1 - ends.0;
                feeds.push(feed);
            }
        }
        Ok(LineSensors { feeds, forwards_m, pitch_m, spot_radius_m })
    }

    /// What a sensor shows over a bright floor and over a line.
    fn floor(
        &self,
        feed: &Feed,
        bright: Option<f64>,
        dark: Option<f64>,
        span: Span,
    ) -> Result<(f64, f64), Failed> {
        if let Some(both) = bright.zip(dark) {
            return Ok(both);
        }
        let device = self.reader.scene.design.device(feed.device);
        let is_bool = device.is_some_and(|one| one.value.value.scalar == ScalarType::Bool);
        let is_plain =
            device.is_some_and(|one| one.kind.analog().is_some() && one.shown.is_plain());
        match (is_bool, is_plain) {
            (true, _) => Ok((bright.unwrap_or(0.0), dark.unwrap_or(1.0))),
            (_, true) => Ok((bright.unwrap_or(BRIGHT), dark.unwrap_or(DARK))),
            (false, false) => {
                let why = "what the sensors show over the floor and over a line is not known";
                let help = "write `line = { sensors = \"Line\", bright = 20, dark = 90 }`";
                Err(does_not_fit(span, why, help).into())
            }
        }
    }

    fn ranger(&mut self, value: &Value<'i>, body_m: f64) -> Result<Ranger, Failed> {
        if value.get_ref().as_str().is_some() {
            let feed = self.feed_of(value, Sort::Length, Some((0.0, 4.0)))?;
            let (forwards_m, left_m, heading) = (body_m, 0.0, 0.0);
            return Ok(Ranger { feed, forwards_m, left_m, heading, most_m: 4.0, opening: 0.0 });
        }
        let Some(mut keys) = self.within(value) else {
            return Err(self.no_table(
                value,
                "ranger",
                "ranger = { sensor = \"Front\", heading = \"0 deg\" }",
            ));
        };
        let Some(sensor) = keys.get("sensor") else {
            return Err(keys.missing("sensor", "sensor = \"Front\""));
        };
        let heading = keys.quantity("heading", Sort::Angle, 0.0)?;
        let most_m = keys.positive("range", Sort::Length, 4.0)?;
        let (sin, cos) = libm::sincos(heading);
        let ranger = Ranger {
            feed: keys.feed_of(sensor, Sort::Length, Some((0.0, most_m)))?,
            forwards_m: keys.quantity("forwards", Sort::Length, body_m * cos)?,
            left_m: keys.quantity("left", Sort::Length, body_m * sin)?,
            heading,
            most_m,
            opening: keys.quantity("opening", Sort::Angle, 0.0)?,
        };
        keys.finish("a ranger")?;
        Ok(ranger)
    }

    fn no_table(&self, value: &Value<'_>, key: &str, example: &str) -> Failed {
        let wanted = "a table, or the name of a sensor";
        let (span, what) = (self.span_of(value), format!("`{key}`"));
        sensedsl_diagnostics::codes::e0540_world_unreadable::wrong_sort(
            span, &what, wanted, example,
        )
        .into()
    }
}
