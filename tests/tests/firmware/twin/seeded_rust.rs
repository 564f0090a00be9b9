//! Mistakes put into the Rust that is generated for a rover, one at a time. The types of the HAL
//! accept them; the test finds what notices them when the program runs in its world.
//!
//! The table is in `docs/seeded-mistakes.md`, written together with that of `seeded.rs`.

use sensedsl_tests::{mistakes, read};

use super::seeded::{assert_table, noticed_by, table, tried};
use super::trial::{System, rover};
use crate::firmware::embassy::{build, generated, project};

const HEADING: &str = "In Rust, when it runs";

#[test]
fn mistakes_that_types_take_are_noticed() {
    if !sensedsl_tests::is_exhaustive() {
        return;
    }
    let Some(board) = project("seeded_rust", &rover()) else { return };
    let try_out = || noticed_by(System::Embassy, &std::fs::read(build(&board)).unwrap());
    assert_eq!(try_out(), "", "the rover is wrong without a mistake");
    let (all, mut rows) = (mistakes("rover_rust.txt"), Vec::new());
    for mistake in tried(&all) {
        let paths: Vec<_> = mistake.places.iter().map(|place| board.join(&place.name)).collect();
        let right: Vec<String> = paths.iter().map(|path| read(path)).collect();
        for ((place, path), text) in mistake.places.iter().zip(&paths).zip(&right) {
            std::fs::write(path, place.everywhere(text)).unwrap();
        }
        let by = try_out();
        for (path, text) in paths.iter().zip(right) {
            std::fs::write(path, text).unwrap();
        }
        eprintln!("{}: {by}", mistake.what);
        rows.push((mistake, by));
    }
    assert_table(HEADING, &table(&rows));
}

/// The text that each mistake replaces must exist, so that the list follows the generator.
#[test]
fn mistakes_in_rust_are_of_texts_that_are_there() {
    let board = generated("seeded_rust_texts", &rover());
    let all = mistakes("rover_rust.txt");
    assert!(all.len() > 20 && all.iter().all(|mistake| !mistake.places.is_empty()));
    for place in all.iter().flat_map(|mistake| &mistake.places) {
        let _ = place.everywhere(&read(&board.join(&place.name)));
    }
}
