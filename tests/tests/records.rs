//! Records of runs, as users make and use them: written while boards run, played again, converted, read by the programs
//! of others, simulated again; killed, cut and damaged anywhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_tests::{
    Random, TempDir, binary, few, has_python, is_thorough, printed, read, root, run, sensedsl,
};
use serde_json::Value;

const EXAMPLES: [&str; 6] =
    ["fig2", "miniature_car", "line_follower", "greenhouse", "arm", "quadcopter"];

const PAIR: &str = "board Left on NUCLEO_F446RE {
    sensor Light returns uint16 { id = 1; type = analog; delay = 10 ms; }
    actuator Servo accepts uint16 { id = 2; type = dac; scale = 0.1; quantity = deg; }
    link { stamp = true; checksum = crc16; }
}
board Right on NUCLEO_F446RE {
    sensor Turns returns int16 { id = 3; type = encoder; }
    sensor Bumper returns bool[2] { id = 4; type = digital; delay = 20 ms; }
}";

/// Watches a simulated design for some time, and gives its record and what was printed in JSON.
fn recorded(scratch: &TempDir, file: &Path, seconds: &str, more: &[&str]) -> (PathBuf, String) {
    let record = scratch.join("run.mcap");
    let _ = std::fs::remove_file(&record);
    let call = sensedsl(["monitor", "simulate"]).arg(file).args(["--format", "ndjson", "--record"]);
    let ran = call.arg(&record).args(["--seconds", seconds]).args(more).run().exits(0);
    (record, ran.stdout)
}

fn example(name: &str) -> PathBuf {
    root().join(format!("examples/{name}.sense"))
}

fn converted(record: &Path, to: &str) -> String {
    sensedsl(["convert", "--to", to]).arg(record).run().exits(0).stdout
}

/// The sensors' lines of what was converted.
fn of_sensors(ndjson: &str, actuators: &[&str]) -> String {
    let is_set = |line: &&str| {
        let object: Value = serde_json::from_str(line).unwrap();
        actuators.iter().any(|name| object["device"] == **name)
    };
    ndjson.lines().filter(|line| !is_set(line)).map(|line| format!("{line}\n")).collect()
}

#[test]
fn what_was_shown_is_shown_again() {
    let scratch = TempDir::new("records-again");
    for name in few(&EXAMPLES, 2) {
        let (record, live) = recorded(&scratch, &example(name), "1", &[]);
        assert!(live.lines().count() > 10, "{name}: {live}");
        let replay = sensedsl(["monitor", "--speed", "max", "--format", "ndjson"]);
        let replay = replay.arg(&record).run().exits(0);
        assert!(replay.stdout == live, "{name}: replayed otherwise");
        assert!(converted(&record, "ndjson") == live, "{name}: converted otherwise");
        let csv = sensedsl(["monitor", "--speed", "max", "--format", "csv"]).arg(&record);
        assert!(csv.run().exits(0).stdout == converted(&record, "csv"), "{name}");
        let summary = sensedsl(["convert", "--summary"]).arg(&record).run().exits(0).stdout;
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for line in live.lines() {
            let object: Value = serde_json::from_str(line).unwrap();
            *counts.entry(object["device"].as_str().unwrap().to_owned()).or_default() += 1;
        }
        for (device, count) in counts {
            let of = |line: &&str| {
                let mut words = line.split_whitespace();
                let first = words.next().unwrap_or_default();
                first.split('[').next() == Some(&device) && !first.ends_with(':')
            };
            let row = summary.lines().find(of).unwrap();
            assert_eq!(row.split_whitespace().nth(1), Some(count.to_string().as_str()), "{row}");
        }
    }
}

#[test]
fn several_boards_are_in_one_record() {
    let scratch = TempDir::new("records-pair");
    let file = scratch.write("pair.sense", PAIR);
    let set = ["--set", "Servo=20"];
    let (record, live) = recorded(&scratch, &file, "1", &set);
    assert!(of_sensors(&converted(&record, "ndjson"), &["Servo"]) == live);
    let left = sensedsl(["convert", "--board", "Left", "--device", "Servo"]).arg(&record);
    let left = left.run().exits(0).stdout;
    let rows: Vec<&str> = left.lines().skip(1).collect();
    assert!(rows.len() == 1 && rows[0].ends_with("Servo,0,200,20.0,deg"), "{left}");
    let wide = converted(&record, "wide");
    let head = wide.lines().next().unwrap();
    for column in ["Light", "Turns", "Bumper[1]", "Servo"] {
        assert!(head.contains(column), "{head}");
    }
    // A stranger's name is told with those that there are.
    let wrong = sensedsl(["convert", "--device", "Serv"]).arg(&record).run().exits(2);
    assert!(wrong.stderr.contains("E0565") && wrong.stderr.contains("Servo"), "{}", wrong.stderr);
    // What was a record is not written over.
    let again = sensedsl(["monitor", "simulate"]).arg(&file).args(["--seconds", "1", "--record"]);
    let again = again.arg(&record).run().exits(2);
    assert!(again.stderr.contains("E0566"), "{}", again.stderr);
}

#[test]
fn a_recorded_run_is_a_world() {
    let scratch = TempDir::new("records-world");
    let mut random = Random::new(28);
    for name in few(&EXAMPLES, 2) {
        let file = example(name);
        let seed = random.below(1_000).to_string();
        let world = scratch.write("world.toml", format!("seed = {seed}\n"));
        let world = world.to_str().unwrap();
        let (record, _) = recorded(&scratch, &file, "1", &["--world", world]);
        let judge = sensedsl(["simulate", "--judge", "--world"]).arg(&record).arg(&file).run();
        let judge = judge.exits(0);
        assert!(judge.stdout.contains("agree with the world"), "{name}: {}", judge.stdout);
    }
    // A design that reports something else is told from it, whatever the difference is.
    let pair = scratch.write("pair.sense", PAIR);
    let (record, _) = recorded(&scratch, &pair, "1", &["--set", "Servo=20"]);
    let judge = |text: &str| {
        let file = scratch.write("changed.sense", text);
        let call = sensedsl(["simulate", "--judge", "--board", "Left", "--world"]).arg(&record);
        call.arg(&file).run()
    };
    let kept = judge(PAIR).exits(0);
    assert!(kept.stdout.contains("Servo") && !kept.stderr.contains("E0568"), "{}", kept.stderr);
    for (from, to, told) in [
        ("type = analog;", "type = analog; scale = 0.5;", "Light of "),
        ("delay = 10 ms;", "delay = 20 ms;", "Light came every 10 ms and comes every 20 ms"),
        ("Light returns uint16", "Light returns int32", "Light was uint16 and is int32"),
        ("Light", "Lamp", "Light is gone"),
        ("scale = 0.1;", "scale = 0.2;", "Servo of "),
    ] {
        let changed = judge(&PAIR.replacen(from, to, 1)).exits(1);
        assert!(
            changed.stderr.contains("E0568") && changed.stderr.contains(told),
            "{told}: {}",
            changed.stderr
        );
    }
    let none = sensedsl(["simulate", "--judge", "--world"]).arg(&record).arg(example("fig2"));
    let none = none.run().exits(2);
    assert!(none.stderr.contains("E0565") && none.stderr.contains("Left"), "{}", none.stderr);
}

/// Everything that was shown and is a second older than the end of a record must be in it.
fn holds_a_beginning(record: &Path, live: &str, killed_after: Duration) -> usize {
    let done = sensedsl(["convert", "--to", "ndjson"]).arg(record).run().exits(0);
    let kept: Vec<&str> = done.stdout.lines().collect();
    // The last line may have been written in part.
    let shown: Vec<&str> =
        live.rsplit_once('\n').map_or(Vec::new(), |(all, _)| all.lines().collect());
    let both = kept.iter().zip(&shown);
    for (one, other) in both {
        assert_eq!(one, other);
    }
    let time_s =
        |line: &&&str| serde_json::from_str::<Value>(line).unwrap()["time_s"].as_f64().unwrap();
    let lost = shown.get(kept.len()..).unwrap_or_default();
    if let Some(first) = lost.first().as_ref().map(time_s) {
        // A chunk a second, and what a loaded machine needs to write it.
        let last = lost.last().as_ref().map_or(first, time_s);
        assert!(last - first < 1.5, "{first} to {last} of {killed_after:?} are lost");
    }
    kept.len()
}

#[test]
fn a_killed_run_can_be_read() {
    let scratch = TempDir::new("records-kill");
    let mut random = Random::new(9);
    let file = scratch.write("pair.sense", PAIR);
    let count = if is_thorough() { 100 } else { 8 };
    let mut kept = 0;
    let times: Vec<u64> = (0..count).map(|_| 150 + random.below(3_000) as u64).collect();
    for (batch, times) in times.chunks(8).enumerate() {
        let runs: Vec<_> = times
            .iter()
            .enumerate()
            .map(|(place, after_ms)| {
                let record = scratch.join(&format!("{batch}-{place}.mcap"));
                let shown = scratch.join(&format!("{batch}-{place}.ndjson"));
                let mut command = Command::new(binary());
                command.args(["monitor", "simulate", "--quiet", "--format", "ndjson", "--record"]);
                command.arg(&record).arg(&file).stdin(Stdio::null());
                command.stdout(std::fs::File::create(&shown).unwrap());
                (command.spawn().unwrap(), Instant::now(), *after_ms, record, shown)
            })
            .collect();
        for (mut child, began, after_ms, record, shown) in runs {
            let after = Duration::from_millis(after_ms);
            std::thread::sleep(after.saturating_sub(began.elapsed()));
            // SIGKILL: nothing of the program runs any more.
            child.kill().unwrap();
            let _ = child.wait().unwrap();
            if std::fs::metadata(&record).is_ok_and(|file| file.len() > 0) {
                kept += holds_a_beginning(&record, &read(&shown), after);
            }
        }
    }
    assert!(kept > 50 * count, "{kept}");
}

#[test]
fn a_record_that_is_cut_or_damaged_is_no_trap() {
    let scratch = TempDir::new("records-cut");
    let file = scratch.write("pair.sense", PAIR);
    let (record, live) = recorded(&scratch, &file, "2.5", &[]);
    let whole = std::fs::read(&record).unwrap();
    let mut random = Random::new(4);
    let (mut read, mut refused) = (0, 0);
    for round in 0..if is_thorough() { 300 } else { 40 } {
        let mut bytes = whole.clone();
        let at = random.below(bytes.len());
        if round % 2 == 0 {
            bytes.truncate(at);
        } else {
            bytes[at] ^= 1 << random.below(8);
        }
        let damaged = scratch.write("damaged.mcap", &bytes);
        let call = sensedsl(["convert", "--to", "ndjson"]).arg(&damaged).run();
        let what = format!("{round} at {at}: {:?} {}", call.status, call.stderr);
        match call.status {
            0 => {
                read += 1;
                // A chunk whose bytes were changed is noticed by its checksum.
                assert!(live.starts_with(&call.stdout), "{what}");
            }
            2 => {
                refused += 1;
                assert!(
                    call.stderr.contains("E0565") && !call.stderr.contains("panicked"),
                    "{what}"
                );
            }
            _ => panic!("{what}"),
        }
        let replay = sensedsl(["monitor", "--speed", "max", "--quiet"]).arg(&damaged).run();
        assert!(matches!(replay.status, 0 | 2), "{what}: {}", replay.stderr);
    }
    assert!(read > 5 && refused > 5, "{read} read, {refused} refused");
    for other in ["examples/fig2.sense", "Cargo.toml"] {
        let wrong = sensedsl(["convert", other]).run().exits(2);
        assert!(wrong.stderr.contains("E0565"), "{}", wrong.stderr);
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_record_and_not_the_run() {
    let scratch = TempDir::new("records-full");
    let file = scratch.write("pair.sense", PAIR);
    let record = scratch.join("run.mcap");
    // A file of more than 32 KiB is refused, as on a disk that is full.
    let line = "trap '' XFSZ; ulimit -f 32; exec \"$0\" \"$@\"";
    let mut command = Command::new("bash");
    command.args(["-c", line]).arg(binary()).args(["monitor", "simulate", "--format", "ndjson"]);
    command.args(["--seconds", "5", "--record"]).arg(&record).arg(&file).stdin(Stdio::null());
    let done = run(&mut command);
    let (shown, told) =
        (String::from_utf8(done.stdout).unwrap(), String::from_utf8(done.stderr).unwrap());
    assert!(told.contains("ends here") && told.contains("E0566"), "{told}");
    assert!(told.contains("make room"), "{told}");
    let last: Value = serde_json::from_str(shown.lines().last().unwrap()).unwrap();
    assert!(last["time_s"].as_f64().unwrap() > 4.5, "the run went on: {last}");
    let kept = sensedsl(["convert", "--to", "ndjson"]).arg(&record).run().exits(0).stdout;
    assert!(shown.starts_with(&kept) && kept.lines().count() > 20, "{}", kept.len());
}

#[test]
fn other_programs_read_them() {
    if !has_python("mcap, pyarrow") {
        return;
    }
    let scratch = TempDir::new("records-peers");
    let file = scratch.write("pair.sense", PAIR);
    let (record, live) = recorded(&scratch, &file, "1.5", &["--set", "Servo=20"]);
    let script = r#"
import json, sys
from mcap.reader import make_reader
with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True)
    for schema, channel, message in reader.iter_messages(log_time_order=False):
        if "type" in channel.metadata:
            value = json.loads(message.data)
            print(json.dumps([channel.topic, value["raw"], value["value"], message.log_time]))
    assert [a.name for a in reader.iter_attachments()] == ["schema.json"]
"#;
    let all = printed(Command::new("python3").args(["-c", script]).arg(&record));
    let all: Vec<Value> = all.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let sensors: Vec<&Value> =
        all.iter().filter(|one| !one[0].as_str().unwrap().ends_with("Servo")).collect();
    let live: Vec<Value> = live.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(sensors.len(), live.len());
    for (one, shown) in sensors.iter().zip(&live) {
        let topic =
            format!("/{}/{}", shown["board"].as_str().unwrap(), shown["device"].as_str().unwrap());
        assert_eq!((&one[0], &one[1], &one[2]), (&topic.into(), &shown["raw"], &shown["value"]));
    }
    let parquet = scratch.join("run.parquet");
    let _ = sensedsl(["convert", "-o"]).arg(&parquet).arg(&record).run().exits(0);
    let script = r"
import csv, sys
import pyarrow.parquet
table = pyarrow.parquet.read_table(sys.argv[1])
assert table.schema.field('time').type == pyarrow.timestamp('ns', 'UTC')
rows = table.drop_columns(['time', 'sampled']).to_pylist()
with open(sys.argv[2]) as file:
    wanted = list(csv.DictReader(file))
assert len(rows) == len(wanted) > 100, (len(rows), len(wanted))
for row, want in zip(rows, wanted):
    assert want['device'] == row['board'] + '/' + row['device'], (row, want)
    assert want['unit'] == (row['unit'] or ''), (row, want)
    for name in ('time_s', 'element', 'raw', 'value'):
        number = {'true': 1, 'false': 0}.get(want[name]) if want[name].isalpha() else float(want[name])
        assert abs(number - row[name]) < 1e-6, (name, row, want)
";
    let csv = scratch.write("run.csv", converted(&record, "csv"));
    let _ = run(Command::new("python3").args(["-c", script]).arg(&parquet).arg(&csv));
}

#[test]
fn a_page_needs_nothing_else() {
    let scratch = TempDir::new("records-page");
    let file = scratch.write("pair.sense", PAIR);
    let (record, _) = recorded(&scratch, &file, "1", &[]);
    let page = converted(&record, "html");
    for word in ["<h2>Left</h2>", "<h3>Light", "Bumper", "<path class=\"e1\""] {
        assert!(page.contains(word), "{word}: {page}");
    }
    assert!(!page.contains("http") && !page.contains("src=") && !page.contains("NaN"), "{page}");
    // Devices that are named are the only ones.
    let call = ["convert", "--to", "html", "--device", "Light"];
    let some = sensedsl(call).arg(&record).run().exits(0).stdout;
    assert!(some.contains("<h3>Light") && !some.contains("Bumper"), "{some}");
    // What is there is not replaced, unless that is asked for.
    let output = scratch.write("page.html", "mine");
    let call = || sensedsl(["convert", "-o"]).arg(&output).arg(&record);
    let refused = call().run().exits(2);
    assert!(refused.stderr.contains("E0508") && read(&output) == "mine", "{}", refused.stderr);
    let _ = call().arg("--force").run().exits(0);
    assert!(read(&output).contains("<h2>Right</h2>"));
}
