//! Whole boards: all examples, without a world and in the worlds that come with them.

use std::fs;

use crate::run::plainly;

fn example(name: &str) -> String {
    let path = format!("{}/../../examples/{name}.sense", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(path).unwrap()
}

#[test]
fn every_sensor_of_every_example_reports_what_the_world_does() {
    let names =
        ["fig2", "miniature_car", "line_follower", "quadcopter", "arm", "greenhouse", "rover"];
    for name in names.into_iter().step_by(crate::step(3)) {
        let run = plainly(&example(name), "", 5);
        let wrong = run.wrong();
        assert!(wrong.is_empty(), "{name}: {wrong:#?}");
        for one in &run.judged {
            // A value that comes once a minute has come at most twice.
            assert!(one.reports > 0, "{name}: {} reported nothing", one.name);
        }
        assert_eq!(run.dropped, 0, "{name}");
    }
}

/// Without a world, contacts do not change faster than their debounce time.
#[test]
fn contacts_last_as_long_as_they_must() {
    let contacts: String = (1..=11_u16)
        .map(|id| {
            let edge = ["edge = rising;", "edge = both;", ""][usize::from(id % 3)];
            let scalar = if edge.is_empty() { "bool" } else { "uint32" };
            let debounce = u32::from(id) * 30;
            format!(
                "sensor C{id} returns {scalar} {{ id = {id}; type = digital; {edge} debounce = {debounce} ms; delay = 50 ms; }}\n"
            )
        })
        .collect();
    let run = plainly(&format!("board STM32F407G_DISC1 {{ {contacts} }}"), "", 30);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    for one in &run.judged {
        assert!(one.reports > 50 && one.excused < one.reports / 2, "{}: {one:?}", one.name);
    }
}

#[test]
fn a_run_is_the_same_to_the_byte() {
    let text = example("miniature_car");
    let world =
        "seed = 3\n[devices]\nIRRear = { sine = 5, offset = 15, period = \"2 s\", noise = 1 }\n";
    let runs = [(); 2].map(|()| plainly(&text, world, 3).bytes);
    assert_eq!(runs[0], runs[1]);
    assert!(runs[0].len() > 1_000);
}

#[test]
fn the_worlds_of_the_examples_are_kept() {
    for (name, world) in [
        ("fig2", "fig2"),
        ("miniature_car", "car"),
        ("line_follower", "line_follower"),
        ("quadcopter", "quadcopter"),
    ] {
        let path = format!("{}/../../examples/worlds/{world}.toml", env!("CARGO_MANIFEST_DIR"));
        let run = plainly(&example(name), &fs::read_to_string(path).unwrap(), 7);
        assert!(run.wrong().is_empty(), "{name}: {:#?}", run.wrong());
    }
}
