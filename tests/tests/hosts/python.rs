//! The host `python`: the shared vectors, damaged streams, a strict type checker, and a program on a serial line that the
//! test plays.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{TempDir, answered, few, has, has_python, is_thorough, root, run, sensedsl};
use sensedsl_wire::{Event, Scalar, Schema, encode_hello};

use super::vectors::{self, DAMAGED, Exchange, Numbers};
use super::{designs, files};

fn runtime() -> PathBuf {
    root().join("crates/host-python/runtime/sensedsl")
}

/// What the driver of the vectors answers for a schema.
fn answer(schema: &Schema, exchange: &Exchange) -> String {
    let items = schema.items.iter().map(|item| {
        let length = item.value.length.map_or(String::new(), |length| length.to_string());
        let (id, kind, scalar) = (item.id, item.direction.name(), item.value.scalar);
        format!("{id},{kind},{},{scalar},{length}", item.name)
    });
    let mut python = Command::new("python3");
    python.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/vectors.py")).arg(runtime());
    python.arg(schema.checksum.name()).arg(if schema.stamp { "stamp" } else { "-" }).args(items);
    answered(&mut python, exchange.asked())
}

#[test]
fn shared_vectors_cut_at_every_place() {
    if !has("python3") {
        return;
    }
    for path in few(&vectors::files(), 3) {
        let (schema, exchange) = vectors::read(path);
        assert_eq!(answer(&schema, &exchange), exchange.expected(), "{}", path.display());
    }
}

#[test]
fn damaged_streams_are_read_as_by_the_reference() {
    if !is_thorough() || !has("python3") {
        return;
    }
    for name in DAMAGED {
        let mut numbers = Numbers::new(2015);
        let (schema, exchange) = vectors::damage(name, &mut numbers, 500);
        let alike = |answer: &str| vectors::with_reals_alike(&schema, answer);
        assert_eq!(alike(&answer(&schema, &exchange)), alike(exchange.expected()), "{name}");
    }
}

#[test]
fn types_are_checked_strictly() {
    if !is_thorough() || !has_python("mypy") || !has_python("serial") {
        return;
    }
    for (name, boards) in designs::all() {
        let folder = files::generate("python", &format!("{name}-types"), &boards);
        run(Command::new("python3").current_dir(&folder).args([
            "-m",
            "mypy",
            "--strict",
            "sense_robot",
        ]));
    }
}

const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Light returns uint16 { id = 17; type = analog; scale = 0.5; offset = -10; quantity = cm; max = 900; }
    sensor lambda returns int32 { id = 18; type = encoder; }
    actuator Servo accepts uint16 { id = 19; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; failsafe = 0; }
    link { silence = 400 ms; }
}";

/// A folder with the robot and its package, and its link.
fn robot(name: &str) -> (TempDir, Schema) {
    let scratch = TempDir::new(name);
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "--quiet", "--without", "firmware", "--host", "python", "-o"]);
    let _ = call.arg(&out).arg(&file).run().exits(0);
    let text = sensedsl_tests::read(&out.join("schema.json"));
    let boards = sensedsl_host::Board::all_of_json(&text).unwrap();
    (scratch, boards[0].schema.clone())
}

/// Runs a program with the package while the test plays the board.
fn played(
    scratch: &TempDir,
    schema: &Schema,
    hello: &[u8],
    program: &str,
) -> (Vec<Event>, i32, String) {
    let mut python = Command::new("python3");
    python.args(["-c", program]).env("PYTHONPATH", scratch.join("out/host/python"));
    super::played::played(python.env("PYTHONDONTWRITEBYTECODE", "1"), schema, hello)
}

const PROGRAM: &str = r#"
import asyncio, sys
from sense_robot import DeviceError, Light, Rover, Servo, lambda_

with Rover.open(sys.argv[1]) as board:
    board.send(Servo.of(45.5))
    board.send(Servo.of_raw(7))
    for wrong in (lambda: Servo.of(180.1), lambda: Servo.of_raw(1801), lambda: Servo.of(float("nan"))):
        try:
            wrong()
            print("not refused")
        except ValueError as error:
            print("refused:", error)
    first = next(message for message in board if isinstance(message, Light))
    print(first, first.value, first.raw, first.unit, first.outside)
    seen = []
    board.on(lambda_, seen.append)
    board.run(0.3)
    print(len(seen) > 1, seen[-1].value, board.latest(Servo).value, board.is_overdue(Light))
    health = board.health()
    print(health.uptime_ms, health.reset_cause, health.devices[0])

    async def three():
        kinds = []
        async for message in board.stream():
            kinds.append(type(message).__name__)
            if len(kinds) == 3:
                return kinds
    print(asyncio.run(three()))
    print(board.dropped_bytes, board.is_ready)
"#;

#[test]
fn a_program_reads_sets_and_asks() {
    if !has_python("serial") {
        return;
    }
    let (scratch, schema) = robot("python-program");
    let (commands, status, said) = played(&scratch, &schema, &encode_hello(&schema), PROGRAM);
    assert_eq!(status, 0, "{said}");
    let servo = |code| Event::Report(None, vec![(19, vec![Scalar::Unsigned(code)])]);
    assert_eq!(commands, [servo(455), servo(7)], "{said}");
    for expected in [
        "refused: Servo: (180.1,) is above the maximum of 180 deg\n",
        "refused: Servo: raw (1801,) is above the maximum of 180 deg\n",
        "Light = 910.0 cm (above the maximum of 900 cm) 910.0 1840 cm above the maximum of 900 cm\n",
        "True -3 0.7000000000000001 False\n",
        "12345 4 DeviceHealth(id=17, status=3, age_ms=7, failures=(1, 2, 3, 4, 5, 6))\n",
        "'Light', 'lambda_'",
        "0 True\n",
        "Rover on /dev/",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    assert!(!said.contains("not refused"), "{said}");
}

#[test]
fn other_firmware_and_devices_that_are_none_end_it() {
    if !has_python("serial") {
        return;
    }
    let (scratch, schema) = robot("python-other");
    let mut other = schema.clone();
    other.items[0].name = "Dark".to_owned();
    let text = other.canonical_text().replace('\n', "\r\n");
    let hello = [encode_hello(&other), format!("ch> schema\r\n{text}ch> ").into_bytes()].concat();
    let main = "import runpy; runpy.run_module('sense_robot', run_name='__main__')";
    let (commands, status, said) = played(&scratch, &schema, &hello, main);
    assert_eq!((status, commands.len()), (1, 0), "{said}");
    for expected in ["Light: not there on the board", "Dark: only on the board"] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    let mut python = Command::new("python3");
    python.args(["-m", "sense_robot", "/dev/no such"]).env("PYTHONDONTWRITEBYTECODE", "1");
    let output = python.current_dir(scratch.join("out/host/python")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.starts_with("cannot open /dev/no such: "), "{said}");
}

#[test]
fn a_recording_has_the_values_of_the_monitor() {
    if !has("python3") {
        return;
    }
    let scratch = TempDir::new("python-recording");
    for name in few(&["line_follower", "miniature_car", "quadcopter"], 1) {
        let file = format!("examples/{name}.sense");
        let frames = scratch.join("frames");
        let run = ["simulate", &file, "--judge", "--quiet", "--seconds", "2", "--frames"];
        let _ = sensedsl(run).arg(&frames).run().exits(0);
        let out = scratch.join(name);
        let write =
            ["generate", &file, "--quiet", "--without", "firmware", "--host", "python", "-o"];
        let _ = sensedsl(write).arg(&out).run().exits(0);
        let program = format!(
            "import json, sys\nimport sense_{name} as package\nfrom sense_{name} import Board\n\
             board, = Board.__subclasses__()\n\
             for one in board.play(sys.argv[1]):\n    \
             print(json.dumps([one.FACTS.item.name, one.raw, one.value, one.unit]))\n"
        );
        let mut python = Command::new("python3");
        python.args(["-c", &program]).arg(&frames).env("PYTHONDONTWRITEBYTECODE", "1");
        let found = sensedsl_tests::printed(python.env("PYTHONPATH", out.join("host/python")));
        let monitor =
            sensedsl(["monitor", "--format", "ndjson"]).arg(&frames).arg(&file).run().exits(0);
        let read = |line: &str| serde_json::from_str::<serde_json::Value>(line).unwrap();
        let (found, shown): (Vec<_>, Vec<_>) =
            (found.lines().map(read).collect(), monitor.stdout.lines().map(read).collect());
        assert!(found.len() == shown.len() && found.len() > 10, "{name}: {}", found.len());
        for (own, monitor) in found.iter().zip(&shown) {
            let alike = |value: &serde_json::Value| -> Vec<f64> {
                let all = value.as_array().cloned().unwrap_or_else(|| vec![value.clone()]);
                all.iter()
                    .map(|one| one.as_f64().unwrap_or(f64::from(u8::from(*one == true))))
                    .collect()
            };
            assert_eq!((&own[0], &own[3]), (&monitor["device"], &monitor["unit"]));
            assert_eq!(alike(&own[1]), alike(&monitor["raw"]), "{own}");
            let pairs = alike(&own[2]).into_iter().zip(alike(&monitor["value"]));
            assert!(
                pairs.into_iter().all(|(a, b)| (a - b).abs() <= 1e-9 * a.abs().max(1.0)),
                "{own} {monitor}"
            );
        }
    }
}
