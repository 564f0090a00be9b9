//! A snapshot after many edits is the same as a fresh reading of the same text; a mistake in one
//! device leaves the others their wiring.
#![allow(missing_docs, reason = "tests need none")]
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "a test reads the examples")]

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::{FileRequest, Files, NoFiles, ReadError};
use sensedsl_session::{Ask, On, Workspace};

const NAME: &str = "robot.sense";

/// What edits insert: what people type, and what breaks the most.
const TYPED: [&str; 12] =
    ["", "", "}", "{", ";", "type = i2c;", "id = 3;", "\"", "A", "1", "/*", " pin = PA1;\n"];

fn car() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/miniature_car.sense");
    std::fs::read_to_string(path).unwrap()
}

fn reported(workspace: &Workspace) -> Vec<Diagnostic> {
    workspace.snapshot(NAME, On::default(), &NoFiles).diagnostics().to_vec()
}

/// The next number of a fixed sequence (Knuth's MMIX generator), below `most`.
fn next(state: &mut u64, most: usize) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize % most.max(1)
}

/// A place between two characters.
fn place(text: &str, state: &mut u64) -> usize {
    let mut at = next(state, text.len() + 1);
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[test]
fn random_edits_end_where_a_fresh_reading_is() {
    let edits = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 5_000 } else { 60 };
    let (mut workspace, mut state) = (Workspace::default(), 1);
    workspace.open(NAME, car());
    let mut undo: Vec<String> = Vec::new();
    for number in 0..edits {
        let text = workspace.text(NAME).unwrap().to_owned();
        // People undo most of what they break.
        if undo.len() > 8 || (!undo.is_empty() && next(&mut state, 3) == 0) {
            workspace.open(NAME, undo.pop().unwrap());
        } else {
            let start = place(&text, &mut state);
            let end = (start + next(&mut state, 4)).min(text.len());
            let end = (end..=text.len()).find(|end| text.is_char_boundary(*end)).unwrap();
            let with = TYPED[next(&mut state, TYPED.len())];
            workspace.edit(NAME, start..end, with).unwrap();
            undo.push(text);
        }
        let now = reported(&workspace);
        if number % 100 == 99 {
            let mut fresh = Workspace::default();
            fresh.open(NAME, workspace.text(NAME).unwrap());
            assert_eq!(now, reported(&fresh), "after {number} edits");
        }
    }
    while let Some(text) = undo.pop() {
        workspace.open(NAME, text);
    }
    assert_eq!(workspace.text(NAME).unwrap(), car());
    let mut fresh = Workspace::default();
    fresh.open(NAME, car());
    assert_eq!(reported(&workspace), reported(&fresh));
}

#[test]
fn an_edit_needs_a_place_that_there_is() {
    let mut workspace = Workspace::default();
    workspace.open("./a.sense", "µ");
    assert!(workspace.edit("a.sense", 0..1, "").is_err());
    assert!(workspace.edit("a.sense", 1..5, "").is_err());
    assert!(workspace.edit("b.sense", 0..0, "").is_err());
    workspace.edit("a.sense", 0..2, "m").unwrap();
    assert_eq!(workspace.text("a.sense"), Some("m"));
    workspace.close("a.sense");
    assert_eq!(workspace.text("a.sense"), None);
}

/// Five devices, one of which is replaced by `broken`: the devices that are wired, the ones left
/// out, and the codes reported.
fn five(broken: &str) -> (Vec<String>, Vec<String>, Vec<&'static str>) {
    let text = format!(
        "board Robot on STM32F4DiscoveryBoard {{
            sensor One returns uint16 {{ id = 1; type = analog; }}
            {broken}
            sensor Three returns int32 {{ id = 3; type = encoder; }}
            sensor Four returns uint32 {{ id = 4; type = icu; }}
            actuator Five accepts bool {{ id = 5; type = digital; }}
        }}"
    );
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let snapshot = workspace.snapshot(NAME, On::default(), &NoFiles);
    let answer = snapshot.solve(&Ask { partly: true, ..Ask::default() });
    let names = |(design, wiring): (&sensedsl_model::design::Design, &_)| {
        let wiring: &sensedsl_wiring::assignment::Assignment = wiring;
        let devices = wiring.boards.iter().flat_map(|board| &board.devices);
        devices.map(|one| design.device(one.device).unwrap().name.value.clone()).collect()
    };
    let wired = answer.wired().map(names).unwrap_or_default();
    let left_out = answer.left_out.iter().map(|one| one.value.clone()).collect();
    (wired, left_out, answer.diagnostics.iter().map(|one| one.code.name()).collect())
}

#[test]
fn a_broken_device_leaves_the_others_their_wiring() {
    let rest = ["One", "Three", "Four", "Five"];
    for (broken, code) in [
        // Not understood at all.
        ("sensor Two returns uint16 { id = 2; type = analogue; }", "E0207"),
        ("sensor Two returns uint99 { id = 2; type = analog; }", "E0208"),
        ("sensor Two returns uint16 { id = 2; }", "E0206"),
        // Understood, but wrong.
        ("sensor Two returns uint16 { id = 2; type = analog; pin = PZ1; }", "E0310"),
        ("sensor Two returns uint16 { id = 1; type = analog; }", "E0203"),
        ("sensor Two returns uint16 { id = 2; type = i2c; driver = nobody; }", "E0216"),
        ("sensor Two returns uint16 { id = 2 type = analog; }", "E0104"),
        // No pin can serve it.
        ("sensor Two returns uint16 { id = 2; type = analog; pin = PB5; }", "E0314"),
        ("sensor Two returns uint16 { id = 2; type = analog; unit = ADC9; }", "E0311"),
    ] {
        let (wired, left_out, reported) = five(broken);
        assert!(reported.contains(&code), "{broken}: {reported:?}");
        assert_eq!(wired, rest, "{broken}: {reported:?}");
        assert_eq!(left_out, ["Two"], "{broken}");
    }
}

#[test]
fn a_conflict_among_the_others_is_still_found() {
    let broken = "sensor Two returns uint16 { id = 2; type = analogue; }
        sensor Six returns uint16 { id = 6; type = analog; pin = PA1; }
        sensor Seven returns uint16 { id = 7; type = analog; pin = PA1; }";
    let (wired, left_out, reported) = five(broken);
    assert_eq!((wired.len(), left_out), (0, vec!["Two".to_owned()]));
    assert!(reported.contains(&"E0207") && reported.contains(&"E0401"), "{reported:?}");
}

#[test]
fn a_design_with_mistakes_is_not_wired_unasked() {
    let mut workspace = Workspace::default();
    workspace
        .open(NAME, "board B on STM32F4DiscoveryBoard { sensor A returns uint16 { id = 1; } }");
    let snapshot = workspace.snapshot(NAME, On::default(), &NoFiles);
    assert!(snapshot.design().is_none());
    assert_eq!(snapshot.sound().unwrap().left_out[0].value, "A");
    assert_eq!(snapshot.trees().len(), 1);
    assert!(snapshot.solve(&Ask::default()).wired().is_none());
}

#[test]
fn a_missing_board_takes_with_it_what_may_belong_on_it() {
    let text = "board A on Nowhere { sensor One returns uint16 { id = 1; type = analog; } }
        board B on STM32F4DiscoveryBoard { sensor Two returns uint16 { id = 2; type = analog; } }
        sensor Three returns uint16 { id = 3; type = analog; }";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let snapshot = workspace.snapshot(NAME, On::default(), &NoFiles);
    let sound = snapshot.sound().unwrap();
    let names: Vec<&str> = sound.left_out.iter().map(|one| one.value.as_str()).collect();
    assert_eq!(names, ["A", "One", "Three"]);
    let answer = snapshot.solve(&Ask { partly: true, ..Ask::default() });
    let (design, wiring) = answer.wired().unwrap();
    assert_eq!(design.boards[wiring.boards[0].board.0].name.value, "B");
}

#[test]
fn open_texts_win_over_files() {
    struct Stored;
    impl Files for Stored {
        fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
            match wanted.path {
                "robot.sense" => {
                    Ok("use \"legs.sense\";\nboard B on STM32F4DiscoveryBoard {}".into())
                }
                "legs.sense" => Ok("sensor Leg returns uint16 { id = 1; }".into()),
                _ => Err(ReadError::Missing),
            }
        }
    }
    let mut workspace = Workspace::default();
    let codes = |workspace: &Workspace| -> Vec<&'static str> {
        let snapshot = workspace.snapshot(NAME, On::default(), &Stored);
        snapshot.diagnostics().iter().map(|one| one.code.name()).collect()
    };
    assert_eq!(codes(&workspace), ["E0206"]);
    workspace.open("legs.sense", "sensor Leg returns uint16 { id = 1; type = analog; }");
    assert_eq!(codes(&workspace), [""; 0]);
    workspace.close("legs.sense");
    assert_eq!(codes(&workspace), ["E0206"]);
    let missing = workspace.snapshot("gone.sense", On::default(), &Stored);
    assert_eq!(missing.diagnostics()[0].code.name(), "E0111");
}
