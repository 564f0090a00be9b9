//! Seeded pin problems as JSON lines, each with our answer and the time it took, for
//! `benches/compare.py`, which gives them to other solvers.
//!
//!     cargo run --release -p sensedsl-solve --features problems --example instances -- [FAMILY...] > instances.jsonl
#![expect(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a developer's program"
)]
#![allow(dead_code, reason = "the support code serves several programs")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::time::{Duration, Instant};

use sensedsl_solve::{Cancel, Options, Outcome, Problem, solve};
use support::board::TABLE_1;
use support::generate::{Mix, problem, table};
use support::json::json;

/// Instances of each size of a family.
const SEEDS: u64 = 5;
/// A run ends after this time: no instance is worth more.
const LIMIT: Duration = Duration::from_secs(20);

/// A family: its name, the tables of its boards, its sizes, its mix.
struct Family {
    name: &'static str,
    boards: Boards,
    sizes: &'static [u64],
    mix: Mix,
    dma: bool,
}

enum Boards {
    Table1,
    /// Boards with these numbers of pins, all different.
    Different(&'static [u64]),
    /// This many boards with this many pins each, all the same.
    Same(usize, u64),
}

/// A family with a bit of everything.
const fn family(name: &'static str, boards: Boards, sizes: &'static [u64]) -> Family {
    Family { name, boards, sizes, mix: Mix::General, dma: false }
}

const FAMILIES: &[Family] = &[
    family("table 1", Boards::Table1, &[2, 4, 6, 8, 10, 12]),
    family("one small board", Boards::Different(&[37]), &[4, 8, 12, 16]),
    family("one board", Boards::Different(&[82]), &[8, 16, 24, 32]),
    family("one full board", Boards::Different(&[114]), &[40, 50, 60]),
    Family {
        mix: Mix::Dma,
        dma: true,
        ..family("one board, DMA-tight", Boards::Different(&[82]), &[8, 12, 16, 20])
    },
    Family {
        mix: Mix::Timers,
        ..family("one board, timer-tight", Boards::Different(&[82]), &[8, 12, 16, 20])
    },
    family("two boards", Boards::Different(&[51, 82]), &[16, 32, 48]),
    family("two equal boards", Boards::Same(2, 82), &[16, 32, 48]),
    family("four equal boards", Boards::Same(4, 51), &[24, 48]),
    family("eight boards", Boards::Different(&[37, 37, 51, 51, 51, 82, 82, 82]), &[40, 80, 100]),
];

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for family in FAMILIES {
        if !wanted.is_empty() && wanted.iter().all(|name| name != family.name) {
            continue;
        }
        for size in family.sizes {
            for seed in 0..SEEDS {
                print_instance(family, *size, seed);
            }
        }
    }
}

fn print_instance(family: &Family, size: u64, seed: u64) {
    let tables: Vec<String> = match family.boards {
        Boards::Table1 => vec![TABLE_1.to_owned()],
        Boards::Different(pins) => {
            (1..).zip(pins).map(|(number, pins)| table(seed * 100 + number, *pins)).collect()
        }
        Boards::Same(count, pins) => vec![table(seed * 100 + 1, pins); count],
    };
    let boards: Vec<(&str, bool)> = tables.iter().map(|table| (table.as_str(), false)).collect();
    let problem = problem(seed, &boards, size, family.mix, family.dma).problem;
    let (status, objective, micros) = measured(&problem);
    println!(
        "{{\"family\":\"{}\",\"devices\":{size},\"seed\":{seed},\"status\":\"{status}\",\
         \"objective\":{objective:?},\"micros\":{micros},\"problem\":{}}}",
        family.name,
        json(&problem)
    );
}

/// Status, objective (moved, violated, shared, cost, spares) and the best time of a few runs,
/// including proof and tie-break.
fn measured(problem: &Problem) -> (&'static str, [u32; 5], f64) {
    let mut best = f64::INFINITY;
    let mut result = ("stopped", [0; 5]);
    for _ in 0..5 {
        let start = Instant::now();
        let stop = || start.elapsed() > LIMIT;
        let outcome = solve(problem, &Options { any: false, cancel: Cancel::when(&stop) }).unwrap();
        let micros = start.elapsed().as_secs_f64() * 1e6;
        best = best.min(micros);
        result = match outcome {
            Outcome::Solved(answer) => {
                let o = answer.objective;
                ("optimal", [o.moved, o.violated, o.shared, o.cost, o.spares])
            }
            Outcome::Infeasible(_) => ("infeasible", [0; 5]),
            Outcome::Stopped { .. } => ("stopped", [0; 5]),
        };
        if micros > 200_000.0 {
            break;
        }
    }
    (result.0, result.1, best)
}
