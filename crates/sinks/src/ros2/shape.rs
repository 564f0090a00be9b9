//! Which message a device has: its unit and its elements in, a type of ROS 2 and a factor to its unit out.

use crate::plan::Place;

/// The acceleration of 1 g.
const GRAVITY: f64 = 9.806_65;

/// A type of message, and what a number that goes out is multiplied with to be in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// `sensor_msgs/Range`, in metres.
    Range(f64),
    /// One of the types with a value and its variance.
    Measured(&'static str, f64),
    /// `sensor_msgs/Imu` with an acceleration.
    Acceleration(f64),
    /// `sensor_msgs/Imu` with an angular velocity.
    Rotation(f64),
    /// `sensor_msgs/MagneticField`, in tesla.
    Magnetic(f64),
    /// `sensor_msgs/JointState`, in radians.
    Joint(f64),
    /// `std_msgs/Bool`.
    Flag,
    /// `std_msgs/Float64`, in the unit in which it is shown.
    Number,
    /// `std_msgs/Float64MultiArray`.
    Numbers,
}

impl Shape {
    /// Of a device.
    pub(super) fn of(place: &Place<'_>) -> Self {
        let usual = match place.device.value.length {
            Some(_) => Self::Numbers,
            None if place.is_bool() => Self::Flag,
            None => Self::Number,
        };
        if place.is_actuator() || place.is_bool() {
            return usual;
        }
        let unit = place.route.unit.as_deref().unwrap_or_default();
        let is_joint = place.device.kind == "encoder";
        match (unit, place.device.value.length) {
            ("deg", None) if is_joint => Self::Joint(1_f64.to_radians()),
            ("rad", None) if is_joint => Self::Joint(1.0),
            ("m", None) => Self::Range(1.0),
            ("cm", None) => Self::Range(0.01),
            ("mm", None) => Self::Range(0.001),
            ("degC", None) => Self::Measured("Temperature", 1.0),
            ("Pa", None) => Self::Measured("FluidPressure", 1.0),
            ("hPa", None) => Self::Measured("FluidPressure", 100.0),
            ("lx", None) => Self::Measured("Illuminance", 1.0),
            ("g", Some(3)) => Self::Acceleration(GRAVITY),
            ("m/s^2", Some(3)) => Self::Acceleration(1.0),
            ("deg/s", Some(3)) => Self::Rotation(1_f64.to_radians()),
            ("rad/s", Some(3)) => Self::Rotation(1.0),
            ("uT", Some(3)) => Self::Magnetic(1e-6),
            _ => usual,
        }
    }

    /// Its package and its name.
    pub(super) fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::Range(_) => ("sensor_msgs", "Range"),
            Self::Measured(name, _) => ("sensor_msgs", name),
            Self::Acceleration(_) | Self::Rotation(_) => ("sensor_msgs", "Imu"),
            Self::Magnetic(_) => ("sensor_msgs", "MagneticField"),
            Self::Joint(_) => ("sensor_msgs", "JointState"),
            Self::Flag => ("std_msgs", "Bool"),
            Self::Number => ("std_msgs", "Float64"),
            Self::Numbers => ("std_msgs", "Float64MultiArray"),
        }
    }
}
