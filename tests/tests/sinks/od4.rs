//! OD4: another program of the session is pycluon, which reads and sends messages by the generated `sense.odvd`.

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{has_python, root, sensedsl};
use serde_json::Value;

use super::{Running, robot, shown, text, until};

/// A session of this run alone.
fn session(test: u32) -> String {
    (10 + 9 * (std::process::id() % 27) + test).to_string()
}

fn peer(design: &Path, out: &Path, cid: &str, sent: &[&str]) -> Running {
    let write = ["generate", "--quiet", "--host", "libcluon", "--without", "firmware", "-o"];
    let _ = sensedsl(write).arg(out).arg(design).run().exits(0);
    let odvd = out.join("host/libcluon/sense.odvd");
    let peer = Running::start(
        Command::new("python3")
            .arg(root().join("tests/hosts/od4_peer.py"))
            .args([cid, text(&odvd)])
            .args(sent),
    );
    until(|| peer.printed().iter().any(|line| line == "ready"), || peer.said());
    peer
}

#[test]
fn messages_are_those_of_the_generated_host() {
    if !has_python("pycluon.importer") {
        return;
    }
    let (scratch, _) = robot("sinks-od4");
    let cid = session(6);
    let file = scratch.join("robot.sense");
    let sent = [
        "21019:sense_robot_Servo:value=45.5",
        "21019:sense_robot_Servo:raw=300,is_raw=True",
        "21019:sense_robot_Servo:raw=300",
    ];
    let peer = peer(&file, &scratch.join("od4"), &cid, &sent);
    let config = scratch.write("sinks.toml", format!("[od4]\ncid = {cid}\n"));
    let call = ["simulate", text(&file), "--seconds", "3", "--format", "ndjson", "--config"];
    let mut run = Running::monitor(call.into_iter().chain([text(&config)]));
    assert_eq!(run.ends(), 0, "{}", run.said());
    let said = run.said();
    let places: Vec<Option<usize>> = [
        "sent: Servo = 455 (45.5 deg)",
        "sent: Servo = 300 (30 deg)",
        "OD4: Servo not set: `raw` is set and `is_raw` is not",
    ]
    .iter()
    .map(|line| said.find(line))
    .collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{said}");
    let printed = shown(&run.printed());
    for (name, number, scale) in [("Light", 21_017, Some((0.5, -10.0))), ("Turns", 21_018, None)] {
        let all: Vec<f64> =
            printed.iter().filter(|one| one.0 == name).map(|one| one.1.as_f64().unwrap()).collect();
        let prefix = format!("{number} {} raw=", number - 21_000);
        let heard = || -> Vec<f64> {
            let lines = peer.printed();
            let lines = lines.iter().filter_map(|line| line.strip_prefix(&prefix));
            let of = |line: &str| match (scale, line.split_once(" value=")) {
                (Some((scale, offset)), Some((raw, value))) => {
                    let (raw, value): (f64, f64) = (raw.parse().unwrap(), value.parse().unwrap());
                    assert_eq!(value, raw * scale + offset);
                    value
                }
                (None, None) => line.parse().unwrap(),
                _ => panic!("{line}"),
            };
            lines.map(of).collect()
        };
        until(|| heard().last() == all.last(), || format!("{name}: {:?}", heard().len()));
        assert!(all.len() > 10 && heard() == all, "{name}: {} of {}", heard().len(), all.len());
    }
}

/// Values of all types and arrays, as other programs read them.
#[test]
fn arrays_and_signs_are_kept() {
    if !has_python("pycluon.importer") {
        return;
    }
    let (scratch, _) = robot("sinks-od4-types");
    let cid = session(7);
    let file = Path::new("examples/line_follower.sense");
    let sent = ["21002:sense_line_follower_Left:raw=-77,is_raw=True"];
    let peer = peer(file, &scratch.join("od4"), &cid, &sent);
    let config = scratch.write("sinks.toml", format!("[od4]\ncid = {cid}\n"));
    let call = ["simulate", text(file), "--seconds", "2", "--format", "ndjson", "--config"];
    let mut run = Running::monitor(call.into_iter().chain([text(&config)]));
    assert_eq!(run.ends(), 0, "{}", run.said());
    let printed = shown(&run.printed());
    for name in ["Line", "Wheels"] {
        let last = |name: &str| -> &Value { &printed.iter().rfind(|one| one.0 == name).unwrap().1 };
        let numbers: Vec<f64> =
            last(name).as_array().unwrap().iter().map(|one| one.as_f64().unwrap()).collect();
        let fields: Vec<String> =
            numbers.iter().enumerate().map(|(at, number)| format!("raw{at}={number}")).collect();
        let expected = fields.join(" ");
        until(
            || peer.printed().iter().any(|line| line.ends_with(&expected)),
            || format!("{expected}: {:?}", peer.printed().last()),
        );
    }
    assert!(run.said().contains("sent: Left = -77"), "{}", run.said());
}
