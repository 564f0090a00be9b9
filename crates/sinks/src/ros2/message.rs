//! Messages of ROS 2, field by field as their definitions have them: numbers and texts in, what serde writes as CDR out.
//!
//! Those with the same fields share a struct; their names are in `shape.rs`.

use std::time::Duration;

use sensedsl_host::{causes, status};
use sensedsl_wire::{Health, Status};
use serde::{Deserialize, Serialize, Serializer};

use crate::plan::BoardPlan;

/// `builtin_interfaces/Time`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Time {
    sec: i32,
    nanosec: u32,
}

/// `std_msgs/Header`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Header {
    stamp: Time,
    frame_id: String,
}

impl Header {
    pub(super) fn new(taken: Duration, frame: &str) -> Self {
        let sec = i32::try_from(taken.as_secs()).unwrap_or(i32::MAX);
        Self { stamp: Time { sec, nanosec: taken.subsec_nanos() }, frame_id: frame.to_owned() }
    }
}

/// A field that only later releases have: nothing is written for earlier ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Since<T>(pub(super) Option<T>);

impl<T: Serialize> Serialize for Since<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0 {
            Some(value) => value.serialize(serializer),
            None => serializer.serialize_unit(),
        }
    }
}

/// `sensor_msgs/Range`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Range {
    pub(super) header: Header,
    pub(super) radiation_type: u8,
    pub(super) field_of_view: f32,
    pub(super) min_range: f32,
    pub(super) max_range: f32,
    pub(super) range: f32,
    pub(super) variance: Since<f32>,
}

/// `sensor_msgs/Temperature`, `FluidPressure` and `Illuminance`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Measured {
    pub(super) header: Header,
    pub(super) value: f64,
    pub(super) variance: f64,
}

/// `geometry_msgs/Vector3`.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Vector3 {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

/// `geometry_msgs/Quaternion`.
#[derive(Clone, Copy, Debug, Serialize)]
struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

/// What `sensor_msgs/Imu` says of what is not measured.
const NOT_MEASURED: [f64; 9] = [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];

/// `sensor_msgs/Imu`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Imu {
    header: Header,
    orientation: Quaternion,
    orientation_covariance: [f64; 9],
    angular_velocity: Vector3,
    angular_velocity_covariance: [f64; 9],
    linear_acceleration: Vector3,
    linear_acceleration_covariance: [f64; 9],
}

impl Imu {
    /// With one of both, or both; what is not there, and the orientation, are not measured.
    pub(super) fn new(
        header: Header,
        velocity: Option<Vector3>,
        acceleration: Option<Vector3>,
    ) -> Self {
        let covariance = |of: Option<Vector3>| if of.is_some() { [0.0; 9] } else { NOT_MEASURED };
        Self {
            header,
            orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
            orientation_covariance: NOT_MEASURED,
            angular_velocity: velocity.unwrap_or_default(),
            angular_velocity_covariance: covariance(velocity),
            linear_acceleration: acceleration.unwrap_or_default(),
            linear_acceleration_covariance: covariance(acceleration),
        }
    }
}

/// `sensor_msgs/MagneticField`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MagneticField {
    pub(super) header: Header,
    pub(super) magnetic_field: Vector3,
    pub(super) magnetic_field_covariance: [f64; 9],
}

/// `sensor_msgs/JointState`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct JointState {
    pub(super) header: Header,
    pub(super) name: Vec<String>,
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
    pub(super) effort: Vec<f64>,
}

/// `sensor_msgs/BatteryState`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct BatteryState {
    pub(super) header: Header,
    pub(super) voltage: f32,
    pub(super) temperature: f32,
    pub(super) current: f32,
    pub(super) charge: f32,
    pub(super) capacity: f32,
    pub(super) design_capacity: f32,
    pub(super) percentage: f32,
    /// 0 is not known in each of the three.
    pub(super) power_supply_status: u8,
    pub(super) power_supply_health: u8,
    pub(super) power_supply_technology: u8,
    pub(super) present: bool,
    pub(super) cell_voltage: Vec<f32>,
    pub(super) cell_temperature: Vec<f32>,
    pub(super) location: String,
    pub(super) serial_number: String,
}

/// `sensor_msgs/Joy`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Joy {
    pub(super) header: Header,
    pub(super) axes: Vec<f32>,
    pub(super) buttons: Vec<i32>,
}

/// `sensor_msgs/NavSatStatus`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct NavSatStatus {
    pub(super) status: i8,
    pub(super) service: u16,
}

/// `sensor_msgs/NavSatFix`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct NavSatFix {
    pub(super) header: Header,
    pub(super) status: NavSatStatus,
    pub(super) latitude: f64,
    pub(super) longitude: f64,
    pub(super) altitude: f64,
    pub(super) position_covariance: [f64; 9],
    /// 0 is not known.
    pub(super) position_covariance_type: u8,
}

/// `std_msgs/Float64`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Float64 {
    pub(super) data: f64,
}

/// `std_msgs/Bool`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Bool {
    pub(super) data: bool,
}

/// `std_msgs/MultiArrayDimension`.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Dimension {
    label: String,
    size: u32,
    stride: u32,
}

/// `std_msgs/MultiArrayLayout`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Layout {
    dim: Vec<Dimension>,
    data_offset: u32,
}

/// `std_msgs/Float64MultiArray`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Float64MultiArray {
    layout: Layout,
    pub(super) data: Vec<f64>,
}

impl Float64MultiArray {
    pub(super) fn new(data: Vec<f64>) -> Self {
        Self { layout: Layout::default(), data }
    }
}

/// `diagnostic_msgs/KeyValue`.
#[derive(Clone, Debug, Serialize)]
struct KeyValue {
    key: String,
    value: String,
}

/// `diagnostic_msgs/DiagnosticStatus`.
#[derive(Clone, Debug, Serialize)]
struct DiagnosticStatus {
    level: u8,
    name: String,
    message: String,
    hardware_id: String,
    values: Vec<KeyValue>,
}

/// `diagnostic_msgs/DiagnosticArray`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct DiagnosticArray {
    header: Header,
    status: Vec<DiagnosticStatus>,
}

/// The levels of a status.
const OK: u8 = 0;
const WARN: u8 = 1;
const ERROR: u8 = 2;
const STALE: u8 = 3;

impl DiagnosticArray {
    /// What a board tells of itself and its devices.
    pub(super) fn of_health(on: &BoardPlan, health: &Health, at: Duration) -> Self {
        let hardware = || on.board.name.clone();
        let pair = |key: &str, value: String| KeyValue { key: key.to_owned(), value };
        let mut all = vec![DiagnosticStatus {
            level: if health.reports_refused > 0 { WARN } else { OK },
            name: on.board.name.clone(),
            message: "running".to_owned(),
            hardware_id: hardware(),
            values: vec![
                pair("uptime_s", (f64::from(health.uptime_ms) / 1e3).to_string()),
                pair("reports_sent", health.reports_sent.to_string()),
                pair("reports_refused", health.reports_refused.to_string()),
            ],
        }];
        for one in &health.devices {
            let Some(device) = on.board.devices.iter().find(|device| device.id == one.id) else {
                continue;
            };
            let level = match one.status {
                Status::Good => OK,
                Status::NeverRead | Status::Stale => STALE,
                Status::Failed => ERROR,
                Status::Invalid | Status::Other(_) => WARN,
            };
            all.push(DiagnosticStatus {
                level,
                name: format!("{}/{}", on.board.name, device.name),
                message: status(one.status).to_owned(),
                hardware_id: hardware(),
                values: vec![pair("failures", causes(one.causes.counts()))],
            });
        }
        Self { header: Header::new(at, ""), status: all }
    }

    /// That a board is there, or why it is not.
    pub(super) fn of_presence(on: &BoardPlan, away: Option<&str>, at: Duration) -> Self {
        let status = DiagnosticStatus {
            level: if away.is_none() { OK } else { ERROR },
            name: on.board.name.clone(),
            message: away.unwrap_or("online").to_owned(),
            hardware_id: on.board.name.clone(),
            values: Vec::new(),
        };
        Self { header: Header::new(at, ""), status: vec![status] }
    }
}
