//! Every driver in the simulator: a board that uses all its values runs, and the judge finds that each report is what
//! the part measured, and each command what arrives at it.

use std::sync::Mutex;

use sensedsl_model::facts;
use sensedsl_tests::{TempDir, one_in, sensedsl};

use super::library::examples;

/// Long enough for the part that starts the slowest (an SCD40, 6 s) and is then read every 6 s.
const SECONDS: &str = "20";
/// A run of this many threads; each waits for a program.
const THREADS: usize = 2;

/// What the judge says against the boards, one a part.
fn judged(all: &[(String, String)]) -> Vec<String> {
    let folder = TempDir::new("judged-drivers");
    let (left, wrong) = (Mutex::new(all.iter()), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            let _ = scope.spawn(|| {
                loop {
                    let Some((name, text)) = left.lock().unwrap().next() else { return };
                    let file = folder.write(&format!("{name}.sense"), text);
                    let run = sensedsl(["simulate"]).arg(file);
                    let ran = run.args(["--judge", "--seconds", SECONDS]).run();
                    let told = format!("{}{}", ran.stdout, ran.stderr);
                    let is_judged = ["agree with the world", "found what the design says"];
                    if ran.status != 0 || !is_judged.iter().any(|words| told.contains(words)) {
                        wrong.lock().unwrap().push(format!("{name}: {}\n{text}", told));
                    }
                }
            });
        }
    });
    wrong.into_inner().unwrap()
}

#[test]
fn every_driver_is_judged_in_the_simulator() {
    // Two parts need a port that inverts.
    let plain = examples(facts::EXAMPLE_BOARD);
    let inverting = examples("NUCLEO_F303RE");
    let is_inverted = |name: &str| {
        facts::find(name).is_some_and(|part| facts::example_board(&part) != facts::EXAMPLE_BOARD)
    };
    let boards = plain.into_iter().zip(inverting);
    let all = boards.map(|(plain, other)| if is_inverted(&plain.0) { other } else { plain });
    let wrong = judged(&one_in(3, all).collect::<Vec<_>>());
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}
