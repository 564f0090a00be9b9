//! Serial lines with requests and answers, on all three boards: several servos on one wire, commands that are answered,
//! numbers that are sent as text. What a part has taken must be what the host has set for it.

use sensedsl_tests::{TempDir, is_thorough, sensedsl};

use super::silent::judged;
use super::trial::System;

const LINES: &str = include_str!("../../../firmware/designs/lines.sense");

/// An unplugged servo.
const UNPLUGGED: &str =
    "[[fault]]\ndevice = \"ElbowPosition\"\nkind = \"silent\"\nat = \"1 s\"\nfor = \"20 s\"\n";

/// Checks that each output was looked at.
fn assert_looked_at(name: &str, reported: &str) {
    assert!(reported.contains("looks at outputs found what the design says"), "{name}: {reported}");
    for output in ["ShoulderGoal", "ElbowGoal", "GripperTorque", "DriveMotor1", "Shown"] {
        let row = reported.lines().find(|line| line.trim_start().starts_with(output)).unwrap();
        let looks = row.split_whitespace().nth(2).unwrap();
        assert_ne!(looks, "0", "{name}: {row}");
    }
}

#[test]
fn the_soft_board_speaks_with_its_parts() {
    let scratch = TempDir::new("lines-soft");
    let file = scratch.write("lines.sense", LINES).display().to_string();
    let ran = sensedsl(["simulate", &file, "--judge"]).run().exits(0);
    assert_looked_at("soft board", &ran.stdout);
}

/// The health names the servo that does not answer, and the others go on.
#[test]
fn an_unplugged_servo_is_named() {
    let scratch = TempDir::new("lines-unplugged");
    let file = scratch.write("lines.sense", LINES).display().to_string();
    let world = scratch.write("world.toml", UNPLUGGED).display().to_string();
    let call = ["simulate", &file, "--world", &world, "--judge", "--health", "--seconds", "4"];
    let ran = sensedsl(call).run().exits(0);
    let row =
        |name: &str| ran.stdout.lines().find(|line| line.trim_start().starts_with(name)).unwrap();
    assert!(row("ElbowPosition").contains("failed"), "{}", ran.stdout);
    for name in ["ShoulderPosition", "GripperPosition", "DriveBattery"] {
        assert!(row(name).contains("good"), "{}", ran.stdout);
    }
}

#[test]
fn images_speak_with_their_parts() {
    if !is_thorough() {
        return;
    }
    for system in [System::Chibios, System::Embassy] {
        let name = format!("lines_{system:?}");
        let Some((status, reported)) = judged(system, &name, LINES, LINES) else { continue };
        assert_eq!(status, 0, "{name}: {reported}");
        assert_looked_at(&name, &reported);
    }
}

/// An image that moves the wrong servo must not agree with the design.
#[test]
fn a_command_to_another_servo_is_told() {
    if !is_thorough() {
        return;
    }
    let other = LINES.replacen("address = 2", "address = 4", 1);
    assert_ne!(other, LINES);
    for system in [System::Chibios, System::Embassy] {
        let name = format!("lines_other_{system:?}");
        let Some((status, reported)) = judged(system, &name, &other, LINES) else { continue };
        assert_eq!(status, 1, "{name}: {reported}");
        assert!(reported.contains("`Elbow"), "{name}: {reported}");
    }
}
