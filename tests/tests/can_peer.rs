//! A motor controller played by another program: `simulate --can` with python-can and cantools on
//! its bus, which know a DBC file and none of the project's code.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, binary, few, has_python, root, sensedsl};
use sensedsl_wire::{Checksum, Decoder, Direction, Event, Scalar, Schema, encode_report};

use crate::hosts::designs;

const DESIGN: &str = "tests/can/vesc.sense";
const PATIENCE: Duration = Duration::from_secs(60);

/// A process that is ended with the test, whatever its result.
struct Running {
    child: Child,
    lines: Receiver<String>,
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn lines(out: ChildStdout) -> Receiver<String> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let all = BufReader::new(out).lines().map_while(Result::ok);
        all.take_while(|line| sender.send(line.clone()).is_ok()).count()
    });
    receiver
}

impl Running {
    fn new(command: &mut Command) -> Self {
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn().unwrap();
        let lines = lines(child.stdout.take().unwrap());
        Self { child, lines }
    }

    /// The first line that is wanted; if none comes, panics with the lines received.
    fn wait(&self, mut wanted: impl FnMut(&str) -> bool) -> String {
        let (end, mut reported) = (Instant::now() + PATIENCE, Vec::new());
        while let Ok(line) = self.lines.recv_timeout(end.saturating_duration_since(Instant::now()))
        {
            if wanted(&line) {
                return line;
            }
            reported.push(line);
        }
        panic!("only {reported:#?}");
    }
}

fn schema() -> Schema {
    let sensors = ["1 sensor Rpm int32", "2 sensor Current int16", "3 sensor Voltage int16"];
    let actuators = ["4 actuator Speed int32", "5 actuator Throttle int32"];
    designs::schema(Checksum::None, &[&sensors[..], &actuators].concat())
}

/// Reads the host's end until each sensor has reported the values that the peer sends.
fn hear(link: &mut std::fs::File) {
    let schema = schema();
    let mut decoder = Decoder::new(&schema, Direction::Sensor);
    // The raw numbers of -4321 erpm, 12.3 A and 46.5 V.
    let mut missing = vec![(1, vec![Scalar::Signed(-4321)]), (2, vec![Scalar::Signed(123)])];
    missing.push((3, vec![Scalar::Signed(465)]));
    let end = Instant::now() + PATIENCE;
    while !missing.is_empty() {
        assert!(Instant::now() < end, "{missing:?} never arrives");
        let mut bytes = [0; 256];
        let count = link.read(&mut bytes).unwrap();
        decoder.feed(&bytes[..count], |event| {
            if let Event::Report(_, values) = event {
                missing.retain(|one| !values.contains(one));
            }
        });
    }
}

/// A board, its host and its peer: each command goes in one direction, each status in the other.
fn between_host_and_peer(simulate: &mut Command) {
    simulate.args(["--can", "--seconds", "120"]).current_dir(root()).stderr(Stdio::null());
    let board = Running::new(simulate);
    let place = |start: &'static str| {
        let line = board.wait(|line| line.starts_with(start));
        line.strip_prefix(start).unwrap().to_owned()
    };
    let link = place("the board is at ");
    let bus = place("CAN1 is at ");
    let mut link = std::fs::File::options().read(true).write(true).open(link).unwrap();
    let mut python = Command::new("python3");
    python.arg(root().join("tests/can/peer.py")).arg(root().join("tests/can/vesc.dbc")).arg(bus);
    let peer = Running::new(&mut python);
    let _ = peer.wait(|line| line == "on the bus");
    hear(&mut link);
    let mut set = |id: u8, value: i64, seen: &str| {
        let frame =
            encode_report(&schema(), Direction::Actuator, &[(id, vec![Scalar::Signed(value)])]);
        link.write_all(&frame.unwrap()).unwrap();
        let _ = peer.wait(|line| line == seen);
    };
    set(4, 2500, "VESC_SetRpm Set_Rpm=2500");
    // The frame is repeated although the host sends no more: without it, a VESC would release its
    // motor.
    for _ in 0..3 {
        let _ = peer.wait(|line| line == "VESC_SetRpm Set_Rpm=2500");
    }
    set(5, -37_500, "VESC_SetDuty Set_Duty=-37.5");
    set(4, -70_000, "VESC_SetRpm Set_Rpm=-70000");
}

#[test]
fn a_vesc_is_moved_by_an_independent_peer() {
    if has_python("can, cantools, serial") {
        between_host_and_peer(Command::new(binary()).args(["simulate", DESIGN]));
    }
}

/// The content of a table row: the device, its value, and half of the last digit.
fn row(line: &str) -> Option<(String, f64, f64)> {
    let mut words = line.split_whitespace();
    let (name, value) = (words.next()?, words.next()?);
    let value = match value {
        "true" => "1",
        "false" => "0",
        other => other,
    };
    let digits = value.split_once('.').map_or(0, |(_, digits)| digits.len());
    let slack = 0.51 * 10_f64.powi(-i32::try_from(digits).ok()?);
    Some((name.to_owned(), value.parse().ok()?, slack))
}

/// Signals with 11-bit and 29-bit identifiers, in both byte orders, across bytes, signed, scaled,
/// multiplexed and as floats: the user is shown the values that cantools puts into the frames.
#[test]
fn values_of_an_imported_file_are_those_of_cantools() {
    if !has_python("can, cantools, serial") {
        return;
    }
    let (scratch, dbc) = (TempDir::new("dbc"), root().join("tests/can/vehicle.dbc"));
    let import = sensedsl(["import", "tests/can/vehicle.dbc", "--node", "Gateway", "-o"]);
    let _ = import.arg(scratch.join("vehicle.sense")).run().exits(0);
    let text = "use \"vehicle.sense\";\nboard OLIMEX_STM32_E407 {}\n";
    let design = scratch.write("car.sense", text).display().to_string();
    let judged = sensedsl(["simulate", &design, "--judge", "--seconds", "4"]).run().exits(0);
    assert!(judged.stdout.contains("agree with the world"), "{}", judged.stdout);
    for seed in few(&["1", "2"], 1) {
        let mut simulate = Command::new(binary());
        simulate.args(["simulate", &design, "--can", "--seconds", "6"]).stderr(Stdio::null());
        let board = Running::new(&mut simulate);
        let bus = board.wait(|line| line.starts_with("CAN1 is at "));
        let mut python = Command::new("python3");
        python.arg(root().join("tests/can/play.py")).arg(&dbc);
        let peer = Running::new(python.arg(bus.trim_start_matches("CAN1 is at ")).arg(seed));
        let mut wanted = Vec::new();
        let _ = peer.wait(|line| {
            wanted.extend(
                line.split_once(' ')
                    .map(|(name, value)| (name.to_owned(), value.parse::<f64>().unwrap())),
            );
            line == "all"
        });
        let shown: Vec<_> = board.lines.iter().filter_map(|line| row(&line)).collect();
        assert!(wanted.len() == 14, "{wanted:?}");
        for (name, value) in wanted {
            let found = shown.iter().find(|(of, ..)| *of == name);
            let is_right = found.is_some_and(|(_, shown, slack)| (shown - value).abs() <= *slack);
            assert!(is_right, "seed {seed}: {name} is {value}, and shown as {found:?}");
        }
    }
}
