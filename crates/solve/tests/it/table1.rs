//! The paper's table: counts, costs, answers and conflicts that were found by enumeration.

use crate::support::board::{Builder, Kind, TABLE_1, Target};
use sensedsl_solve::{Cancel, Optimality, Options, Outcome, check, count, enumerate, solve};

fn build(target: Target, analog: u32, i2c: u32, icu: u32) -> Builder {
    let mut builder = Builder::new(target, &[(TABLE_1, false)]);
    for _ in 0..analog {
        builder.device(&Kind::Analog, &[0]);
    }
    for address in 0..i2c {
        builder.device(&Kind::I2c { address, exclusive: true }, &[0]);
    }
    for _ in 0..icu {
        builder.device(&Kind::Icu, &[0]);
    }
    builder
}

type Row = (u32, u32, u32, u32, [u64; 3], [u64; 3]);

/// Analog, I2C, ICU; best cost; counts and numbers of optima for each target.
const ROWS: [Row; 5] = [
    (2, 1, 1, 5, [6_240, 6_240, 5_952], [720, 720, 720]),
    (2, 1, 2, 6, [80_744, 74_576, 66_592], [5_040, 4_320, 4_320]),
    (3, 1, 3, 8, [5_927_616, 4_582_368, 3_697_344], [120_960, 69_120, 69_120]),
    (2, 1, 4, 8, [9_421_584, 5_439_168, 3_840_768], [151_200, 34_560, 34_560]),
    (4, 1, 4, 10, [307_823_040, 175_762_944, 121_218_048], [1_814_400, 414_720, 414_720]),
];
const TARGETS: [Target; 3] = [Target::None, Target::Timers, Target::Chibios];

#[test]
fn counts_and_costs() {
    for (analog, i2c, icu, cost, counts, _) in ROWS {
        for (target, expected) in TARGETS.into_iter().zip(counts) {
            let builder = build(target, analog, i2c, icu);
            let number = count(&builder.problem, Cancel::NEVER).expect("a proper problem");
            assert_eq!(number, expected.into(), "{analog} {i2c} {icu}");
            let Ok(Outcome::Solved(answer)) = solve(&builder.problem, &Options::default()) else {
                panic!("{analog} {i2c} {icu} has an answer")
            };
            assert_eq!(answer.objective.cost, cost);
            assert_eq!(answer.optimality, Optimality::Proved);
            assert_eq!(check(&builder.problem, &answer), Ok(()));
        }
    }
}

#[test]
fn numbers_of_optima() {
    for (analog, i2c, icu, cost, _, optima) in ROWS.into_iter().take(2) {
        for (target, expected) in TARGETS.into_iter().zip(optima) {
            let builder = build(target, analog, i2c, icu);
            let answers =
                enumerate(&builder.problem, Cancel::NEVER).map(|a| a.expect("a checked answer"));
            let best = answers.take_while(|a| a.objective.cost == cost);
            assert_eq!(best.count() as u64, expected, "{analog} {i2c} {icu}");
        }
    }
}

#[test]
fn every_answer_of_the_example_once_and_in_order() {
    let builder = build(Target::None, 2, 1, 1);
    let mut last = None;
    let mut number = 0;
    for answer in enumerate(&builder.problem, Cancel::NEVER) {
        let answer = answer.expect("a checked answer");
        let key = |wires: Vec<Vec<&str>>| -> Vec<u32> {
            wires.into_iter().flatten().map(|w| position(&builder, w)).collect()
        };
        let order =
            (answer.objective, key(builder.pins(&answer)), key(builder.used_signals(&answer)));
        assert!(last < Some(order.clone()));
        last = Some(order);
        number += 1;
    }
    assert_eq!(number, 6_240);
}

fn position(builder: &Builder, name: &str) -> u32 {
    let all = builder.names.iter().chain(&builder.signals);
    all.into_iter().position(|n| n == name).unwrap_or(usize::MAX) as u32
}

#[test]
fn the_example() {
    for target in TARGETS {
        let builder = build(target, 2, 1, 1);
        let Ok(Outcome::Solved(answer)) = solve(&builder.problem, &Options::default()) else {
            panic!("the example has an answer")
        };
        let pins = [vec!["PB0"], vec!["PB1"], vec!["PA8", "PC9"], vec!["PB4"]];
        assert_eq!(builder.pins(&answer), pins);
        assert_eq!(builder.used_signals(&answer)[3], ["TIM3_CH1"]);
        assert_eq!(builder.used_signals(&answer)[2], ["I2C3_SCL", "I2C3_SDA"]);
    }
}

#[test]
fn the_real_car() {
    let mut builder = build(Target::Chibios, 3, 0, 0);
    for address in 1..=3 {
        builder.device(&Kind::I2c { address, exclusive: false }, &[0]);
    }
    for _ in 0..7 {
        builder.device(&Kind::Icu, &[0]);
    }
    let Ok(Outcome::Solved(answer)) = solve(&builder.problem, &Options::default()) else {
        panic!("the car has an answer")
    };
    assert_eq!(answer.objective.cost, 16);
    builder.device(&Kind::Icu, &[0]);
    let Ok(Outcome::Infeasible(conflict)) = solve(&builder.problem, &Options::default()) else {
        panic!("an eighth capture has no timer")
    };
    let devices: Vec<u32> = conflict.devices.iter().map(|d| d.0).collect();
    assert_eq!(devices, [6, 7, 8, 9, 10, 11, 12, 13]);
    // Eight timers could capture, but for TIM2 and TIM5 there is only PA1.
    assert_eq!(conflict.resources.len(), 6);
    let pins = conflict.pins.iter().map(|p| builder.names[p.0 as usize].as_str());
    assert_eq!(pins.collect::<Vec<_>>(), ["PA1"]);
}

#[test]
fn ten_analog_sensors_fight_for_nine_pins() {
    let builder = build(Target::Chibios, 10, 1, 1);
    let Ok(Outcome::Infeasible(conflict)) = solve(&builder.problem, &Options::default()) else {
        panic!("ten do not fit")
    };
    assert_eq!(
        conflict.devices.iter().map(|d| d.0).collect::<Vec<_>>(),
        (0..10).collect::<Vec<_>>()
    );
    let pins: Vec<&str> =
        conflict.pins.iter().map(|p| builder.names[p.0 as usize].as_str()).collect();
    assert_eq!(pins, ["PA1", "PA2", "PA3", "PB0", "PB1", "PC1", "PC2", "PC4", "PC5"]);
    assert_eq!(conflict.resources, []);
}

#[test]
fn four_exclusive_buses_are_one_too_many_and_shared_ones_are_one() {
    let builder = build(Target::Chibios, 0, 4, 0);
    let Ok(Outcome::Infeasible(conflict)) = solve(&builder.problem, &Options::default()) else {
        panic!("there are three buses")
    };
    assert_eq!(conflict.devices.len(), 4);
    assert_eq!(conflict.resources.len(), 3);
    let mut builder = Builder::new(Target::Chibios, &[(TABLE_1, false)]);
    for address in 0..4 {
        builder.device(&Kind::I2c { address, exclusive: false }, &[0]);
    }
    let Ok(Outcome::Solved(answer)) = solve(&builder.problem, &Options::default()) else {
        panic!("four addresses share a bus")
    };
    assert_eq!(answer.objective.cost, 2);
    assert_eq!(builder.pins(&answer), vec![vec!["PA8", "PC9"]; 4]);
}
