//! Names: where they are described and used, and how they change.

use serde_json::{Value, json};

use crate::session::{FILE, Session, Stored, edited, unmarked};

const ROBOT: &str = "const CYCLE = 10 ms;
driver mine for i2c {
    address = 0x70; length = 2; register = 2;
    reading Distance returns uint16 { register = 4; length = 2; }
    reading Light returns uint8 { register = 1; length = 1; }
}
board B on STM32F4DiscoveryBoard {
    chip Eye {
        driver = mine; delay = 2 * CYCLE;
        sensor Distance returns uint16 { id = 1; }
        sensor Dark returns uint8 { id = 2; reading = Light; }
    }
    sensor Line returns uint16 { id = 3; type = analog; delay = CYCLE; }
}
";

/// The first line and column of each place of an answer.
fn places(answer: &Value) -> Vec<(u64, u64)> {
    let at = |one: &Value| {
        let start = &one["range"]["start"];
        (start["line"].as_u64().unwrap(), start["character"].as_u64().unwrap())
    };
    answer.as_array().unwrap().iter().map(at).collect()
}

fn marked(at: &str, mark: &str) -> (Session, Value) {
    assert_eq!(ROBOT.matches(at).count(), 1, "{at}");
    let (session, mut places) = Session::of(&ROBOT.replace(at, mark));
    (session, places.remove(0))
}

#[test]
fn a_name_leads_to_what_it_names() {
    for (at, mark, wanted) in [
        ("2 * CYCLE", "2 * CY$0CLE", (0, 6)),
        ("driver = mine", "driver = mine$0", (1, 7)),
        ("reading = Light", "reading = $0Light", (4, 12)),
        ("chip Eye", "chip E$0ye", (7, 9)),
    ] {
        let (mut session, place) = marked(at, mark);
        assert_eq!(places(&session.at("textDocument/definition", &place)), [wanted], "{at}");
    }
    let (mut session, place) = marked("type = analog", "type = an$0alog");
    assert_eq!(session.at("textDocument/definition", &place), json!([]));
}

#[test]
fn all_uses_are_found() {
    let (mut session, place) = marked("const CYCLE", "const $0CYCLE");
    let mut ask = |with: bool| {
        let params = json!({
            "textDocument": { "uri": FILE }, "position": place,
            "context": { "includeDeclaration": with },
        });
        places(&session.ask("textDocument/references", params)).len()
    };
    assert_eq!((ask(true), ask(false)), (3, 2));
    assert_eq!(session.at("textDocument/documentHighlight", &place).as_array().unwrap().len(), 3);
}

#[test]
fn the_file_that_is_used_is_a_definition_too() {
    let stored = Stored([("/robot/legs.sense".to_owned(), "const N = 1;".to_owned())].into());
    let mut session = Session::with(stored, &json!({}));
    let at =
        session.open(FILE, "use \"le$0gs.sense\"; board B on STM32F4DiscoveryBoard {}").remove(0);
    let found = session.at("textDocument/definition", &at);
    assert_eq!(found[0]["uri"], "file:///robot/legs.sense");
}

fn rename(session: &mut Session, place: &Value, new: &str) -> Result<Value, String> {
    let params = json!({ "textDocument": { "uri": FILE }, "position": place, "newName": new });
    session.response("textDocument/rename", params).response_result.map_err(|error| error.message)
}

#[test]
fn a_new_name_reaches_all_places_and_changes_nothing_else() {
    let (mut session, place) = marked("const CYCLE", "const CYC$0LE");
    let changes = rename(&mut session, &place, "Turn").unwrap();
    let text = edited(ROBOT, &changes["changes"][FILE]);
    assert_eq!(text, ROBOT.replace("CYCLE", "Turn"));
}

/// What a device of a chip showed because of its name it still shows.
#[test]
fn what_a_name_said_alone_is_said_in_words() {
    let (mut session, place) = marked("sensor Distance", "sensor Dist$0ance");
    let changes = rename(&mut session, &place, "Ahead").unwrap();
    let text = edited(ROBOT, &changes["changes"][FILE]);
    assert!(text.contains("sensor Ahead returns uint16 { id = 1; reading = Distance; }"), "{text}");
    let (mut session, place) = marked("reading Distance", "reading Dist$0ance");
    let changes = rename(&mut session, &place, "range").unwrap();
    let text = edited(ROBOT, &changes["changes"][FILE]);
    assert!(text.contains("reading range returns"), "{text}");
    assert!(text.contains("sensor Distance returns uint16 { id = 1; reading = range; }"), "{text}");
}

#[test]
fn a_name_that_would_be_a_mistake_is_refused() {
    let (mut session, place) = marked("sensor Line", "sensor Li$0ne");
    for (new, why) in [
        ("9x", "not a valid name"),
        ("a-b", "not a valid name"),
        ("", "not a valid name"),
        ("Dark", "Dark"),
    ] {
        let refused = rename(&mut session, &place, new).unwrap_err();
        assert!(refused.contains(why), "{new}: {refused}");
    }
    let (mut session, place) = marked("type = analog", "type = an$0alog");
    assert!(
        rename(&mut session, &place, "other").unwrap_err().contains("nothing here can be renamed")
    );
    let (text, places) = unmarked(
        "board B on STM32F4DiscoveryBoard { sensor Far returns uint16 { id = 1; driver = srf$008; } }",
    );
    let (mut session, _) = Session::of(&text);
    assert!(rename(&mut session, &places[0], "mine").unwrap_err().contains("built in"));
}
