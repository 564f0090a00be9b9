//! Zenoh: the others are two programs with the library in Python, a router and a client behind it.

use std::process::Command;

use sensedsl_tests::{has_python, root};
use serde_json::Value;

use super::{Running, free_port, robot, shown, text, until};

fn peer(mode: &str, endpoint: &str) -> Running {
    let script = root().join("tests/hosts/zenoh_peer.py");
    let peer = Running::start(Command::new("python3").arg(script).args([mode, endpoint]));
    until(|| peer.printed().iter().any(|line| line == "ready"), || peer.said());
    peer
}

/// What a peer has printed behind a word and a key.
fn of(peer: &Running, what: &str) -> Vec<Value> {
    let lines = peer.printed();
    let own = lines.iter().filter_map(|line| line.strip_prefix(what)?.strip_prefix(' '));
    own.map(|json| serde_json::from_str(json).unwrap()).collect()
}

#[test]
fn values_go_through_a_router_and_commands_come_back() {
    if !has_python("zenoh") {
        return;
    }
    let (scratch, _) = robot("sinks-zenoh");
    let endpoint = format!("tcp/127.0.0.1:{}", free_port());
    let router = peer("router", &endpoint);
    let mut client = peer("client", &endpoint);
    let config = format!(
        "[zenoh]\nmode = \"client\"\nconnect = [\"{endpoint}\"]\nscouting = false\n[devices.\"Rover/Light\"]\nunit = \"m\"\n"
    );
    let config = scratch.write("sinks.toml", config);
    let mut run = Running::monitor([
        "simulate",
        text(&scratch.join("robot.sense")),
        "--format",
        "ndjson",
        "--config",
        text(&config),
    ]);
    until(|| of(&client, "sample sensedsl/Rover/Turns").len() > 10, || run.said());
    let alive = "alive sensedsl/Rover/link/alive".to_owned();
    until(|| client.printed().contains(&alive), || run.said());
    let printed = shown(&run.printed());
    for (name, factor) in [("Light", 0.01), ("Turns", 1.0)] {
        let values: Vec<f64> =
            printed.iter().filter(|one| one.0 == name).map(|one| one.1.as_f64().unwrap()).collect();
        let found = of(&client, &format!("sample sensedsl/Rover/{name}"));
        let mut rest = values.iter();
        for sample in found.iter().take(8) {
            let value = sample["value"].as_f64().unwrap();
            assert!(rest.any(|one| (one * factor - value).abs() < 1e-9), "{name}: {sample}");
        }
    }
    client.type_in("sensedsl/Rover/Servo/set 45.5");
    run.says("sent: Servo = 455 (45.5 deg)");
    client.type_in("sensedsl/Rover/Servo/set 181");
    run.says("Zenoh: Servo not set: 181 deg is above the maximum of 180");
    until(|| !of(&client, "sample sensedsl/Rover/Servo").is_empty(), || run.said());
    // Who comes later asks.
    let mut later = peer("client", &endpoint);
    later.type_in("get");
    until(|| later.printed().iter().any(|line| line == "end"), || later.said());
    let servo = of(&later, "got sensedsl/Rover/Servo");
    assert_eq!((servo.len(), &servo[0]["value"]), (1, &45.5.into()));
    assert_eq!(of(&later, "got sensedsl/Rover/link/presence")[0]["online"], true);
    // A program that is killed takes its token with it.
    run.kill();
    let gone = "gone sensedsl/Rover/link/alive".to_owned();
    until(|| later.printed().contains(&gone), || later.said());
    drop(router);
}

#[test]
fn a_router_may_come_later_and_two_peers_need_none() {
    if !has_python("zenoh") {
        return;
    }
    let (scratch, _) = robot("sinks-zenoh-later");
    let endpoint = format!("tcp/127.0.0.1:{}", free_port());
    let own = format!("tcp/127.0.0.1:{}", free_port());
    let config = format!(
        "[zenoh]\nconnect = [\"{endpoint}\"]\nlisten = [\"{own}\"]\nscouting = false\nprefix = \"sensedsl/car\"\n"
    );
    let config = scratch.write("sinks.toml", config);
    let run = Running::monitor([
        "simulate",
        text(&scratch.join("robot.sense")),
        "--format",
        "ndjson",
        "--config",
        text(&config),
    ]);
    until(|| run.printed().len() > 10, || run.said());
    // Straight to the monitor.
    let direct = peer("client", &own);
    until(|| of(&direct, "sample sensedsl/car/Rover/Light").len() > 5, || run.said());
    // Through a router that was not there when it began.
    let router = peer("router", &endpoint);
    let behind = peer("client", &endpoint);
    until(|| of(&behind, "sample sensedsl/car/Rover/Light").len() > 5, || run.said());
    drop(router);
}
