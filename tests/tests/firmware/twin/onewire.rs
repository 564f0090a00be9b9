//! Parts on one wire: the image reads what the world has, below zero as well; a part that is missing, that answers late
//! or whose checksum is wrong is a fault with a name, never a value, and the others go on.

use sensedsl_wire::{Causes, Health};

use super::trial::{System, Trial, run};
use sensedsl_tests::{read, root};

/// How long the board runs, and when its health is asked for.
const SECONDS: u64 = 11;
const ASKED_MS: [u64; 2] = [2_900, 10_700];

/// The smallest design of the kind, on a board, with parts that share a wire.
fn design() -> String {
    let text = read(&root().join("tests/firmware/kinds/onewire.sense"));
    let head = "board STM32F407G_DISC1 {\n    link { transport = uart; unit = USART3; }";
    text.replacen("board BOARD {", head, 1)
}

const WORLD: &str = r#"
[devices]
Outside = { ramp = [-20.5, 5], over = "11 s" }
Cellar = -0.0625
Attic = -55.0
AirHumidity = 44.4
AirTemperature = -12.3

[[fault]]
kind = "no_answer"
device = "Outside"
at = "3500 ms"
for = "2 s"

[[fault]]
kind = "bad_checksum"
device = "Cellar"
at = "4500 ms"
for = "2 s"

[[fault]]
kind = "late"
device = "AirHumidity"
at = "4500 ms"
for = "2 s"
"#;

fn trial(system: System) -> Option<Trial> {
    let design = design();
    let image = system.image(&format!("onewire_{system:?}"), &design)?;
    Some(run(system, (&design, WORLD), &image, SECONDS, &ASKED_MS))
}

fn id(trial: &Trial, name: &str) -> u8 {
    *trial.names.iter().find(|(_, one)| *one == name).unwrap().0
}

fn causes(health: &Health, id: u8) -> Causes {
    health.devices.iter().find(|one| one.id == id).unwrap().causes
}

fn is_right(system: System) {
    let Some(trial) = trial(system) else { return };
    assert!(trial.wrong().is_empty(), "{:#?}", trial.wrong());
    assert!(trial.mismatches.is_empty(), "{:?}", trial.mismatches);
    assert!(trial.halt.is_none(), "{:?}", trial.halt);
    let [(_, before), (_, after)] = &trial.health[..] else { panic!("{:?}", trial.health) };
    for device in &before.devices {
        assert_eq!(device.causes, Causes::default(), "{}", device.id);
    }
    let of = |name: &str| causes(after, id(&trial, name));
    assert!(of("Outside").not_acknowledged > 0, "{:?}", of("Outside"));
    assert!(of("Cellar").wrong_checksum > 0, "{:?}", of("Cellar"));
    let late = of("AirTemperature");
    assert!(late.timed_out + late.not_acknowledged > 0, "{late:?}");
    // The part that shares the wire of another one goes on.
    assert_eq!(of("Attic"), Causes::default());
    for name in ["Outside", "Cellar", "Attic", "AirHumidity", "AirTemperature"] {
        let id = id(&trial, name);
        assert!(trial.reports_of(id, 0, 3_500) > 0, "{name} before");
        assert!(trial.reports_of(id, 8_000, 11_000) > 0, "{name} after");
    }
    // None reports anything while it is broken, once what was measured before has come.
    for (name, from_ms, to_ms) in
        [("Outside", 4_300, 5_500), ("Cellar", 5_300, 6_500), ("AirHumidity", 4_600, 6_500)]
    {
        assert_eq!(trial.reports_of(id(&trial, name), from_ms, to_ms), 0, "{name}");
    }
}

#[test]
fn on_chibios() {
    is_right(System::Chibios);
}

#[test]
fn on_embassy() {
    is_right(System::Embassy);
}
