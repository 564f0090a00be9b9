//! Prometheus: the text is read by the parser of its client for Python.

use std::net::TcpListener;
use std::process::{Command, Stdio};

use sensedsl_tests::has_python;
use serde_json::Value;

use super::websocket::get;
use super::{Running, free_port, robot, shown, text, until};

const READER: &str = "
import json, sys
from prometheus_client.parser import text_string_to_metric_families as families
print(json.dumps([[one.name, one.labels, one.value] for all in families(sys.stdin.read()) for one in all.samples]))
";

/// All samples: name, labels, value.
fn samples(page: &str) -> Vec<(String, Value, f64)> {
    let (head, body) = page.split_once("\r\n\r\n").unwrap();
    assert!(head.starts_with("HTTP/1.1 200 OK\r\n") && head.contains("version=0.0.4"), "{head}");
    let mut child = Command::new("python3")
        .args(["-c", READER])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), body.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{body}");
    let all: Vec<(String, Value, f64)> = serde_json::from_slice(&output.stdout).unwrap();
    all
}

#[test]
fn the_latest_of_all_is_there_for_who_asks() {
    if !has_python("prometheus_client.parser") {
        return;
    }
    let (scratch, _) = robot("sinks-prometheus");
    let port = free_port();
    let config =
        scratch.write("sinks.toml", format!("[prometheus]\nlisten = \"127.0.0.1:{port}\"\n"));
    let file = scratch.join("robot.sense");
    let call = ["simulate", text(&file), "--format", "ndjson", "--set", "Servo=30", "--config"];
    let run = Running::monitor(call.into_iter().chain([text(&config)]));
    run.says(&format!("Prometheus: http://127.0.0.1:{port}/metrics"));
    run.says("set Servo");
    until(|| run.printed().len() > 20, || run.said());
    let found = samples(&get(port, "/metrics"));
    let of = |name: &str, device: &str| -> Option<f64> {
        let mut all =
            found.iter().filter(|(one, labels, _)| one == name && labels["device"] == device);
        let found = all.next().map(|one| one.2);
        assert!(all.next().is_none(), "{name} of {device} twice");
        found
    };
    let printed = shown(&run.printed());
    let light = of("sensedsl_value", "Light").unwrap();
    assert!(printed.iter().any(|(name, value)| name == "Light" && *value == light), "{light}");
    assert_eq!(of("sensedsl_value", "Servo"), Some(30.0));
    let count = of("sensedsl_values_total", "Light").unwrap();
    let lights = printed.iter().filter(|(name, _)| name == "Light").count();
    assert!(count > 5.0 && count <= lights as f64, "{count} of {lights}");
    let (_, labels, _) = found.iter().find(|(_, labels, _)| labels["device"] == "Light").unwrap();
    let expected = serde_json::json!(
        { "board": "Rover", "device": "Light", "topic": "Rover/Light", "unit": "cm" }
    );
    assert_eq!(*labels, expected);
    let online = found.iter().find(|one| one.0 == "sensedsl_board_online").unwrap();
    assert_eq!((&online.1["board"], online.2), (&"Rover".into(), 1.0));
    assert_eq!(of("sensedsl_device_failures_total", "Light"), Some(0.0));
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap();
    let taken = of("sensedsl_value_timestamp_seconds", "Light").unwrap();
    assert!((now.as_secs_f64() - taken).abs() < 30.0, "{taken}");
    // Each time the latest.
    until(
        || {
            let again = samples(&get(port, "/metrics"));
            let is_light = |one: &&(String, Value, f64)| {
                one.0 == "sensedsl_values_total" && one.1["device"] == "Light"
            };
            again.iter().find(is_light).unwrap().2 > count
        },
        || "no new value".to_owned(),
    );
    assert!(get(port, "/").starts_with("HTTP/1.1 404 "));
}

#[test]
fn an_address_that_is_taken_is_waited_for() {
    let (scratch, _) = robot("sinks-prometheus-taken");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let config =
        scratch.write("sinks.toml", format!("[prometheus]\nlisten = \"127.0.0.1:{port}\"\n"));
    let file = scratch.join("robot.sense");
    let run = Running::monitor(["simulate", text(&file), "--config", text(&config)]);
    run.says(&format!("Prometheus: cannot listen on 127.0.0.1:{port}: "));
    drop(taken);
    run.says("Prometheus: works again");
    assert!(get(port, "/metrics").contains("sensedsl_board_online{board=\"Rover\"} 1"));
}
