//! Which message of ROS 2 carries a device: by the unit of what is shown, and the number of its elements.
//!
//! A unit that `sensor_msgs` has a message for is converted to that message's. Everything else travels as what it is, in
//! `std_msgs`: a number with a unit of its own as `Float64`, a code in its type.

use sensedsl_job::host::MessagePlan;
use sensedsl_wire::ScalarType;

/// What a message says of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Carrier {
    /// One number in a field of a message of `sensor_msgs`: message, field, factor and offset.
    Field(&'static str, &'static str, f64, f64),
    /// A distance: the factor to metres.
    Range(f64),
    /// Three numbers in a vector of a message of `sensor_msgs`: message, vector, factor.
    Vector(&'static str, &'static str, f64),
    /// What is shown, as a `Float64`.
    Shown,
    /// The code, in its type.
    Code,
}

/// Standard gravity.
const GRAVITY: f64 = 9.80665;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// One number, by its unit.
const SCALARS: &[(&str, Carrier)] = &[
    ("mm", Carrier::Range(0.001)),
    ("cm", Carrier::Range(0.01)),
    ("m", Carrier::Range(1.0)),
    ("degC", Carrier::Field("Temperature", "temperature", 1.0, 0.0)),
    ("°C", Carrier::Field("Temperature", "temperature", 1.0, 0.0)),
    ("K", Carrier::Field("Temperature", "temperature", 1.0, -273.15)),
    ("Pa", Carrier::Field("FluidPressure", "fluid_pressure", 1.0, 0.0)),
    ("hPa", Carrier::Field("FluidPressure", "fluid_pressure", 100.0, 0.0)),
    ("mbar", Carrier::Field("FluidPressure", "fluid_pressure", 100.0, 0.0)),
    ("kPa", Carrier::Field("FluidPressure", "fluid_pressure", 1000.0, 0.0)),
    ("bar", Carrier::Field("FluidPressure", "fluid_pressure", 100_000.0, 0.0)),
    ("lx", Carrier::Field("Illuminance", "illuminance", 1.0, 0.0)),
    ("%RH", Carrier::Field("RelativeHumidity", "relative_humidity", 0.01, 0.0)),
];

/// Three numbers, by their unit.
const VECTORS: &[(&str, Carrier)] = &[
    ("m/s^2", Carrier::Vector("Imu", "linear_acceleration", 1.0)),
    ("g", Carrier::Vector("Imu", "linear_acceleration", GRAVITY)),
    ("rad/s", Carrier::Vector("Imu", "angular_velocity", 1.0)),
    ("deg/s", Carrier::Vector("Imu", "angular_velocity", DEGREE)),
    ("T", Carrier::Vector("MagneticField", "magnetic_field", 1.0)),
    ("mT", Carrier::Vector("MagneticField", "magnetic_field", 1e-3)),
    ("uT", Carrier::Vector("MagneticField", "magnetic_field", 1e-6)),
    ("G", Carrier::Vector("MagneticField", "magnetic_field", 1e-4)),
];

/// What carries a sensor.
pub(super) fn of_sensor(message: &MessagePlan) -> Carrier {
    let table = match message.value.length {
        None => SCALARS,
        Some(3) => VECTORS,
        Some(_) => &[],
    };
    let unit = message.quantity.as_deref().unwrap_or_default();
    let found = table.iter().find(|(name, _)| *name == unit).map(|(_, carrier)| *carrier);
    found.filter(|_| message.value.scalar != ScalarType::Bool).unwrap_or(of_actuator(message))
}

/// What carries an actuator, or a sensor whose unit no message has.
pub(super) fn of_actuator(message: &MessagePlan) -> Carrier {
    let is_shown = message.scaling.is_some() && message.value.scalar != ScalarType::Bool;
    if is_shown { Carrier::Shown } else { Carrier::Code }
}

/// The message of `std_msgs` that has one such code, or an array of them.
pub(super) fn code_message(scalar: ScalarType, is_array: bool) -> String {
    let name = match scalar {
        // `std_msgs` has no array of `bool`.
        ScalarType::Bool if is_array => "UInt8",
        ScalarType::Bool => "Bool",
        ScalarType::Uint8 => "UInt8",
        ScalarType::Int8 => "Int8",
        ScalarType::Uint16 => "UInt16",
        ScalarType::Int16 => "Int16",
        ScalarType::Uint32 => "UInt32",
        ScalarType::Int32 => "Int32",
        ScalarType::Uint64 => "UInt64",
        ScalarType::Int64 => "Int64",
        ScalarType::Float32 => "Float32",
        ScalarType::Float64 => "Float64",
    };
    format!("{name}{}", if is_array { "MultiArray" } else { "" })
}
