//! SWI-Prolog, given the exported problem, finds the same best cost as the tool.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use sensedsl_tests::{
    Call, Random, TempDir, design, device_block, has, run, scratch_folder, sensedsl, text,
};
use serde_json::Value;

/// A call of `solve` that may read the tables of these tests, which are in folders of their own.
fn call(format: &str) -> Call {
    let call = sensedsl(["solve", "-q", "--format", format, "--allow-outside"]);
    call.arg(scratch_folder())
}

/// What `main` of an exported program prints; it must say nothing else.
pub(crate) fn by_swipl(file: &Path) -> String {
    let output = run(Command::new("swipl").args(["-q", "-g", "main", "-t", "halt"]).arg(file));
    assert!(output.stderr.is_empty(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The first line that `main` of an exported program prints: rules violated, shared pins, cost.
fn by_prolog(scratch: &TempDir, design: &str) -> Option<(u64, u64, u64)> {
    let program = call("prolog").arg(design).run().exits(0).stdout;
    let file = scratch.write("wiring.pl", program);
    let out = by_swipl(&file);
    if out.trim() == "infeasible" {
        return None;
    }
    let number = |word: &str| -> u64 {
        let line = out.lines().find_map(|line| line.strip_prefix(word));
        line.unwrap_or_else(|| panic!("no {word}in {out}")).parse().unwrap()
    };
    Some((number("violated "), number("shared "), number("cost ")))
}

fn by_us(design: &str) -> Option<(u64, u64, u64)> {
    let ran = call("json").arg(design).run();
    let answer: Value = ran.json();
    match ran.status {
        0 => Some(["violated", "shared", "cost"].map(|part| answer[part].as_u64().unwrap()).into()),
        _ => {
            assert_eq!(answer["status"], "infeasible");
            None
        }
    }
}

#[track_caller]
fn agree(design: &str) -> Option<(u64, u64, u64)> {
    let scratch = TempDir::new("prolog");
    let file = scratch.write("robot.sense", design).display().to_string();
    let ours = by_us(&file);
    assert_eq!(by_prolog(&scratch, &file), ours, "{design}");
    ours
}

/// A table like Table 1: a dozen pins with one to three random usages each.
pub(crate) fn random_table(random: &mut Random) -> String {
    let signals = [
        "ADC12_IN1",
        "ADC12_IN2",
        "ADC12_IN3",
        "ADC1_IN4",
        "I2C1_SCL",
        "I2C1_SDA",
        "I2C2_SCL",
        "I2C2_SDA",
        "TIM2_CH1",
        "TIM2_CH2",
        "TIM3_CH1",
        "TIM3_CH2",
        "TIM4_CH1",
        "SPI1_SCK",
        "USART1_TX",
    ];
    let mut table = String::from("# mcu = STM32F407VGT6\nPin,A,B,C\n");
    for pin in 0..12 {
        let mut row: Vec<&str> = Vec::new();
        for _ in 0..=random.below(3) {
            let signal = *random.pick(&signals).unwrap();
            if !row.contains(&signal) {
                row.push(signal);
            }
        }
        row.resize(3, "-");
        writeln!(table, "PD{pin},{}", row.join(",")).unwrap();
    }
    table
}

#[test]
fn fig2() {
    if has("swipl") {
        assert_eq!(agree(&text("examples/fig2.sense")), Some((0, 0, 5)));
    }
}

#[test]
fn six_random_tables() {
    if !has("swipl") {
        return;
    }
    let scratch = TempDir::new("tables");
    let pool = ["analog", "analog", "icu", "i2c: address = 0x20;", "i2c: address = 0x21;"];
    let mut answers = Vec::new();
    for seed in 1..=6 {
        let mut random = Random::new(seed);
        let name = format!("table{seed}.csv");
        let table = scratch.write(&name, random_table(&mut random)).display().to_string();
        let devices: Vec<&str> = (0..4).map(|_| *random.pick(&pool).unwrap()).collect();
        answers.push(agree(&design(&format!("B on \"{table}\""), &devices)));
    }
    assert!(answers.iter().flatten().count() >= 2, "too few are feasible: {answers:?}");
}

#[test]
fn infeasible() {
    if has("swipl") {
        let five = design("STM32F4DiscoveryBoard", &["i2c: address = 0x20;"; 4]);
        assert_eq!(agree(&five), None);
    }
}

#[test]
fn with_wishes() {
    if has("swipl") {
        let devices = [
            "analog: prefer pin = PA1; avoid pin = PB0;",
            "analog: prefer pin = PA1;",
            "icu: prefer unit = TIM8;",
        ];
        let (violated, _, cost) = agree(&design("STM32F4DiscoveryBoard", &devices)).unwrap();
        assert_eq!(violated, 1);
        assert!(cost > 3);
    }
}

#[test]
fn on_two_boards_one_spare() {
    if has("swipl") {
        let floating: String = (1..=3).map(|id| device_block(id, "icu: unit = TIM8;")).collect();
        let board = "on STM32F4DiscoveryBoard {}";
        let two = format!("{floating} board One {board} spare board Two {board}");
        assert_eq!(agree(&two), None);
        let floating: String = (1..=2).map(|id| device_block(id, "icu: unit = TIM8;")).collect();
        let two = format!("{floating} board One {board} spare board Two {board}");
        assert_eq!(agree(&two), Some((0, 0, 4)));
    }
}
