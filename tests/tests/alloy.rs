//! The Alloy Analyzer, given the exported model, finds a wiring as good as the tool's, and none
//! better.
//!
//! `ALLOY` is the class path of the analyzer: its jar, or several, separated by colons. Without it,
//! only the text of the model is checked.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{
    Random, TempDir, design, device_block, has, printed, root, scratch_folder, sensedsl, text,
};

use crate::prolog::random_table;

/// The results of a model's runs, by name.
type Runs = BTreeMap<String, bool>;

/// Runs all commands of the models; `None` if no analyzer is named.
fn analyze(models: &[PathBuf]) -> Option<Vec<Runs>> {
    let Some(classes) = std::env::var_os("ALLOY") else {
        eprintln!("SKIPPED: ALLOY names no analyzer");
        return None;
    };
    if !has("java") {
        return None;
    }
    let mut call = Command::new("java");
    call.arg("-cp").arg(classes).arg(root().join("tests/alloy/Runs.java")).args(models);
    let output = printed(&mut call);
    eprint!("{output}");
    let runs = |model: &PathBuf| {
        let lines = output.lines().filter_map(|line| {
            line.strip_prefix(model.to_str().unwrap()).map(str::split_whitespace)
        });
        let runs = lines.map(|mut words| {
            let name = words.next().unwrap().to_owned();
            (name, words.next().unwrap().parse().unwrap())
        });
        runs.collect()
    };
    Some(models.iter().map(runs).collect())
}

fn model(call: &[&str], file: &Path) -> String {
    let call = sensedsl(["solve", "-q", "--format", "alloy"]).args(call);
    let call = call.arg("--allow-outside").arg(scratch_folder());
    call.arg(file).run().exits(0).stdout
}

/// The cost, if there is a wiring.
fn cost(call: &[&str], file: &Path) -> Option<u64> {
    let call = sensedsl(["solve", "-q", "--format", "json"]).args(call);
    let ran = call.arg("--allow-outside").arg(scratch_folder()).arg(file).run();
    ran.json()["cost"].as_u64().filter(|_| ran.status == 0)
}

/// The analyzer must find a wiring with the tool's objective and none below it, or no wiring if the
/// tool finds none. Returns how many cases were feasible.
#[track_caller]
fn agree(name: &str, cases: &[(&[&str], String)]) -> usize {
    let scratch = TempDir::new(name);
    let mut models = Vec::new();
    let mut costs = Vec::new();
    for (at, (call, design)) in cases.iter().enumerate() {
        let file = scratch.write(&format!("{at}.sense"), design);
        let model = model(call, &file);
        assert!(is_plain(&model), "{model}");
        costs.push(cost(call, &file));
        models.push(scratch.write(&format!("{at}.als"), model));
    }
    for (found, ((_, design), cost)) in
        analyze(&models).into_iter().flatten().zip(cases.iter().zip(&costs))
    {
        let ask = |run: &str| found.get(run).copied();
        let wired = cost.is_some();
        assert_eq!(ask("any"), Some(wired), "{cost:?}\n{design}");
        assert_eq!(ask("best"), wired.then_some(true), "{cost:?}\n{design}");
        assert_eq!(ask("better"), wired.then_some(false), "{cost:?}\n{design}");
    }
    costs.iter().flatten().count()
}

/// Whether the text outside comments uses only the characters that a model is written with.
fn is_plain(model: &str) -> bool {
    model.lines().all(|line| {
        let code = line.split("//").next().unwrap_or_default();
        code.chars().all(|c| c.is_ascii_alphanumeric() || "_ +#&,{}()[]:=<".contains(c))
    })
}

#[test]
fn fig2_and_the_car() {
    let car = text("examples/miniature_car.sense");
    let cases = [
        (&[][..], text("examples/fig2.sense")),
        (&["--target", "none"], car.clone()),
        (&["--board", "STM32F407G-DISC1"], car),
    ];
    assert_eq!(agree("alloy", &cases), 3);
}

#[test]
fn a_model_states_its_runs_and_its_width() {
    let scratch = TempDir::new("alloy-text");
    let file = scratch.write("fig2.sense", text("examples/fig2.sense"));
    let fig2 = model(&[], &file);
    // The cost of all pins together is 33, and six bits only reach 31.
    for line in [
        "run any for 7 Int expect 1",
        "run best for 7 Int expect 1",
        "run better for 7 Int expect 0",
    ] {
        assert!(fig2.lines().any(|one| one == line), "{line}\n{fig2}");
    }
    assert!(fig2.contains("cost = 5 and") && fig2.contains("cost < 5)"), "{fig2}");
    let five = design("STM32F4DiscoveryBoard", &["i2c: address = 0x20;"; 4]);
    let none = model(&[], &scratch.write("none.sense", five));
    assert!(none.contains(" Int expect 0\n") && !none.contains("\nrun better"), "{none}");
    // If the search ran out of time, the model does not claim optimality.
    let late = model(&["--timeout", "0"], &file);
    assert!(late.contains("Time ran out") && !late.contains("expect 0"), "{late}");
}

#[test]
fn ten_random_tables() {
    let scratch = TempDir::new("tables");
    let pool = [
        "analog",
        "analog: prefer pin = PD3;",
        "icu",
        "icu: avoid unit = TIM2;",
        "i2c: address = 0x20;",
        "i2c: address = 0x21;",
        "pwm: frequency = 50 Hz;",
        "pwm: frequency = 50 Hz;",
        "pwm: frequency = 400 Hz;",
    ];
    let mut cases: Vec<(&[&str], String)> = Vec::new();
    for seed in 1..=10 {
        let mut random = Random::new(seed);
        let table = scratch.write(&format!("table{seed}.csv"), random_table(&mut random));
        let devices: Vec<&str> = (0..4).map(|_| *random.pick(&pool).unwrap()).collect();
        let call: &[&str] = if seed % 2 == 0 { &[] } else { &["--target", "none"] };
        cases.push((call, design(&format!("B on \"{}\"", table.display()), &devices)));
    }
    let feasible = agree("alloy-random", &cases);
    assert!((3..10).contains(&feasible), "{feasible} of 10 are feasible");
}

#[test]
fn every_part_of_the_objective() {
    let wishes = [
        "analog: prefer pin = PA1; avoid pin = PB0;",
        "analog: prefer pin = PA1;",
        "icu: prefer unit = TIM8;",
        "i2c: address = 0x10; avoid unit = I2C1;",
        "i2c: address = 0x10; avoid unit = I2C1;",
    ];
    let spare = |count: usize| {
        let floating: String =
            (1..=count).map(|id| device_block(id, "icu: unit = TIM8;")).collect();
        let board = "on STM32F4DiscoveryBoard {}";
        format!("{floating} board One {board} spare board Two {board}")
    };
    // The board's LEDs are on PD12 to PD15, the only pins that TIM4 has left.
    let lights = "# mcu = STM32F407VGT6\nPin,Usages,Onboard\nPD12,TIM4_CH1,LED:care\nPD13,TIM4_CH2 x,LED:care\nPB7,TIM4_CH2 y z,\n";
    let scratch = TempDir::new("alloy-shared");
    let table = scratch.write("t.csv", lights).display().to_string();
    let shared = design(&format!("B on \"{table}\""), &["pwm: frequency = 50 Hz;"; 2]);
    let before = design(
        "STM32F4DiscoveryBoard",
        &["analog: pin = PC1;", "i2c: address = 0x20; unit = I2C2;"],
    );
    let before = scratch.write("before.sense", before);
    let answer = sensedsl(["solve", "-q", "--format", "json"]).arg(before).run().exits(0);
    let before = scratch.write("before.json", answer.stdout).display().to_string();
    let keep: &[&str] = &["--keep", &before];
    let moved = design(
        "STM32F4DiscoveryBoard",
        &["analog: avoid pin = PC1;", "i2c: address = 0x20; unit = I2C1;"],
    );
    let none: &[&str] = &["--target", "none"];
    let cases = [
        (&[][..], design("STM32F4DiscoveryBoard", &wishes), "violated"),
        (&[], spare(2), "spares"),
        (&[], spare(3), ""),
        (none, shared, "shared"),
        (keep, moved, "moved"),
        (&[], design("STM32F4DiscoveryBoard", &["i2c: address = 0x20;"; 4]), ""),
    ];
    for (at, (call, design, part)) in
        cases.iter().enumerate().filter(|(_, case)| !case.2.is_empty())
    {
        let model = model(call, &scratch.write(&format!("{at}.sense"), design));
        let stated = model.lines().find(|line| line.contains(" and spares = ")).unwrap();
        assert!(!stated.contains(&format!("{part} = 0")), "{part}: {stated}");
    }
    let cases = cases.map(|(call, design, _)| (call, design));
    assert_eq!(agree("alloy-parts", &cases), 4);
}

#[test]
fn hostile_names_stay_in_comments() {
    let scratch = TempDir::new("alloy-hostile");
    let table = "# mcu = STM32F407VGT6\nPin,Usages,Side\nPA1,ADC1_IN1 }fact{some/none},x } // fact { some none }\nPA2,ADC1_IN2,left\n";
    let table = scratch.write("t.csv", table).display().to_string();
    let rules = "analog: avoid side = \"x } // fact { some none }\"; avoid side = left;";
    let devices = ["analog", rules];
    let words = design(&format!("run on \"{table}\""), &devices)
        .replace("D1", "fact")
        .replace("D2", "none");
    let none: &[&str] = &["--target", "none"];
    let file = scratch.write("hostile.sense", &words);
    assert!(model(none, &file).contains("// fact\n"), "the names are there");
    assert_eq!(agree("alloy-hostile", &[(none, words)]), 1);
}
