//! ROS 2: another program of the domain is CycloneDDS, with the definitions of messages that rosbags has.

mod messages;
mod parameters;

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{has_python, root};
use serde_json::Value;

use super::{Running, shown, text, until};
use crate::monitor::robot_of;

/// A board with something for each type of message.
const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Wall returns uint16 { id = 17; type = analog; delay = 20 ms; scale = 0.5; quantity = cm; min = 5; max = 900; }
    sensor Oven returns uint16 { id = 18; type = analog; delay = 50 ms; scale = 0.1; quantity = degC; }
    sensor Push returns uint16[3] { id = 19; type = analog; delay = 50 ms; scale = 0.001; quantity = g; }
    sensor Volts returns uint16 { id = 20; type = analog; delay = 50 ms; scale = 0.01; quantity = V; }
    sensor Switch returns bool { id = 21; type = digital; delay = 50 ms; }
    sensor Wheel returns int32 { id = 22; type = encoder; delay = 50 ms; scale = 0.5; quantity = deg; }
    actuator Servo accepts uint16 { id = 23; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; }
    actuator Lamps accepts bool[3] { id = 24; type = digital; }
}";

/// A domain of this run alone.
fn domain(test: u32) -> String {
    (20 + 6 * (std::process::id() % 33) + test).to_string()
}

fn peer(distro: &str, domain: &str, topics: &[&str]) -> Running {
    let peer = Running::start(
        Command::new("python3")
            .arg(root().join("tests/hosts/ros2_peer.py"))
            .args([distro, domain])
            .args(topics),
    );
    until(|| peer.printed().iter().any(|line| line == "ready"), || peer.said());
    peer
}

/// The messages of a topic.
fn of(peer: &Running, topic: &str) -> Vec<Value> {
    let lines = peer.printed();
    let own = lines.iter().filter_map(|line| line.strip_prefix(topic)?.strip_prefix(' '));
    own.map(|json| serde_json::from_str(json).unwrap()).collect()
}

fn start(file: &Path, config: &Path) -> Running {
    Running::monitor(["simulate", text(file), "--format", "ndjson", "--config", text(config)])
}

#[test]
fn each_device_has_its_message() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let (scratch, _) = robot_of("sinks-ros2", ROBOT);
    let domain = domain(0);
    let peer = peer(
        "jazzy",
        &domain,
        &[
            "Rover/Wall=sensor_msgs/msg/Range",
            "Rover/Oven=sensor_msgs/msg/Temperature",
            "Rover/Push=sensor_msgs/msg/Imu",
            "Rover/Volts=std_msgs/msg/Float64",
            "Rover/Switch=std_msgs/msg/Bool",
            "Rover/Wheel=sensor_msgs/msg/JointState",
            "diagnostics=diagnostic_msgs/msg/DiagnosticArray",
            "Rover/Servo=std_msgs/msg/Float64",
            "Rover/Servo/set:std_msgs/msg/Float64:45.5",
            "Rover/Servo/set:std_msgs/msg/Float64:181.0",
        ],
    );
    let config =
        format!("[ros2]\ndomain = {domain}\n[devices.\"Rover/Wall\"]\nframe = \"front\"\n");
    let config = scratch.write("sinks.toml", config);
    let run = start(&scratch.join("robot.sense"), &config);
    run.says("sent: Servo = 455 (45.5 deg)");
    run.says("ROS 2: Servo not set: 181 deg is above the maximum of 180");
    for name in ["Wall", "Oven", "Push", "Volts", "Switch", "Wheel"] {
        until(
            || of(&peer, &format!("Rover/{name}")).len() > 5,
            || format!("{name}: {}", run.said()),
        );
    }
    until(|| !of(&peer, "Rover/Servo").is_empty(), || run.said());
    until(|| !of(&peer, "diagnostics").is_empty(), || run.said());
    let messages = |name: &str| of(&peer, &format!("Rover/{name}"));
    let printed = shown(&run.printed());
    let all = |name: &str| -> Vec<Value> {
        printed.iter().filter(|one| one.0 == name).map(|one| one.1.clone()).collect()
    };
    let is_near = |one: &Value, other: f64| (one.as_f64().unwrap() - other).abs() < 1e-4;
    for (name, field, factor) in
        [("Wall", "range", 0.01), ("Oven", "temperature", 1.0), ("Volts", "data", 1.0)]
    {
        let values = all(name);
        let found = messages(name);
        // Values in their order, from when the two had found each other.
        let first = values.len() - values.len().min(found.len() + 40);
        let mut rest = values[first..].iter();
        for message in found.iter().take(5) {
            let is_it = |value: &Value| is_near(&message[field], value.as_f64().unwrap() * factor);
            assert!(rest.any(is_it) || values.iter().any(is_it), "{name}: {message}");
        }
    }
    let wall = &messages("Wall")[0];
    assert!(is_near(&wall["min_range"], 0.05) && is_near(&wall["max_range"], 9.0), "{wall}");
    assert_eq!((&wall["header"]["frame_id"], &wall["variance"]), (&"front".into(), &0.0.into()));
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap();
    let sec = wall["header"]["stamp"]["sec"].as_u64().unwrap();
    assert!(now.as_secs() - sec < 60, "{wall}");
    let push = &messages("Push")[0];
    let x = push["linear_acceleration"]["x"].as_f64().unwrap() / 9.806_65;
    assert!(all("Push").iter().any(|value| is_near(&value[0], x)), "{push}");
    assert_eq!(push["angular_velocity_covariance"][0], -1.0);
    assert_eq!(push["orientation_covariance"][0], -1.0);
    assert_eq!(push["header"]["frame_id"], "Rover");
    let wheel = &messages("Wheel")[0];
    assert_eq!(wheel["name"], serde_json::json!(["Wheel"]));
    let degrees = wheel["position"][0].as_f64().unwrap().to_degrees();
    assert!(all("Wheel").iter().any(|value| is_near(value, degrees)), "{wheel}");
    assert!(messages("Switch").iter().all(|message| message["data"].is_boolean()));
    assert_eq!(messages("Servo").last().unwrap()["data"], 45.5);
    let status = &of(&peer, "diagnostics")[0]["status"][0];
    assert_eq!((&status["name"], &status["hardware_id"]), (&"Rover".into(), &"Rover".into()));
}

/// `Range` has a field less in Humble, which a reader of its definition would stumble over.
#[test]
fn humble_has_its_own_layout_and_arrays_are_set() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let (scratch, _) = robot_of("sinks-ros2-humble", ROBOT);
    let domain = domain(1);
    let topics = [
        "car/Rover/Wall=sensor_msgs/msg/Range",
        "car/Rover/Lamps=std_msgs/msg/Float64MultiArray",
        "car/Rover/Lamps/set:std_msgs/msg/Float64MultiArray:[1, 0, 1]",
    ];
    let peer = peer("humble", &domain, &topics);
    let config = format!("[ros2]\ndomain = {domain}\ndistro = \"humble\"\nnamespace = \"/car\"\n");
    let config = scratch.write("sinks.toml", config);
    let run = start(&scratch.join("robot.sense"), &config);
    run.says("sent: Lamps = [true, false, true]");
    until(|| of(&peer, "car/Rover/Wall").len() > 5, || run.said());
    let wall = &of(&peer, "car/Rover/Wall")[0];
    assert!(wall["variance"].is_null() && wall["range"].as_f64().unwrap() > 0.0, "{wall}");
    until(|| !of(&peer, "car/Rover/Lamps").is_empty(), || run.said());
    assert_eq!(of(&peer, "car/Rover/Lamps")[0]["data"], serde_json::json!([1.0, 0.0, 1.0]));
}
