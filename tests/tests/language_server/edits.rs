//! Many edits, drawn by a seed: what the server says then is what `sensedsl check` says of the text.

use sensedsl_tests::{Random, TempDir, files, is_exhaustive, is_thorough, read, root, sensedsl};
use serde_json::{Value, json};

use super::session::Editor;

/// What is typed, besides pieces of the file itself.
const TYPED: &[&str] = &[
    "{",
    "}",
    ";",
    "=",
    " ",
    "\n",
    "\"",
    "/*",
    "//",
    "8",
    "-",
    "pin = PA0;",
    "delay = 5 ms;",
    "type = icu;",
    "é",
    "\u{1d11e}",
    "sensor X returns uint8 { type = digital; }",
    "analog",
    "0xE6",
    "const N = 3;",
    "driver = mpu6050;",
    "avoid pin = PB1;",
];

/// After how many edits the two are compared.
const APART: usize = 25;

#[test]
fn after_any_edits_the_diagnostics_are_those_of_check() {
    let count = if is_exhaustive() {
        10_000
    } else if is_thorough() {
        500
    } else {
        100
    };
    let folder = TempDir::new("lsp-edits");
    let examples = files(&root().join("examples"), "sense");
    let mut random = Random::new(28);
    let mut editor = Editor::start();
    let (mut done, mut compared) = (0, 0);
    while done < count {
        let example = random.pick(&examples).unwrap();
        let mut text = read(example);
        let path = folder.join(&format!("edited{done}.sense"));
        let uri = editor.open(path.to_str().unwrap(), &text);
        for _ in 0..4 {
            for _ in 0..APART.min(count - done) {
                edit(&mut editor, &uri, &mut text, &mut random);
                done += 1;
            }
            let told = shown(&editor.diagnostics(&uri));
            let fresh = checked(&folder, path.file_name().unwrap().to_str().unwrap(), &text);
            assert_eq!(told, fresh, "after {done} edits:\n{text}");
            compared += 1;
        }
        editor.tell("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    }
    assert!(compared >= count / APART, "{compared} comparisons");
    assert_eq!(editor.end(), 0);
}

/// One edit at a place drawn by chance: something is typed, taken out, or put in from elsewhere in the text.
fn edit(editor: &mut Editor, uri: &str, text: &mut String, random: &mut Random) {
    let boundary = |text: &str, at: usize| {
        (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or_default()
    };
    let start = boundary(text, random.below(text.len() + 1));
    let length = if random.below(3) == 0 { random.below(30) } else { 0 };
    let end = boundary(text, (start + length).min(text.len())).max(start);
    let piece = match random.below(4) {
        0 => String::new(),
        1 => {
            let from = boundary(text, random.below(text.len() + 1));
            let to = boundary(text, (from + random.below(80)).min(text.len()));
            text.get(from..to).unwrap_or_default().to_owned()
        }
        _ => (*random.pick(TYPED).unwrap()).to_owned(),
    };
    let range = json!({ "start": position(text, start), "end": position(text, end) });
    editor.edit(uri, range, &piece);
    text.replace_range(start..end, &piece);
}

fn position(text: &str, offset: usize) -> Value {
    let before = &text[..offset];
    let line = before.matches('\n').count();
    let column = before.rsplit('\n').next().unwrap().encode_utf16().count();
    json!({ "line": line, "character": column })
}

/// Code, line and column of each, all from 1; columns of the client count units of UTF-16.
fn shown(told: &Value) -> Vec<(String, u64, u64)> {
    let one = |one: &Value| {
        let start = &one["range"]["start"];
        let code = one["code"].as_str().unwrap().to_owned();
        (code, start["line"].as_u64().unwrap() + 1, start["character"].as_u64().unwrap() + 1)
    };
    let mut all: Vec<_> = told.as_array().unwrap().iter().map(one).collect();
    all.sort();
    all
}

/// The same of a fresh `check`.
fn checked(folder: &TempDir, name: &str, text: &str) -> Vec<(String, u64, u64)> {
    folder.write(name, text);
    let output = sensedsl(["check", name, "--format", "json"]).within(folder.path()).run();
    let report = output.json();
    let one = |one: &Value| {
        let code = one["code"].as_str().unwrap().to_owned();
        let start = &one["start"];
        let (line, column) = (start["line"].as_u64().unwrap(), start["column"].as_u64().unwrap());
        // Columns of `check` count characters.
        let row = text.split('\n').nth(usize::try_from(line).unwrap() - 1).unwrap_or_default();
        let before: String = row.chars().take(usize::try_from(column).unwrap() - 1).collect();
        (code, line, before.encode_utf16().count() as u64 + 1)
    };
    let mut all: Vec<_> = report["diagnostics"].as_array().unwrap().iter().map(one).collect();
    all.sort();
    all
}
