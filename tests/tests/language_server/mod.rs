//! The language server as editors talk to it: `sensedsl lsp` on pipes.
//!
//! `session.rs` is a client of our own, `edits.rs` compares what it is told after many edits with `sensedsl check`,
//! `clients.rs` lets pytest-lsp, Neovim and Emacs do the talking.

mod clients;
mod edits;
mod session;

use serde_json::{Value, json};

use session::Editor;

const ROBOT: &str = "board B on STM32F407G_DISC1 {
    sensor Light returns uint16 { id = 1; type = analog; delay = 2 * 10 ms; }
    sensor Far returns uint16 { id = 2; driver = srf08; address = 0x70; }
}
";

/// Each request that the server announces is answered, in one session.
#[test]
fn every_feature_answers() {
    let mut editor = Editor::start();
    let announced = editor.capabilities.clone();
    let uri = editor.open("/robot/robot.sense", ROBOT);
    assert_eq!(editor.diagnostics(&uri), json!([]));
    let file = json!({ "uri": uri });
    let at = json!({ "line": 1, "character": 13 });
    let range =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 5, "character": 0 } });
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let reference = json!({ "includeDeclaration": true });
    for (provider, method, more) in [
        ("definitionProvider", "textDocument/definition", json!({ "position": at })),
        ("documentFormattingProvider", "textDocument/formatting", json!({ "options": options })),
        ("documentHighlightProvider", "textDocument/documentHighlight", json!({ "position": at })),
        (
            "documentRangeFormattingProvider",
            "textDocument/rangeFormatting",
            json!({ "range": range, "options": options }),
        ),
        ("documentSymbolProvider", "textDocument/documentSymbol", json!({})),
        ("codeLensProvider", "textDocument/codeLens", json!({})),
        ("foldingRangeProvider", "textDocument/foldingRange", json!({})),
        ("hoverProvider", "textDocument/hover", json!({ "position": at })),
        ("inlayHintProvider", "textDocument/inlayHint", json!({ "range": range })),
        (
            "referencesProvider",
            "textDocument/references",
            json!({ "position": at, "context": reference }),
        ),
        ("renameProvider", "textDocument/rename", json!({ "position": at, "newName": "Dark" })),
        ("selectionRangeProvider", "textDocument/selectionRange", json!({ "positions": [at] })),
        ("semanticTokensProvider", "textDocument/semanticTokens/full", json!({})),
    ] {
        assert!(!announced[provider].is_null(), "{provider} is not announced");
        let mut params = more;
        params["textDocument"] = file.clone();
        let answer = editor.ask(method, params);
        let is_empty = answer.is_null();
        assert!(!is_empty, "{method} is not answered");
    }
    let symbols = editor.ask("workspace/symbol", json!({ "query": "light" }));
    assert_eq!(symbols[0]["name"], "Light");
    let hints =
        editor.ask("textDocument/inlayHint", json!({ "textDocument": file, "range": range }));
    assert!(hints.as_array().unwrap().iter().any(|one| one["label"] == "= 20 ms"), "{hints}");
    assert_eq!(editor.end(), 0);
}

/// A session that is cut off is no success, and one that says nonsense does not hang.
#[test]
fn a_client_that_goes_is_noticed() {
    assert_eq!(Editor::start().drop_it(), 1);
    let output = sensedsl_tests::sensedsl(["lsp"]).stdin("Content-Length: 5\r\n\r\nhello").run();
    assert_ne!(output.status, 0, "{output:?}");
}

#[test]
fn what_is_typed_is_seen_and_what_is_used_is_read() {
    let folder = sensedsl_tests::TempDir::new("lsp-used");
    folder.write("legs.sense", "sensor Leg returns uint16 { id = 7; type = analogue; }");
    let path = folder.write("robot.sense", "use \"legs.sense\";\nboard B on STM32F407G_DISC1 {}\n");
    let mut editor = Editor::start();
    let text = sensedsl_tests::read(&path);
    let uri = editor.open(path.to_str().unwrap(), &text);
    assert_eq!(editor.diagnostics(&uri), json!([]));
    let legs: Vec<Value> = editor
        .told
        .iter()
        .filter(|one| one.0.ends_with("legs.sense"))
        .map(|one| one.1.clone())
        .collect();
    assert_eq!(legs[0][0]["code"], "E0207", "{legs:?}");
    assert_eq!(editor.end(), 0);
}
