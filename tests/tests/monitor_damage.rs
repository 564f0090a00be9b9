//! `monitor`, the programs of generated hosts, and a million frames of which many are damaged: the counters are those of
//! the damage, no undamaged frame is lost, and no wrong value comes beyond what the checksum's bits allow.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_host::Board;
use sensedsl_tests::{Random, TempDir, fed, has, is_exhaustive, is_thorough, read, run, sensedsl};
use sensedsl_wire::{Scalar, Stamp, encode_hello, encode_stamped_report};
use serde_json::Value;

const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Turns returns int32 { id = 18; type = encoder; }
    sensor Light returns uint16 { id = 17; type = analog; }
    link { stamp = true; checksum = crc16; }
}";

/// What was sent, and what a right host makes of it.
#[derive(Default)]
struct Sent {
    bytes: Vec<u8>,
    /// The numbers of the frames that arrive as they were sent.
    whole: Vec<i64>,
    /// The bytes that belong to whole frames, greetings among them.
    good_bytes: usize,
    greetings: usize,
    damaged: usize,
}

fn stream(board: &Board, count: usize, random: &mut Random) -> Sent {
    let mut sent = Sent::default();
    let hello = encode_hello(&board.schema);
    let greet = |sent: &mut Sent| {
        sent.bytes.extend(&hello);
        sent.good_bytes += hello.len();
        sent.greetings += 1;
    };
    greet(&mut sent);
    for number in 0..count {
        let value = i64::try_from(number).unwrap();
        let values = [
            (18, vec![Scalar::Signed(value)]),
            (17, vec![Scalar::Unsigned(u64::try_from(random.below(4_096)).unwrap())]),
        ];
        let stamp = Stamp { time_us: u32::try_from(number * 100).unwrap(), counter: number as u8 };
        let frame = encode_stamped_report(&board.schema, stamp, &values).unwrap();
        match random.below(100) {
            // Bytes that nobody sent.
            0..2 => {
                let garbage = (0..1 + random.below(24)).map(|_| random.below(256) as u8);
                sent.bytes.extend(garbage.collect::<Vec<_>>());
            }
            // A bit, or a few, are another.
            2..5 => {
                let mut other = frame.clone();
                for _ in 0..1 + random.below(3) {
                    let at = random.below(other.len());
                    other[at] ^= 1 << random.below(8);
                }
                if other != frame {
                    sent.bytes.extend(&other);
                    sent.damaged += 1;
                    continue;
                }
            }
            // The link was cut in the middle, and the board greets again.
            5 => {
                sent.bytes.extend(&frame[..random.below(frame.len())]);
                sent.damaged += 1;
                greet(&mut sent);
                continue;
            }
            _ => {}
        }
        sent.bytes.extend(&frame);
        sent.good_bytes += frame.len();
        sent.whole.push(value);
    }
    sent
}

/// The design's board, its generated files, and a stream.
fn prepared(scratch: &TempDir) -> (Board, PathBuf, Sent) {
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let generate = sensedsl(["generate", "--quiet", "--without", "firmware", "-o"]).arg(&out);
    let hosts = ["--host", "c", "cpp", "python", "rust", "--"];
    let _ = generate.args(hosts).arg(&file).run().exits(0);
    let board = Board::all_of_json(&read(&out.join("schema.json"))).unwrap().remove(0);
    let count = match (is_exhaustive(), is_thorough()) {
        (true, _) => 1_000_000,
        (_, true) => 100_000,
        _ => 10_000,
    };
    let sent = stream(&board, count, &mut Random::new(1_000_000));
    let _ = scratch.write("frames", &sent.bytes);
    (board, out, sent)
}

/// Judges what a program has printed: the numbers of frames, and its last words.
fn judge(who: &str, numbers: impl Iterator<Item = i64>, said: &str, sent: &Sent) {
    let mut whole = sent.whole.iter().peekable();
    let mut wrong = 0;
    for number in numbers {
        if whole.next_if(|expected| **expected == number).is_none() {
            wrong += 1;
        }
    }
    assert_eq!(whole.next(), None, "{who}: an undamaged frame is lost");
    // Of 65,536 damaged frames that still look like one, a checksum of 16 bits lets one pass.
    let most = 6 + sent.damaged / 10_000;
    assert!(sent.damaged > sent.whole.len() / 50, "{}", sent.damaged);
    assert!(wrong <= most, "{who}: {wrong} of {}", sent.damaged);
    if wrong == 0 {
        let (kept, dropped) =
            (sent.whole.len() + sent.greetings, sent.bytes.len() - sent.good_bytes);
        let counts = format!("{kept} frames, {dropped} bytes dropped");
        assert!(said.contains(&counts), "{who}: {counts}: {said}");
    }
}

#[test]
fn counters_are_those_of_the_damage() {
    let scratch = TempDir::new("monitor-damage");
    let (_, _, sent) = prepared(&scratch);
    let run = sensedsl(["monitor", "--format", "ndjson"]).arg(scratch.join("frames"));
    let ran = run.arg(scratch.join("robot.sense")).run().exits(0);
    let turns = ran.stdout.lines().filter(|line| line.contains("\"Turns\""));
    let numbers = turns.map(|line| {
        let object: Value = serde_json::from_str(line).unwrap();
        object["raw"].as_i64().unwrap()
    });
    judge("monitor", numbers, &ran.stderr, &sent);
}

/// The monitor of a generated host, as its README says to build it; none where its tools are missing.
fn program(host: &str, out: &Path, scratch: &TempDir) -> Option<Command> {
    let folder = out.join("host").join(host);
    let built = scratch.join(&format!("{host}-monitor"));
    match host {
        "c" if has("gcc") => {
            let mut gcc = Command::new("gcc");
            gcc.args(["-std=c99", "-O1", "-I."]).current_dir(&folder).arg("-o").arg(&built);
            let _ = run(gcc.args(["monitor_robot_Rover.c", "robot_Rover.c", "sensedsl.c"]));
            Some(Command::new(built))
        }
        "cpp" if has("g++") => {
            let mut gcc = Command::new("g++");
            gcc.args(["-std=c++17", "-O1", "-pthread", "-Iinclude"]).current_dir(&folder);
            let _ = run(gcc.arg("src/monitor_Rover.cpp").arg("-o").arg(&built));
            Some(Command::new(built))
        }
        "python" if has("python3") => {
            let mut python = Command::new("python3");
            let _ = python.args(["-m", "sense_robot"]).current_dir(folder);
            Some(python)
        }
        // It builds what the host builds on, too.
        "rust" if is_thorough() => {
            let mut cargo =
                Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
            let target = scratch.join("rust-target");
            cargo.current_dir(&folder).env("CARGO_TARGET_DIR", &target);
            cargo.env("CARGO_PROFILE_DEV_DEBUG", "none");
            let _ = run(cargo.args([
                "build",
                "--quiet",
                "--offline",
                "--locked",
                "--example",
                "monitor",
            ]));
            Some(Command::new(target.join("debug/examples/monitor")))
        }
        _ => None,
    }
}

#[test]
fn programs_of_hosts_count_the_same() {
    let scratch = TempDir::new("hosts-damage");
    let (_, out, sent) = prepared(&scratch);
    for host in ["c", "cpp", "python", "rust"] {
        let Some(mut program) = program(host, &out, &scratch) else { continue };
        let done = fed(program.arg(scratch.join("frames")), "");
        let [printed, said] =
            [done.stdout, done.stderr].map(|text| String::from_utf8(text).unwrap());
        let numbers =
            printed.lines().filter_map(|line| line.strip_prefix("Turns = ")?.parse().ok());
        judge(host, numbers, &said, &sent);
    }
}
