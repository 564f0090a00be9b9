//! Formatting: of the whole file, of a range, while one types.

use sensedsl_syntax::format;
use serde_json::{Value, json};

use crate::session::{FILE, Session, edited, unmarked};

const UNTIDY: &str = "board B on   STM32F4DiscoveryBoard {\nsensor  Light returns uint16 {\nid=1 ;\n  type = analog; // dim\n}\nsensor Two returns uint16 { type = analog;}\n}\n";

#[test]
fn the_edits_make_the_canonical_layout() {
    let (mut session, _) = Session::of(UNTIDY);
    let edits = session.whole("textDocument/formatting");
    assert_eq!(edited(UNTIDY, &edits), format(UNTIDY).unwrap());
    // Each leaves alone what is as it should be.
    assert!(edits.as_array().unwrap().len() > 4, "{edits}");
    let (mut session, _) = Session::of(&format(UNTIDY).unwrap());
    assert_eq!(session.whole("textDocument/formatting"), json!([]));
}

#[test]
fn a_text_with_mistakes_stays_as_it_is() {
    let (mut session, _) = Session::of("board  B {");
    assert_eq!(session.whole("textDocument/formatting"), json!([]));
}

#[test]
fn a_range_is_laid_out_and_the_rest_is_not() {
    let marked = UNTIDY.replace("id=1", "$0id=1$0");
    let (mut session, places) = Session::of(&marked);
    let range = json!({ "start": places[0], "end": places[1] });
    let params = json!({ "textDocument": { "uri": FILE }, "range": range });
    let edits = session.ask("textDocument/rangeFormatting", params);
    let text = edited(UNTIDY, &edits);
    assert!(text.contains("\n        id = 1;\n"), "{text}");
    assert!(text.contains("on   STM32F4DiscoveryBoard"), "{text}");
}

#[test]
fn a_typed_brace_lays_its_block_out() {
    let marked = UNTIDY.replace("analog;}", "analog;}$0");
    let (mut session, places) = Session::of(&marked);
    let ask = |session: &mut Session, at: &Value, ch: &str| {
        let params = json!({ "textDocument": { "uri": FILE }, "position": at, "ch": ch });
        session.ask("textDocument/onTypeFormatting", params)
    };
    let edits = ask(&mut session, &places[0], "}");
    let text = edited(UNTIDY, &edits);
    assert!(text.contains("    sensor Two returns uint16 { type = analog; }\n"), "{text}");
    assert!(text.contains("sensor  Light"), "{text}");
    assert_eq!(ask(&mut session, &places[0], ";"), json!([]));
    assert_eq!(unmarked(&marked).0, UNTIDY);
}
