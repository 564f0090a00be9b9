//! Devices that stay silent, tested through the command that users run: an image that was built
//! from another file than the one it is judged by must not agree with it.

use sensedsl_tests::{TempDir, is_thorough, root, sensedsl};

use super::trial::System;

/// Judges an image built from one text by another text; returns the exit status and the output.
pub(super) fn judged(system: System, name: &str, built: &str, text: &str) -> Option<(i32, String)> {
    let image = system.image(name, built)?;
    let scratch = TempDir::new(name);
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
        let Some((status, reported)) = judged(system, &name, built, text) else { continue };
        assert_eq!(status, 1, "{name}: {reported}");
        for words in expected {
            assert!(reported.contains(words), "{name} does not say {words}: {reported}");
        }
        // The image agrees with the file that it was built from.
        let (status, reported) = judged(system, &name, built, built).unwrap();
        assert_eq!(status, 0, "{name}: {reported}");
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

/// Three channels of an RC receiver, on pins other than those it is plugged into.
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
