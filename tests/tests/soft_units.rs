//! `prefer unit` and `avoid unit` in the pure pin model: the program is compared with all possible
//! pin assignments of a few devices, which are tried here without any of its code.

use std::fmt::Write as _;

use sensedsl_tests::{Random, TempDir, design, sensedsl};
use serde_json::Value;

/// The number of pins in the table.
const PINS: usize = 7;

/// A soft rule: the unit, and whether it is preferred.
type Rule = (String, bool);

struct Asked {
    kind: &'static str,
    rules: Vec<Rule>,
}

struct Robot {
    /// The usages of each pin.
    table: Vec<Vec<String>>,
    devices: Vec<Asked>,
    board_rules: Vec<Rule>,
}

/// The objectives in the order of comparison: violated rules, cost, pins.
type Wiring = (u64, u64, Vec<usize>);

fn robot(random: &mut Random) -> Robot {
    let mut free: Vec<String> = Vec::new();
    for timer in 1..=3 {
        free.extend((1..=3).map(|channel| format!("TIM{timer}_CH{channel}")));
    }
    free.extend(["ADC12_IN1", "ADC1_IN2", "ADC2_IN3", "DAC1_OUT1"].map(str::to_owned));
    let table = (0..PINS).map(|_| {
        let mut row: Vec<String> = Vec::new();
        for _ in 0..=random.below(3) {
            let usage = free[random.below(free.len())].clone();
            if !row.contains(&usage) {
                row.push(usage);
            }
        }
        row
    });
    let table = table.collect();
    let rules = |random: &mut Random, most: usize| -> Vec<Rule> {
        let units = ["TIM1", "TIM2", "TIM3", "ADC1", "ADC2"];
        let count = random.below(most + 1);
        let one = |random: &mut Random| {
            ((*random.pick(&units).unwrap()).to_owned(), random.below(2) == 0)
        };
        (0..count).map(|_| one(random)).collect()
    };
    let kinds = ["icu", "pwm", "icu", "pwm", "analog"];
    let devices = (0..=random.below(3)).map(|_| {
        let kind = *random.pick(&kinds).unwrap();
        Asked { kind, rules: rules(random, 2) }
    });
    let devices = devices.collect();
    Robot { table, devices, board_rules: rules(random, 2) }
}

fn rules_text(rules: &[Rule]) -> String {
    let one = |(unit, prefer): &Rule| {
        format!("{} unit = {unit}; ", if *prefer { "prefer" } else { "avoid" })
    };
    rules.iter().map(one).collect()
}

impl Robot {
    fn text(&self, table: &str) -> String {
        let blocks = self.devices.iter().map(|device| {
            let own = if device.kind == "pwm" { "frequency = 50 Hz; " } else { "" };
            format!("{}: {own}{}", device.kind, rules_text(&device.rules))
        });
        let blocks: Vec<String> = blocks.collect();
        let blocks: Vec<&str> = blocks.iter().map(String::as_str).collect();
        let text = design(&format!("B on \"{table}\""), &blocks);
        text.replacen('{', &format!("{{ {}", rules_text(&self.board_rules)), 1)
    }

    fn csv(&self) -> String {
        let mut csv = String::from("# mcu = X\nPin,A,B,C\n");
        for (pin, row) in self.table.iter().enumerate() {
            let mut row = row.clone();
            row.resize(3, "-".into());
            writeln!(csv, "PA{pin},{}", row.join(",")).unwrap();
        }
        csv
    }

    /// All wirings, best first.
    fn wirings(&self) -> Vec<Wiring> {
        let mut found = Vec::new();
        self.extend(&mut Vec::new(), &mut found);
        found.sort();
        found
    }

    fn extend(&self, taken: &mut Vec<(usize, String)>, found: &mut Vec<Wiring>) {
        let Some(device) = self.devices.get(taken.len()) else {
            let violated = self.devices.iter().zip(&*taken).map(|(device, (_, usage))| {
                let rules = device.rules.iter().chain(&self.board_rules);
                rules.filter(|rule| violates(usage, rule)).count() as u64
            });
            let cost = taken.iter().map(|(pin, _)| self.table[*pin].len() as u64).sum();
            let pins = taken.iter().map(|(pin, _)| *pin).collect();
            found.push((violated.sum(), cost, pins));
            return;
        };
        for (pin, usage) in self
            .table
            .iter()
            .enumerate()
            .flat_map(|(pin, row)| row.iter().map(move |usage| (pin, usage)))
        {
            let free = taken.iter().all(|(other, signal)| *other != pin && signal != usage);
            if free && serves(device.kind, usage) {
                taken.push((pin, usage.clone()));
                self.extend(taken, found);
                taken.pop();
            }
        }
    }
}

fn serves(kind: &str, usage: &str) -> bool {
    match kind {
        "icu" => usage.ends_with("_CH1") || usage.ends_with("_CH2"),
        "pwm" => usage.contains("_CH"),
        _ => usage.starts_with("ADC"),
    }
}

/// Whether a usage violates a rule: a preferred unit must be able to have the wire; an avoided unit
/// must not be the only one.
fn violates(usage: &str, (unit, prefer): &Rule) -> bool {
    let of = usage.split('_').next().unwrap_or(usage);
    let units = if of == "ADC12" { vec!["ADC1", "ADC2"] } else { vec![of] };
    let has = units.contains(&unit.as_str());
    if *prefer { !has } else { units == [unit.as_str()] }
}

fn pins_of(answer: &Value) -> Vec<usize> {
    let devices = answer["boards"][0]["devices"].as_array().unwrap();
    let pin = |device: &Value| device["wires"][0]["pin"].as_str().unwrap()[2..].parse().unwrap();
    devices.iter().map(pin).collect()
}

fn wiring_of(answer: &Value) -> Wiring {
    let number = |name: &str| answer[name].as_u64().unwrap();
    (number("violated"), number("cost"), pins_of(answer))
}

#[test]
fn soft_rules_for_units_count_without_a_target() {
    let scratch = TempDir::new("soft_units");
    let (mut feasible, mut ruled) = (0, 0);
    for seed in 1..=40 {
        let mut random = Random::new(seed);
        let robot = robot(&mut random);
        let table = scratch.write(&format!("t{seed}.csv"), robot.csv()).display().to_string();
        let text = robot.text(&table);
        let solve = |arguments: &[&str]| {
            let call = sensedsl(["solve", "-", "-q", "--target", "none", "--allow-outside"]);
            let call = call.arg(scratch.path());
            arguments.iter().fold(call, |call, one| call.arg(one)).stdin(text.clone()).run()
        };
        let all = robot.wirings();
        let Some(best) = all.first() else {
            let _ = solve(&[]).exits(1);
            continue;
        };
        feasible += 1;
        ruled += u32::from(best.0 > 0);
        let answer = solve(&["--format", "json"]).exits(0).json();
        assert_eq!(&wiring_of(&answer), best, "{seed}\n{text}{}", robot.csv());
        let count = solve(&["--count"]).exits(0).stdout;
        assert_eq!(count.trim(), all.len().to_string(), "{seed}\n{text}{}", robot.csv());
        if seed <= 10 {
            let listed = solve(&["--all", "--limit", "30", "--format", "json"]).exits(0);
            let lines = listed.stdout.lines().map(|line| serde_json::from_str(line).unwrap());
            let listed: Vec<Wiring> = lines.map(|line: Value| wiring_of(&line)).collect();
            let expected: Vec<_> = all.iter().take(30).cloned().collect();
            assert_eq!(listed, expected, "{seed}\n{text}{}", robot.csv());
        }
    }
    assert!(feasible >= 20 && ruled >= 5, "{feasible} feasible, {ruled} with a violated rule");
}
