//! The time that each stage takes for the paper's example and the real car, from text to all files.
#![expect(clippy::disallowed_methods, reason = "a benchmark reads its data")]

use divan::Bencher;
use sensedsl_generate::Selection;
use sensedsl_model::design::Design;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Search, Solved, Wiring};

const EXAMPLES: [&str; 2] = ["fig2", "miniature_car"];

fn main() {
    divan::main();
}

fn text(example: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    std::fs::read_to_string(format!("{root}/{example}.sense")).expect("the example is there")
}

fn design(text: &str) -> Design {
    let request = Request { path: "robot.sense", text, board: None, target: None };
    resolve(&request, &NoFiles).design.expect("the example is right")
}

fn solved(design: &Design) -> Assignment {
    match Wiring::new(design, None).solve(&Search::default()) {
        Solved::Wired(assignment) => *assignment,
        Solved::Infeasible(_) | Solved::Failed(_) => panic!("the example has a wiring"),
    }
}

#[divan::bench(args = EXAMPLES)]
fn parse(bencher: Bencher<'_, '_>, example: &str) {
    let text = text(example);
    bencher.bench(|| sensedsl_syntax::parse(&text));
}

/// Includes parsing.
#[divan::bench(args = EXAMPLES)]
fn resolve_design(bencher: Bencher<'_, '_>, example: &str) {
    let text = text(example);
    bencher.bench(|| design(&text));
}

/// Formulates the problem for the solver, without solving it.
#[divan::bench(args = EXAMPLES)]
fn formulate(bencher: Bencher<'_, '_>, example: &str) {
    let design = design(&text(example));
    bencher.bench(|| drop(Wiring::new(&design, None)));
}

/// The search, the check of its answer and the mapping back to names.
#[divan::bench(args = EXAMPLES)]
fn solve(bencher: Bencher<'_, '_>, example: &str) {
    let design = design(&text(example));
    let wiring = Wiring::new(&design, None);
    bencher.bench(|| wiring.solve(&Search::default()));
}

#[divan::bench(args = ["fig2"])]
fn count(bencher: Bencher<'_, '_>, example: &str) {
    let design = design(&text(example));
    let wiring = Wiring::new(&design, None);
    bencher.bench(|| wiring.count());
}

/// All files of all hosts, in memory.
#[divan::bench(args = EXAMPLES)]
fn generate(bencher: Bencher<'_, '_>, example: &str) {
    let design = design(&text(example));
    let assignment = solved(&design);
    bencher.bench(|| sensedsl_generate::project("pipeline", &design, &assignment, &Selection::ALL));
}

#[divan::bench(args = EXAMPLES)]
fn all(bencher: Bencher<'_, '_>, example: &str) {
    let text = text(example);
    bencher.bench(|| {
        let design = design(&text);
        let assignment = solved(&design);
        sensedsl_generate::project("pipeline", &design, &assignment, &Selection::ALL)
    });
}
