//! The values that hosts show and accept for curves, chips and arrays. The program generates them
//! from `tests/hosts/curves.sense`; this test compares them with what it computes from
//! `schema.json` only.

use std::path::PathBuf;
use std::process::Command;

use sensedsl_job::host::HostBoard;
use sensedsl_tests::{compiled_once, has, printed, read, run, sensedsl};
use sensedsl_twin::truth::real;
use sensedsl_wire::{Checksum, Direction, Event, Scalar, encode_report};
use serde_json::{Value, json};

use super::terminal::commanded;
use super::{designs, files};

/// Raw values at the points of each curve, between them and beyond them, one for each report.
const RANGER: [u64; 9] = [0, 497, 500, 621, 1000, 1614, 2500, 3900, 4095];
const BENT: [u64; 9] = [0, 79, 80, 81, 165, 249, 250, 251, 65_535];

/// The links of the design, written down a second time by hand.
pub(crate) fn boards() -> Vec<HostBoard> {
    let items = "1 sensor Ranger uint16\n10 sensor Line uint16[8]\n12 sensor Bumper bool[3]\n\
                 13 sensor Wheels int32[2]\n14 sensor Bent uint16\n20 actuator Escs uint16[4]\n\
                 21 actuator Lamps bool[3]\n22 actuator Winch uint16\n\
                 30 sensor Acceleration int16[3]\n31 sensor Rate int16[3]\n\
                 40 actuator Speed int16\n41 sensor Position int32";
    vec![designs::board("Rover", Checksum::None, items)]
}

/// Generates one host of the design; returns its folder and the content of `schema.json`.
pub(crate) fn generate(host: &str, test: &str) -> (PathBuf, Value) {
    let folder = files::folder(&format!("curves-{test}-{host}"));
    let call = sensedsl(["generate", "tests/hosts/curves.sense", "--without", "firmware", "-q"]);
    let _ = call.args(["--host", host, "-o"]).arg(&folder).run().exits(0);
    let schema = serde_json::from_str(&read(&folder.join("schema.json"))).unwrap();
    (folder.join("host").join(host), schema)
}

/// The board's reports: one for each of [`RANGER`].
pub(crate) fn reports() -> Vec<Vec<(u8, Vec<Scalar>)>> {
    let unsigned = |values: &[u64]| values.iter().copied().map(Scalar::Unsigned).collect();
    let signed = |values: &[i64]| values.iter().copied().map(Scalar::Signed).collect();
    let report = |(at, (ranger, bent)): (u64, (&u64, &u64))| {
        let line: Vec<u64> = (0..8).map(|element| 199 + 500 * element + at).collect();
        let turn = i64::try_from(at).unwrap();
        vec![
            (1, unsigned(&[*ranger])),
            (10, unsigned(&line)),
            (12, (0..3).map(|bit| Scalar::Bool(at >> bit & 1 == 1)).collect()),
            (13, signed(&[i64::from(i32::MIN) + turn, i64::from(i32::MAX)])),
            (14, unsigned(&[*bent])),
            (30, signed(&[-32_768 + turn, turn, 32_767])),
            (31, signed(&[-turn, 256, -257])),
            (41, signed(&[-1440 * turn])),
        ]
    };
    (0..).zip(RANGER.iter().zip(&BENT)).map(report).collect()
}

/// The reports as bytes.
pub(crate) fn stream() -> Vec<u8> {
    let schema = &boards()[0].schema;
    let frame = |values: &Vec<_>| encode_report(schema, Direction::Sensor, values).unwrap();
    reports().iter().flat_map(frame).collect()
}

/// The value shown for a raw one, computed from its item in `schema.json`.
fn shown(item: &Value, raw: f64) -> f64 {
    let x = raw * item["scale"].as_f64().unwrap_or(1.0) + item["offset"].as_f64().unwrap_or(0.0);
    let point = |point: &Value| (point[0].as_f64().unwrap(), point[1].as_f64().unwrap());
    let curve: Vec<(f64, f64)> = item["curve"].as_array().unwrap().iter().map(point).collect();
    let (Some(first), Some(last)) = (curve.first(), curve.last()) else { return x };
    let between =
        curve.iter().zip(curve.iter().skip(1)).find(|(one, next)| one.0 <= x && x < next.0);
    match between {
        Some((one, next)) => (one.1 * (next.0 - x) + next.1 * (x - one.0)) / (next.0 - one.0),
        None if x < first.0 => first.1,
        None => last.1,
    }
}

/// The numbers of `1.5`, `[1.5, 2]` and `[1.5, 2] cm`, and the unit.
fn numbers(text: &str) -> (Vec<f64>, &str) {
    let (list, unit) = match text.strip_prefix('[') {
        Some(rest) => rest.split_once(']').unwrap(),
        None => text.split_at(text.find(' ').unwrap_or(text.len())),
    };
    (list.split(", ").map(|one| one.parse().unwrap()).collect(), unit)
}

/// Checks that a program which received the messages of `Ranger`, such as `raw=1000 value=37.9` for
/// `1000 (37.9 cm)`, got the values in full.
pub(crate) fn check_messages(output: &str, schema: &Value) {
    for raw in RANGER {
        let start = format!("21001 1 raw={raw} value=");
        let found = output.lines().find_map(|line| line.strip_prefix(&start));
        let found: f64 = found.unwrap_or_else(|| panic!("no {start}\n{output}")).parse().unwrap();
        let expected = shown(&schema["boards"][0]["items"][0], raw as f64);
        assert!((found - expected).abs() <= 1e-12 * expected, "{start}{found}, not {expected}");
    }
}

/// The text after values of which one is outside the limits.
fn outside(item: &Value, values: &[f64]) -> String {
    let unit = item["quantity"].as_str().map(|unit| format!(" {unit}")).unwrap_or_default();
    let (min, max) = (item["min"].as_f64(), item["max"].as_f64());
    let of = |value: &f64| match (min, max) {
        (Some(min), _) if *value < min => Some(format!(" (below the minimum of {min}{unit})")),
        (_, Some(max)) if *value > max => Some(format!(" (above the maximum of {max}{unit})")),
        _ => None,
    };
    values.iter().find_map(of).unwrap_or_default()
}

/// Checks that the output has each value of [`reports`], both raw and as shown.
pub(crate) fn check(output: &str, schema: &Value) {
    let items = schema["boards"][0]["items"].as_array().unwrap();
    for (id, raw) in reports().into_iter().flatten() {
        let item = items.iter().find(|item| item["id"] == id).unwrap();
        let texts: Vec<String> = raw.iter().map(ToString::to_string).collect();
        let raw_text =
            if raw.len() == 1 { texts.concat() } else { format!("[{}]", texts.join(", ")) };
        let start = format!("{} = {raw_text}", item["name"].as_str().unwrap());
        let with_value = format!("{start} (");
        let is_scaled = ["scale", "offset", "quantity"].iter().any(|key| !item[key].is_null())
            || item["curve"] != json!([]);
        if !is_scaled {
            assert!(output.lines().any(|line| line == start), "no {start}\n{output}");
            continue;
        }
        let Some(rest) = output.lines().find_map(|line| line.strip_prefix(&with_value)) else {
            panic!("no {start}\n{output}");
        };
        let (printed, behind) = rest.split_once(')').unwrap();
        let (found, unit) = numbers(printed);
        let expected: Vec<f64> = raw.iter().map(|one| shown(item, real(*one))).collect();
        assert_eq!(unit.trim_start(), item["quantity"].as_str().unwrap_or_default(), "{start}");
        assert_eq!(found.len(), expected.len(), "{start} {rest}");
        for (found, expected) in found.iter().zip(&expected) {
            // Nine digits are printed.
            let close = (found - expected).abs() <= 1e-8 * expected.abs().max(1.0);
            assert!(close, "{start}: {found}, not {expected}");
        }
        assert_eq!(behind, outside(item, &expected), "{start} {rest}");
    }
}

/// Lines that a reader of the file can compute by hand.
pub(crate) const BY_HAND: [&str; 7] = [
    "Ranger = 0 (80 cm) (above the maximum of 70 cm)\n",
    "Ranger = 4095 (6 cm) (below the minimum of 8 cm)\n",
    "Bent = 80 (8)\n",
    "Bent = 165 (5.5)\n",
    "Bent = 250 (3)\n",
    "Bent = 65535 (3)\n",
    "Bumper = [true, false, true]\n",
];

#[test]
fn schema_json_says_how_values_are_shown() {
    let (_, schema) = generate("cpp", "fields");
    assert_eq!(schema["version"], 2);
    let board = &schema["boards"][0];
    assert_eq!((&board["stamp"], &board["baud"]), (&json!(false), &Value::Null));
    assert_eq!(board["hash"], format!("0x{:08x}", boards()[0].schema.hash()));
    let item = |name: &str| {
        let mut items = board["items"].as_array().unwrap().iter();
        items.find(|item| item["name"] == name).unwrap().clone()
    };
    let ranger = json!({
        "id": 1, "name": "Ranger", "direction": "sensor", "type": "uint16", "length": null,
        "kind": "analog", "cycle_ms": 1000, "chip": null, "label": "a GP2Y0A21 behind the bumper", "quantity": "cm",
        "scale": 3.3 / 4096.0, "offset": null, "min": 8.0, "max": 70.0,
        "curve": [[0.4, 80.0], [0.5, 60.0], [0.75, 40.0], [1.3, 20.0], [2.3, 10.0], [3.1, 6.0]],
        "invalid": [[0, 0], [4000, 4095]],
    });
    assert_eq!(item("Ranger"), ranger);
    let imu = json!({ "name": "Imu", "driver": "mpu6050" });
    assert_eq!([&item("Acceleration")["chip"], &item("Rate")["chip"]], [&imu, &imu]);
    let position = item("Position");
    assert_eq!(position["chip"], json!({ "name": "Left", "driver": "gearmotor_tb6612" }));
    assert_eq!(position["invalid"], json!([[-1, -1]]));
    let bumper = item("Bumper");
    assert_eq!([&bumper["curve"], &bumper["invalid"]], [&json!([]), &json!([])]);
    assert_eq!((&bumper["type"], &bumper["length"]), (&json!("bool"), &json!(3)));
}

/// The plain host, built as its README states.
fn plain(test: &str) -> Option<(PathBuf, PathBuf, Value)> {
    if !has("g++") {
        return None;
    }
    let (folder, schema) = generate("cpp", test);
    let program = compiled_once("host of the curves".to_owned(), || {
        let program = folder.join("monitor_Rover");
        let mut command = Command::new("g++");
        command.current_dir(&folder).args(["-std=c++17", "-O0", "-pthread", "-Iinclude"]);
        run(command.arg("src/monitor_Rover.cpp").arg("-o").arg(&program));
        program
    });
    Some((folder, program, schema))
}

#[test]
fn cpp_shows_values_through_curves() {
    let Some((folder, program, schema)) = plain("values") else { return };
    let record = folder.join("record.bin");
    std::fs::write(&record, stream()).unwrap();
    let output = printed(Command::new(program).arg(record));
    check(&output, &schema);
    for line in BY_HAND {
        assert!(output.contains(line), "no {line}{output}");
    }
}

/// The commands that the board must receive, whichever host they went to.
pub(crate) fn commands() -> Vec<(u8, Vec<Scalar>)> {
    let escs = [1000, 1500, 2000, 65_535].map(Scalar::Unsigned);
    let lamps = [true, false, true].map(Scalar::Bool);
    vec![(20, escs.to_vec()), (21, lamps.to_vec()), (22, vec![Scalar::Unsigned(3000)])]
}

/// The answer to a command beyond the limits, which apply to the values of the curve.
pub(crate) const REFUSED: &str = "(above the maximum of 100 N)";

#[test]
fn cpp_takes_arrays_and_limits_behind_curves() {
    let Some((_, program, _)) = plain("commands") else { return };
    let typed = "Escs raw 1000 1500 2000 65535\nWinch raw 900\nWinch raw 3001\nWinch 3001\n\
                 Lamps 1 2 0\nEscs 1 2\nEscs 0 50 % 101 100\nLamps true false 1\nWinch 100 N\n";
    let (events, errors) = commanded(&program, &boards()[0], typed, 3);
    let expected: Vec<Event> =
        commands().into_iter().map(|command| Event::Report(None, vec![command])).collect();
    assert_eq!(events, expected);
    for expected in [
        "not sent: Winch raw 900: Winch = 900 (-27.5 N) (below the minimum of -25 N)\n",
        "not sent: Winch raw 3001: Winch = 3001 (100.1 N) (above the maximum of 100 N)\n",
        "not sent: Winch 3001: 3001 N (above the maximum of 100 N)\n",
        "not sent: Escs 0 50 % 101 100: 101 percent is out of reach of the value",
        "sent: Winch = 3000 (100 N)\n",
        "sent: Lamps = [true, false, true]\n",
        "not sent: Lamps 1 2 0: 2 is not true, false, 1 or 0\n",
        "not sent: Escs 1 2: Escs takes 4 values\n",
    ] {
        assert!(errors.contains(expected), "no {expected}{errors}");
    }
}

/// The commands in `main` of a program that sends them repeatedly: see `commander.cpp`.
pub(crate) const COMMANDS: &str = "\
    sense::curves::Escs escs; escs.setRaw(0, 1000); escs.setRaw(1, 1500); escs.setRaw(2, 2000); \
    escs.setRaw(3, 65535); SEND(sense::curves::Escs, escs) \
    sense::curves::Winch much; much.setRaw(3001); SEND(sense::curves::Winch, much) \
    sense::curves::Lamps lamps; lamps.setRaw(0, true); lamps.setRaw(2, true); \
    SEND(sense::curves::Lamps, lamps) \
    sense::curves::Winch winch; winch.setValue(100.0); SEND(sense::curves::Winch, winch)";
