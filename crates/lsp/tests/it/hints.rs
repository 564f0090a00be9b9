//! Hints, lenses and what is said of words.

use serde_json::{Value, json};

use crate::session::{FILE, Session, unmarked};

const ROBOT: &str = "const CYCLE = 10 ms;
board B on STM32F407G_DISC1 {
    sensor Light returns uint16 { id = 1; type = analog; delay = 2 * CYCLE; pin = PA1; }
    sensor Far returns uint16 {
        id = 2;
        driver = srf08;
        address = 0xE6;
    }
}
";

fn session(at: &str, mark: &str) -> (Session, Value) {
    assert_eq!(ROBOT.matches(at).count(), 1, "{at}");
    let (mut session, mut places) = Session::of(&ROBOT.replace(at, mark));
    session.settle();
    assert_eq!(session.codes(), ["H0701"]);
    (session, places.remove(0))
}

fn hints(session: &mut Session) -> Vec<(u64, u64, String)> {
    let all =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let params = json!({ "textDocument": { "uri": FILE }, "range": all });
    let found = session.ask("textDocument/inlayHint", params);
    let place = |one: &Value, name: &str| one["position"][name].as_u64().unwrap();
    let hint = |one: &Value| {
        (place(one, "line"), place(one, "character"), one["label"].as_str().unwrap().to_owned())
    };
    found.as_array().unwrap().iter().map(hint).collect()
}

#[test]
fn pins_stand_behind_devices_and_values_behind_expressions() {
    let (mut session, _) = session("board B", "board B$0");
    let found = hints(&mut session);
    assert_eq!(found[0], (2, 74, "= 20 ms".to_owned()), "{found:?}");
    assert_eq!(found[1], (2, 88, "→ PA1".to_owned()), "{found:?}");
    assert_eq!((found[2].0, found[2].1), (3, 31), "{found:?}");
    assert!(found[2].2.starts_with("→ scl P") && found[2].2.contains("sda P"), "{found:?}");
    assert_eq!(found.len(), 3);
}

/// While one types there is no new wiring, and the old one stays.
#[test]
fn hints_outlive_a_mistake() {
    let (mut session, at) = session("type = analog", "type = analo$0g");
    let change = json!({ "range": { "start": at, "end": at }, "text": "#" });
    let file = json!({ "uri": FILE, "version": 2 });
    session.tell(
        "textDocument/didChange",
        json!({ "textDocument": file, "contentChanges": [change] }),
    );
    let found = hints(&mut session);
    assert_eq!(found.iter().filter(|one| one.2.starts_with('→')).count(), 2, "{found:?}");
}

fn said(at: &str, mark: &str) -> String {
    let (mut session, place) = session(at, mark);
    let hover = session.at("textDocument/hover", &place);
    hover["contents"]["value"].as_str().unwrap_or_default().to_owned()
}

#[test]
fn words_are_explained() {
    for (at, mark, wanted) in [
        (
            "sensor Light",
            "sensor Li$0ght",
            &["**Light**, analog of B, id 1", "| in | PA1 |"] as &[_],
        ),
        ("sensor Far", "sensor Far$0", &["| scl |", "costs least", "Other pins"]),
        ("= PA1", "= P$0A1", &["**PA1**", "taken by Light", "ADC"]),
        ("driver = srf08", "driver = srf$008", &["SRF08", "driver = srf08"]),
        ("type = analog", "type = $0analog", &["**analog**", "properties"]),
        ("const CYCLE", "const CYC$0LE", &["const CYCLE = 10 ms"]),
        ("0xE6", "0x$0E6", &["7-bit form 0x73"]),
        ("board B", "board B$0", &["2 devices, opportunity cost", "STM32F407"]),
        ("on STM32F407G_DISC1", "on STM32F4$007G_DISC1", &["MCU STM32F407VGT6"]),
    ] {
        let said = said(at, mark);
        for word in wanted {
            assert!(said.contains(word), "{mark}: {word} is not in\n{said}");
        }
    }
    assert_eq!(said("sensor Light", "sen$0sor Light"), "");
}

#[test]
fn lenses_tell_costs_and_their_commands_the_rest() {
    let (mut session, _) = session("board B", "board B$0");
    let lenses = session.whole("textDocument/codeLens");
    let titles: Vec<&str> = lenses
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["command"]["title"].as_str().unwrap())
        .collect();
    assert!(
        titles[0].starts_with("2 devices, cost ") && titles[0].ends_with("optimal"),
        "{titles:?}"
    );
    assert_eq!(titles.len(), 4, "{titles:?}");
    for (lens, wanted) in [(1, "analog"), (2, "PA1"), (3, "scl")] {
        let command = &lenses[lens]["command"];
        let params = json!({ "command": command["command"], "arguments": command["arguments"] });
        let text = session.ask("workspace/executeCommand", params);
        assert!(text.as_str().unwrap().contains(wanted), "{text}");
    }
    let params = json!({ "command": "sensedsl.nothing", "arguments": [FILE, "B"] });
    assert!(session.response("workspace/executeCommand", params).response_result.is_err());
}

#[test]
fn what_was_marked_is_the_text() {
    assert_eq!(
        unmarked("a$0b$0").1,
        [json!({ "line": 0, "character": 1 }), json!({ "line": 0, "character": 2 })]
    );
}
