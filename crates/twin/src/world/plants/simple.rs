//! Motors, servos, heaters, batteries and programs: their keys, and what stands for those that are not given.

use std::f64::consts::TAU;

use sensedsl_diagnostics::codes::e0540_world_unreadable as unreadable;
use sensedsl_diagnostics::codes::e0541_world_unknown as unknown;
use sensedsl_diagnostics::codes::e0571_not_for_this_plant::does_not_fit;
use sensedsl_diagnostics::nearest;
use sensedsl_model::design::Device;
use sensedsl_model::kind::Interface;
use sensedsl_plants::{BatteryFacts, HeaterFacts, MotorFacts, ServoFacts};
use sensedsl_wire::Direction;

use super::super::units::{Sort, unit};
use super::Failed;
use super::table::Keys;
use crate::plants::{
    BatteryPlant, Goal, HeaterPlant, MotorPlant, ProcessPlant, ServoPlant, Source, What,
};
use crate::truth::scale_of;

const ROOM_CELSIUS: f64 = 20.0;
/// The angles of a servo at its shortest and its longest pulse.
const SERVO_ENDS: f64 = TAU / 4.0;
/// What servos take, where a part is told the width of pulses.
const PULSES_US: (f64, f64) = (1_000.0, 2_000.0);
const MS_NS: u64 = 1_000_000;

impl Keys<'_, '_> {
    /// What is known of a motor, and whether it runs the other way round.
    pub(super) fn motor_facts(&self, wheel_m: Option<f64>) -> Result<(MotorFacts, bool), Failed> {
        let usual = 200.0 / 60.0 * TAU;
        // A motor with a wheel may be described by how fast that drives.
        let is_speed = |text: &str| super::super::units::read(text, Sort::Speed).is_some();
        let text = self.get("speed").and_then(|value| value.get_ref().as_str());
        let turning = match wheel_m.filter(|_| text.is_some_and(is_speed)) {
            Some(wheel_m) => self.positive("speed", Sort::Speed, 0.0)? / (wheel_m / 2.0),
            None => self.positive("speed", Sort::Turning, usual)?,
        };
        let facts = MotorFacts {
            no_load_turns: turning / TAU,
            settling_s: self.seconds("settling", 0.1)?,
            dead_zone: self.share("dead_zone", 0.05)?,
            load: self.share("load", 0.0)?,
            stall_amperes: self.positive("stall_current", Sort::Current, 1.5)?,
            stall_rise_kelvin: self.quantity("stall_rise", Sort::Warmth, 60.0)?,
            warming_s: self.seconds("warming", 60.0)?,
            room_celsius: self.quantity("room", Sort::Temperature, ROOM_CELSIUS)?,
        };
        Ok((facts, self.flag("reversed")?))
    }

    pub(super) fn motor(&mut self) -> Result<MotorPlant, Failed> {
        let source = self.source("drive")?;
        let (facts, is_reversed) = self.motor_facts(None)?;
        let fastest = facts.no_load_turns * TAU;
        let rise = facts.stall_rise_kelvin;
        let warm = (facts.room_celsius, facts.room_celsius + rise);
        let (least, most) = (-2.0 * facts.stall_amperes, 2.0 * facts.stall_amperes);
        Ok(MotorPlant {
            source,
            is_reversed,
            facts,
            encoder: self.feed("encoder", Sort::Angle, None)?,
            tachometer: self.feed("tachometer", Sort::Turning, Some((-fastest, fastest)))?,
            current: self.feed("current", Sort::Current, Some((least, most)))?,
            temperature: self.feed("temperature", Sort::Temperature, Some(warm))?,
        })
    }

    pub(super) fn servo(&mut self) -> Result<ServoPlant, Failed> {
        let source = self.source("drive")?;
        let angles = self.angles("angles")?;
        let usual = angles.unwrap_or((-SERVO_ENDS, SERVO_ENDS));
        let goal = self.goal(&source, angles)?;
        let given = self.angles("stops")?;
        let (one, other) = given.unwrap_or(match goal {
            Goal::Between { angles, .. } => angles,
            Goal::Angle(_) => usual,
        });
        let stops = (one.min(other), one.max(other));
        let middle = f64::midpoint(stops.0, stops.1);
        let start = self.quantity("start", Sort::Angle, middle)?.max(stops.0).min(stops.1);
        let rate = self.positive("rate", Sort::Turning, 400.0 / 360.0 * TAU)?;
        let facts = ServoFacts { rate, stops };
        let angle = self.feed("angle", Sort::Angle, Some(stops))?;
        Ok(ServoPlant { source, goal, facts, start, angle })
    }

    /// What the actuator of a servo tells it: an angle, if it shows one and the world says nothing else.
    fn goal(&self, source: &Source, angles: Option<(f64, f64)>) -> Result<Goal, Failed> {
        let Some(device) = self.device_of(source) else { return Ok(Goal::Angle(0.0)) };
        let shown = device.shown.quantity.as_deref().and_then(|name| unit(name, Sort::Angle));
        if let (Some((each, _)), None) = (shown, angles) {
            return Ok(Goal::Angle(each));
        }
        let angles = angles.unwrap_or((-SERVO_ENDS, SERVO_ENDS));
        let given = self.pair("pulses", "pulses = [1000, 2000]")?;
        let given = given.and_then(|[one, other]| {
            let number =
                |value: &super::table::Value<'_>| super::super::entry::number(value.get_ref());
            number(one).zip(number(other))
        });
        let ends = given.or_else(|| ends_of(device)).ok_or_else(|| {
            let span = self.get("drive").map_or(self.span, |value| self.span_of(value));
            let why = format!(
                "`{}` does not say what it is set to at the ends of the servo",
                device.name.value
            );
            does_not_fit(span, &why, "add what it shows there: `pulses = [1000, 2000]`")
        })?;
        Ok(Goal::Between { angles, ends })
    }

    /// Two angles.
    fn angles(&self, key: &'static str) -> Result<Option<(f64, f64)>, Failed> {
        let Some([one, other]) = self.pair(key, "[\"-90 deg\", \"90 deg\"]")? else {
            return Ok(None);
        };
        let angle = |value| self.amount(key, value, Sort::Angle);
        Ok(Some((angle(one)?, angle(other)?)))
    }

    pub(super) fn heater(&mut self) -> Result<HeaterPlant, Failed> {
        let source = self.source("drive")?;
        let room_celsius = self.quantity("room", Sort::Temperature, ROOM_CELSIUS)?;
        let facts = HeaterFacts {
            watts: self.positive("power", Sort::Power, 40.0)?,
            kelvin_per_watt: self.positive("rise", Sort::Insulation, 2.0)?,
            settling_s: self.seconds("settling", 120.0)?,
            room_celsius,
        };
        let start = self.quantity("start", Sort::Temperature, room_celsius)?;
        let most = room_celsius + facts.watts * facts.kelvin_per_watt;
        let bounds = (start.min(room_celsius), start.max(most));
        let mut temperatures = Vec::new();
        for value in self.list("temperature") {
            temperatures.push(self.feed_of(value, Sort::Temperature, Some(bounds))?);
        }
        Ok(HeaterPlant { source, facts, start, temperatures })
    }

    pub(super) fn battery(&mut self) -> Result<BatteryPlant, Failed> {
        let full_volts = self.positive("full", Sort::Voltage, 8.4)?;
        let facts = BatteryFacts {
            full_volts,
            empty_volts: self.quantity("empty", Sort::Voltage, 0.76 * full_volts)?,
            capacity_coulombs: self.positive("capacity", Sort::Charge, 2.2 * 3_600.0)?,
            ohms: self.quantity("resistance", Sort::Resistance, 0.1)?,
        };
        let supplies = self.supplied()?;
        let bounds = Some((0.0, full_volts));
        Ok(BatteryPlant {
            facts,
            left: self.share("charge", 1.0)?,
            draws: self.quantity("draws", Sort::Current, 0.1)?,
            supplies,
            voltage: self.feed("voltage", Sort::Voltage, bounds)?,
            current: self.feed("current", Sort::Current, None)?,
        })
    }

    /// The motors and heaters that a battery supplies: those of its list, or all.
    fn supplied(&self) -> Result<Vec<String>, Failed> {
        let own = |name: &str| -> Vec<String> {
            let found = self.known.plants.iter().find(|one| one.name == name);
            match found.map(|one| (&one.name, &one.what)) {
                Some((name, What::Motor(_) | What::Heater(_))) => vec![name.clone()],
                Some((_, What::Robot(robot))) => robot.motors.to_vec(),
                Some((_, What::Balancer(robot))) => robot.motors.to_vec(),
                Some((_, What::Servo(_) | What::Battery(_) | What::Process(_))) | None => {
                    Vec::new()
                }
            }
        };
        let names: Vec<&str> = self.known.plants.iter().map(|one| one.name.as_str()).collect();
        let list = self.list("supplies");
        if list.is_empty() {
            return Ok(names.into_iter().flat_map(own).collect());
        }
        let mut all = Vec::new();
        for value in list {
            let (text, span) = (value.get_ref().as_str().unwrap_or_default(), self.span_of(value));
            let supplied = own(text);
            if supplied.is_empty() {
                let near = nearest(text, names.iter().copied());
                let place = "`supplies`, which takes motors, heaters and robots";
                let list = if names.is_empty() { "none yet".to_owned() } else { names.join(", ") };
                return Err(unknown::unknown_word(span, text, place, near, &list).into());
            }
            all.extend(supplied);
        }
        Ok(all)
    }

    pub(super) fn process(&mut self) -> Result<ProcessPlant, Failed> {
        let example = "command = [\"python3\", \"plant.py\"]";
        let list = self.list("command");
        let word = |value: &&super::table::Value<'_>| value.get_ref().as_str().map(str::to_owned);
        let command: Option<Vec<String>> = list.iter().map(word).collect();
        let command = match command {
            Some(command) if command.is_empty() => return Err(self.missing("command", example)),
            Some(command) => command,
            None => {
                let span = self.get("command").map_or(self.span, |value| self.span_of(value));
                let wanted = "a list of texts: the program, then its arguments";
                return Err(unreadable::wrong_sort(span, "`command`", wanted, example).into());
            }
        };
        if self.get("step").is_none() {
            return Err(self.missing("step", "step = \"5 ms\""));
        }
        let step_ns = self.time_ns("step", MS_NS)?;
        if !step_ns.is_multiple_of(MS_NS) {
            let span = self.get("step").map_or(self.span, |value| self.span_of(value));
            let wanted = "a whole number of milliseconds";
            return Err(unreadable::wrong_sort(span, "`step`", wanted, "step = \"5 ms\"").into());
        }
        let mut sensors = Vec::new();
        for value in self.list("sensors") {
            sensors.push(self.shown_feeds(value)?);
        }
        if sensors.is_empty() {
            return Err(self.missing("sensors", "sensors = [\"Front\"]"));
        }
        Ok(ProcessPlant { command, step_ns, sets: self.sets()?, sensors })
    }

    /// The actuators that a program is told of: those of its list, or all that move something.
    fn sets(&self) -> Result<Vec<(String, sensedsl_model::design::DeviceIndex, usize)>, Failed> {
        let scene = self.reader.scene;
        let of =
            |index, device: &Device| (device.name.value.clone(), index, device.value.value.count());
        if self.get("set").is_none() {
            let here = scene.devices.iter().filter_map(|at| Some((*at, scene.design.device(*at)?)));
            let is_moved =
                |one: &Device| one.direction == Direction::Actuator && one.kind.code().is_none();
            return Ok(here
                .filter(|(_, one)| is_moved(one))
                .map(|(at, one)| of(at, one))
                .collect());
        }
        let mut all = Vec::new();
        for value in self.list("set") {
            let text = value.get_ref().as_str().unwrap_or_default();
            let (index, device) = self.actuator(text, self.span_of(value))?;
            all.push(of(index, device));
        }
        Ok(all)
    }
}

/// What an actuator shows at its one end and at the other; `None` if nothing tells.
fn ends_of(device: &Device) -> Option<(f64, f64)> {
    let scale = scale_of(&device.shown);
    match device.kind.interface() {
        Interface::Pwm(_) => Some((scale.shown(0.0), scale.shown(10_000.0))),
        Interface::Dac(_) => Some((scale.shown(0.0), scale.shown(4_095.0))),
        Interface::Analog(_)
        | Interface::Digital(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => {
            let is_pulse = device.shown.quantity.as_deref() == Some("us");
            let own = device.shown.min.zip(device.shown.max);
            own.or_else(|| is_pulse.then_some(PULSES_US))
        }
    }
}
