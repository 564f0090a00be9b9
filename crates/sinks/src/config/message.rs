//! Messages that are put together from several devices: which there are, and what each of their fields takes.
//!
//! One table serves the reader, the printed sample and the sink, so that a field that can be named also goes out. The
//! names are those of the definitions in ROS 2, and so are the units.

/// What a field takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// One number.
    Number,
    /// A list of numbers.
    Numbers,
    /// A list of what is on or off.
    Flags,
    /// Three numbers: of three devices, or of an array with three.
    Vector,
    /// One number, or something that is on or off.
    State,
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// The units that it can be in, the usual one first; none where any number will do. `1` is a bare number.
    pub units: &'static [&'static str],
    /// Whether the message means nothing without it.
    pub is_needed: bool,
}

/// A type of message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MessageSpec {
    /// Its name in `sensor_msgs`.
    pub name: &'static str,
    /// What it is for, in a line.
    pub about: &'static str,
    /// Its fields.
    pub fields: &'static [Field],
}

const fn needed(name: &'static str, takes: Takes, units: &'static [&'static str]) -> Field {
    Field { name, takes, units, is_needed: true }
}

const fn optional(name: &'static str, takes: Takes, units: &'static [&'static str]) -> Field {
    Field { name, takes, units, is_needed: false }
}

/// All types.
pub const MESSAGES: &[MessageSpec] = &[
    MessageSpec {
        name: "BatteryState",
        about: "a battery",
        fields: &[
            needed("voltage", Takes::Number, &["V"]),
            optional("temperature", Takes::Number, &["degC"]),
            optional("current", Takes::Number, &["A"]),
            optional("charge", Takes::Number, &["Ah"]),
            optional("capacity", Takes::Number, &["Ah"]),
            optional("design_capacity", Takes::Number, &["Ah"]),
            optional("percentage", Takes::Number, &["1"]),
            optional("cell_voltage", Takes::Numbers, &["V"]),
            optional("cell_temperature", Takes::Numbers, &["degC"]),
        ],
    },
    MessageSpec {
        name: "Joy",
        about: "a joystick, or a board with switches",
        fields: &[optional("axes", Takes::Numbers, &[]), optional("buttons", Takes::Flags, &[])],
    },
    MessageSpec {
        name: "NavSatFix",
        about: "where a receiver of satellites is",
        fields: &[
            needed("latitude", Takes::Number, &["deg"]),
            needed("longitude", Takes::Number, &["deg"]),
            optional("altitude", Takes::Number, &["m"]),
            optional("status", Takes::State, &[]),
        ],
    },
    MessageSpec {
        name: "JointState",
        about: "several joints at a time",
        fields: &[
            needed("position", Takes::Numbers, &["rad", "m"]),
            optional("velocity", Takes::Numbers, &["rad/s", "m/s"]),
            optional("effort", Takes::Numbers, &["Nm", "N"]),
        ],
    },
    MessageSpec {
        name: "Imu",
        about: "accelerations and rotations at a time",
        fields: &[
            optional("linear_acceleration", Takes::Vector, &["m/s^2"]),
            optional("angular_velocity", Takes::Vector, &["rad/s"]),
        ],
    },
];

/// A number of a message: where it comes from, and what is done to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The field that it is for.
    pub field: &'static str,
    /// The board.
    pub board: String,
    /// The device.
    pub device: String,
    /// Which of its numbers.
    pub element: usize,
    /// What the number that goes out is multiplied with.
    pub factor: f64,
    /// What is added then.
    pub offset: f64,
}

/// A message, as a configuration describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Its name for other programs.
    pub topic: String,
    /// Its type.
    pub spec: &'static MessageSpec,
    /// Its coordinate frame; without it that of its first device.
    pub frame: Option<String>,
    /// The names of joints; without them those of the devices.
    pub names: Vec<String>,
    /// Its numbers, in the order of the file: it goes out with each value of the first.
    pub parts: Vec<Part>,
}
