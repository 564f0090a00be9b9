//! Pins that an MCU needs for itself are never given to a device, whatever the part or the board,
//! and pins that something else is on are used only if no others are left.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::profile;
use sensedsl_board::silicon::{PinRole, pin_roles};
use sensedsl_board::table::Role;
use sensedsl_model::design::Transport;
use sensedsl_wiring::{Solved, Wiring};

use super::designs;

/// The pins of five digital outputs on a part or a board, or `None` if it does not have so many;
/// and the pins that nothing else is on.
fn five_outputs(on: &str, target: Option<&str>) -> (Option<BTreeSet<PinName>>, BTreeSet<PinName>) {
    let mut text = format!("board X on {on} {{\n");
    for id in 1..=5 {
        text.push_str(&format!("actuator D{id} accepts bool {{ id = {id}; type = digital; }}\n"));
    }
    text.push('}');
    let design = designs::of_text(&text, target);
    let table = &design.boards[0].table;
    let mcu = design.boards[0].mcu.as_deref().unwrap_or_default();
    // A board's table shows where crystals are.
    let tells = table.columns.iter().any(|column| column.role == Role::Onboard);
    let held = if tells { needed(mcu) } else { pin_roles(mcu).into_keys().collect() };
    let clean = table.pins.iter();
    let clean = clean.filter(|pin| pin.onboard.is_none() && !held.contains(&pin.name));
    let clean = clean.filter(|pin| !table.is_off_connectors(pin));
    let link = &design.boards[0].link;
    let usb = design.boards[0].profile().filter(|_| link.transport == Transport::Usb);
    let of_link = usb.map_or(&[][..], |profile| profile.link_pins(profile::Transport::Usb, None));
    let clean = clean.filter(|pin| !of_link.contains(&pin.name));
    let clean = clean.map(|pin| pin.name.clone()).collect();
    let pins = match Wiring::new(&design, None).solve(&Default::default()) {
        Solved::Wired(assignment) => {
            let wires = assignment.boards[0].devices.iter().flat_map(|device| &device.wires);
            let pins = &design.boards[0].table.pins;
            Some(wires.map(|wire| pins[wire.pin].name.clone()).collect())
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(failure) => panic!("{on}: {}", failure.message),
    };
    (pins, clean)
}

#[test]
fn outputs_are_on_pins_that_the_mcu_does_not_need() {
    // One part for each die and number of contacts.
    let parts: BTreeMap<&str, String> =
        sensedsl_parts::all().map(|part| (part.base(), part.name().replace('-', "_"))).collect();
    let (mut wired, mut short) = (0, Vec::new());
    for part in parts.values().step_by(crate::step(16)) {
        let needed: BTreeSet<PinName> = needed(part);
        match five_outputs(part, Some("none")) {
            (Some(pins), clean) => {
                let bad: Vec<_> = pins.intersection(&needed).collect();
                assert!(bad.is_empty(), "{part}: {bad:?}");
                assert_eq!(pins.difference(&clean).count(), 5_usize.saturating_sub(clean.len()));
                wired += 1;
            }
            (None, _) => short.push(part.as_str()),
        }
    }
    assert!(wired > 60, "{wired} parts");
    assert!(short.len() <= 8, "no five outputs on {short:?}");
}

/// The pins that an MCU cannot do without.
fn needed(mcu: &str) -> BTreeSet<PinName> {
    let roles = pin_roles(mcu).into_iter();
    roles.filter(|(_, role)| *role != PinRole::Oscillator).map(|(pin, _)| pin).collect()
}

#[test]
fn outputs_are_on_clean_pins_of_boards() {
    let (mut wired, mut short) = (0, Vec::new());
    for board in sensedsl_board::catalog::all() {
        let name = board.name.replace('-', "_");
        for target in [None, Some("none")] {
            match five_outputs(&name, target) {
                (Some(pins), clean) => {
                    let bad: Vec<_> = pins.difference(&clean).collect();
                    let free = clean.len();
                    assert!(bad.len() <= 5_usize.saturating_sub(free), "{name}: {free}, {bad:?}");
                    wired += 1;
                }
                (None, clean) => short.push((name.clone(), clean.len())),
            }
        }
    }
    assert!(wired > 150, "{wired} wirings");
    assert!(short.is_empty(), "no five outputs on {short:?}");
}
