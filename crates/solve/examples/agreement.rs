//! Seeded pin problems of all sorts as JSON lines, each with our result, for `benches/agree.py`,
//! which has other solvers check them.
//!
//!     cargo run --release -p sensedsl-solve --features problems --example agreement -- [NUMBER [FIRST]] > agreement.jsonl
#![expect(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a developer's program"
)]
#![allow(dead_code, reason = "the support code serves several programs")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::fmt::Display;
use std::time::{Duration, Instant};

use sensedsl_solve::problem::{Candidate, Problem, RuleId};
use sensedsl_solve::{Cancel, Options, Outcome, count, solve};
use support::board::TABLE_1;
use support::generate::{Mix, Rng, problem, table};
use support::json::{json, list};

/// No problem here should take this long.
const LIMIT: Duration = Duration::from_secs(5);

fn main() {
    let number = std::env::args().nth(1).map_or(1000, |text| text.parse().unwrap());
    let first = std::env::args().nth(2).map_or(0, |text| text.parse().unwrap());
    for seed in first..first + number {
        let mut rng = Rng(seed ^ 0x5EED);
        let problem = restricted(plain(seed, &mut rng), &mut rng);
        print_instance(seed, &problem);
    }
}

/// One to four boards, with and without a spare one, small or medium-sized.
fn plain(seed: u64, rng: &mut Rng) -> Problem {
    let boards = [1, 1, 1, 2, 2, 4][rng.below(6) as usize];
    let same = rng.below(3) == 0;
    let spare = rng.below(2) == 0;
    let pins = [26, 37, 51, 82][rng.below(4) as usize];
    let tables: Vec<String> = (0..boards)
        .map(|board| {
            let number = if same { 0 } else { board };
            if seed.is_multiple_of(10) {
                TABLE_1.to_owned()
            } else {
                table(seed * 10 + number, pins)
            }
        })
        .collect();
    let is_spare = |board: usize| spare && board > 0 && board + 1 == tables.len();
    let tables: Vec<(&str, bool)> =
        tables.iter().enumerate().map(|(board, t)| (t.as_str(), is_spare(board))).collect();
    let mix = [Mix::General, Mix::General, Mix::Dma, Mix::Timers][rng.below(4) as usize];
    let devices = 1 + rng.below(if boards == 1 { 16 } else { 24 });
    problem(seed, &tables, devices, mix, rng.below(2) == 0).problem
}

/// Adds what people write: reserved and fixed pins, sides, things preferred and avoided, and pins
/// that something else on the board uses.
fn restricted(mut problem: Problem, rng: &mut Rng) -> Problem {
    let reserved: Vec<bool> = problem.pins.iter().map(|_| rng.below(16) == 0).collect();
    let with_rules = rng.below(2) == 0;
    let with_shared = rng.below(2) == 0;
    problem.pins.iter_mut().for_each(|pin| pin.shared = with_shared && rng.below(4) == 0);
    for device in &mut problem.devices {
        let kind = rng.below(10);
        let side = rng.below(2) as u32;
        let rule = problem.rules;
        for role in device.alternatives.iter_mut().flat_map(|a| &mut a.roles) {
            role.candidates.retain(|c| !reserved[c.pin.0 as usize]);
            match kind {
                // One of two sides.
                0 => role.candidates.retain(|c| c.pin.0 / 16 % 2 == side),
                // A fixed wire.
                1 => role.candidates.truncate(1),
                // A preferred side, or pins to avoid.
                2 | 3 if with_rules => {
                    let bad = |c: &&mut Candidate| (c.pin.0 / 8 + side).is_multiple_of(2);
                    for c in role.candidates.iter_mut().filter(bad) {
                        c.violates.push(RuleId(rule));
                    }
                }
                _ => {}
            }
        }
        if with_rules && (kind == 2 || kind == 3) {
            problem.rules += 1;
        }
        device.alternatives.retain(|a| a.roles.iter().all(|r| !r.candidates.is_empty()));
    }
    problem
}

fn print_instance(seed: u64, problem: &Problem) {
    let start = Instant::now();
    let stop = || start.elapsed() > LIMIT;
    let options = Options { any: false, cancel: Cancel::when(&stop) };
    let (status, objective, detail) = match solve(problem, &options) {
        Ok(Outcome::Solved(answer)) => {
            let wires = problem.devices.iter().zip(&answer.choices).map(|(device, choice)| {
                let roles = &device.alternatives[choice.alternative].roles;
                let picks = roles.iter().zip(&choice.candidates);
                numbers(picks.map(|(role, &c)| role.candidates[c].pin.0))
            });
            let o = answer.objective;
            ("optimal", [o.moved, o.violated, o.shared, o.cost, o.spares], list(wires))
        }
        Ok(Outcome::Infeasible(conflict)) => {
            ("infeasible", [0; 5], numbers(conflict.devices.iter().map(|d| d.0)))
        }
        Ok(Outcome::Stopped { .. }) => ("stopped", [0; 5], "null".to_owned()),
        Err(fault) => panic!("seed {seed}: {fault}"),
    };
    // Small problems are counted too.
    let count = if problem.devices.len() <= 4 && problem.boards.len() == 1 {
        count(problem, Cancel::NEVER).unwrap().to_string()
    } else {
        "null".to_owned()
    };
    println!(
        "{{\"seed\":{seed},\"status\":\"{status}\",\"objective\":{objective:?},\
         \"detail\":{detail},\"count\":{count},\"problem\":{}}}",
        json(problem)
    );
}

fn numbers(items: impl Iterator<Item = impl Display>) -> String {
    list(items.map(|item| item.to_string()))
}
