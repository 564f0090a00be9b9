//! Every kind of the registry is wired on a part that has everything, with all wires that it names.
#![allow(missing_docs, reason = "tests need none")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

use sensedsl_model::kind::KindName;
use sensedsl_model::{Files, Unread, Wanted};
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_wire::Direction;

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &Wanted<'_>) -> Result<String, Unread> {
        Err(Unread::Missing)
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
