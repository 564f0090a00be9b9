//! Every listed part can be named in a file, with the spelling that lists and messages give.
#![expect(clippy::disallowed_methods, reason = "a test asks the environment how much is wanted")]
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test may panic")]

use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_parts::{all, find};

/// The MCU of `board Robot on NAME`, and the errors.
fn named(name: &str) -> (Option<String>, Vec<Diagnostic>) {
    let text =
        format!("board Robot on {name} {{ sensor A returns bool {{ id = 1; type = digital; }} }}");
    let request = Request { path: "robot.sense", text: &text, board: None, target: Some("none") };
    let resolved = resolve(&request, &NoFiles);
    let errors = resolved.diagnostics.into_iter();
    let errors = errors.filter(|diagnostic| diagnostic.severity == Severity::Error).collect();
    (resolved.design.and_then(|design| design.boards[0].mcu.clone()), errors)
}

/// How a reader of `parts --list` writes a name, which has no hyphens.
fn spelled(number: &str) -> String {
    number.replace('-', "_")
}

#[test]
fn every_part_number_is_found_as_a_file_spells_it() {
    let mut count = 0;
    let is_thorough = std::env::var("SENSEDSL_THOROUGH").is_ok();
    for part in all().step_by(if is_thorough { 1 } else { 10 }) {
        for number in part.numbers() {
            let name = spelled(&number);
            assert!(name.starts_with(|c: char| c.is_ascii_alphabetic()), "{name}");
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{name}");
            for name in [&number, &name, &name.to_lowercase()] {
                let found = find(name);
                assert_eq!(found.map(|found| found.mcu).as_ref(), Some(&number), "{name}");
            }
            count += 1;
        }
    }
    assert!(count > if is_thorough { 3000 } else { 300 }, "{count}");
}

#[test]
fn parts_are_named_in_files() {
    let hyphened: Vec<String> = all().map(|part| part.name()).filter(|n| n.contains('-')).collect();
    assert!(hyphened.len() > 8, "{}", hyphened.len());
    let others = all().map(|part| part.name()).filter(|name| !name.contains('-')).step_by(20);
    for number in others.chain(hyphened) {
        let (mcu, errors) = named(&spelled(&number));
        assert_eq!((mcu.as_ref(), &errors[..]), (Some(&number), &[][..]), "{number}");
    }
}

/// Names that a message proposes are accepted.
#[test]
fn the_way_out_of_a_message_is_one() {
    let proposed = |name: &str| -> Vec<String> {
        let errors = named(name).1;
        assert!(!errors.is_empty(), "{name}");
        let text = format!("{errors:?}");
        let words = text.split('`').skip(1).step_by(2).filter(|word| *word != name);
        let words = words.filter(|word| word.to_uppercase().starts_with("ATMEGA"));
        words.map(str::to_owned).collect()
    };
    for wrong in ["ATmega328P-AU", "ATMEGA2560-16AU", "ATMEGA328P_XU", "ATMEGA2560_16AX"] {
        let ways = proposed(wrong);
        assert!(!ways.is_empty(), "{wrong}: no way out");
        for way in ways {
            assert_eq!(named(&way).1, [], "{wrong}: `{way}` is proposed");
        }
    }
}
