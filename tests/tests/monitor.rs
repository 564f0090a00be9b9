//! The command `monitor`, as users run it: recordings, a board on a serial line that the test plays, boards in its own
//! program, and everything that can be wrong about them.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, binary, few, root, sensedsl};
use sensedsl_wire::{
    Decoder, Direction, Event, Scalar, Schema, encode_hello, encode_hello_request, encode_report,
};
use serde_json::Value;

use crate::hosts::terminal::Line;

const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Light returns uint16 { id = 17; type = analog; scale = 0.5; offset = -10; quantity = cm; max = 900; }
    sensor Turns returns int32 { id = 18; type = encoder; }
    actuator Servo accepts uint16 { id = 19; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; failsafe = 0; }
    link { silence = 400 ms; }
}";

/// A folder with the robot, its generated schema, and the link that it gives.
pub(crate) fn robot(name: &str) -> (TempDir, Schema) {
    robot_of(name, ROBOT)
}

/// The same with a design of one's own.
pub(crate) fn robot_of(name: &str, design: &str) -> (TempDir, Schema) {
    let scratch = TempDir::new(name);
    let file = scratch.write("robot.sense", design);
    let out = scratch.join("out");
    let _ = sensedsl(["generate", "--quiet", "--without", "firmware", "-o"])
        .arg(&out)
        .arg(&file)
        .run()
        .exits(0);
    let text = sensedsl_tests::read(&out.join("schema.json"));
    let boards = sensedsl_host::Board::all_of_json(&text).unwrap();
    (scratch, boards[0].schema.clone())
}

/// The lines of a run's output in JSON.
fn objects(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_recording_has_the_values_that_were_sent() {
    let scratch = TempDir::new("monitor-recording");
    let all = ["fig2", "miniature_car", "line_follower", "quadcopter"];
    for name in few(&all, 2) {
        let file = format!("examples/{name}.sense");
        let frames = scratch.join("frames");
        let run = ["simulate", &file, "--judge", "--quiet", "--seconds", "2", "--frames"];
        let _ = sensedsl(run).arg(&frames).run().exits(0);
        let bytes = std::fs::read(&frames).unwrap();
        let shown =
            sensedsl(["monitor", "--format", "ndjson"]).arg(&frames).arg(&file).run().exits(0);
        // An own reading of the bytes, by the generated schema.
        let out = scratch.join("out");
        let write = ["generate", &file, "--quiet", "--without", "firmware", "-o"];
        let _ = sensedsl(write).arg(&out).run().exits(0);
        let schema: Value =
            serde_json::from_str(&sensedsl_tests::read(&out.join("schema.json"))).unwrap();
        let board = &schema["boards"][0];
        let own = sensedsl_host::Board::all_of_json(&schema.to_string()).unwrap();
        let mut expected = Vec::new();
        Decoder::new(&own[0].schema, Direction::Sensor).feed(&bytes, |event| {
            if let Event::Report(_, values) = event {
                expected.extend(values);
            }
        });
        let found = objects(&shown.stdout);
        assert!(found.len() == expected.len() && found.len() > 20, "{name}: {}", found.len());
        for (object, (id, value)) in found.iter().zip(expected) {
            let items = board["items"].as_array().unwrap();
            let item = items.iter().find(|item| item["id"] == id).unwrap();
            assert_eq!((&object["device"], &object["unit"]), (&item["name"], &item["quantity"]));
            let raw: Vec<Value> =
                value.iter().map(|one| serde_json::from_str(&one.to_string()).unwrap()).collect();
            let raw = if item["length"].is_null() { raw[0].clone() } else { Value::from(raw) };
            assert_eq!(object["raw"], raw, "{name}: {object}");
            if let (Some(scale), Some(raw), true) =
                (item["scale"].as_f64(), raw.as_f64(), item["curve"] == serde_json::json!([]))
            {
                let shown = scale * raw + item["offset"].as_f64().unwrap_or_default();
                assert!((object["value"].as_f64().unwrap() - shown).abs() < 1e-9, "{object}");
            }
        }
        assert!(shown.stderr.contains(" bytes dropped"), "{}", shown.stderr);
    }
}

#[test]
fn formats_say_the_same() {
    let (scratch, schema) = robot("monitor-formats");
    let values = [(17, vec![Scalar::Unsigned(1_840)]), (18, vec![Scalar::Signed(-3)])];
    let report = encode_report(&schema, Direction::Sensor, &values).unwrap();
    let frames = [encode_hello(&schema), b"?".to_vec(), report].concat();
    let say = |format: &str| {
        let call = sensedsl(["monitor", "-", "--format", format]).arg(scratch.join("robot.sense"));
        call.stdin(frames.clone()).run().exits(0)
    };
    let lines = say("lines");
    let texts: Vec<&str> =
        lines.stdout.lines().map(|line| line.split_once(" s  ").unwrap().1).collect();
    assert_eq!(texts, ["Light = 1840 (910 cm) (above the maximum of 900 cm)", "Turns = -3"]);
    assert_eq!(lines.stderr, "Rover: firmware and design agree\n2 frames, 1 bytes dropped\n");
    let csv = say("csv").stdout;
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some("time_s,device,element,raw,value,unit"));
    let rows: Vec<&str> = rows.map(|row| row.split_once(',').unwrap().1).collect();
    assert_eq!(rows, ["Light,0,1840,910.0,cm", "Turns,0,-3,-3.0,"]);
    let found = objects(&say("ndjson").stdout);
    assert_eq!((&found[0]["value"], &found[1]["raw"]), (&910.0.into(), &(-3).into()));
    let table = say("table").stdout;
    assert!(table.contains("Light") && table.contains("910.0 cm"), "{table}");
    // The schema alone does as well, and a quiet run says nothing else.
    let call = sensedsl(["monitor", "-", "--quiet", "--format", "csv", "--schema"]);
    let quiet = call.arg(scratch.join("out/schema.json")).stdin(frames.clone()).run().exits(0);
    assert_eq!((quiet.stdout.lines().count(), quiet.stderr.as_str()), (3, ""));
}

/// Plays the board until the monitor ends: says hello to each question, and reports every 50 ms. Returns what the host
/// has sent, apart from questions, and what it printed.
fn played(
    line: &mut Line,
    schema: &Schema,
    hello: &[u8],
    arguments: &[&str],
    typed: &str,
) -> (Vec<Event>, std::process::Output) {
    let mut child = Command::new(binary())
        .arg("monitor")
        .arg(&line.device)
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take();
    let mut decoder = Decoder::new(schema, Direction::Actuator);
    let (mut sent, mut is_met) = (Vec::new(), false);
    let light =
        encode_report(schema, Direction::Sensor, &[(17, vec![Scalar::Unsigned(100)])]).unwrap();
    let start = Instant::now();
    let mut questions = 0;
    while child.try_wait().unwrap().is_none() {
        assert!(start.elapsed() < Duration::from_secs(20), "the monitor does not end");
        let bytes = line.hear(1, Duration::from_millis(50));
        decoder.feed(&bytes, |event| match event {
            Event::HelloRequest => questions += 1,
            Event::HealthRequest => {}
            other => sent.push(other),
        });
        if questions > 0 {
            if !is_met && let Some(mut stdin) = stdin.take() {
                stdin.write_all(typed.as_bytes()).unwrap();
            }
            is_met = true;
            line.say(hello);
            line.say(&light);
        }
    }
    (sent, child.wait_with_output().unwrap())
}

fn servo(code: u64) -> Event {
    Event::Report(None, vec![(19, vec![Scalar::Unsigned(code)])])
}

#[test]
fn actuators_are_set_and_held() {
    let (scratch, schema) = robot("monitor-set");
    let file = scratch.join("robot.sense");
    let file = file.to_str().unwrap();
    let mut line = Line::new();
    let typed = "Servo 45.5 deg\nservo raw 7\nServo 181\nSevro 1\nLight 3\nServo\n";
    let arguments = [file, "--seconds", "2", "--set", "Servo=90", "--format", "lines"];
    let (sent, output) = played(&mut line, &schema, &encode_hello(&schema), &arguments, typed);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(sent, [servo(900), servo(455), servo(7)]);
    let said = String::from_utf8(output.stderr).unwrap();
    for expected in [
        "set Servo\n",
        "sent: Servo = 455 (45.5 deg)\n",
        "sent: Servo = 7 (0.7 deg)\n",
        "not sent: Servo 181: 181 deg is above the maximum of 180\n",
        "did you mean `Servo`?",
        "not sent: Light 3: `Light` is a sensor",
        "not sent: `Servo`: write the name of an actuator and its value\n",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    assert!(String::from_utf8(output.stdout).unwrap().contains("Light = 100 (40 cm)"));
    // Refused before anything is opened.
    let call = sensedsl(["monitor", "/dev/null", file, "--set", "Servo=many"]);
    assert!(call.run().exits(2).stderr.contains("cannot open /dev/null"));
}

#[test]
fn what_was_set_is_kept_from_its_failsafe() {
    let (scratch, schema) = robot("monitor-hold");
    let file = scratch.join("robot.sense");
    let mut line = Line::new();
    let mut child = Command::new(binary())
        .args(["monitor", line.device.to_str().unwrap(), file.to_str().unwrap()])
        .args(["--set", "Servo=1", "--seconds", "2", "--quiet"])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let request = encode_hello_request(&schema);
    let mut heard: Vec<Duration> = Vec::new();
    let (start, mut is_met) = (Instant::now(), false);
    while child.try_wait().unwrap().is_none() {
        let bytes = line.hear(1, Duration::from_millis(20));
        if bytes.windows(request.len()).any(|some| some == request) {
            heard.push(start.elapsed());
            if !is_met {
                line.say(&encode_hello(&schema));
                is_met = true;
            }
        }
    }
    let gaps = heard.windows(2).map(|pair| pair[1] - pair[0]);
    let longest = gaps.max().unwrap();
    assert!(heard.len() > 8 && longest < Duration::from_millis(400), "{longest:?} of {heard:?}");
}

#[test]
fn other_firmware_is_refused_with_its_differences() {
    let (scratch, schema) = robot("monitor-other");
    let file = scratch.join("robot.sense");
    let mut other = schema.clone();
    other.items[0].name = "Dark".to_owned();
    let text = other.canonical_text().replace('\n', "\r\n");
    let hello = [encode_hello(&other), format!("ch> schema\r\n{text}ch> ").into_bytes()].concat();
    let mut line = Line::new();
    let (sent, output) = played(&mut line, &schema, &hello, &[file.to_str().unwrap()], "Servo 1\n");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        (output.status.code(), output.stdout.as_slice(), sent.len()),
        (Some(1), &b""[..], 0),
        "{said}"
    );
    for expected in ["E0558", "Light: not on the board", "Dark: only on the board"] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
}

#[test]
fn a_device_that_goes_ends_it_or_is_waited_for() {
    let (scratch, schema) = robot("monitor-gone");
    let file = scratch.join("robot.sense");
    for (arguments, status, expected) in [
        (&["--no-reconnect"][..], 1, "the device is gone\n"),
        (&["--seconds", "2"][..], 0, "the device is gone; waiting for it\n"),
    ] {
        let mut line = Line::new();
        // A name of its own: the system gives that of a terminal that is gone to the next one.
        let device = scratch.join(&format!("board{status}"));
        std::os::unix::fs::symlink(&line.device, &device).unwrap();
        let child = Command::new(binary())
            .args(["monitor", device.to_str().unwrap(), file.to_str().unwrap()])
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let request = encode_hello_request(&schema);
        assert_eq!(line.hear(request.len(), Duration::from_secs(10)), request);
        line.say(&encode_hello(&schema));
        std::thread::sleep(Duration::from_millis(300));
        std::fs::remove_file(&device).unwrap();
        drop(line);
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(status), "{said}");
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn a_board_in_its_own_program_is_watched_and_set() {
    let (scratch, _) = robot("monitor-simulated");
    let file = scratch.join("robot.sense");
    let call =
        ["monitor", "simulate", file.to_str().unwrap(), "--seconds", "1.5", "--format", "ndjson"];
    let run = sensedsl(call).args(["--set", "Servo=30", "--health"]).run().exits(0);
    assert!(objects(&run.stdout).iter().any(|one| one["device"] == "Turns"), "{}", run.stdout);
    let good =
        run.stderr.lines().filter(|line| line.contains("Servo") && line.contains("good")).count();
    assert!(good > 0 && run.stderr.contains("health of Rover"), "{}", run.stderr);
}

#[test]
fn a_world_may_speak_of_all_boards_of_a_file() {
    let scratch = TempDir::new("monitor-world");
    let board = |name: &str, id: u8| {
        format!(
            "board {name} on NUCLEO_F446RE {{ sensor Light{name} returns uint16 {{ id = {id}; type = analog; delay = 50 ms; }} }}\n"
        )
    };
    let file = scratch.write("two.sense", [board("Left", 1), board("Right", 2)].concat());
    // Only one of them loses its cable, although both are at the same pin of their boards.
    let world = "[devices]\nLightLeft = 1000\nLightRight = 2000\n
[[fault]]\nkind = \"torn\"\ndevice = \"LightLeft\"\nat = \"500 ms\"\nfor = \"10 s\"";
    let (file, world) = (file.to_str().unwrap(), scratch.write("two.toml", world));
    let run = |rest: &[&str]| {
        let call = ["monitor", "simulate", file, "--seconds", "1.5", "--format", "ndjson"];
        sensedsl(call).arg("--world").arg(&world).args(rest).run()
    };
    let all = objects(&run(&[]).exits(0).stdout);
    let of = |board: &str, from_us: u64| {
        let own = all.iter().filter(move |one| one["board"] == *board);
        let own = own.filter(|one| one["time_s"].as_f64().unwrap() * 1e6 >= from_us as f64);
        own.map(|one| one["raw"].as_u64().unwrap()).collect::<Vec<_>>()
    };
    assert!(of("Left", 0).contains(&1000) && of("Right", 0).len() > 10, "{all:?}");
    assert!(of("Left", 800_000).iter().any(|raw| *raw != 1000), "{all:?}");
    assert!(of("Right", 0).iter().all(|raw| *raw == 2000), "{all:?}");
    // Of a board that is not simulated it has nothing to say.
    let alone = run(&["--board", "Right"]);
    assert_eq!(alone.status, 1, "{}", alone.stderr);
    assert!(alone.stderr.contains("`LightLeft` is not on the simulated board"), "{}", alone.stderr);
}

#[test]
fn wrong_calls_and_files_say_what_to_do() {
    let (scratch, _) = robot("monitor-wrong");
    let file = scratch.join("robot.sense");
    let schema = scratch.join("out/schema.json");
    let text = sensedsl_tests::read(&schema);
    let newer = scratch.write("newer.json", text.replacen("\"version\": 2", "\"version\": 3", 1));
    let edited = scratch.write("edited.json", text.replace("\"Light\"", "\"Dark\""));
    let cut = scratch.write("cut.json", &text[..text.len() / 2]);
    let path = |path: &Path| path.to_str().unwrap().to_owned();
    for (arguments, status, expected) in [
        (vec!["-".into(), "--schema".into(), path(&newer)], 2, "it has version 3"),
        (vec!["-".into(), "--schema".into(), path(&edited)], 2, "it was changed after"),
        (vec!["-".into(), "--schema".into(), path(&cut)], 2, "it is no schema"),
        (vec!["-".into(), "--schema".into(), path(&file)], 2, "it is no schema"),
        (vec!["-".into()], 2, "nobody says which design"),
        (vec!["/dev/no such".into(), path(&file)], 2, "there is no such device"),
        (vec!["/dev/null".into(), path(&file)], 2, "it is no serial port"),
        (vec!["-".into(), path(&file), "--board".into(), "Rower".into()], 2, "Rower"),
        (
            vec!["-".into(), path(&file), "--set".into(), "Servo=1000".into()],
            2,
            "above the maximum",
        ),
        (vec!["-".into(), path(&scratch.join("no.sense"))], 2, "E0111"),
    ] {
        let run = sensedsl(["monitor"]).args(&arguments).stdin("").run();
        assert_eq!(run.status, status, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(expected), "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stdout, "");
    }
}
