//! What can stand in a configuration: the sinks, their keys, and what each key is for.
//!
//! One table serves reader, printer and documentation, so that no key is read and not shown, or shown and not read.

/// What a key takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sort {
    /// Any text.
    Text(&'static str),
    /// One of these words.
    Word(&'static [&'static str]),
    /// Several texts.
    Texts,
    /// `true` or `false`.
    Flag(bool),
    /// A whole number within these bounds.
    Whole(u32, u32, u32),
    /// A number above 0.
    Positive(Option<f64>),
    /// Where another program is: a host and a port.
    Remote(&'static str),
    /// Where this program listens: a number of an interface and a port.
    Listen(&'static str),
}

/// A key of a sink's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// The key.
    pub name: &'static str,
    /// What it takes, and what counts without it.
    pub sort: Sort,
    /// What it is for, in a line.
    pub about: &'static str,
}

/// A way to pass values on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    /// Its table, which is also its feature.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// Whether this build has it.
    pub is_built: bool,
    /// What it does, in a line.
    pub about: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
}

const fn key(name: &'static str, sort: Sort, about: &'static str) -> Key {
    Key { name, sort, about }
}

const RATE: Key = key(
    "rate_hz",
    Sort::Positive(None),
    "at most so many values a second of each device; all without it",
);
const COMMANDS: Key =
    key("commands", Sort::Flag(true), "whether other programs may set actuators this way");

/// The releases of ROS 2, the usual one first.
pub const ROS_DISTROS: &[&str] = &["jazzy", "kilted", "lyrical", "rolling", "iron", "humble"];

/// All ways, in the order of the documentation.
pub const SINKS: &[Spec] = &[
    Spec {
        name: "plotjuggler",
        title: "PlotJuggler",
        is_built: cfg!(feature = "plotjuggler"),
        about: "values as JSON over UDP, as the UDP server of PlotJuggler reads them",
        keys: &[key("to", Sort::Remote("127.0.0.1:9870"), "where PlotJuggler listens"), RATE],
    },
    Spec {
        name: "websocket",
        title: "WebSocket",
        is_built: cfg!(feature = "websocket"),
        about: "values, health and commands as JSON, for scripts, and a page for browsers",
        keys: &[
            key("listen", Sort::Listen("127.0.0.1:8765"), "the address that clients connect to"),
            key(
                "origins",
                Sort::Texts,
                "origins of pages that may connect besides those of this machine; \"*\" allows all",
            ),
            COMMANDS,
            RATE,
        ],
    },
    Spec {
        name: "foxglove",
        title: "Foxglove",
        is_built: cfg!(feature = "foxglove"),
        about: "a server that Foxglove connects to, with a channel for each device",
        keys: &[
            key("listen", Sort::Listen("127.0.0.1:8766"), "the address that Foxglove connects to"),
            key(
                "origins",
                Sort::Texts,
                "origins of pages that may connect besides Foxglove's and those of this machine",
            ),
            COMMANDS,
            RATE,
        ],
    },
    Spec {
        name: "mqtt",
        title: "MQTT",
        is_built: cfg!(feature = "mqtt"),
        about: "a retained topic for each device, with discovery for Home Assistant",
        keys: &[
            key("broker", Sort::Remote("localhost:1883"), "where the broker is"),
            key("prefix", Sort::Text("sensedsl"), "the first words of all topics"),
            key(
                "payload",
                Sort::Word(&["plain", "json"]),
                "a bare value, or an object with its time and unit",
            ),
            key(
                "discovery",
                Sort::Text("homeassistant"),
                "the prefix of Home Assistant's discovery; \"\" for none",
            ),
            key(
                "client_id",
                Sort::Text(""),
                "the name for the broker; \"\" for one of its own each time",
            ),
            key("user", Sort::Text(""), "the user for the broker; \"\" for none"),
            key(
                "password",
                Sort::Text(""),
                "the user's password, which goes over the network as it is",
            ),
            COMMANDS,
            key(
                "rate_hz",
                Sort::Positive(Some(10.0)),
                "at most so many values a second of each device; 1e6 lets all pass",
            ),
        ],
    },
    Spec {
        name: "prometheus",
        title: "Prometheus",
        is_built: cfg!(feature = "prometheus"),
        about: "the latest values and counts at http://ADDRESS/metrics",
        keys: &[key(
            "listen",
            Sort::Listen("127.0.0.1:9101"),
            "the address that Prometheus scrapes",
        )],
    },
    Spec {
        name: "od4",
        title: "OD4",
        is_built: cfg!(feature = "od4"),
        about: "messages of an OD4 session, as the generated host for libcluon sends them",
        keys: &[
            key("cid", Sort::Whole(111, 1, 254), "the OD4 session"),
            key(
                "interface",
                Sort::Listen("0.0.0.0:12175"),
                "the interface and the port; 0.0.0.0 leaves the interface to the system",
            ),
            COMMANDS,
            RATE,
        ],
    },
    Spec {
        name: "ros2",
        title: "ROS 2",
        is_built: cfg!(feature = "ros2"),
        about: "topics of ROS 2 over DDS, without an installation of ROS",
        keys: &[
            key(
                "distro",
                Sort::Word(ROS_DISTROS),
                "the release of the others: from \"iron\" on `Range` has a field more",
            ),
            key(
                "rmw",
                Sort::Word(&["fastrtps", "cyclonedds"]),
                "the middleware of the others, for parameters: RMW_IMPLEMENTATION without \"rmw_\" and \"_cpp\"",
            ),
            key("domain", Sort::Whole(0, 0, 232), "the domain, ROS_DOMAIN_ID of the others"),
            key("namespace", Sort::Text(""), "the first words of all topics; \"\" for none"),
            key("node", Sort::Text("sensedsl"), "the name of the node"),
            COMMANDS,
            RATE,
        ],
    },
    Spec {
        name: "zenoh",
        title: "Zenoh",
        is_built: cfg!(feature = "zenoh"),
        about: "a key for each device, between machines and networks, with or without a router",
        keys: &[
            key(
                "mode",
                Sort::Word(&["peer", "client"]),
                "\"peer\" finds others by itself, \"client\" needs a router",
            ),
            key("connect", Sort::Texts, "whom to connect to, such as \"tcp/192.168.1.5:7447\""),
            key("listen", Sort::Texts, "where others connect; any free port without it"),
            key("scouting", Sort::Flag(true), "whether to look for others by multicast"),
            key("prefix", Sort::Text("sensedsl"), "the first words of all keys; \"\" for none"),
            COMMANDS,
            RATE,
        ],
    },
];

/// Keys of `[boards.NAME]`.
pub const BOARD_KEYS: &[Key] = &[
    key("topic", Sort::Text(""), "its name for other programs; without it its own"),
    key(
        "frame",
        Sort::Text(""),
        "the coordinate frame of its devices, for Foxglove and ROS 2; without it its topic",
    ),
    RATE,
    key("leave_out", Sort::Flag(false), "whether none of its devices goes out"),
];

/// Keys of `[devices."BOARD/DEVICE"]`.
pub const DEVICE_KEYS: &[Key] = &[
    key("topic", Sort::Text(""), "its name for other programs; without it BOARD/DEVICE"),
    key("frame", Sort::Text(""), "its coordinate frame; without it that of its board"),
    RATE,
    key("unit", Sort::Text(""), "the unit in which it goes out: \"m\" for what is shown in cm"),
    key(
        "scale",
        Sort::Positive(None),
        "what the shown value is multiplied with; `unit` then is only its name",
    ),
    key("leave_out", Sort::Flag(false), "whether it stays here"),
];

/// Keys of `[messages.TOPIC]` beside the fields of its type.
pub const MESSAGE_KEYS: &[Key] = &[
    key("type", Sort::Text("Joy"), "the message of sensor_msgs, for ROS 2"),
    key("frame", Sort::Text(""), "its coordinate frame; without it that of its first device"),
    key("names", Sort::Texts, "the names of joints; without them those of the devices"),
];

/// The sink with that table.
#[must_use]
pub fn find(name: &str) -> Option<&'static Spec> {
    SINKS.iter().find(|spec| spec.name == name)
}
