//! Every text of the repository: completion and signature help answer at its tokens, and what is taken parses.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]

use std::path::{Path, PathBuf};

use sensedsl_syntax::{SyntaxElement, parse};
use serde_json::{Value, json};

use crate::corpus::is_exhaustive;
use crate::session::{FILE, Session, Stored, edited};

/// The most places of a text that a thorough run asks at.
const PLACES_MAX: usize = 300;

/// The texts below a folder, by path.
fn texts(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            texts(&path, found);
        } else if path.extension().is_some_and(|end| end == "sense") {
            found.extend(std::fs::read_to_string(&path).ok().map(|text| (path, text)));
        }
    }
}

fn position(text: &str, offset: usize) -> Value {
    let before = &text[..offset];
    let line = before.matches('\n').count();
    let column = before.rsplit('\n').next().unwrap().encode_utf16().count();
    json!({ "line": line, "character": column })
}

/// A snippet with a word in each of its places.
fn filled(snippet: &str) -> String {
    let (mut out, mut letters) = (String::new(), snippet.chars().peekable());
    let mut depth = 0;
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => out.extend(letters.next()),
            '$' => {
                let is_block = letters.next_if_eq(&'{').is_some();
                let is_last = letters.next() == Some('0');
                if is_block {
                    letters.next_if_eq(&':');
                    depth += 1;
                } else if !is_last {
                    out.push('x');
                }
            }
            '}' if depth > 0 => depth -= 1,
            other => out.push(other),
        }
    }
    out
}

/// Whether something that is taken there must parse: a new statement, or another word in the place of one.
fn is_replaceable(text: &str, offset: usize, item: &Value) -> bool {
    let range = &item["textEdit"]["range"];
    let begins = text[..offset].ends_with(['{', ';']);
    range["start"] != range["end"] && !text[..offset].ends_with(['{', ';']) || begins
}

/// The completions and the help at an offset; how many of the completions were taken.
fn ask(session: &mut Session, path: &Path, text: &str, offset: usize) -> usize {
    let at = position(text, offset);
    session.at("textDocument/signatureHelp", &at);
    let list = session.at("textDocument/completion", &at);
    let items = list["items"].as_array().unwrap();
    assert!(items.len() <= 200);
    let known = parse(text).errors().len();
    let step = 1 + items.len() / 3;
    let mut taken = 0;
    for item in items.iter().skip(offset % step).step_by(step) {
        let own = item["textEdit"]["range"]["start"]["line"].as_u64();
        assert_eq!(own, at["line"].as_u64(), "{path:?}: {item}");
        // A word is exchanged for one of its own kind: not the keyword of a block, not a whole statement.
        let is_word = !text[..offset].ends_with(['{', ';']);
        // Only `mux` has a value that is a name and its value.
        let is_pair = text[..offset].ends_with("mux");
        // A name takes the place of `not` with all that it negates.
        let negates = ["not", "no", "n"].iter().any(|word| {
            text[..offset].ends_with(&format!(" {word}"))
                && text[offset..].starts_with(&"not "[word.len()..])
        });
        if is_pair || negates || is_word && item["kind"] == 14 {
            continue;
        }
        if !is_replaceable(text, offset, item) || is_word && item["insertTextFormat"] == 2 {
            continue;
        }
        let mut edit = item["textEdit"].clone();
        if item["insertTextFormat"] == 2 {
            edit["newText"] = filled(edit["newText"].as_str().unwrap()).into();
        }
        let new = edited(text, &json!([edit]));
        let errors = parse(&new);
        let near =
            |at: usize| (0..=at.min(new.len())).rev().find(|at| new.is_char_boundary(*at)).unwrap();
        let from = near(offset.saturating_sub(60));
        let place = &new[from..near(offset + 60)];
        assert!(errors.errors().len() <= known, "{path:?} {item}: {:?} {place}", errors.errors());
        taken += 1;
    }
    taken
}

#[test]
fn every_text_can_be_asked_and_completed_anywhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut all = Vec::new();
    for folder in ["examples", "tests", "crates/model/drivers", "crates/syntax/tests/samples"] {
        texts(&root.join(folder), &mut all);
    }
    assert!(all.len() > 300, "{}", all.len());
    let is_thorough = is_exhaustive();
    let item = json!({ "snippetSupport": true });
    let capabilities = json!({ "textDocument": { "completion": { "completionItem": item } } });
    let (mut session, mut taken) = (Session::with(Stored::default(), &capabilities), 0);
    let files = all.iter().step_by(if is_thorough { 1 } else { 12 });
    for ((path, text), at) in files.zip(0_usize..) {
        session.open(FILE, text);
        let tree = parse(text).syntax();
        let tokens = tree.descendants_with_tokens().filter_map(SyntaxElement::into_token);
        let ends: Vec<usize> = tokens.map(|token| token.text_range().end().into()).collect();
        // An answer takes as long as the text is, so that all places of a long one would take its square.
        let step = 1 + ends.len() / if is_thorough { PLACES_MAX } else { 8 };
        for offset in ends.iter().copied().skip(at % step).step_by(step).chain([0, text.len()]) {
            taken += ask(&mut session, path, text, offset);
        }
    }
    assert!(taken > if is_thorough { 500 } else { 40 }, "{taken} completions were taken");
}
