//! Devices that say nothing, through the command that a user runs: an image that was built for another file than the one
//! it is judged by must not agree with it.

use sensedsl_tests::{Scratch, is_thorough, root, sensedsl};

use super::trial::System;

/// Judges an image of one text by another one; what the command says, and where.
pub(super) fn judged(system: System, name: &str, built: &str, text: &str) -> Option<(i32, String)> {
    let image = system.image(name, built)?;
    let scratch = Scratch::new(name);
    let image = scratch.write("image.elf", &*image).display().to_string();
    let file = scratch.write("board.sense", text).display().to_string();
    let call = ["simulate", &file, "--firmware", &image, "--judge", "--seconds", "6"];
    let target = system.target().map(|target| ["--target", target]);
    let ran = sensedsl(call).args(target.iter().flatten()).run();
    Some((ran.status, format!("{}\n{}", ran.stdout, ran.stderr)))
}

fn of_both(name: &str, built: &str, text: &str, expected: &[&str]) {
    if !is_thorough() {
        return;
    }
    for system in [System::Chibios, System::Embassy] {
        let name = format!("{name}_{system:?}");
        let Some((status, said)) = judged(system, &name, built, text) else { continue };
        assert_eq!(status, 1, "{name}: {said}");
        for words in expected {
            assert!(said.contains(words), "{name} does not say {words}: {said}");
        }
        // What it was built for, it does.
        let (status, said) = judged(system, &name, built, built).unwrap();
        assert_eq!(status, 0, "{name}: {said}");
    }
}

#[test]
fn a_sensor_at_another_address() {
    let fig2 = std::fs::read_to_string(root().join("examples/fig2.sense")).unwrap();
    let fig2 = fig2.replacen("board STM32F4DiscoveryBoard", "board STM32F407G_DISC1", 1);
    assert!(fig2.contains("0xE6"));
    let other = fig2.replacen("0xE6", "0xE4", 1);
    of_both("silent_sonar", &other, &fig2, &["error[E0549]: `USRear`", "not acknowledged"]);
}

/// Three channels of a radio, on other pins than they are plugged into.
#[test]
fn channels_of_a_radio() {
    let radio = |pins: [&str; 3]| {
        let channels: String = pins
            .iter()
            .zip(1..)
            .map(|(pin, id)| {
                format!("    sensor Channel{id} returns uint16 {{ id = {id}; type = icu; mode = width; pin = {pin}; }}\n")
            })
            .collect();
        format!("board STM32F407G_DISC1 {{\n{channels}}}\n")
    };
    let (right, other) = (radio(["PE5", "PE9", "PB4"]), radio(["PC6", "PA15", "PD12"]));
    of_both("silent_radio", &other, &right, &["error[E0549]: `Channel", "never read"]);
}
