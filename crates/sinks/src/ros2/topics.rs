//! One topic of ROS 2: a device's raw value in, its message out; or a message in, a value to be set out.

use std::time::Duration;

use ros2_client::qos::{History, WhenFull};
use ros2_client::{MessageTypeName, Name, Node, Publisher, QosProfile, Subscription};
use sensedsl_wire::Scalar;
use serde::Serialize;
use serde_json::Value;

use super::message::{
    Bool, Float64, Float64MultiArray, Header, Imu, JointState, MagneticField, Measured, Range,
    Since, Vector3,
};
use super::shape::Shape;
use crate::plan::Place;

/// How many messages wait for one who reads slowly.
const DEPTH: usize = 10;
/// The radiation of a range finder that is not known: ROS 2 has no word for that, and this is its first one.
const ULTRASOUND: u8 = 0;

/// Reliable, so that both those who want that and those who do not are served.
pub(super) fn qos() -> QosProfile {
    QosProfile::publisher_default()
        .reliability_reliable(WhenFull::DEFAULT)
        .history(History::KeepLast { depth: DEPTH })
}

/// Where the values of a device go.
pub(super) struct Told {
    shape: Shape,
    is_humble: bool,
    to: Topic,
}

enum Topic {
    Range(Publisher<Range>),
    Measured(Publisher<Measured>),
    Imu(Publisher<Imu>),
    Magnetic(Publisher<MagneticField>),
    Joint(Publisher<JointState>),
    Flag(Publisher<Bool>),
    Number(Publisher<Float64>),
    Numbers(Publisher<Float64MultiArray>),
}

/// A topic of a type, by its package and name, to publish on.
pub(super) fn publisher<M: Serialize>(
    node: &mut Node,
    name: &Name,
    (package, kind): (&str, &str),
) -> Result<Publisher<M>, String> {
    let topic = node.create_topic(name, MessageTypeName::new(package, kind), &qos());
    let topic = topic.map_err(|why| why.to_string())?;
    node.create_publisher(&topic, None).map_err(|why| why.to_string())
}

impl Told {
    pub(super) fn new(
        node: &mut Node,
        place: &Place<'_>,
        name: &Name,
        is_humble: bool,
    ) -> Result<Self, String> {
        let shape = Shape::of(place);
        let kind = shape.name();
        let to = match shape {
            Shape::Range(_) => Topic::Range(publisher(node, name, kind)?),
            Shape::Measured(..) => Topic::Measured(publisher(node, name, kind)?),
            Shape::Acceleration(_) | Shape::Rotation(_) => Topic::Imu(publisher(node, name, kind)?),
            Shape::Magnetic(_) => Topic::Magnetic(publisher(node, name, kind)?),
            Shape::Joint(_) => Topic::Joint(publisher(node, name, kind)?),
            Shape::Flag => Topic::Flag(publisher(node, name, kind)?),
            Shape::Number => Topic::Number(publisher(node, name, kind)?),
            Shape::Numbers => Topic::Numbers(publisher(node, name, kind)?),
        };
        Ok(Self { shape, is_humble, to })
    }

    /// Publishes a value.
    pub(super) fn publish(
        &self,
        place: &Place<'_>,
        raw: &[Scalar],
        taken: Duration,
    ) -> Result<(), String> {
        let factor = match self.shape {
            Shape::Range(factor)
            | Shape::Measured(_, factor)
            | Shape::Acceleration(factor)
            | Shape::Rotation(factor)
            | Shape::Magnetic(factor)
            | Shape::Joint(factor) => factor,
            Shape::Flag | Shape::Number | Shape::Numbers => 1.0,
        };
        let numbers: Vec<f64> = raw.iter().map(|one| place.number(*one) * factor).collect();
        let first = numbers.first().copied().unwrap_or_default();
        let header = || Header::new(taken, &place.route.frame);
        let done = match &self.to {
            Topic::Range(to) => {
                to.publish(self.range(place, header(), first, factor)).map_err(drop)
            }
            Topic::Measured(to) => {
                to.publish(Measured { header: header(), value: first, variance: 0.0 }).map_err(drop)
            }
            Topic::Imu(to) => {
                let vector = vector(&numbers);
                let is_rotation = matches!(self.shape, Shape::Rotation(_));
                let (velocity, acceleration) =
                    (is_rotation.then_some(vector), (!is_rotation).then_some(vector));
                to.publish(Imu::new(header(), velocity, acceleration)).map_err(drop)
            }
            Topic::Magnetic(to) => {
                let (magnetic_field, magnetic_field_covariance) = (vector(&numbers), [0.0; 9]);
                let field =
                    MagneticField { header: header(), magnetic_field, magnetic_field_covariance };
                to.publish(field).map_err(drop)
            }
            Topic::Joint(to) => {
                let name = vec![place.device.name.clone()];
                let (velocity, effort) = (Vec::new(), Vec::new());
                let joint =
                    JointState { header: header(), name, position: numbers, velocity, effort };
                to.publish(joint).map_err(drop)
            }
            Topic::Flag(to) => to.publish(Bool { data: first != 0.0 }).map_err(drop),
            Topic::Number(to) => to.publish(Float64 { data: first }).map_err(drop),
            Topic::Numbers(to) => to.publish(Float64MultiArray::new(numbers)).map_err(drop),
        };
        done.map_err(|()| format!("{} is not taken by the network", place.route.topic))
    }

    #[expect(clippy::cast_possible_truncation, reason = "the message has no more digits")]
    fn range(&self, place: &Place<'_>, header: Header, range: f64, factor: f64) -> Range {
        let limit = |shown: Option<f64>, other: f64| {
            shown.map_or(other, |shown| place.scaled(shown) * factor) as f32
        };
        Range {
            header,
            radiation_type: ULTRASOUND,
            field_of_view: 0.0,
            min_range: limit(place.device.min, 0.0),
            max_range: limit(place.device.max, f64::INFINITY),
            range: range as f32,
            variance: Since((!self.is_humble).then_some(0.0)),
        }
    }
}

pub(super) fn vector(numbers: &[f64]) -> Vector3 {
    match *numbers {
        [x, y, z] => Vector3 { x, y, z },
        _ => Vector3::default(),
    }
}

/// Where commands for an actuator come from.
pub(super) enum Heard {
    Flag(Subscription<Bool>),
    Number(Subscription<Float64>),
    Numbers(Subscription<Float64MultiArray>, bool),
}

impl Heard {
    pub(super) fn new(node: &mut Node, place: &Place<'_>, name: &Name) -> Result<Self, String> {
        let shape = Shape::of(place);
        let (package, kind) = shape.name();
        let topic = node.create_topic(name, MessageTypeName::new(package, kind), &qos());
        let topic = topic.map_err(|why| why.to_string())?;
        let refused = |why: ros2_client::CreateError| why.to_string();
        let is_bool = place.is_bool();
        Ok(if place.device.value.length.is_some() {
            Self::Numbers(node.create_subscription(&topic, None).map_err(refused)?, is_bool)
        } else if is_bool {
            Self::Flag(node.create_subscription(&topic, None).map_err(refused)?)
        } else {
            Self::Number(node.create_subscription(&topic, None).map_err(refused)?)
        })
    }

    /// What came, as it is shown. What cannot be read is as if it had not come.
    pub(super) fn take(&self) -> Option<Value> {
        match self {
            Self::Flag(from) => Some(from.take().ok()??.0.data.into()),
            Self::Number(from) => Some(from.take().ok()??.0.data.into()),
            Self::Numbers(from, is_bool) => {
                let all = from.take().ok()??.0.data;
                let value =
                    |number: f64| if *is_bool { (number != 0.0).into() } else { number.into() };
                Some(all.into_iter().map(value).collect::<Vec<Value>>().into())
            }
        }
    }
}
