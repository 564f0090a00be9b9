//! Measures the solver on the paper's table and on seeded families of problems.

#[path = "../tests/support/mod.rs"]
mod support;

use divan::{Bencher, black_box};
use sensedsl_solve::{Cancel, Options, Problem, count, enumerate, solve};
use support::board::{Builder, Kind, TABLE_1, Target};
use support::generate::{self, Mix};

fn main() {
    divan::main();
}

/// Analog, I2C and ICU devices on the paper's table.
fn table_1(target: Target, analog: u32, i2c: u32, icu: u32) -> Problem {
    let mut builder = Builder::new(target, &[(TABLE_1, false)]);
    (0..analog).for_each(|_| builder.device(&Kind::Analog, &[0]));
    for address in 0..i2c {
        builder.device(&Kind::I2c { address, exclusive: false }, &[0]);
    }
    (0..icu).for_each(|_| builder.device(&Kind::Icu, &[0]));
    builder.problem
}

/// Eight problems of one size on made-up boards of 82 pins.
fn family(boards: u64, devices: u64, mix: Mix) -> Vec<Problem> {
    let problem = |seed: u64| {
        let tables: Vec<String> =
            (0..boards).map(|board| generate::table(seed * 8 + board, 82)).collect();
        let tables: Vec<(&str, bool)> = tables.iter().map(|t| (t.as_str(), false)).collect();
        generate::problem(seed, &tables, devices, mix, mix == Mix::Dma).problem
    };
    (0..8).map(problem).collect()
}

fn solve_all(bencher: Bencher<'_, '_>, problems: &[Problem]) {
    bencher.bench(|| {
        for problem in problems {
            let _ = black_box(solve(black_box(problem), &Options::default()));
        }
    });
}

#[divan::bench]
fn the_example(bencher: Bencher<'_, '_>) {
    solve_all(bencher, &[table_1(Target::Chibios, 2, 1, 1)]);
}

#[divan::bench]
fn table_1_with_twelve_devices(bencher: Bencher<'_, '_>) {
    solve_all(bencher, &[table_1(Target::Chibios, 4, 3, 5)]);
}

#[divan::bench]
fn table_1_without_an_answer(bencher: Bencher<'_, '_>) {
    solve_all(bencher, &[table_1(Target::Chibios, 10, 0, 0)]);
}

#[divan::bench]
fn a_hundred_answers_of_the_example(bencher: Bencher<'_, '_>) {
    let problem = table_1(Target::Chibios, 2, 1, 1);
    bencher.bench(|| enumerate(black_box(&problem), Cancel::NEVER).take(100).count());
}

#[divan::bench]
fn count_of_table_1(bencher: Bencher<'_, '_>) {
    let problem = table_1(Target::Chibios, 4, 1, 4);
    bencher.bench(|| count(black_box(&problem), Cancel::NEVER));
}

#[divan::bench(sample_count = 10)]
fn count_of_eight_devices(bencher: Bencher<'_, '_>) {
    let problems = family(1, 8, Mix::General);
    bencher.bench(|| {
        problems.iter().for_each(|p| {
            let _ = black_box(count(p, Cancel::NEVER));
        });
    });
}

#[divan::bench(args = [8, 16, 32], sample_count = 5)]
fn eight_of_one_board(bencher: Bencher<'_, '_>, devices: u64) {
    solve_all(bencher, &family(1, devices, Mix::General));
}

#[divan::bench(args = [12], sample_count = 5)]
fn eight_short_of_timers(bencher: Bencher<'_, '_>, devices: u64) {
    solve_all(bencher, &family(1, devices, Mix::Timers));
}

#[divan::bench(args = [12, 24], sample_count = 3)]
fn eight_of_two_boards(bencher: Bencher<'_, '_>, devices: u64) {
    solve_all(bencher, &family(2, devices, Mix::General));
}

/// The problem of `benches/naive.pl`: only pins and signals.
#[divan::bench(args = [(2, 1, 1), (3, 1, 3), (4, 1, 3)])]
fn as_naive_prolog(bencher: Bencher<'_, '_>, (analog, i2c, icu): (u32, u32, u32)) {
    solve_all(bencher, &[table_1(Target::None, analog, i2c, icu)]);
}
