//! Kernels whose clock needs a timer: the wiring leaves one of those that serve, at the lowest cost, and a design is
//! refused only where no choice of that timer leaves a wiring.
#![allow(missing_docs, reason = "tests need none")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::disallowed_methods, reason = "only tests")]

use std::collections::BTreeSet;

use sensedsl_board::catalog;
use sensedsl_model::design::Design;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_wiring::{Search, Solved, Wiring};

/// Devices that take timers, which none of the others shares.
const DEVICES: [&str; 4] = [
    "sensor NAME returns int32 { type = encoder; }",
    "sensor NAME returns uint32 { type = icu; }",
    "actuator NAME accepts int16 { type = pwm; frequency = 1 kHz; }",
    "actuator NAME accepts int16 { type = pwm; frequency = 2 kHz; }",
];

/// The next number of a sequence (Numerical Recipes' generator).
fn next(state: &mut u32) -> usize {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*state >> 16) as usize
}

/// `None` if Embassy does not know the MCU.
fn design(board: &str, lines: &str) -> Option<Design> {
    let board = board.replace('-', "_");
    let text =
        format!("board B on {board} {{ target = embassy; link {{ transport = none; }}\n{lines}}}");
    let request = Request { path: "x.sense", text: &text, ..Request::default() };
    resolve(&request, &NoFiles).design
}

/// The shared pins and the cost of the best wiring, and the timers that it takes; `None` if there is no wiring.
fn solved(board: &str, lines: &str) -> Option<((usize, u32), BTreeSet<String>)> {
    let design = design(board, lines).unwrap();
    match Wiring::new(&design, None).solve(&Search::default()) {
        Solved::Wired(wiring) => {
            let units = wiring.boards.iter().flat_map(|on| &on.connections);
            let units = units.filter_map(|one| one.unit.clone()).collect();
            let shared = wiring.boards.iter().map(|on| on.shared.len()).sum();
            Some(((shared, wiring.cost), units))
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(why) => panic!("{why:?}"),
    }
}

/// The boards whose kernel has no other clock, with its timers.
fn boards() -> Vec<(String, Vec<String>)> {
    let all = catalog::all().iter().filter_map(|board| {
        let design = design(board.name, "")?;
        let timers = design.boards.first()?.profile()?.kernel.needed().to_vec();
        (!timers.is_empty()).then(|| (board.name.to_owned(), timers))
    });
    all.collect()
}

#[test]
fn a_wiring_leaves_the_kernel_a_timer_at_the_lowest_cost() {
    let boards = boards();
    assert!(boards.len() > 40, "{}", boards.len());
    let (mut state, mut wired, mut refused) = (27, 0, 0);
    let cases = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 400 } else { 16 };
    for _ in 0..cases {
        let (board, timers) = &boards[next(&mut state) % boards.len()];
        let count = 1 + next(&mut state) % 4;
        let device = |number: usize| {
            DEVICES[next(&mut state) % DEVICES.len()].replace("NAME", &format!("D{number}"))
        };
        let lines = (0..count).map(device).collect::<Vec<_>>().join("\n");
        let found = solved(board, &lines);
        let with = timers
            .iter()
            .filter_map(|timer| Some(solved(board, &format!("{lines}\nreserve {timer};"))?.0));
        assert_eq!(found.as_ref().map(|one| one.0), with.min(), "{board}\n{lines}");
        match found {
            Some((_, units)) => {
                wired += 1;
                assert!(timers.iter().any(|timer| !units.contains(timer)), "{board}\n{lines}");
            }
            None => refused += 1,
        }
    }
    assert!(wired > cases / 4 && refused > cases / 16, "{wired} wired, {refused} refused");
}
