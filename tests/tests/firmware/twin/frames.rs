//! CAN as vehicles use it, on all three boards: 29-bit identifiers, bits across bytes in both
//! orders, multiplexed contents, repeated frames. The soft board and both images must agree with
//! the judge's own reading of the design.

use sensedsl_tests::{TempDir, is_thorough, sensedsl};

use super::silent::judged;
use super::trial::System;

const FRAMES: &str = include_str!("../../../firmware/designs/frames.sense");

/// Checks the report on an image or on the soft board, in which each output must have been checked.
fn assert_looked_at(name: &str, reported: &str) {
    assert!(reported.contains("looks at outputs found what the design says"), "{name}: {reported}");
    for output in ["Rpm", "Mode", "Gain", "Both"] {
        let row = reported.lines().find(|line| line.trim_start().starts_with(output)).unwrap();
        let looks = row.split_whitespace().nth(2).unwrap();
        assert_ne!(looks, "0", "{name}: {row}");
    }
}

/// `Both` is in two contents of its frame; one of them is sent when it is set.
#[test]
fn the_soft_board_sends_them() {
    let scratch = TempDir::new("frames-soft");
    let file = scratch.write("frames.sense", FRAMES).display().to_string();
    let ran = sensedsl(["simulate", &file, "--judge"]).run().exits(0);
    assert_looked_at("soft board", &ran.stdout);
}

#[test]
fn images_send_them() {
    if !is_thorough() {
        return;
    }
    for system in [System::Chibios, System::Embassy] {
        let name = format!("frames_{system:?}");
        let Some((status, reported)) = judged(system, &name, FRAMES, FRAMES) else { continue };
        assert_eq!(status, 0, "{name}: {reported}");
        assert_looked_at(&name, &reported);
    }
}

/// The selector of contents is checked separately: an image that puts it elsewhere in the frame is
/// wrong.
#[test]
fn a_selector_at_another_place_is_told() {
    if !is_thorough() {
        return;
    }
    let elsewhere = FRAMES.replacen(
        "little; bit = 0; bits = 3; length = 8; }\n    actuator Gain",
        "little; bit = 4; bits = 3; length = 8; }\n    actuator Gain",
        1,
    );
    assert_ne!(elsewhere, FRAMES);
    let Some((status, reported)) = judged(System::Embassy, "frames_elsewhere", &elsewhere, FRAMES)
    else {
        return;
    };
    assert_eq!(status, 1, "{reported}");
    assert!(reported.contains("error[E0552]: `Mode`"), "{reported}");
}
