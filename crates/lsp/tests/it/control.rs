//! Completion in controllers and tests.

use serde_json::Value;

use crate::completion::{able, labels, list, taken};

const ROBOT: &str = "const REACTION = 150 ms;
board Robot on NUCLEO_F446RE {
    sensor Front returns uint16 { type = analog; quantity = cm; }
    sensor Error returns float32 { type = code; }
    actuator Gain accepts float32 { type = code; }
    actuator Left accepts uint16 { type = pwm; }
    controller Follow every 10 ms { reads = [Front]; sets = [Left, Error]; }
}
";

/// What is offered at the mark, in a block beside the robot's.
fn beside(block: &str) -> Vec<Value> {
    offered(&format!("{ROBOT}{block}"))
}

/// What is offered at the mark, where it stands in the controller.
fn in_controller(body: &str) -> Vec<Value> {
    offered(&ROBOT.replace("reads = [Front]; sets = [Left, Error];", body))
}

fn offered(marked: &str) -> Vec<Value> {
    list(&mut able(), marked)["items"].as_array().unwrap().clone()
}

#[test]
fn a_controller_is_begun_and_has_its_properties() {
    let marked = "board B on NUCLEO_F446RE {\n    contr$0\n}";
    let items = offered(marked);
    let item = items.iter().find(|item| item["label"] == "controller").unwrap();
    assert!(taken(marked, item).contains("controller Name every 10 ms {"), "{item}");
    let items = in_controller("$0");
    for name in ["reads", "sets", "takes", "host", "prio", "id", "label", "allow"] {
        assert!(labels(&items).contains(&name), "{name}: {:?}", labels(&items));
    }
    assert_eq!(labels(&in_controller("host = $0;")), ["refused", "override", "REACTION"]);
    assert!(labels(&in_controller("takes = 200 $0;")).contains(&"us"));
    assert_eq!(labels(&offered("board B { controller C $0 }")), ["every"]);
    assert!(labels(&offered("board B { controller C every 5 $0 }")).contains(&"ms"));
}

#[test]
fn a_controller_names_what_it_can_read_and_set() {
    let without_constants = |body: &str| {
        let items = in_controller(body);
        let mut names: Vec<String> = labels(&items).iter().map(|one| (*one).to_owned()).collect();
        names.retain(|name| name != "REACTION");
        names.sort();
        names
    };
    assert_eq!(without_constants("reads = [$0]; sets = [];"), ["Error", "Front", "Gain", "Left"]);
    assert_eq!(without_constants("reads = [Front, $0]; sets = [];"), ["Error", "Gain", "Left"]);
    // The host sets parameters, and no code makes what is measured.
    assert_eq!(without_constants("sets = [$0];"), ["Error", "Left"]);
}

#[test]
fn a_test_has_properties_and_steps() {
    let items = beside("test T {\n    $0\n}");
    for name in ["for", "world", "seed", "at", "fault", "always", "never", "eventually", "when"] {
        assert!(labels(&items).contains(&name), "{name}: {:?}", labels(&items));
    }
    assert!(!labels(&items).contains(&"sensor"));
}

#[test]
fn steps_go_on_word_by_word() {
    let all = [
        ("at 1 $0", "s"),
        ("at 1 s $0", "set"),
        ("at 1 s set $0", "Left"),
        ("at 1 s set Left = 50 $0", "%"),
        ("fault $0", "no_answer"),
        ("fault torn $0", "of"),
        ("fault torn of $0", "Front"),
        ("fault torn of Front $0", "at"),
        ("fault torn of Front at 2 s $0", "for"),
        ("always $0", "Front"),
        ("always $0", "rising"),
        ("always Front < 20 $0", "cm"),
        ("always Front $0", "and"),
        ("always Front < 20 cm and $0", "Left"),
        ("always Front < 20 cm $0", "from"),
        ("eventually Front < 20 cm $0", "within"),
        ("when Front < 20 cm $0", "then"),
        ("when Front < 20 cm then Left == 0 $0", "within"),
        ("when Front < 20 cm then Left == 0 within $0", "REACTION"),
        ("never Follow.$0", "Follow.overruns"),
        ("always health(Front) == $0", "good"),
    ];
    for (step, wanted) in all {
        let items = beside(&format!("test T {{\n    for = 10 s;\n    {step};\n}}"));
        assert!(labels(&items).contains(&wanted), "{step}: {:?}", labels(&items));
    }
    // `always` has no `within`, and the host sets no sensor.
    let items = beside("test T { always Front < 20 cm $0; }");
    assert!(!labels(&items).contains(&"within"));
    let items = beside("test T { at 1 s set $0; }");
    assert!(!labels(&items).contains(&"Front"));
}
