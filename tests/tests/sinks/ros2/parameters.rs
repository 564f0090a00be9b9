//! Parameters of the node, asked for in the form in which the middleware of ROS 2 does.

use sensedsl_tests::has_python;
use serde_json::{Value, json};

use super::{ROBOT, domain, of, peer, start};
use crate::monitor::robot_of;
use crate::sinks::{Running, until};

/// Asks, and waits for the answer.
#[track_caller]
fn asked(peer: &mut Running, service: &str, request: &Value) -> Value {
    let before = of(peer, service).len();
    peer.type_in(&format!("{service} {request}"));
    until(|| of(peer, service).len() > before, || format!("{service}: {}", peer.said()));
    of(peer, service).pop().unwrap()
}

/// One value of an answer to `get_parameters`.
fn got(peer: &mut Running, name: &str) -> Value {
    asked(peer, "get_parameters", &json!({ "names": [name] }))["values"][0].clone()
}

#[test]
fn actuators_are_parameters_for_cyclonedds() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let (scratch, _) = robot_of("sinks-ros2-parameters", ROBOT);
    let domain = domain(4);
    let node = ["car/robot?cyclonedds", "parameter_events=rcl_interfaces/msg/ParameterEvent"];
    let mut peer = peer("jazzy", &domain, &node);
    let config = format!(
        "[ros2]\ndomain = {domain}\nnamespace = \"car\"\nnode = \"robot\"\nrmw = \"cyclonedds\"\n"
    );
    let config = scratch.write("sinks.toml", config);
    let run = start(&scratch.join("robot.sense"), &config);
    let list = json!({ "prefixes": [], "depth": 0 });
    let listed = asked(&mut peer, "list_parameters", &list);
    let all = json!({ "names": ["Rover.Lamps", "Rover.Servo"], "prefixes": ["Rover"] });
    assert_eq!(listed["result"], all);
    let list = json!({ "prefixes": ["Rover.Lamps", "Rove"], "depth": 1 });
    let listed = asked(&mut peer, "list_parameters", &list);
    assert_eq!(listed["result"]["names"], json!(["Rover.Lamps"]));
    let names = json!({ "names": ["Rover.Servo", "Rover.Lamps", "Rover.Wall"] });
    let described = asked(&mut peer, "describe_parameters", &names)["descriptors"].clone();
    assert_eq!(
        (&described[0]["type"], &described[1]["type"], &described[2]["type"]),
        (&json!(3), &json!(6), &json!(0))
    );
    let range = json!([{ "from_value": 0.0, "to_value": 180.0, "step": 0.0 }]);
    assert_eq!(described[0]["floating_point_range"], range);
    assert_eq!(described[0]["description"], "actuator Servo in deg");
    // Nothing was set so far.
    assert_eq!(got(&mut peer, "Rover.Servo")["type"], 0);
    let set = asked(&mut peer, "set_parameters", &json!({ "Rover.Servo": 45.5 }));
    assert_eq!(set["results"], json!([{ "successful": true, "reason": "" }]));
    run.says("sent: Servo = 455 (45.5 deg)");
    until(|| got(&mut peer, "Rover.Servo")["double_value"] == 45.5, || run.said());
    // A whole number, as it is typed, and a list.
    let set = asked(
        &mut peer,
        "set_parameters",
        &json!({ "Rover.Servo": 20, "Rover.Lamps": [true, false, true] }),
    );
    assert_eq!(set["results"][1]["successful"], true);
    run.says("sent: Servo = 200 (20 deg)");
    run.says("sent: Lamps = [true, false, true]");
    until(
        || got(&mut peer, "Rover.Lamps")["bool_array_value"] == json!([true, false, true]),
        || run.said(),
    );
    assert_eq!(asked(&mut peer, "get_parameter_types", &names)["types"], json!([3, 6, 0]));
    // What is refused is answered with the reason, and told.
    for (wanted, why) in [
        (json!({ "Rover.Servo": 181.0 }), "181 deg is above the maximum of 180"),
        (json!({ "Rover.Servo": [1.0, 2.0] }), "2 values for 1"),
        (json!({ "Rover.Wall": 1.0 }), "there is no such actuator"),
    ] {
        let refused = asked(&mut peer, "set_parameters", &wanted)["results"][0].clone();
        let reason = refused["reason"].as_str().unwrap();
        assert!(refused["successful"] == false && reason.contains(why), "{wanted}: {refused}");
    }
    run.says("Servo not set: ");
    // All or none of them.
    let wanted = json!({ "Rover.Servo": 30.0, "Rover.Lamps": [1, 0] });
    let refused = asked(&mut peer, "set_parameters_atomically", &wanted)["result"].clone();
    assert!(refused["successful"] == false, "{refused}");
    let wanted = json!({ "Rover.Servo": "30.5 deg", "Rover.Lamps": [false, false, false] });
    let taken = asked(&mut peer, "set_parameters_atomically", &wanted)["result"].clone();
    assert_eq!(taken["successful"], true);
    run.says("sent: Servo = 305 (30.5 deg)");
    assert!(!run.said().contains("(30 deg)"), "{}", run.said());
    // Others notice what was set.
    let changed = |one: &Value| one["changed_parameters"][0]["value"]["double_value"] == 30.5;
    until(|| of(&peer, "parameter_events").iter().any(changed), || run.said());
}

/// The usual middleware puts nothing before a request.
#[test]
fn parameters_for_fastrtps_have_no_header_and_may_be_closed() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let (scratch, _) = robot_of("sinks-ros2-closed", ROBOT);
    let domain = domain(5);
    let mut peer = peer("humble", &domain, &["sensedsl?fastrtps"]);
    let config = format!("[ros2]\ndomain = {domain}\ncommands = false\n");
    let config = scratch.write("sinks.toml", config);
    let mut run = start(&scratch.join("robot.sense"), &config);
    let set = asked(&mut peer, "set_parameters", &json!({ "Rover.Servo": 45.5 }));
    assert_eq!(set["results"][0]["successful"], false);
    assert_eq!(set["results"][0]["reason"], "other programs may not set actuators here");
    run.type_in("Servo = 12.5");
    run.says("sent: Servo = 125 (12.5 deg)");
    until(|| got(&mut peer, "Rover.Servo")["double_value"] == 12.5, || run.said());
    let names = json!({ "names": ["Rover.Servo"] });
    let described = asked(&mut peer, "describe_parameters", &names)["descriptors"][0].clone();
    assert_eq!(described["read_only"], true);
}
