//! Messages that are put together from several devices: a world says what each measures, and the peer reads the same.

use serde_json::{Value, json};

use super::{domain, of, peer};
use crate::monitor::robot_of;
use crate::sinks::{Running, text, until};
use sensedsl_tests::has_python;

const VEHICLE: &str = "board Rover on NUCLEO_F446RE {
    sensor Lat returns uint16 { id = 17; type = analog; delay = 20 ms; scale = 0.05; offset = -90; quantity = deg; }
    sensor Lon returns uint16 { id = 18; type = analog; delay = 20 ms; scale = 0.1; offset = -180; quantity = deg; }
    sensor Alt returns uint16 { id = 19; type = analog; delay = 50 ms; quantity = cm; }
    sensor HasFix returns bool { id = 20; type = digital; delay = 20 ms; }
    sensor Volts returns uint16 { id = 21; type = analog; delay = 20 ms; scale = 4; quantity = mV; }
    sensor Amps returns uint16 { id = 22; type = analog; delay = 20 ms; scale = 0.01; offset = -20; quantity = A; }
    sensor Charge returns uint16 { id = 23; type = analog; delay = 20 ms; quantity = mAh; }
    sensor Percent returns uint16 { id = 24; type = analog; delay = 20 ms; scale = 0.1; quantity = \"%\"; }
    sensor Warm returns uint16 { id = 25; type = analog; delay = 20 ms; scale = 0.1; quantity = K; }
    sensor X returns uint16 { id = 26; type = analog; delay = 20 ms; scale = 0.001; offset = -2; }
    sensor Sticks returns uint16[2] { id = 27; type = analog; delay = 20 ms; scale = 0.001; offset = -2; }
    sensor Fire returns bool { id = 28; type = digital; delay = 20 ms; }
    sensor Keys returns bool[2] { id = 29; type = digital; delay = 20 ms; }
}";

const WORLD: &str = "[devices]
Lat = 52.5\nLon = 13.4\nAlt = 3400\nHasFix = true\nVolts = 11400\nAmps = -1.25\nCharge = 2200\nPercent = 75.5
Warm = 300.1\nX = 0.25\nSticks = [-1.5, 1.75]\nFire = true\nKeys = [false, true]\n";

const MESSAGES: &str = "[devices.X]\nleave_out = true
[messages.fix]
type = \"NavSatFix\"\nframe = \"gps\"\nlatitude = \"Rover/Lat\"\nlongitude = \"Lon\"\naltitude = \"Alt\"\nstatus = \"HasFix\"
[messages.\"power/battery\"]
type = \"BatteryState\"\nvoltage = \"Volts\"\ncurrent = \"Amps\"\ncharge = \"Charge\"\npercentage = \"Percent\"
temperature = \"Warm\"
[messages.pad]
type = \"sensor_msgs/msg/Joy\"\naxes = [\"X\", \"Rover/Sticks[1]\", \"Sticks[0]\"]\nbuttons = [\"Fire\", \"Keys[0]\", \"Keys[1]\"]\n";

/// `monitor simulate` of a design in a world, with the messages of a configuration.
fn simulated(name: &str, design: &str, world: &str, config: &str, more: &[&str]) -> Running {
    let (scratch, _) = robot_of(name, design);
    let config = scratch.write("sinks.toml", config);
    let world = scratch.write("world.toml", world);
    let file = scratch.join("robot.sense");
    let mut arguments = vec!["simulate", text(&file), "--format", "ndjson", "--config"];
    arguments.extend([text(&config), "--world", text(&world)]);
    arguments.extend(more);
    let run = Running::monitor(arguments);
    // The files are read before the first value comes.
    until(|| !run.printed().is_empty(), || run.said());
    run
}

#[track_caller]
fn near(one: &Value, other: f64) {
    let found = one.as_f64().unwrap_or_else(|| panic!("{one} is no number"));
    assert!((found - other).abs() < 1e-4 * other.abs().max(1.0), "{found} is not {other}");
}

#[test]
fn several_devices_go_out_in_one_message() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let domain = domain(2);
    let topics = [
        "car/fix=sensor_msgs/msg/NavSatFix",
        "car/power/battery=sensor_msgs/msg/BatteryState",
        "car/pad=sensor_msgs/msg/Joy",
        "car/Rover/Volts=std_msgs/msg/Float64",
        "car/Rover/X=std_msgs/msg/Float64",
        "car/Rover/Alt=sensor_msgs/msg/Range",
    ];
    let peer = peer("iron", &domain, &topics);
    let config =
        format!("[ros2]\ndomain = {domain}\nnamespace = \"car\"\ndistro = \"iron\"\n{MESSAGES}");
    let run = simulated("sinks-ros2-together", VEHICLE, WORLD, &config, &[]);
    for topic in ["car/fix", "car/power/battery", "car/pad", "car/Rover/Volts", "car/Rover/Alt"] {
        until(|| of(&peer, topic).len() > 5, || format!("{topic}: {}", run.said()));
    }
    let last = |topic: &str| of(&peer, topic).pop().unwrap();
    let fix = last("car/fix");
    near(&fix["latitude"], 52.5);
    near(&fix["longitude"], 13.4);
    near(&fix["altitude"], 34.0);
    assert_eq!(fix["status"], json!({ "status": 0, "service": 1 }));
    assert_eq!(
        (&fix["header"]["frame_id"], &fix["position_covariance_type"]),
        (&json!("gps"), &json!(0))
    );
    let battery = last("car/power/battery");
    for (field, value) in [
        ("voltage", 11.4),
        ("current", -1.25),
        ("charge", 2.2),
        ("percentage", 0.755),
        ("temperature", 26.95),
    ] {
        near(&battery[field], value);
    }
    // What is not named is not measured.
    assert_eq!((&battery["capacity"], &battery["design_capacity"]), (&json!("nan"), &json!("nan")));
    assert_eq!((&battery["power_supply_status"], &battery["present"]), (&json!(0), &json!(true)));
    assert_eq!(battery["header"]["frame_id"], "Rover");
    let pad = last("car/pad");
    for (axis, value) in [0.25, 1.75, -1.5].into_iter().enumerate() {
        near(&pad["axes"][axis], value);
    }
    assert_eq!(pad["buttons"], json!([1, 0, 1]));
    // A device of a message has its own topic as well, unless it is left out.
    near(&last("car/Rover/Volts")["data"], 11_400.0);
    near(&last("car/Rover/Alt")["range"], 34.0);
    assert_eq!(of(&peer, "car/Rover/X"), Vec::<Value>::new());
}

const ARM: &str = "board Rover on NUCLEO_F446RE {
    sensor Hip returns int32 { id = 17; type = encoder; delay = 20 ms; scale = 0.5; quantity = deg; }
    sensor Knee returns int32 { id = 18; type = encoder; delay = 20 ms; scale = 0.5; quantity = deg; }
    sensor Speeds returns uint16[2] { id = 19; type = analog; delay = 20 ms; scale = 0.1; offset = -200; quantity = rpm; }
    sensor Shake returns uint16[3] { id = 20; type = analog; delay = 20 ms; scale = 0.001; offset = -2; quantity = g; }
    sensor GyroX returns uint16 { id = 21; type = analog; delay = 20 ms; scale = 0.1; offset = -200; quantity = \"deg/s\"; }
    sensor GyroY returns uint16 { id = 22; type = analog; delay = 20 ms; scale = 0.1; offset = -200; quantity = \"deg/s\"; }
    sensor GyroZ returns uint16 { id = 23; type = analog; delay = 20 ms; scale = 0.1; offset = -200; quantity = \"deg/s\"; }
    sensor Wall returns uint16 { id = 24; type = analog; delay = 20 ms; scale = 0.5; quantity = cm; }
    sensor Rare returns uint16 { id = 25; type = analog; delay = 500 ms; scale = 0.001; }
}";

/// Joints and movements; and `Range` in the older layout, which the option asks for against the file.
#[test]
fn joints_and_movements_go_out_together_for_the_release_of_the_option() {
    if !has_python("cyclonedds, rosbags.typesys") {
        return;
    }
    let domain = domain(3);
    let topics = [
        "legs=sensor_msgs/msg/JointState",
        "imu=sensor_msgs/msg/Imu",
        "slow=sensor_msgs/msg/Joy",
        "Rover/Wall=sensor_msgs/msg/Range",
    ];
    let peer = peer("humble", &domain, &topics);
    let config = format!(
        "[messages.legs]\ntype = \"JointState\"\nposition = [\"Hip\", \"Knee\"]\nvelocity = [\"Speeds[0]\", \"Speeds[1]\"]
[messages.imu]\ntype = \"Imu\"\nlinear_acceleration = \"Shake\"\nangular_velocity = [\"GyroX\", \"GyroY\", \"GyroZ\"]
[messages.slow]\ntype = \"Joy\"\naxes = [\"Rare\", \"Wall\"]
[ros2]\ndomain = {domain}\ndistro = \"jazzy\"\n"
    );
    let world = "[devices]\nHip = { ramp = [0, 90], over = \"300 ms\" }
Knee = { ramp = [0, -45], over = \"300 ms\" }
Speeds = [30, -60]\nShake = [0.5, -1, 1.25]
GyroX = 90\nGyroY = -45\nGyroZ = 10\nWall = 150\nRare = 2.5\n";
    let run = simulated("sinks-ros2-arm", ARM, world, &config, &["--ros-distro", "humble"]);
    for (topic, count) in [("legs", 5), ("imu", 5), ("Rover/Wall", 20), ("slow", 2)] {
        until(|| of(&peer, topic).len() > count, || format!("{topic}: {}", run.said()));
    }
    // An encoder counts from where it began, give or take an edge.
    let is_there = |legs: &Value| {
        let joints = [(0, 90.0_f64), (1, -45.0)];
        joints.into_iter().all(|(joint, degrees)| {
            let position = legs["position"][joint].as_f64().unwrap();
            (position - degrees.to_radians()).abs() < 0.01
        })
    };
    until(|| of(&peer, "legs").last().is_some_and(is_there), || run.said());
    let legs = of(&peer, "legs").pop().unwrap();
    assert_eq!(legs["name"], json!(["Hip", "Knee"]));
    for (joint, rpm) in [(0, 30.0), (1, -60.0)] {
        near(&legs["velocity"][joint], rpm * 6_f64.to_radians());
    }
    assert_eq!(legs["effort"], json!([]));
    let imu = of(&peer, "imu").pop().unwrap();
    for (axis, (gravity, degrees)) in
        [("x", (0.5, 90.0_f64)), ("y", (-1.0, -45.0)), ("z", (1.25, 10.0))]
    {
        near(&imu["linear_acceleration"][axis], gravity * 9.806_65);
        near(&imu["angular_velocity"][axis], degrees.to_radians());
    }
    // Both are measured, the orientation is not.
    let covariance = |field: &str| imu[format!("{field}_covariance")][0].as_f64().unwrap();
    let all = ["linear_acceleration", "angular_velocity", "orientation"].map(covariance);
    assert!(all == [0.0, 0.0, -1.0], "{all:?}");
    let wall = of(&peer, "Rover/Wall").pop().unwrap();
    near(&wall["range"], 1.5);
    assert!(wall["variance"].is_null(), "{wall}");
    // Once with each value of the first device, and not with those of the others.
    let (slow, quick) = (of(&peer, "slow").len(), of(&peer, "Rover/Wall").len());
    assert!(slow * 5 < quick, "{slow} of {quick}");
}
