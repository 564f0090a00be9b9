//! From the unit of a device to the one that a definition asks for: two units in, a factor and an offset out.

use std::f64::consts::PI;

use sensedsl_host::Device;

/// A number in one unit is this many of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Conversion {
    /// What it is multiplied with.
    pub(super) factor: f64,
    /// What is added then.
    pub(super) offset: f64,
}

/// What differs in more than a prefix: from, to, factor, offset.
const OTHERS: &[(&str, &str, f64, f64)] = &[
    ("g", "m/s^2", 9.806_65, 0.0),
    ("deg", "rad", PI / 180.0, 0.0),
    ("rad", "deg", 180.0 / PI, 0.0),
    ("deg/s", "rad/s", PI / 180.0, 0.0),
    ("rpm", "rad/s", PI / 30.0, 0.0),
    ("km/h", "m/s", 1.0 / 3.6, 0.0),
    ("K", "degC", 1.0, -273.15),
    ("degF", "degC", 5.0 / 9.0, -160.0 / 9.0),
    ("As", "Ah", 1.0 / 3_600.0, 0.0),
    ("N*m", "Nm", 1.0, 0.0),
    ("N m", "Nm", 1.0, 0.0),
    ("%", "1", 0.01, 0.0),
];

/// The way from a unit to another; none if they measure something else. A bare number is in `1`.
pub(super) fn convert(device: &Device, from: Option<&str>, to: &str) -> Option<Conversion> {
    let from = from.filter(|unit| !unit.is_empty()).unwrap_or("1");
    let is_in = Device { quantity: Some(from.to_owned()), ..device.clone() };
    let by_prefix = |to: &str| is_in.factor(to).ok().map(|factor| 1.0 / factor);
    if let Some(factor) = by_prefix(to) {
        return Some(Conversion { factor, offset: 0.0 });
    }
    OTHERS.iter().filter(|other| other.1 == to).find_map(|(own, _, factor, offset)| {
        Some(Conversion { factor: by_prefix(own)? * factor, offset: *offset })
    })
}
