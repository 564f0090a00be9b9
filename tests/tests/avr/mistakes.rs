//! Mistakes put into sketches and their runtime, one at a time. The compilers accept most of them; the test finds what
//! notices them when the sketch runs in its world, under a host that sets actuators and falls silent.
//!
//! The table is in `docs/seeded-mistakes.md`.

use std::path::Path;

use sensedsl_job::BoardJob;
use sensedsl_tests::{
    Mistake, assert_rows, assert_section, drawn, is_exhaustive, mistakes, read, text,
};

use super::sketches::{made, written};
use super::tools::can_compile_sketches;
use super::trial::{Host, run};
use crate::embassy::with_job;

const FILE: &str = "sketches.txt";
const DESIGNS: [&str; 3] = ["rover", "gauge", "receiver"];
/// The length of a run: in this time all actuators are set and abandoned, and everything in the worlds moves.
const SECONDS: u64 = 5;
/// So many are made in a usual run.
const USUALLY: usize = 2;

const PAGE: &str = "docs/seeded-mistakes.md";
const HEADING: &str = "In sketches, when they run";

/// The design of a mistake, and the file in its sketch.
fn place_of(mistake: &Mistake) -> (&str, &str) {
    mistake.places[0].name.split_once('/').unwrap()
}

fn design(name: &str) -> String {
    text(&format!("tests/avr/designs/{name}.sense"))
}

/// What notices that a sketch is wrong, in words; empty if nothing does.
fn noticed(job: &BoardJob<'_>, folder: &Path, world: &str) -> String {
    match made(job, folder) {
        Ok(image) => run(job, world, &image, Host::that_sets(SECONDS)).noticed(),
        Err(said) => {
            eprintln!("{said}");
            "compiler".to_owned()
        }
    }
}

/// What notices each mistake of a design.
fn tried<'a>(name: &str, own: &[&'a Mistake]) -> Vec<(&'a Mistake, String)> {
    let world = text(&format!("tests/avr/designs/{name}.toml"));
    with_job(&design(name), None, |job| {
        let folder = written(job, &format!("mistakes-{name}"));
        let by = noticed(job, &folder, &world);
        assert_eq!(by, "", "the {name} is wrong without a mistake");
        let try_out = |mistake: &&'a Mistake| {
            let path = folder.join(place_of(mistake).1);
            let right = read(&path);
            std::fs::write(&path, mistake.places[0].once(&right)).unwrap();
            let by = noticed(job, &folder, &world);
            std::fs::write(&path, right).unwrap();
            eprintln!("{name}, {}: {by}", mistake.what);
            (*mistake, by)
        };
        own.iter().map(try_out).collect()
    })
}

#[test]
fn mistakes_are_noticed() {
    if !can_compile_sketches() {
        return;
    }
    let all = mistakes(FILE);
    let drawn = drawn(FILE, &all, USUALLY);
    let mut table = "| mistake | noticed by |\n| --- | --- |\n".to_owned();
    let mut survivors = Vec::new();
    for name in DESIGNS {
        let own: Vec<&Mistake> =
            drawn.iter().filter(|one| place_of(one).0 == name).copied().collect();
        if own.is_empty() {
            continue;
        }
        for (mistake, by) in tried(name, &own) {
            table.push_str(&format!("| {}: {} | {by} |\n", name, mistake.what));
            survivors.extend(by.is_empty().then_some(&mistake.what));
        }
    }
    assert!(survivors.is_empty(), "nobody notices {survivors:?}");
    if is_exhaustive() {
        assert_section(PAGE, HEADING, &table);
    } else {
        assert_rows(PAGE, &table);
    }
}

/// The text that each mistake replaces must exist, so that the list follows the generator.
#[test]
fn mistakes_are_of_texts_that_are_there() {
    let all = mistakes(FILE);
    assert!(all.len() >= 40 && all.iter().all(|one| one.places.len() == 1), "{}", all.len());
    assert!(all.iter().all(|one| DESIGNS.contains(&place_of(one).0)));
    for name in DESIGNS {
        with_job(&design(name), None, |job| {
            let folder = written(job, &format!("mistakes-texts-{name}"));
            let own = all.iter().filter(|one| place_of(one).0 == name);
            for mistake in own {
                let right = read(&folder.join(place_of(mistake).1));
                assert_ne!(mistake.places[0].once(&right), right, "{}", mistake.what);
            }
        });
    }
}
