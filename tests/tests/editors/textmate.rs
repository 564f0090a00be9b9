//! The TextMate grammar by the engine of VS Code: every word of every text has the scope of what the compiler says it is.
//!
//! Needs Node.js and `npm ci --prefix tests/editors`.

use std::process::Command;

use sensedsl_tests::{answered, has, is_exhaustive, missing, root};

use super::classes::{Class, classes};
use super::texts::as_written;

const GRAMMAR: &str = "editors/vscode/syntaxes/sensedsl.tmLanguage.json";

fn scope(class: Class) -> &'static str {
    match class {
        Class::Comment => "comment.",
        Class::Constant => "variable.other.constant.sensedsl",
        Class::Device => "entity.name.function.sensedsl",
        Class::Function => "support.function.sensedsl",
        Class::Keyword => "keyword.other.sensedsl",
        Class::Number => "constant.numeric.sensedsl",
        Class::Property => "variable.other.property.sensedsl",
        Class::Text => "string.quoted.double.sensedsl",
        Class::Thing => "entity.name.type.sensedsl",
        Class::Type => "support.type.sensedsl",
        Class::Unit => "keyword.other.unit.sensedsl",
    }
}

#[test]
fn scopes_are_what_the_compiler_says() {
    let folder = root().join("tests/editors");
    if !["vscode-oniguruma", "vscode-textmate"]
        .iter()
        .all(|name| folder.join("node_modules").join(name).exists())
    {
        let what = "VS Code's engine for grammars (npm ci --prefix tests/editors)";
        if is_exhaustive() {
            missing(what);
        } else {
            eprintln!("SKIPPED: {what} is not here");
        }
        return;
    }
    if !has("node") {
        return;
    }
    let texts = as_written();
    let request: Vec<&str> = texts.iter().map(|text| text.text.as_str()).collect();
    let mut node = Command::new("node");
    node.arg(folder.join("tokens.mjs")).arg(root().join(GRAMMAR));
    let answer = answered(&mut node, serde_json::to_vec(&request).unwrap());
    let answers: Vec<Vec<(usize, usize, Vec<String>)>> = serde_json::from_str(&answer).unwrap();
    assert_eq!(answers.len(), texts.len());
    for (text, colours) in texts.iter().zip(answers) {
        let scopes = by_byte(&text.text, &colours);
        for (from, to, class) in classes(&text.text) {
            let word = &text.text[from..to];
            for (at, letter) in
                word.char_indices().filter(|(_, letter)| *letter != '\n' && *letter != '\r')
            {
                let found = &scopes[from + at];
                let is_right = found.iter().any(|name| name.starts_with(scope(class)));
                assert!(is_right, "{}: `{letter}` of `{word}` at {from}: {found:?}", text.name);
            }
            // What is more than one thing at once is only an escape within a text.
            let first =
                scopes[from].iter().filter(|name| !name.starts_with("punctuation.")).count();
            assert_eq!(first, 1, "{}: `{word}` at {from}: {:?}", text.name, scopes[from]);
        }
    }
}

/// The scopes of each byte; those of a line's end are those before it.
fn by_byte(text: &str, colours: &[(usize, usize, Vec<String>)]) -> Vec<Vec<String>> {
    let mut bytes_of_units = Vec::new();
    for (at, letter) in text.char_indices() {
        bytes_of_units.extend(std::iter::repeat_n(at, letter.len_utf16()));
    }
    bytes_of_units.push(text.len());
    let mut scopes = vec![Vec::new(); text.len()];
    for (from, to, names) in colours {
        let [from, to] =
            [*from, *to].map(|unit| bytes_of_units.get(unit).copied().unwrap_or(text.len()));
        scopes[from..to].fill(names.clone());
    }
    scopes
}
