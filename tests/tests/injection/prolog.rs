//! SWI-Prolog runs a program whose devices have the names of its own predicates.

use std::fmt::Write as _;

use sensedsl_tests::{TempDir, has, sensedsl};

use crate::prolog::by_swipl;

#[test]
fn prolog_finds_the_same_cost_whatever_devices_are_called() {
    if !has("swipl") {
        return;
    }
    let scratch = TempDir::new("prolog");
    let words = ["Self_", "dynamic", "discontiguous", "halt", "is", "rem", "fail", "module"];
    let mut design = String::from("board once on STM32F4DiscoveryBoard {\n");
    for (at, word) in words.iter().enumerate() {
        let id = at + 1;
        writeln!(
            design,
            "    sensor {word} returns uint16 {{ id = {id}; type = i2c; address = {}; }}",
            id + 8
        )
        .unwrap();
    }
    let source = scratch.write("words.sense", design + "}\n");
    let program = sensedsl(["solve", "--format", "prolog"]).arg(&source).run().exits(0).stdout;
    let program = scratch.write("wiring.pl", program);
    let reported = by_swipl(&program);
    let answer = sensedsl(["solve", "--format", "json"]).arg(&source).run().exits(0).json();
    let cost = answer["cost"].to_string();
    assert!(reported.split(|c: char| !c.is_ascii_digit()).any(|word| word == cost), "{reported}");
    assert!(reported.contains("halt") && reported.contains("Self_"), "{reported}");
}
