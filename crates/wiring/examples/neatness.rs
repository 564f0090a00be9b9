//! How neat the wirings of designs are, before and after the search for neat ones:
//! `cargo run --release -p sensedsl-wiring --example neatness -- [--board NAME] [--neat N] FILE…`.
#![expect(clippy::print_stdout, clippy::disallowed_methods, reason = "a program for developers")]

use std::time::Instant;

use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_wiring::{Search, Solved, Wiring};

fn main() {
    let (mut board, mut rise, mut files) = (None, 0, Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--board" => board = arguments.next(),
            "--neat" => rise = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(0),
            _ => files.push(argument),
        }
    }
    println!("| design | devices | cost | sides | span | proved | steps | all ms |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for path in files {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let request =
            Request { path: &path, text: &text, board: board.as_deref(), ..Request::default() };
        let Some(design) = resolve(&request, &NoFiles).design else {
            println!("| {path} | | | | | | not a design |");
            continue;
        };
        let wiring = Wiring::new(&design, None);
        let began = Instant::now();
        let solved = wiring.solve(&Search { any: false, rise });
        let Solved::Wired(wired) = solved else {
            println!("| {path} | | | | | | no wiring |");
            continue;
        };
        let (now, devices) = (wired.neatness, design.devices.len());
        let before = now.before.map_or((0, 0), |plain| (plain.sides, plain.span));
        println!(
            "| {path} | {devices} | {} | {} → {} | {} → {} | {} | {} | {} |",
            wired.cost,
            before.0,
            now.sides,
            before.1,
            now.span,
            now.is_proved,
            now.steps,
            began.elapsed().as_millis(),
        );
    }
}
