//! The statements of the paper and of later studies about Table 1, checked against the program.
#![expect(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeSet;

use sensedsl_tests::{Random, RunOutput, TempDir, design, few, sensedsl, text};
use serde_json::Value;

const FIG2: &str = "examples/fig2.sense";

/// The pins of all devices of an answer: `name role pin signal`.
fn wires(answer: &Value) -> Vec<String> {
    let mut wires = Vec::new();
    for board in answer["boards"].as_array().unwrap() {
        for device in board["devices"].as_array().unwrap() {
            for wire in device["wires"].as_array().unwrap() {
                let word = |key: &str| wire[key].as_str().unwrap().to_owned();
                let name = device["name"].as_str().unwrap();
                let line = [name, &word("role"), &word("pin"), &word("signal")].join(" ");
                wires.push(line);
            }
        }
    }
    wires
}

fn names(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

fn solve(text: &str, arguments: &[&str]) -> RunOutput {
    sensedsl(["solve", "-", "-q", "--format", "json"].iter().chain(arguments)).stdin(text).run()
}

#[test]
fn fig2_on_table1_has_the_known_answer_in_the_fixed_form() {
    let scratch = TempDir::new("fig2");
    let table = sensedsl(["boards", "STM32F4DiscoveryBoard"]).run().exits(0).stdout;
    assert_eq!(table.lines().filter(|line| line.starts_with('P')).count(), 1 + 26);
    let table = scratch.write("table1.csv", table);
    let ran = sensedsl(["solve", FIG2, "--format", "json", "--board"]).arg(&table).run().exits(0);
    let answer = ran.json();
    assert_eq!(
        keys(&answer),
        ["version", "status", "moved", "violated", "shared", "cost", "neatness", "count", "boards"]
    );
    assert_eq!(answer["version"], 1);
    assert_eq!(answer["status"], "optimal");
    assert_eq!(answer["moved"], 0);
    assert_eq!(answer["violated"], 0);
    assert_eq!(answer["shared"], 0);
    assert_eq!(answer["cost"], 5);
    assert_eq!(answer["count"], Value::Null);
    let board = &answer["boards"][0];
    assert_eq!(keys(board), ["name", "mcu", "cost", "devices"]);
    assert_eq!(board["name"], "STM32F4DiscoveryBoard");
    assert_eq!(board["mcu"], "STM32F407VGT6");
    let device = &board["devices"][0];
    assert_eq!(keys(device), ["name", "id", "kind", "unit", "wires"]);
    assert_eq!(keys(&device["wires"][0]), ["role", "pin", "signal", "usages"]);
    let units: Vec<_> = (0..4).map(|at| board["devices"][at]["unit"].clone()).collect();
    assert_eq!(units, ["ADC1", "ADC1", "I2C3", "TIM3"]);
    assert_eq!(
        wires(&answer),
        [
            "IRFront in PB0 ADC12-IN8",
            "IRFrontRight in PB1 ADC12-IN9",
            "USRear scl PA8 I2C3-SCL",
            "USRear sda PC9 I2C3-SDA",
            "WheelEncoder in PB4 TIM3_CH1",
        ]
    );
    // The built-in board gives the same, whichever way it is named.
    for board in [None, Some("STM32F4DiscoveryBoard"), Some("stm32f4_discovery-board")] {
        let call = sensedsl(["solve", FIG2, "--format", "json"]);
        let call = board.map_or(sensedsl(["solve", FIG2, "--format", "json"]), |name| {
            call.arg("--board").arg(name)
        });
        assert_eq!(call.run().exits(0).stdout, ran.stdout);
    }
}

/// A number of analog inputs, separate I2C buses and captures on Table 1.
struct Row {
    devices: [usize; 3],
    /// Number of wirings, least cost, and number of wirings with that cost, for the pins only.
    pins_alone: (&'static str, u64, usize),
    /// The same numbers, within what ChibiOS can do.
    chibios: (&'static str, u64, usize),
}

const ROWS: [Row; 5] = [
    Row { devices: [2, 1, 1], pins_alone: ("6240", 5, 720), chibios: ("5952", 5, 720) },
    Row { devices: [2, 1, 2], pins_alone: ("80744", 6, 5_040), chibios: ("66592", 6, 4_320) },
    Row {
        devices: [3, 1, 3],
        pins_alone: ("5927616", 8, 120_960),
        chibios: ("3697344", 8, 69_120),
    },
    Row {
        devices: [2, 1, 4],
        pins_alone: ("9421584", 8, 151_200),
        chibios: ("3840768", 8, 34_560),
    },
    Row {
        devices: [4, 1, 4],
        pins_alone: ("307823040", 10, 1_814_400),
        chibios: ("121218048", 10, 414_720),
    },
];

fn row_text(row: &Row) -> String {
    let [analog, i2c, icu] = row.devices;
    let i2c_device = "i2c: address = 0x20; exclusive = true;";
    let mut devices = vec!["analog"; analog];
    devices.extend(vec![i2c_device; i2c]);
    devices.extend(vec!["icu"; icu]);
    design("STM32F4DiscoveryBoard", &devices)
}

#[test]
fn numbers_of_wirings_and_least_costs_on_table1() {
    for row in ROWS {
        let text = row_text(&row);
        for (target, (count, cost, _)) in [("none", row.pins_alone), ("chibios", row.chibios)] {
            let ran = solve(&text, &["--count", "--target", target]).exits(0);
            let answer = ran.json();
            assert_eq!(answer["count"], count, "{:?} for {target}", row.devices);
            assert_eq!(answer["cost"], cost, "{:?} for {target}", row.devices);
        }
        let default = solve(&text, &["--count"]).exits(0).json();
        assert_eq!(default["count"], row.chibios.0, "chibios is the default target");
    }
    let plain = sensedsl(["solve", FIG2, "-q", "--count", "--target", "none"]).run().exits(0);
    assert_eq!(plain.stdout, "6240\n");
}

#[test]
fn numbers_of_optima_on_table1() {
    for row in few(&ROWS, 1).iter().take(2) {
        let text = row_text(row);
        for (target, (_, cost, optima)) in [("none", row.pins_alone), ("chibios", row.chibios)] {
            // The best wirings come first: all optima, then one with a higher cost.
            let limit = (optima + 1).to_string();
            let ran = solve(&text, &["--limit", &limit, "--target", target]).exits(0);
            let costs: Vec<u64> = ran
                .stdout
                .lines()
                .map(|line| serde_json::from_str::<Value>(line).unwrap()["cost"].as_u64().unwrap())
                .collect();
            assert_eq!(costs.len(), optima + 1);
            assert!(costs[..optima].iter().all(|found| *found == cost), "{:?}", row.devices);
            assert!(costs[optima] > cost, "{:?} for {target}", row.devices);
        }
    }
}

#[test]
fn all_wirings_of_fig2_are_different_and_as_many_as_counted() {
    let fig2 = text(FIG2);
    let ran = solve(&fig2, &["--all", "--target", "none"]).exits(0);
    let mut seen = BTreeSet::new();
    let mut last = 0;
    for line in ran.stdout.lines() {
        let answer: Value = serde_json::from_str(line).unwrap();
        let cost = answer["cost"].as_u64().unwrap();
        assert!(cost >= last, "best first");
        last = cost;
        assert!(seen.insert(wires(&answer)), "twice: {line}");
    }
    assert_eq!(seen.len(), 6240);
}

#[test]
fn ten_analog_sensors_fight_for_nine_pins() {
    let ran = solve(&design("STM32F4DiscoveryBoard", &["analog"; 10]), &[]).exits(1);
    let answer = ran.json();
    assert_eq!(answer["status"], "infeasible");
    let all = ["devices", "resources", "repairs", "rules", "places", "minimal"];
    assert_eq!(keys(&answer["conflict"]), all);
    assert_eq!(answer["conflict"]["minimal"], true);
    let all: Vec<String> = (1..=10).map(|number| format!("D{number}")).collect();
    assert_eq!(names(&answer["conflict"]["devices"]), all);
    let pins = ["PA1", "PA2", "PA3", "PB0", "PB1", "PC1", "PC2", "PC4", "PC5"];
    let mut resources = names(&answer["conflict"]["resources"]);
    resources.sort_unstable();
    assert_eq!(resources, pins);
    assert!(ran.stderr.contains("error[E0401]"), "{}", ran.stderr);
    assert!(!answer["conflict"]["repairs"].as_array().unwrap().is_empty());
    let nine = solve(&design("STM32F4DiscoveryBoard", &["analog"; 9]), &[]).exits(0).json();
    assert_eq!(nine["cost"], 13);
}

#[test]
fn no_time_at_all_is_said() {
    let text = design("STM32F4DiscoveryBoard", &["analog"; 12]);
    let ran = solve(&text, &["--timeout", "0"]).exits(1);
    assert!(ran.stderr.contains("E0404") && ran.stderr.contains("time ran out"), "{}", ran.stderr);
}

#[test]
fn four_exclusive_i2c_devices_fight_for_three_buses() {
    let device = |address: &str, more: &str| format!("i2c: address = {address}; {more}");
    let devices = |more: &str| {
        let addresses = ["0x20", "0x21", "0x22", "0x23"];
        let blocks: Vec<String> = addresses.iter().map(|one| device(one, more)).collect();
        let blocks: Vec<&str> = blocks.iter().map(String::as_str).collect();
        design("STM32F4DiscoveryBoard", &blocks)
    };
    let answer = solve(&devices("exclusive = true;"), &[]).exits(1).json();
    assert_eq!(names(&answer["conflict"]["devices"]), ["D1", "D2", "D3", "D4"]);
    let resources = names(&answer["conflict"]["resources"]);
    for bus in ["I2C1", "I2C2", "I2C3"] {
        assert!(resources.contains(&bus), "{resources:?}");
    }
    let shared = solve(&devices(""), &[]).exits(0).json();
    let wires = wires(&shared);
    assert_eq!(shared["cost"], 2);
    assert!(wires.iter().all(|wire| wire.contains("PA8") || wire.contains("PC9")), "{wires:?}");
}

#[test]
fn devices_of_one_address_go_to_different_buses() {
    let same = ["i2c: address = 0x20;"; 3];
    let answer = solve(&design("STM32F4DiscoveryBoard", &same), &[]).exits(0).json();
    let units: BTreeSet<String> = (0..3)
        .map(|at| answer["boards"][0]["devices"][at]["unit"].as_str().unwrap().to_owned())
        .collect();
    assert_eq!(units.len(), 3);
    let four = design("STM32F4DiscoveryBoard", &["i2c: address = 0x20;"; 4]);
    assert_eq!(solve(&four, &[]).exits(1).json()["status"], "infeasible");
    // 0xE6 (8-bit form) and 0x73 (7-bit form) are the same address.
    let mixed = ["i2c: address = 0xE6;", "i2c: address = 0x73; driver = srf08;"];
    let answer = solve(&design("STM32F4DiscoveryBoard", &mixed), &[]).exits(0).json();
    let devices = &answer["boards"][0]["devices"];
    assert_ne!(devices[0]["unit"], devices[1]["unit"]);
}

#[test]
fn the_miniature_car_takes_every_usable_timer() {
    let car = text("examples/miniature_car.sense");
    let answer = solve(&car, &[]).exits(0).json();
    assert_eq!(answer["status"], "optimal");
    assert_eq!(answer["cost"], 16);
    let devices = answer["boards"][0]["devices"].as_array().unwrap();
    let of_kind = |kind: &str| -> BTreeSet<&str> {
        let found = devices.iter().filter(|device| device["kind"] == kind);
        found.map(|device| device["unit"].as_str().unwrap()).collect()
    };
    let timers = ["TIM1", "TIM12", "TIM2", "TIM3", "TIM4", "TIM5", "TIM8", "TIM9"];
    let used = of_kind("icu");
    assert_eq!(used.len(), 7);
    assert!(used.iter().all(|timer| timers.contains(timer)), "{used:?}");
    assert_eq!(of_kind("i2c").len(), 1, "the rangers share a bus");
    let eighth = "sensor Eighth returns uint32 { id = 14; type = icu; } }";
    let end = car.rfind('}').unwrap();
    let answer = solve(&format!("{}{eighth}", &car[..end]), &[]).exits(1).json();
    let mut conflict = names(&answer["conflict"]["devices"]);
    conflict.sort_unstable();
    let mut icu = vec!["Eighth", "RCSteering", "RCSwitch", "RCThrottle"];
    icu.extend(["WheelLeftA", "WheelLeftB", "WheelRightA", "WheelRightB"]);
    assert_eq!(conflict, icu);
}

#[test]
fn a_conflict_is_minimal_and_its_repairs_hold() {
    let mut random = Random::new(7);
    let pool = ["analog", "icu", "i2c: address = 0x30; exclusive = true;", "encoder"];
    let mut infeasible = 0;
    for _ in 0..24 {
        let devices: Vec<&str> =
            (0..8 + random.below(7)).map(|_| *random.pick(&pool).unwrap()).collect();
        let ran = solve(&design("STM32F4DiscoveryBoard", &devices), &[]);
        if ran.status == 0 {
            continue;
        }
        infeasible += 1;
        let conflict = ran.exits(1).json()["conflict"]["devices"].clone();
        let members: Vec<usize> =
            names(&conflict).iter().map(|name| name[1..].parse::<usize>().unwrap() - 1).collect();
        let of = |members: &[usize]| {
            let chosen: Vec<&str> = members.iter().map(|at| devices[*at]).collect();
            solve(&design("STM32F4DiscoveryBoard", &chosen), &[]).status
        };
        assert_eq!(of(&members), 1, "the conflict alone has no wiring: {devices:?} {members:?}");
        for without in 0..members.len() {
            let mut fewer = members.clone();
            fewer.remove(without);
            assert_eq!(of(&fewer), 0, "not minimal: {devices:?} {members:?}");
        }
    }
    assert!(infeasible >= 5, "{infeasible}");
}
