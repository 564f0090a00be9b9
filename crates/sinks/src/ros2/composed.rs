//! A message that several devices go out in: their values in, one after the other; the message with the latest of each
//! out, once with each value of the first.

use ros2_client::{Name, Node, Publisher};

use super::message::{BatteryState, Header, Imu, JointState, Joy, NavSatFix, NavSatStatus};
use super::topics::{publisher, vector};
use crate::config::Part;
use crate::event::Values;
use crate::plan::{Composed, Plan};

/// What a receiver that has found where it is says of itself, and one that has not.
const FIX: i8 = 0;
const NO_FIX: i8 = -1;
/// GPS: the definition has no word for a service that is not known before Jazzy.
const GPS: u16 = 1;

/// A topic, and what is known of its message so far.
pub(super) struct Together {
    latest: Vec<Option<f64>>,
    to: Topic,
}

enum Topic {
    Battery(Publisher<BatteryState>),
    Joy(Publisher<Joy>),
    Fix(Publisher<NavSatFix>),
    Joints(Publisher<JointState>),
    Imu(Publisher<Imu>),
}

impl Together {
    pub(super) fn new(node: &mut Node, of: &Composed, name: &Name) -> Result<Self, String> {
        let spec = of.message.spec.name;
        let kind = ("sensor_msgs", spec);
        let to = match spec {
            "BatteryState" => Topic::Battery(publisher(node, name, kind)?),
            "Joy" => Topic::Joy(publisher(node, name, kind)?),
            "NavSatFix" => Topic::Fix(publisher(node, name, kind)?),
            "JointState" => Topic::Joints(publisher(node, name, kind)?),
            "Imu" => Topic::Imu(publisher(node, name, kind)?),
            other => return Err(format!("there is no message `{other}`")),
        };
        Ok(Self { latest: vec![None; of.message.parts.len()], to })
    }

    /// Takes the values of a report, and publishes the message if they are of its first device.
    pub(super) fn take(
        &mut self,
        plan: &Plan,
        of: &Composed,
        values: &Values,
    ) -> Result<(), String> {
        let parts = of.message.parts.iter().zip(&of.sources);
        for ((part, (board, index)), latest) in parts.zip(&mut self.latest) {
            let Some(place) = plan.any_place(*board, *index) else { continue };
            let own = |(of, _): &&(usize, _)| *board == values.board && of == index;
            let Some((_, raw)) = values.values.iter().rfind(own) else { continue };
            if let Some(raw) = raw.get(part.element) {
                *latest = Some(place.number(*raw) * part.factor + part.offset);
            }
        }
        let Some((board, first)) = of.sources.first() else { return Ok(()) };
        let is_due = *board == values.board && values.values.iter().any(|(of, _)| of == first);
        let numbers: Option<Vec<f64>> = self.latest.iter().copied().collect();
        match numbers.filter(|_| is_due) {
            Some(numbers) => self.publish(plan, of, &numbers, values),
            None => Ok(()),
        }
    }

    fn publish(
        &self,
        plan: &Plan,
        of: &Composed,
        numbers: &[f64],
        values: &Values,
    ) -> Result<(), String> {
        let message = &of.message;
        let all = |field: &str| -> Vec<f64> {
            let own = message.parts.iter().zip(numbers).filter(|(part, _)| part.field == field);
            own.map(|(_, number)| *number).collect()
        };
        let one = |field: &str| all(field).first().copied();
        let first = of.sources.first().and_then(|(board, index)| plan.any_place(*board, *index));
        let frame = message.frame.as_deref().or(first.map(|place| place.route.frame.as_str()));
        let header = Header::new(values.taken, frame.unwrap_or_default());
        let done = match &self.to {
            Topic::Battery(to) => to.publish(battery(header, one, all)).map_err(drop),
            Topic::Joy(to) => to.publish(joy(header, all)).map_err(drop),
            Topic::Fix(to) => to.publish(fix(header, one, is_flag(plan, of))).map_err(drop),
            Topic::Joints(to) => {
                let name = names(of);
                let (position, velocity) = (all("position"), all("velocity"));
                let effort = all("effort");
                to.publish(JointState { header, name, position, velocity, effort }).map_err(drop)
            }
            Topic::Imu(to) => {
                let of = |field| Some(all(field)).filter(|all| !all.is_empty());
                let three = |field| of(field).map(|all| vector(&all));
                let imu = Imu::new(header, three("angular_velocity"), three("linear_acceleration"));
                to.publish(imu).map_err(drop)
            }
        };
        done.map_err(|()| format!("{} is not taken by the network", message.topic))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the message has no more digits")]
fn narrow(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|number| *number as f32).collect()
}

/// What is not measured is not a number, as the definition asks.
#[expect(clippy::cast_possible_truncation, reason = "the message has no more digits")]
fn battery(
    header: Header,
    one: impl Fn(&str) -> Option<f64>,
    all: impl Fn(&str) -> Vec<f64>,
) -> BatteryState {
    let of = |field| one(field).map_or(f32::NAN, |number| number as f32);
    BatteryState {
        header,
        voltage: of("voltage"),
        temperature: of("temperature"),
        current: of("current"),
        charge: of("charge"),
        capacity: of("capacity"),
        design_capacity: of("design_capacity"),
        percentage: of("percentage"),
        power_supply_status: 0,
        power_supply_health: 0,
        power_supply_technology: 0,
        present: true,
        cell_voltage: narrow(&all("cell_voltage")),
        cell_temperature: narrow(&all("cell_temperature")),
        location: String::new(),
        serial_number: String::new(),
    }
}

fn joy(header: Header, all: impl Fn(&str) -> Vec<f64>) -> Joy {
    let buttons = all("buttons").iter().map(|number| i32::from(*number != 0.0)).collect();
    Joy { header, axes: narrow(&all("axes")), buttons }
}

fn fix(header: Header, one: impl Fn(&str) -> Option<f64>, is_flag: bool) -> NavSatFix {
    #[expect(clippy::cast_possible_truncation, reason = "a number beyond is the nearest one")]
    let status = match one("status") {
        None => FIX,
        Some(0.0) if is_flag => NO_FIX,
        Some(_) if is_flag => FIX,
        Some(number) => number.round() as i8,
    };
    NavSatFix {
        header,
        status: NavSatStatus { status, service: GPS },
        latitude: one("latitude").unwrap_or(f64::NAN),
        longitude: one("longitude").unwrap_or(f64::NAN),
        altitude: one("altitude").unwrap_or(f64::NAN),
        position_covariance: [0.0; 9],
        position_covariance_type: 0,
    }
}

/// Whether the status of a receiver is on or off, and no number.
fn is_flag(plan: &Plan, of: &Composed) -> bool {
    let place = of.message.parts.iter().position(|part| part.field == "status");
    let source = place.and_then(|place| of.sources.get(place));
    let place = source.and_then(|(board, index)| plan.any_place(*board, *index));
    place.is_some_and(|place| place.is_bool())
}

/// The names of joints: those of the file, or of the devices.
fn names(of: &Composed) -> Vec<String> {
    if !of.message.names.is_empty() {
        return of.message.names.clone();
    }
    let joints: Vec<_> = of.message.parts.iter().filter(|part| part.field == "position").collect();
    let is_alone = |device: &str| joints.iter().filter(|part| part.device == device).count() == 1;
    let name = |part: &&Part| {
        if is_alone(&part.device) {
            part.device.clone()
        } else {
            format!("{}_{}", part.device, part.element)
        }
    };
    joints.iter().map(name).collect()
}
