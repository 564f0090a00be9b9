//! SWI-Prolog runs a program whose devices have the names of its own predicates.

use std::fmt::Write as _;
use std::process::Command;

use sensedsl_tests::{Scratch, has, sensedsl};

use super::corpus::WORDS;

#[test]
fn prolog_finds_the_same_cost_whatever_devices_are_called() {
    if !has("swipl") {
        return;
    }
    let scratch = Scratch::new("prolog");
    let words = WORDS.iter().filter(|word| {
        matches!(
            **word,
            "dynamic" | "discontiguous" | "halt" | "is" | "rem" | "fail" | "module" | "Self_"
        )
    });
    let mut design = String::from("board once on STM32F4DiscoveryBoard {\n");
    for (at, word) in words.enumerate() {
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
    let output = Command::new("swipl")
        .args(["-q", "-g", "main", "-t", "halt"])
        .arg(program)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let answer = sensedsl(["solve", "--format", "json"]).arg(&source).run().exits(0).json();
    let cost = answer["cost"].to_string();
    assert!(said.split(|c: char| !c.is_ascii_digit()).any(|word| word == cost), "{said}");
    assert!(said.contains("halt") && said.contains("Self_"), "{said}");
}
