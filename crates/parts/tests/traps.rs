//! Pins that an MCU needs for itself are never given to a device, whatever the part.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test may panic, and asks the environment how much is wanted"
)]

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::silicon::pin_roles;
use sensedsl_model::{Files, Request, Unread, Wanted, resolve};
use sensedsl_wiring::{Solved, Wiring};

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &Wanted<'_>) -> Result<String, Unread> {
        Err(Unread::Missing)
    }
}

/// The pins of five digital outputs, or none where the part has not so many.
fn five_outputs(part: &str) -> Option<BTreeSet<PinName>> {
    let mut text = format!("board X on {part} {{\n");
    for id in 1..=5 {
        text.push_str(&format!("actuator D{id} accepts bool {{ id = {id}; type = digital; }}\n"));
    }
    text.push('}');
    let request = Request { path: "traps.sense", text: &text, board: None, target: Some("none") };
    let resolved = resolve(&request, &NoFiles);
    let design = resolved.design.unwrap_or_else(|| panic!("{part}: {:?}", resolved.diagnostics));
    match Wiring::new(&design, None).solve(&Default::default()) {
        Solved::Wired(assignment) => {
            let wires = assignment.boards[0].devices.iter().flat_map(|device| &device.wires);
            let pins = &design.boards[0].table.pins;
            Some(wires.map(|wire| pins[wire.pin].name.clone()).collect())
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(failure) => panic!("{part}: {}", failure.message),
    }
}

#[test]
fn outputs_are_on_pins_that_the_mcu_does_not_need() {
    // One part of each die and number of contacts.
    let parts: BTreeMap<&str, String> =
        sensedsl_parts::all().map(|part| (part.base(), part.name().replace('-', "_"))).collect();
    let (mut wired, mut short) = (0, Vec::new());
    let thorough = std::env::var("SENSEDSL_THOROUGH").as_deref() == Ok("1");
    for part in parts.values().step_by(if thorough { 1 } else { 5 }) {
        let roles = pin_roles(part);
        match five_outputs(part) {
            Some(pins) => {
                let bad: Vec<_> = pins.iter().filter(|pin| roles.contains_key(*pin)).collect();
                assert!(bad.is_empty(), "{part}: {bad:?}");
                wired += 1;
            }
            None => short.push(part.as_str()),
        }
    }
    assert!(wired > 60, "{wired} parts");
    assert!(short.len() <= 8, "no five outputs on {short:?}");
}
