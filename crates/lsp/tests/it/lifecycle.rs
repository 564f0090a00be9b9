//! From `initialize` to `exit`, and diagnostics that follow the text.

use sensedsl_session::Patience;
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

use crate::session::{FILE, Session, Stored, unmarked};

const GOOD: &str = "board B on STM32F4DiscoveryBoard {\n    sensor Light returns uint16 { id = 1; type = analog; }\n}\n";

#[test]
fn a_session_begins_and_ends_as_the_protocol_says() {
    let mut session = Session::new();
    assert_eq!(session.server.exited(), None);
    session.ask("shutdown", Value::Null);
    let refused = session.response("textDocument/hover", json!({}));
    assert!(refused.response_result.is_err());
    session.tell("exit", Value::Null);
    assert_eq!(session.server.exited(), Some(true));
    let mut hasty = Session::new();
    hasty.tell("exit", Value::Null);
    assert_eq!(hasty.server.exited(), Some(false));
}

#[test]
fn diagnostics_follow_the_text() {
    let mut session = Session::new();
    session.open(FILE, GOOD);
    session.settle();
    assert_eq!(session.told[FILE], Vec::<Value>::new());
    let at = unmarked(&GOOD.replace("analog", "anal$0og")).1.remove(0);
    let change = json!({ "range": { "start": at, "end": at }, "text": "ue" });
    let file = json!({ "uri": FILE, "version": 2 });
    session.tell(
        "textDocument/didChange",
        json!({ "textDocument": file, "contentChanges": [change] }),
    );
    session.settle();
    assert_eq!(session.codes(), ["E0207"]);
    assert_eq!(session.told[FILE][0]["range"]["start"]["line"], 1);
    session.tell("textDocument/didClose", json!({ "textDocument": { "uri": FILE } }));
    session.settle();
    assert_eq!(session.told[FILE], Vec::<Value>::new());
}

#[test]
fn a_mistake_is_told_in_the_file_that_has_it() {
    let legs = "file:///robot/legs.sense";
    let stored = "sensor Leg returns uint16 { id = 1; type = analogue; }".to_owned();
    let stored = Stored([("/robot/legs.sense".to_owned(), stored)].into());
    let mut session = Session::with(stored, &json!({}));
    session.open(FILE, "use \"legs.sense\";\nboard B on STM32F4DiscoveryBoard {}\n");
    session.settle();
    assert_eq!(session.codes(), Vec::<&str>::new());
    assert_eq!(session.told[legs][0]["code"], "E0207");
    // What is open counts, and is read as a part of the design that uses it: it needs no board.
    session.open(legs, "sensor Leg returns uint16 { id = 1; type = analog; }");
    session.settle();
    assert_eq!((session.told[legs].len(), session.codes().len()), (0, 0), "{:?}", session.told);
}

#[test]
fn a_new_wiring_is_drawn_again_where_the_client_can() {
    let refresh = json!({ "refreshSupport": true });
    let capabilities = json!({ "workspace": { "inlayHint": refresh, "codeLens": refresh } });
    let mut session = Session::with(Stored::default(), &capabilities);
    session.open(FILE, GOOD);
    assert_eq!(session.settle(), ["workspace/inlayHint/refresh", "workspace/codeLens/refresh"]);
    assert_eq!(session.settle(), Vec::<String>::new());
}

#[test]
fn what_is_no_message_of_the_protocol_is_refused() {
    let mut session = Session::new();
    session.open(FILE, GOOD);
    for (method, params) in [
        ("textDocument/rangeFormatting", json!({ "textDocument": { "uri": FILE } })),
        ("textDocument/formatting", json!({})),
        ("textDocument/formatting", json!(7)),
        ("no/such", json!({})),
    ] {
        let response = session.response(method, params);
        assert!(response.response_result.is_err(), "{method}");
    }
    let missing = session
        .ask("textDocument/foldingRange", json!({ "textDocument": { "uri": "file:///no" } }));
    assert_eq!(missing, Value::Null);
}

/// Somebody who types stops the search, and nothing is told; who only waits long is told what was found.
#[test]
fn a_search_is_stopped_by_what_is_typed_and_not_by_time() {
    let is_over = || true;
    let over = Cancel::when(&is_over);
    let mut session = Session::new();
    session.open(FILE, GOOD);
    let stopped = Patience { stop: over, ..Patience::default() };
    assert!(session.server.settle(stopped).is_empty());
    assert!(session.server.is_dirty());
    let late = Patience { late: over, ..Patience::default() };
    assert_eq!(session.server.settle(late).len(), 1);
    assert!(!session.server.is_dirty());
}
