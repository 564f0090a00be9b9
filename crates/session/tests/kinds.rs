//! Every kind of the registry is wired on a part with every peripheral, with all wires that it
//! names.
#![allow(missing_docs, reason = "tests need none")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

use sensedsl_model::NoFiles;
use sensedsl_model::kind::KindName;
use sensedsl_session::{Ask, Goal, On, Snapshot, Workspace};
use sensedsl_wire::Direction;
use sensedsl_wiring::{Cancel, capacity};

/// Most devices tried at the same time.
const MANY: u32 = 20;

/// A small board with something for every kind, with an analog sensor and this many devices of a
/// kind.
fn several(kind: KindName, count: u32) -> String {
    let head = match kind.spec().directions {
        [Direction::Actuator, ..] => "actuator D{} accepts",
        _ => "sensor D{} returns",
    };
    let devices = (1..=count).map(|id| {
        // Devices on one bus must differ in this.
        let example = kind.spec().example.replace("0x40", &format!("{}", 0x10 + id));
        let head = head.replace("{}", &id.to_string());
        format!("{head} uint16 {{ id = {id}; type = {kind}; {example} }}\n")
    });
    let devices: String = devices.collect();
    let first = "sensor First returns uint16 { id = 254; type = analog; }";
    format!("board B on STM32F303K8T6 {{\n{first}\n{devices}}}")
}

fn snapshot(text: &str) -> Snapshot {
    let mut workspace = Workspace::default();
    workspace.open("kind.sense", text);
    let on = On { board: None, target: Some("none") };
    workspace.snapshot("kind.sense", on, &NoFiles)
}

fn is_wired(text: &str) -> bool {
    let snapshot = snapshot(text);
    let answer = snapshot.solve(&Ask { goal: Goal::Any, ..Ask::default() });
    answer.wired().is_some()
}

/// A kind's statement about sharing its wires is true: as many devices fit as `capacity` promises.
#[test]
fn as_many_devices_fit_as_are_promised() {
    let snapshot = snapshot(&several(KindName::Analog, 0));
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = answer.wired().unwrap();
    let found = capacity(design, wiring, true, Cancel::NEVER).all;
    assert_eq!(found.len(), KindName::wired().count());
    for one in found {
        let (kind, more) = (one.kind, u32::try_from(one.more).unwrap());
        assert!(more > 0, "{kind}: take a part that has it");
        assert!(is_wired(&several(kind, more.min(MANY))), "{kind}: {more} are promised");
        if more < MANY {
            assert!(!is_wired(&several(kind, more + 1)), "{kind}: only {more} are promised");
        }
    }
}

#[test]
fn every_kind_is_wired() {
    for kind in KindName::ALL {
        let spec = kind.spec();
        for direction in spec.directions {
            let head = match direction {
                Direction::Sensor => "sensor D returns",
                Direction::Actuator => "actuator D accepts",
            };
            let text = format!(
                "board B on STM32F407VGT6 {{ {head} uint16 {{ id = 1; type = {kind}; {} }} }}",
                spec.example
            );
            for target in ["none", "chibios"] {
                let mut workspace = Workspace::default();
                workspace.open("kind.sense", text.as_str());
                let on = On { board: None, target: Some(target) };
                let snapshot = workspace.snapshot("kind.sense", on, &NoFiles);
                let answer = snapshot.solve(&Ask::default());
                let Some((design, wiring)) = answer.wired() else {
                    panic!("{text} for {target}: {:#?}", answer.diagnostics)
                };
                let wires = wiring.boards.iter().flat_map(|board| &board.devices);
                let wires: Vec<_> = wires.flat_map(|one| &one.wires).map(|one| one.role).collect();
                let device = design.devices.first().unwrap();
                assert_eq!(wires, device.kind.roles(*direction), "{text}");
            }
        }
    }
}
