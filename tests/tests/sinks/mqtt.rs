//! MQTT: Mosquitto is the broker, and its clients are Home Assistant and people.

use std::process::Command;
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, missing};
use sensedsl_wire::{Decoder, Direction, Event, Scalar, encode_hello, encode_report};
use serde_json::{Value, json};

use super::{Running, free_port, robot, shown, text, until};
use crate::hosts::terminal::Line;

const READY: &str = "test/ready";
const BROKER: &str = "/usr/sbin/mosquitto";

/// Whether Mosquitto is here; if not, reports it.
fn has_mosquitto() -> bool {
    let is_here = |tool: &str| Command::new(tool).arg("--help").output().is_ok();
    let has_all = is_here(BROKER) && is_here("mosquitto_sub") && is_here("mosquitto_pub");
    if !has_all {
        missing("mosquitto");
    }
    has_all
}

fn broker(scratch: &TempDir, port: u16) -> Running {
    broker_with(scratch, port, "allow_anonymous true\n")
}

fn broker_with(scratch: &TempDir, port: u16, more: &str) -> Running {
    // Root's broker keeps its rights, so that it reads what is in the test's folder.
    let config = format!("user root\nlistener {port} 127.0.0.1\npersistence false\n{more}");
    let config = scratch.write(&format!("mosquitto-{port}.conf"), config);
    let broker = Running::start(Command::new(BROKER).args(["-v", "-c", text(&config)]));
    until(
        || std::net::TcpStream::connect(("127.0.0.1", port)).is_ok(),
        || format!("the broker does not start: {}", broker.said()),
    );
    broker
}

/// One message: whether the broker had kept it, its topic, its text.
type Message = (bool, String, String);

/// Somebody who listens to all topics.
struct Listener(Running);

impl Listener {
    fn start(port: u16) -> Self {
        // Once this is heard, nothing is missed.
        publish(port, &["-r", "-t", READY, "-m", "now"]);
        let port = port.to_string();
        let run = Running::start(
            Command::new("mosquitto_sub").args(["-p", &port, "-t", "#", "-F", "%r %t %p"]),
        );
        until(|| !run.printed().is_empty(), || run.said());
        Self(run)
    }

    fn all(&self) -> Vec<Message> {
        let of = |line: &String| {
            let mut words = line.splitn(3, ' ');
            let is_kept = words.next()?.parse::<u8>().ok()? == 1;
            Some((is_kept, words.next()?.to_owned(), words.next()?.to_owned()))
        };
        let all = self.0.printed().iter().filter_map(of).collect::<Vec<_>>();
        all.into_iter().filter(|one| one.1 != READY).collect()
    }

    /// All texts of a topic.
    fn of(&self, topic: &str) -> Vec<String> {
        self.all().into_iter().filter(|one| one.1 == topic).map(|one| one.2).collect()
    }

    /// Waits for a text on a topic; the time that it took.
    #[track_caller]
    fn hears(&self, topic: &str, payload: &str) -> Duration {
        until(
            || self.of(topic).last().is_some_and(|last| last == payload),
            || format!("{topic} {payload}: {:?}", self.of(topic)),
        )
    }
}

fn publish(port: u16, arguments: &[&str]) {
    let port = port.to_string();
    let output =
        Command::new("mosquitto_pub").args(["-p", &port]).args(arguments).output().unwrap();
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn values_are_those_that_are_shown_and_stay_at_the_broker() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, _) = robot("sinks-mqtt");
    let port = free_port();
    let _broker = broker(&scratch, port);
    let live = Listener::start(port);
    let config = format!("[mqtt]\nbroker = \"127.0.0.1:{port}\"\nrate_hz = 1e6\n");
    let config = scratch.write("sinks.toml", config);
    let file = scratch.join("robot.sense");
    let arguments = ["simulate", text(&file), "--seconds", "2.5", "--format", "ndjson"];
    let mut run = Running::monitor(arguments.into_iter().chain([
        "--config",
        text(&config),
        "--set",
        "Servo=30",
    ]));
    live.hears("sensedsl/host-status", "online");
    live.hears("sensedsl/Rover/board-status", "online");
    assert_eq!(run.ends(), 0, "{}", run.said());
    live.hears("sensedsl/host-status", "offline");
    live.hears("sensedsl/Rover/board-status", "offline");
    let printed = shown(&run.printed());
    let kept = Listener::start(port);
    for name in ["Light", "Turns"] {
        let topic = format!("sensedsl/Rover/{name}");
        let found = live.of(&topic);
        let all: Vec<String> = printed
            .iter()
            .filter(|(device, _)| device == name)
            .map(|(_, value)| value.to_string())
            .collect();
        // The first message has the latest value at the time of the connection.
        assert!(found.len() > 10 && found.len() <= all.len(), "{} of {}", found.len(), all.len());
        assert_eq!(found, all[all.len() - found.len()..], "{name}");
        kept.hears(&topic, all.last().unwrap());
    }
    kept.hears("sensedsl/Rover/Servo", "30.0");
    assert!(kept.all().iter().all(|one| one.0), "{:?}", kept.all());
    let health: Value = serde_json::from_str(&live.of("sensedsl/Rover/board-health")[0]).unwrap();
    assert_eq!(health["devices"]["Light"]["status"], "good", "{health}");
}

#[test]
fn home_assistant_finds_all_devices() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, _) = robot("sinks-mqtt-discovery");
    let port = free_port();
    let _broker = broker(&scratch, port);
    let file = scratch.join("robot.sense");
    let at = format!("127.0.0.1:{port}");
    let mut run = Running::monitor(["simulate", text(&file), "--mqtt", &at, "--seconds", "2"]);
    assert_eq!(run.ends(), 0, "{}", run.said());
    // Home Assistant may start later than the monitor has ended.
    let kept = Listener::start(port);
    let told = |topic: &str| -> Value {
        until(|| !kept.of(topic).is_empty(), || format!("{topic}: {:?}", kept.all()));
        serde_json::from_str(&kept.of(topic)[0]).unwrap()
    };
    let light = told("homeassistant/sensor/sensedsl_Rover_Light/config");
    let status = |topic: &str| json!({ "topic": topic, "payload_available": "online", "payload_not_available": "offline" });
    assert_eq!(
        light,
        json!({
            "name": "Light", "unique_id": "sensedsl_Rover_Light", "state_topic": "sensedsl/Rover/Light",
            "availability": [status("sensedsl/host-status"), status("sensedsl/Rover/board-status")],
            "availability_mode": "all",
            "device": { "identifiers": ["sensedsl_Rover"], "name": "Rover", "manufacturer": "SenseDSL" },
            "unit_of_measurement": "cm", "device_class": "distance", "state_class": "measurement"
        })
    );
    let servo = told("homeassistant/number/sensedsl_Rover_Servo/config");
    for (key, value) in [
        ("command_topic", json!("sensedsl/Rover/Servo/set")),
        ("min", json!(0.0)),
        ("max", json!(180.0)),
        ("step", json!(0.1)),
        ("unit_of_measurement", json!("°")),
    ] {
        assert_eq!(servo[key], value, "{key}: {servo}");
    }
    let topics: Vec<String> = kept.all().into_iter().map(|one| one.1).collect();
    for topic in ["sensedsl/host-status", "sensedsl/Rover/board-status", "sensedsl/Rover/Light"] {
        assert!(topics.iter().any(|one| one == topic), "{topics:?}");
    }
}

#[test]
fn commands_come_back() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, schema) = robot("sinks-mqtt-commands");
    let port = free_port();
    let _broker = broker(&scratch, port);
    let live = Listener::start(port);
    publish(port, &["-r", "-t", "sensedsl/Rover/Servo/set", "-m", "99"]);
    let mut line = Line::new();
    let at = format!("127.0.0.1:{port}");
    let (device, file) = (line.device.clone(), scratch.join("robot.sense"));
    let run = Running::monitor([text(&device), text(&file), "--mqtt", &at, "--format", "ndjson"]);
    let mut decoder = Decoder::new(&schema, Direction::Actuator);
    let mut set = Vec::new();
    let mut play = |line: &mut Line, is_enough: &dyn Fn(&[Scalar]) -> bool| {
        let start = Instant::now();
        while !is_enough(&set) {
            assert!(start.elapsed() < Duration::from_secs(15), "{set:?}: {}", run.said());
            let mut has_asked = false;
            decoder.feed(&line.hear(1, Duration::from_millis(50)), |event| match event {
                Event::HelloRequest => has_asked = true,
                Event::Report(_, values) => set.extend(values.into_iter().flat_map(|one| one.1)),
                _ => {}
            });
            if has_asked {
                line.say(&encode_hello(&schema));
            }
        }
        set.clone()
    };
    run.says("the command is retained: send it without that");
    play(&mut line, &|_| run.said().contains("agree"));
    publish(port, &["-t", "sensedsl/Rover/Servo/set", "-m", "45.5"]);
    play(&mut line, &|set| set.len() == 1);
    publish(port, &["-t", "sensedsl/Rover/Servo/set", "-m", "60 deg"]);
    let set = play(&mut line, &|set| set.len() == 2);
    assert_eq!(set, [455, 600].map(Scalar::Unsigned));
    live.hears("sensedsl/Rover/Servo", "60.0");
    publish(port, &["-t", "sensedsl/Rover/Servo/set", "-m", "181"]);
    run.says("not set by sensedsl/Rover/Servo/set: 181 deg is above the maximum of 180");
}

/// Each element of an array of `bool` is a switch, also where several are set in a row.
#[test]
fn switches_are_set_one_by_one() {
    if !has_mosquitto() {
        return;
    }
    let scratch = TempDir::new("sinks-mqtt-switches");
    let port = free_port();
    let _broker = broker(&scratch, port);
    let live = Listener::start(port);
    let at = format!("127.0.0.1:{port}");
    let run = Running::monitor(["simulate", "examples/greenhouse.sense", "--mqtt", &at]);
    live.hears("sensedsl/Greenhouse/board-status", "online");
    for element in ["0", "1", "2"] {
        let topic = format!("homeassistant/switch/sensedsl_Greenhouse_Switches_{element}/config");
        until(|| !live.of(&topic).is_empty(), || run.said());
        let config: Value = serde_json::from_str(&live.of(&topic)[0]).unwrap();
        assert_eq!(config["state_topic"], "sensedsl/Greenhouse/Switches");
        let set = config["command_topic"].as_str().unwrap();
        assert_eq!(set, format!("sensedsl/Greenhouse/Switches/set/{element}"));
        publish(port, &["-t", set, "-m", config["payload_on"].as_str().unwrap()]);
    }
    live.hears("sensedsl/Greenhouse/Switches", "[true,true,true]");
    // Later, the others keep what they were set to.
    std::thread::sleep(Duration::from_millis(1_200));
    publish(port, &["-t", "sensedsl/Greenhouse/Switches/set/1", "-m", "false"]);
    live.hears("sensedsl/Greenhouse/Switches", "[true,false,true]");
    publish(port, &["-t", "sensedsl/Greenhouse/Switches/set/3", "-m", "true"]);
    run.says("not set by sensedsl/Greenhouse/Switches/set/3: there is no such element");
}

#[test]
fn what_is_gone_is_told_within_two_seconds() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, schema) = robot("sinks-mqtt-gone");
    let port = free_port();
    let _broker = broker(&scratch, port);
    let live = Listener::start(port);
    let mut line = Line::new();
    // A name of its own: the system gives that of a terminal that is gone to the next one.
    let device = scratch.join("board");
    std::os::unix::fs::symlink(&line.device, &device).unwrap();
    let file = scratch.join("robot.sense");
    let at = format!("127.0.0.1:{port}");
    let mut run = Running::monitor([text(&device), text(&file), "--mqtt", &at]);
    live.hears("sensedsl/Rover/board-status", "offline");
    let _ = line.hear(1, Duration::from_secs(5));
    line.say(&encode_hello(&schema));
    let values = [(17, vec![Scalar::Unsigned(100)])];
    line.say(&encode_report(&schema, Direction::Sensor, &values).unwrap());
    live.hears("sensedsl/Rover/board-status", "online");
    live.hears("sensedsl/Rover/Light", "40.0");
    std::fs::remove_file(&device).unwrap();
    drop(line);
    let after = live.hears("sensedsl/Rover/board-status", "offline");
    assert!(after < Duration::from_secs(2), "{after:?}");
    assert_eq!(live.of("sensedsl/host-status").last().unwrap(), "online");
    // The monitor is killed: the broker has its last will.
    run.kill();
    let after = live.hears("sensedsl/host-status", "offline");
    assert!(after < Duration::from_secs(2), "{after:?}");
}

#[test]
fn a_broker_that_is_away_comes_or_goes() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, _) = robot("sinks-mqtt-away");
    let port = free_port();
    let socket = std::net::UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
    let (at, to) = (format!("127.0.0.1:{port}"), socket.local_addr().unwrap());
    let file = scratch.join("robot.sense");
    let plot = format!("--plotjuggler={to}");
    let run =
        Running::monitor(["simulate", text(&file), "--mqtt", &at, &plot, "--format", "ndjson"]);
    run.says(&format!("MQTT: {at}: "));
    run.says("(E0567); start the broker, or name another with `broker`; trying again");
    let has_value = || socket.recv(&mut [0; 512]).is_ok();
    assert!(has_value() && !run.printed().is_empty());
    for round in 1..=2 {
        let mut broker = broker(&scratch, port);
        let again = || run.said().matches("MQTT: works again").count() == round;
        until(again, || run.said());
        // All that is known is there, without a new value of the actuator's.
        let live = Listener::start(port);
        live.hears("sensedsl/Rover/board-status", "online");
        until(|| !live.of("sensedsl/Rover/Light").is_empty(), || format!("{:?}", live.all()));
        until(
            || !live.of("homeassistant/sensor/sensedsl_Rover_Turns/config").is_empty(),
            || format!("{:?}", live.all()),
        );
        broker.kill();
        let lost = || run.said().matches(&format!("MQTT: {at}: ")).count() == round + 1;
        until(lost, || run.said());
    }
    assert!(has_value());
}

#[test]
fn a_broker_that_asks_who_it_is() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, _) = robot("sinks-mqtt-user");
    let port = free_port();
    let passwords = scratch.join("passwords");
    let written = Command::new("mosquitto_passwd")
        .args(["-c", "-b", text(&passwords), "rover", "a secret"])
        .output()
        .unwrap();
    assert!(written.status.success(), "{written:?}");
    let more = format!("allow_anonymous false\npassword_file {}\n", text(&passwords));
    let _broker = broker_with(&scratch, port, &more);
    let file = scratch.join("robot.sense");
    let start = |user: &str| {
        let config = format!("[mqtt]\nbroker = \"127.0.0.1:{port}\"\n{user}");
        let config = scratch.write("sinks.toml", config);
        Running::monitor(["simulate", text(&file), "--config", text(&config)])
    };
    for user in ["", "user = \"rover\"\npassword = \"wrong\"\n"] {
        let run = start(user);
        run.says("the broker does not know the user (E0567); set `user` and `password`");
    }
    let run = start("user = \"rover\"\npassword = \"a secret\"\n");
    let heard = Command::new("mosquitto_sub")
        .args(["-p", &port.to_string(), "-u", "rover", "-P", "a secret", "-W", "10", "-C", "1"])
        .args(["-t", "sensedsl/Rover/Light"])
        .output()
        .unwrap();
    assert!(heard.status.success() && !heard.stdout.is_empty(), "{heard:?}: {}", run.said());
    assert!(!run.said().contains("E0567"), "{}", run.said());
}

#[test]
fn a_record_is_passed_on_as_it_was() {
    if !has_mosquitto() {
        return;
    }
    let (scratch, _) = robot("sinks-mqtt-replay");
    let port = free_port();
    let (file, record) = (scratch.join("robot.sense"), scratch.join("run.mcap"));
    let mut run =
        Running::monitor(["simulate", text(&file), "--seconds", "2", "--record", text(&record)]);
    assert_eq!(run.ends(), 0, "{}", run.said());
    let _broker = broker(&scratch, port);
    let live = Listener::start(port);
    let config =
        format!("[mqtt]\nbroker = \"127.0.0.1:{port}\"\npayload = \"json\"\nrate_hz = 1e6\n");
    let config = scratch.write("sinks.toml", config);
    let arguments = ["--replay", text(&record), "--config", text(&config), "--format", "ndjson"];
    let mut run = Running::monitor(arguments);
    live.hears("sensedsl/Rover/board-status", "online");
    publish(port, &["-t", "sensedsl/Rover/Servo/set", "-m", "5"]);
    run.says("a recording takes no commands");
    assert_eq!(run.ends(), 0, "{}", run.said());
    let printed = shown(&run.printed());
    let found: Vec<Value> = live
        .of("sensedsl/Rover/Light")
        .iter()
        .map(|one| serde_json::from_str(one).unwrap())
        .collect();
    let all: Vec<&Value> =
        printed.iter().filter(|one| one.0 == "Light").map(|one| &one.1).collect();
    let values: Vec<&Value> = found.iter().map(|one| &one["value"]).collect();
    assert!(values.len() > 10, "{found:?}");
    assert_eq!(values, all[all.len() - values.len()..]);
    // Their times are those of the past.
    let times: Vec<f64> = found.iter().map(|one| one["time"].as_f64().unwrap()).collect();
    let now =
        std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_secs_f64();
    assert!(
        times.windows(2).all(|pair| pair[0] <= pair[1])
            && times.iter().all(|time| *time < now - 1.5)
    );
    assert_eq!(found[0]["unit"], "cm");
}
