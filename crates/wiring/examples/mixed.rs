//! Seeded designs on boards of different sizes, with the solver's result for each: one JSON line
//! per design, which `benches/mixed.py` measures as a whole process and `benches/compare.py` gives
//! to other solvers.
//!
//!     cargo run --release -p sensedsl-wiring --features problems --example mixed -- [FAMILY [NUMBER [FIRST]]] > mixed.jsonl
#![expect(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    clippy::panic,
    reason = "a developer's program"
)]
#![allow(dead_code, unreachable_pub, reason = "the support code serves several programs")]

#[path = "../tests/support/mixed.rs"]
mod mixed;

#[path = "../../solve/tests/support/json.rs"]
mod json;

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use mixed::{FAMILIES, Text};
use sensedsl_wiring::solver::{Options, Outcome, solve};
use sensedsl_wiring::{Cancel, Wiring};
use serde_json::{Value, json};

/// A run ends after this time: no instance is worth more.
const LIMIT: Duration = Duration::from_secs(20);

fn main() {
    let wanted = std::env::args().nth(1).unwrap_or_else(|| "all".to_owned());
    let number = std::env::args().nth(2).map(|text| text.parse::<u64>().unwrap());
    let first = std::env::args().nth(3).map_or(0, |text| text.parse().unwrap());
    for family in FAMILIES {
        if wanted != "all" && wanted != family.name {
            continue;
        }
        for seed in first..first + number.unwrap_or(family.number) {
            let text = (family.make)(seed);
            println!("{}", line(family.name, seed, &text));
        }
    }
}

fn line(family: &str, seed: u64, text: &Text) -> Value {
    let design = text.design();
    let wiring = Wiring::new(&design, None);
    let problem = wiring.problem();
    let asked = AtomicU64::new(0);
    let (mut status, mut objective, mut micros) = ("stopped", [0; 5], f64::INFINITY);
    for _ in 0..5 {
        asked.store(0, Ordering::Relaxed);
        let start = Instant::now();
        let stop = || {
            asked.fetch_add(1, Ordering::Relaxed);
            start.elapsed() > LIMIT
        };
        let options = Options { any: false, cancel: Cancel::when(&stop) };
        let outcome = solve(problem, &options).unwrap();
        let spent = start.elapsed().as_secs_f64() * 1e6;
        micros = spent.min(micros);
        (status, objective) = match outcome {
            Outcome::Solved(answer) => {
                let o = answer.objective;
                ("optimal", [o.moved, o.violated, o.shared, o.cost, o.spares])
            }
            Outcome::Infeasible(_) => ("infeasible", [0; 5]),
            Outcome::Stopped { .. } => ("stopped", [0; 5]),
        };
        if spent > 1e6 {
            break;
        }
    }
    eprintln!("{family} {seed} {status} {micros:.0} us, asked {} times", asked.into_inner());
    json!({
        "family": family,
        "devices": problem.devices.len(),
        "seed": seed,
        "status": status,
        "objective": objective,
        "micros": micros,
        "sense": text.sense,
        "target": text.target,
        "tables": text.tables,
        "problem": serde_json::from_str::<Value>(&json::json(problem)).unwrap(),
    })
}
