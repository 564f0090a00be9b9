//! The plan in the words of ROS 2.

use std::collections::BTreeSet;

use sensedsl_diagnostics::visible;
use sensedsl_job::host::{BoardPlan, HostPlan, MessagePlan};
use sensedsl_wire::ScalarType;

use super::super::view::{BoardView, DesignView, MessageView};
use super::kinds::{Carrier, code_message, of_actuator, of_sensor};

/// A package.
pub(super) struct PackageView {
    pub(super) design: DesignView,
    /// The name of the package.
    pub(super) name: String,
    pub(super) nodes: Vec<NodeView>,
}

/// The node of a board.
pub(super) struct NodeView {
    /// The name of the node, and of its executable.
    pub(super) name: String,
    /// The class of the board.
    pub(super) class: String,
    /// The function with its facts.
    pub(super) facts: String,
    pub(super) title: String,
    pub(super) header: String,
    pub(super) source: String,
    pub(super) has_stamp: bool,
    /// The headers of the messages.
    pub(super) includes: BTreeSet<String>,
    pub(super) sensors: Vec<TopicView>,
    pub(super) actuators: Vec<TopicView>,
}

/// A device's topic.
pub(super) struct TopicView {
    /// The name of the message's class in the board's header.
    pub(super) ident: String,
    pub(super) path: String,
    /// The device's name as a literal.
    pub(super) literal: String,
    /// The topic below the node's name.
    pub(super) topic: String,
    /// `sensor_msgs::msg::Range`
    pub(super) message: String,
    /// `sensor_msgs/msg/Range`
    pub(super) interface: String,
    /// What stands on the page beside it: a unit.
    pub(super) unit: String,
    /// Statements that fill `out` from `in`, or for an actuator `command` from `in`.
    pub(super) statements: Vec<String>,
}

impl PackageView {
    pub(super) fn new(plan: &HostPlan) -> Self {
        let design = DesignView::new(plan);
        let mut names = Names::default();
        let nodes = design.boards.iter().zip(&plan.boards);
        let nodes = nodes.map(|(view, board)| NodeView::new(view, board, &mut names)).collect();
        Self { name: format!("sense_{}", plain(&design.ident).to_ascii_lowercase()), nodes, design }
    }
}

impl NodeView {
    fn new(view: &BoardView, plan: &BoardPlan, names: &mut Names) -> Self {
        let mut topics = Names::default();
        let mut sensors = Vec::new();
        for (message, one) in view.sensors.iter().zip(&plan.sensors.messages) {
            sensors.push(TopicView::of_sensor(message, one, topics.take(&one.name)));
        }
        let mut actuators = Vec::new();
        for (message, one) in view.actuators.iter().zip(&plan.actuators.messages) {
            actuators.push(TopicView::of_actuator(message, one, topics.take(&one.name)));
        }
        let all = sensors.iter().chain(&actuators);
        Self {
            name: names.take(&plan.name.to_ascii_lowercase()),
            class: format!("::sense::{}::{}", view.design, view.ident),
            facts: format!("::sense::{}::facts::{}()", view.design, view.ident),
            title: view.name.clone(),
            header: format!("sense/{}/{}.hpp", view.design, view.ident),
            source: format!("src/{}.cpp", view.ident),
            has_stamp: view.has_stamp,
            includes: all.map(|topic| header_of(&topic.interface)).collect(),
            sensors,
            actuators,
        }
    }
}

impl TopicView {
    fn of_sensor(view: &MessageView, plan: &MessagePlan, topic: String) -> Self {
        let carrier = of_sensor(plan);
        let (interface, statements) = match carrier {
            Carrier::Field(message, field, factor, offset) => {
                let value = converted("in.value()", factor, offset);
                (sensor(message), vec![stamped(view), format!("out.{field} = {value};")])
            }
            Carrier::Range(factor) => {
                let limit = |limit: Option<f64>, other: &str| {
                    let number = limit.map(|limit| format!("{:?}F", (limit * factor) as f32));
                    number.unwrap_or_else(|| other.to_owned())
                };
                let value = converted("in.value()", factor, 0.0);
                let least = limit(plan.limits.min, "0.0F");
                let most = limit(plan.limits.max, "std::numeric_limits<float>::infinity()");
                let statements = vec![
                    stamped(view),
                    format!("out.radiation_type = settings.radiation_type({});", view.name),
                    format!("out.min_range = {least};"),
                    format!("out.max_range = {most};"),
                    format!("out.range = static_cast<float>({value});"),
                ];
                (sensor("Range"), statements)
            }
            Carrier::Vector(message, vector, factor) => {
                let mut statements = vec![stamped(view)];
                if message == "Imu" {
                    // What a message does not have is told by a covariance that begins with -1.
                    for other in ["orientation", "linear_acceleration", "angular_velocity"] {
                        if other != vector {
                            statements.push(format!("out.{other}_covariance[0] = -1.0;"));
                        }
                    }
                }
                for (element, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    let value = converted(&format!("in.value({element})"), factor, 0.0);
                    statements.push(format!("out.{vector}.{axis} = {value};"));
                }
                (sensor(message), statements)
            }
            Carrier::Shown if view.is_array => {
                let each = "out.data.push_back(in.value(i));";
                (standard("Float64MultiArray"), vec![for_each(view, each)])
            }
            Carrier::Shown => (standard("Float64"), vec!["out.data = in.value();".to_owned()]),
            Carrier::Code => {
                let interface = standard(&code_message(plan.value.scalar, view.is_array));
                let statement = if view.is_array {
                    for_each(view, &format!("out.data.push_back({});", element(plan)))
                } else {
                    "out.data = in.raw;".to_owned()
                };
                (interface, vec![statement])
            }
        };
        Self::new(view, plan, topic, interface, statements)
    }

    fn of_actuator(view: &MessageView, plan: &MessagePlan, topic: String) -> Self {
        let (interface, statements) = match (of_actuator(plan), view.is_array) {
            (Carrier::Shown, true) => (
                standard("Float64MultiArray"),
                take_each(view, "is_fine = command.value(i, in.data[i]);"),
            ),
            (Carrier::Shown, false) => (
                standard("Float64"),
                vec!["const bool is_fine = command.value(in.data);".to_owned()],
            ),
            (_, true) => {
                let element = if plan.value.scalar == ScalarType::Bool {
                    "command.raw[i] = in.data[i] != 0;"
                } else {
                    "command.raw[i] = in.data[i];"
                };
                (standard(&code_message(plan.value.scalar, true)), take_each(view, element))
            }
            (_, false) => (
                standard(&code_message(plan.value.scalar, false)),
                vec!["const bool is_fine = true;".to_owned(), "command.raw = in.data;".to_owned()],
            ),
        };
        Self::new(view, plan, topic, interface, statements)
    }

    fn new(
        view: &MessageView,
        plan: &MessagePlan,
        topic: String,
        interface: String,
        statements: Vec<String>,
    ) -> Self {
        let unit = match of_sensor(plan) {
            Carrier::Shown => plan.quantity.clone().unwrap_or_default(),
            Carrier::Field(..) | Carrier::Range(_) | Carrier::Vector(..) | Carrier::Code => {
                String::new()
            }
        };
        Self {
            ident: view.ident.clone(),
            path: view.path.clone(),
            literal: view.name.clone(),
            topic,
            message: interface.replace('/', "::"),
            interface,
            unit: visible(&unit).replace('|', "\\|"),
            statements,
        }
    }
}

fn sensor(message: &str) -> String {
    format!("sensor_msgs/msg/{message}")
}

fn standard(message: &str) -> String {
    format!("std_msgs/msg/{message}")
}

fn stamped(view: &MessageView) -> String {
    format!("out.header = header({});", view.name)
}

fn for_each(view: &MessageView, statement: &str) -> String {
    format!("for (std::size_t i = 0; i < {}::count; ++i) {{ {statement} }}", view.path)
}

/// Takes an array of the right length.
fn take_each(view: &MessageView, statement: &str) -> Vec<String> {
    let count = format!("{}::count", view.path);
    vec![
        format!("bool is_fine = in.data.size() == {count};"),
        format!("for (std::size_t i = 0; is_fine && i < {count}; ++i) {{ {statement} }}"),
    ]
}

/// An element as what its message has.
fn element(plan: &MessagePlan) -> &'static str {
    if plan.value.scalar == ScalarType::Bool { "in.raw[i] ? 1 : 0" } else { "in.raw[i]" }
}

/// An expression in another unit.
fn converted(value: &str, factor: f64, offset: f64) -> String {
    let mut text = value.to_owned();
    if factor != 1.0 {
        text.push_str(&format!(" * {factor:?}"));
    }
    if offset != 0.0 {
        text.push_str(&format!(" + {offset:?}"));
    }
    text
}

/// `sensor_msgs/msg/FluidPressure`: its header is `sensor_msgs/msg/fluid_pressure.hpp`. A capital begins a word where a
/// small letter stands before it or behind it.
fn header_of(interface: &str) -> String {
    let (folder, name) = interface.rsplit_once('/').unwrap_or(("", interface));
    let letters: Vec<char> = name.chars().collect();
    let mut file = String::new();
    for (at, letter) in letters.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|at| letters.get(at));
        let is_after_small =
            before.is_some_and(|one| one.is_ascii_lowercase() || one.is_ascii_digit());
        let is_before_small = letters.get(at + 1).is_some_and(char::is_ascii_lowercase);
        let begins =
            letter.is_ascii_uppercase() && before.is_some() && (is_after_small || is_before_small);
        if begins {
            file.push('_');
        }
        file.push(letter.to_ascii_lowercase());
    }
    format!("{folder}/{file}.hpp")
}

/// Hands out names of ROS 2, each at most once.
#[derive(Default)]
struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    fn take(&mut self, name: &str) -> String {
        let plain = plain(name);
        let mut own = plain.clone();
        let mut number = 2;
        while !self.taken.insert(own.clone()) {
            own = format!("{plain}{number}");
            number += 1;
        }
        own
    }
}

/// Letters, digits and single underscores; a letter first.
fn plain(name: &str) -> String {
    let mut out = String::new();
    for character in name.chars() {
        let character = if character.is_ascii_alphanumeric() { character } else { '_' };
        if character != '_' || !(out.is_empty() || out.ends_with('_')) {
            out.push(character);
        }
    }
    let out = out.trim_end_matches('_').to_owned();
    if out.starts_with(|first: char| first.is_ascii_alphabetic()) { out } else { format!("n{out}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_those_of_rosidl() {
        for (interface, header) in [
            ("sensor_msgs/msg/FluidPressure", "sensor_msgs/msg/fluid_pressure.hpp"),
            ("std_msgs/msg/UInt16MultiArray", "std_msgs/msg/u_int16_multi_array.hpp"),
            ("std_msgs/msg/Float64", "std_msgs/msg/float64.hpp"),
            ("sensor_msgs/msg/Imu", "sensor_msgs/msg/imu.hpp"),
        ] {
            assert_eq!(header_of(interface), header);
        }
    }

    #[test]
    fn names_are_those_of_ros() {
        let mut names = Names::default();
        for (name, expected) in [
            ("IRFront", "IRFront"),
            ("_a__b_", "a_b"),
            ("a_b", "a_b2"),
            ("4wd", "n4wd"),
            ("Größe", "Gr_e"),
        ] {
            assert_eq!(names.take(name), expected);
        }
    }
}
