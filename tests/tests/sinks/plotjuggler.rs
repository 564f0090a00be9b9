//! PlotJuggler: its UDP server is a socket of the test.

use std::net::UdpSocket;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde_json::Value;

use super::{Running, robot, shown, text, until};

/// Datagrams until none comes for a while, or those of the given time.
fn datagrams(socket: &UdpSocket, is_over: impl Fn() -> bool) -> Vec<Value> {
    socket.set_read_timeout(Some(Duration::from_millis(200))).unwrap();
    let mut all = Vec::new();
    let mut bytes = vec![0; 1 << 16];
    loop {
        match socket.recv(&mut bytes) {
            Ok(count) => all.push(serde_json::from_slice(&bytes[..count]).unwrap()),
            Err(_) if is_over() => return all,
            Err(_) => {}
        }
    }
}

/// The numbers below the words of their topics, as the plugin names them: `Rover/Light`.
fn series(prefix: &str, value: &Value, all: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(object) => {
            for (word, value) in object {
                let name =
                    if prefix.is_empty() { word.clone() } else { format!("{prefix}/{word}") };
                series(&name, value, all);
            }
        }
        value => all.push((prefix.to_owned(), value.clone())),
    }
}

#[test]
fn all_values_go_out_with_their_times() {
    let (scratch, _) = robot("sinks-plotjuggler");
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let to = format!("--plotjuggler={}", socket.local_addr().unwrap());
    let file = scratch.join("robot.sense");
    let arguments = ["simulate", text(&file), "--seconds", "2", "--format", "ndjson", &to];
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs_f64();
    let before = now();
    let mut run = Running::monitor(arguments.into_iter().chain(["--set", "Servo=30"]));
    let out = std::sync::Arc::clone(&run.err);
    let found =
        datagrams(&socket, || out.lock().unwrap().iter().any(|line| line.contains("frames")));
    assert_eq!(run.ends(), 0, "{}", run.said());
    let after = now();
    let (mut values, mut last) = (Vec::new(), before);
    for datagram in &found {
        let taken = datagram["timestamp"].as_f64().unwrap();
        assert!(taken >= last - 0.01 && taken <= after, "{taken} after {last}");
        last = taken;
        series("", datagram, &mut values);
    }
    values.retain(|(name, _)| name != "timestamp");
    let (set, values): (Vec<_>, Vec<_>) =
        values.into_iter().partition(|(name, _)| name == "Rover/Servo");
    assert_eq!(set, [("Rover/Servo".to_owned(), Value::from(30.0))]);
    let printed: Vec<(String, Value)> = shown(&run.printed())
        .into_iter()
        .map(|(name, value)| (format!("Rover/{name}"), value))
        .collect();
    assert!(printed.len() > 20, "{}", printed.len());
    assert_eq!(values, printed);
}

/// The layout in the examples shows curves that its example has: elements of arrays are curves of their own.
#[test]
fn the_layout_names_curves_that_come() {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let to = format!("--plotjuggler={}", socket.local_addr().unwrap());
    let file = "examples/line_follower.sense";
    let arguments =
        ["simulate", file, "--seconds", "1", "--set", "Left=1", "--set", "Right=1", &to];
    let mut run = Running::monitor(arguments);
    let err = std::sync::Arc::clone(&run.err);
    let found =
        datagrams(&socket, || err.lock().unwrap().iter().any(|line| line.contains("frames")));
    assert_eq!(run.ends(), 0, "{}", run.said());
    let mut names = std::collections::BTreeSet::new();
    for datagram in &found {
        let mut values = Vec::new();
        series("", datagram, &mut values);
        for (name, value) in values {
            match value.as_array() {
                Some(all) => {
                    names.extend((0..all.len()).map(|element| format!("/{name}[{element}]")))
                }
                None => drop(names.insert(format!("/{name}"))),
            }
        }
    }
    assert!(names.remove("/timestamp"));
    let layout = sensedsl_tests::text("examples/sinks/line_follower.plotjuggler.xml");
    let curves = layout.lines().filter_map(|line| line.split_once("name=\"/")?.1.split_once('"'));
    let curves: Vec<String> = curves.map(|(name, _)| format!("/{name}")).collect();
    let (curves, names): (Vec<_>, Vec<_>) = (curves, names.into_iter().collect());
    let sorted: Vec<_> =
        curves.iter().cloned().collect::<std::collections::BTreeSet<_>>().into_iter().collect();
    assert_eq!(sorted, names);
}

#[test]
fn a_rate_a_name_and_a_unit_of_ones_own() {
    let (scratch, _) = robot("sinks-plotjuggler-rate");
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let config = scratch.write(
        "sinks.toml",
        format!(
            "[plotjuggler]\nto = \"{}\"\nrate_hz = 5\n[devices.\"Rover/Light\"]\ntopic = \"wall\"\nunit = \"m\"\n\
             [devices.\"Rover/Turns\"]\nleave_out = true\n",
            socket.local_addr().unwrap()
        ),
    );
    let file = scratch.join("robot.sense");
    let arguments = ["simulate", text(&file), "--seconds", "2.1", "--format", "ndjson"];
    let mut run = Running::monitor(arguments.into_iter().chain(["--config", text(&config)]));
    let err = std::sync::Arc::clone(&run.err);
    let found =
        datagrams(&socket, || err.lock().unwrap().iter().any(|line| line.contains("frames")));
    assert_eq!(run.ends(), 0, "{}", run.said());
    assert!((8..=12).contains(&found.len()), "{found:?}");
    let printed = shown(&run.printed());
    for datagram in &found {
        let keys: Vec<&String> = datagram.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["timestamp", "wall"]);
        let wall = datagram["wall"].as_f64().unwrap();
        let is_it = |(name, value): &(String, Value)| {
            name == "Light" && (value.as_f64().unwrap() / 100.0 - wall).abs() < 1e-12
        };
        assert!(printed.iter().any(is_it), "{wall}");
    }
}

#[test]
fn one_that_comes_later_gets_values_from_then_on() {
    let (scratch, _) = robot("sinks-plotjuggler-late");
    let at = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let file = scratch.join("robot.sense");
    let run = Running::monitor(["simulate", text(&file), &format!("--plotjuggler={at}")]);
    run.says(&format!("PlotJuggler: nobody listens at {at} (E0567); start its UDP server"));
    let socket = UdpSocket::bind(at).unwrap();
    socket.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
    assert!(socket.recv(&mut [0; 512]).unwrap() > 20);
    run.says("PlotJuggler: works again");
    // It is told once, however many datagrams were lost.
    until(|| !run.printed().is_empty(), || "no values".to_owned());
    assert_eq!(run.said().matches("nobody listens").count(), 1);
}
