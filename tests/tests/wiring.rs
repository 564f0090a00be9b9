//! Several boards, all kinds of devices and tables of any order, seen through `solve`; the rest is in
//! `scripts/wiring.txt`.

use std::collections::BTreeMap;

use sensedsl_tests::{RunOutput, TempDir, design, device_block, scratch_folder, sensedsl};
use serde_json::Value;

const BOARD: &str = "STM32F4DiscoveryBoard";
const FULL: &str = "STM32F407G_DISC1";

fn solve(text: impl Into<String>, arguments: &[&str]) -> RunOutput {
    let call = sensedsl(["solve", "-", "-q", "--format", "json", "--allow-outside"]);
    // The tables are in folders of their own.
    let call = call.arg(scratch_folder());
    let call = arguments.iter().fold(call, |call, argument| call.arg(argument));
    call.stdin(text.into()).run()
}

/// The pins, by `board.device.role`.
fn pins(ran: &RunOutput) -> BTreeMap<String, String> {
    let mut pins = BTreeMap::new();
    for board in ran.json()["boards"].as_array().unwrap() {
        for device in board["devices"].as_array().unwrap() {
            for wire in device["wires"].as_array().unwrap() {
                let word = |value: &Value| value.as_str().unwrap().to_owned();
                let name = [&board["name"], &device["name"], &wire["role"]].map(word).join(".");
                pins.insert(name, word(&wire["pin"]));
            }
        }
    }
    pins
}

/// The pins of the best wiring of a design, in the order of devices and roles.
#[track_caller]
fn best(text: &str) -> Vec<String> {
    pins(&solve(text, &[]).exits(0)).into_values().collect()
}

fn table(rows: &str) -> (TempDir, String) {
    let scratch = TempDir::new("table");
    let path = scratch.write("table.csv", rows).display().to_string();
    (scratch, path)
}

#[test]
fn several_boards_and_devices_that_float() {
    let boards = |spare: &str, devices: usize| {
        let blocks: String = (1..=devices).map(|id| device_block(id, "analog")).collect();
        format!("{blocks}board One on {BOARD} {{}}\n{spare} board Two on {BOARD} {{}}\n")
    };
    // Nine fit on one board, but that costs more than using the cheap pins of both.
    let ran = solve(boards("", 9), &[]).exits(0);
    assert_eq!(ran.json()["cost"], 9);
    let on_two = |ran: &RunOutput| pins(ran).keys().filter(|name| name.starts_with("Two.")).count();
    assert_eq!(on_two(&ran), 3);
    // A spare board is used only if the devices need it, whatever the cost; they need it from ten
    // on.
    let ran = solve(boards("spare", 6), &[]).exits(0);
    assert_eq!((ran.json()["cost"].as_u64(), on_two(&ran)), (Some(6), 0));
    assert!(on_two(&solve(boards("spare", 10), &[]).exits(0)) >= 1);
    let ran = solve(boards("spare", 19), &[]).exits(1).json();
    assert_eq!(ran["conflict"]["devices"].as_array().map(Vec::len), Some(19));
}

#[test]
fn one_input_has_one_answer_whatever_the_order_of_the_table() {
    let csv = sensedsl(["boards", BOARD]).run().stdout;
    let (comments, rest): (Vec<&str>, Vec<&str>) =
        csv.lines().partition(|line| line.starts_with('#'));
    let (head, rows) = rest.split_first().unwrap();
    let devices = ["analog", "analog", "icu", "icu", "i2c: address = 0x20;", "encoder"];
    let text = design(BOARD, &devices);
    let expected = best(&text);
    let mut rows = rows.to_vec();
    for turn in 0..4 {
        rows.rotate_left(7);
        rows.swap(turn, turn + 5);
        let (_scratch, path) =
            table(&format!("{}\n{head}\n{}\n", comments.join("\n"), rows.join("\n")));
        let found = pins(&solve(text.clone(), &["--board", &path]).exits(0));
        assert_eq!(found.into_values().collect::<Vec<_>>(), expected);
    }
}

#[test]
fn every_kind_has_its_wires() {
    let cases: &[(&str, &[&str])] = &[
        ("analog", &["in"]),
        ("i2c: address = 0x20;", &["scl", "sda"]),
        ("icu", &["in"]),
        ("icu: driver = hcsr04;", &["in", "trigger"]),
        ("encoder", &["a", "b"]),
        ("digital", &["in"]),
        ("digital: edge = rising;", &["in"]),
        ("uart", &["rx", "tx"]),
        ("uart: tx = none;", &["rx"]),
        ("spi", &["cs", "miso", "mosi", "sck"]),
        ("pwm: frequency = 20 kHz;", &["out"]),
        ("dac", &["out"]),
        ("can: frame = 0x120;", &["rx", "tx"]),
    ];
    for target in ["chibios", "none"] {
        for (device, roles) in cases {
            let text = design(FULL, &[device]).replacen('{', "{ release CS43L22;", 1);
            let ran = solve(text, &["--target", target]).exits(0);
            let found: Vec<String> =
                pins(&ran).keys().map(|name| name.rsplit('.').next().unwrap().to_owned()).collect();
            assert_eq!(&found, roles, "{device} for {target}");
        }
    }
    let all: Vec<&str> = cases.iter().map(|(device, _)| *device).collect();
    let together = design(FULL, &all).replacen('{', "{ release CS43L22;", 1);
    assert_eq!(solve(together, &[]).exits(0).json()["status"], "optimal");
}

#[test]
fn tables_of_many_rows() {
    let mut rows = String::from("Pin,ADC,Other\n");
    for (at, port) in ('A'..='K').enumerate() {
        for number in 0..16 {
            rows.push_str(&format!("P{port}{number},ADC1_IN{number},OTHER{at}\n"));
        }
    }
    let (_scratch, path) = table(&rows);
    let board = format!("B on \"{path}\"");
    let ran = solve(design(&board, &["analog"; 16]), &[]).exits(0);
    assert_eq!(ran.json()["cost"], 32);
    let _ = solve(design(&board, &["analog"; 17]), &[]).exits(1);
}
