//! One list of words: what the compiler has as keywords and units is what each grammar and each editor's file has.

use std::collections::BTreeSet;

use sensedsl_syntax::{SyntaxKind, Unit};
use sensedsl_tests::text;
use serde_json::Value;

const TREE_SITTER: &str = "editors/tree-sitter-sensedsl/src/node-types.json";
const TEXTMATE: &str = "editors/vscode/syntaxes/sensedsl.tmLanguage.json";
const VIM: &str = "editors/neovim/syntax/sensedsl.vim";
const EVERY_WORD: &str = "tests/editors/every_word.sense";
const EMACS: &str = "editors/emacs/sensedsl-mode.el";

fn keywords() -> BTreeSet<String> {
    SyntaxKind::keywords().map(str::to_owned).collect()
}

fn units() -> BTreeSet<String> {
    Unit::ALL.iter().map(|unit| unit.name().to_owned()).collect()
}

/// What is no mark and not a node of its own in the tree-sitter grammar.
#[test]
fn the_tree_sitter_grammar_has_all_words() {
    let types: Value = serde_json::from_str(&text(TREE_SITTER)).unwrap();
    let unnamed = types.as_array().unwrap().iter().filter(|node| node["named"] == false);
    let words = unnamed.map(|node| node["type"].as_str().unwrap());
    let words: BTreeSet<String> = words
        .filter(|word| word.contains(char::is_alphabetic) || *word == "%")
        .map(str::to_owned)
        .collect();
    assert_eq!(words, keywords().union(&units()).cloned().collect());
}

/// The words of all patterns with a scope, where these are alternatives of words.
#[test]
fn the_textmate_grammar_has_all_words() {
    let grammar: Value = serde_json::from_str(&text(TEXTMATE)).unwrap();
    let (mut found_keywords, mut found_units) = (BTreeSet::new(), BTreeSet::new());
    walk(&grammar, &mut |rule| {
        let pattern = rule.get("match").or_else(|| rule.get("begin")).and_then(Value::as_str);
        let Some(pattern) = pattern else { return };
        let captures = rule.get("captures").or_else(|| rule.get("beginCaptures"));
        let is_keyword = |scopes: &Value| scopes["name"] == "keyword.other.sensedsl";
        if is_keyword(rule) || captures.is_some_and(|captures| is_keyword(&captures["1"])) {
            found_keywords.extend(first_words(pattern));
        }
        if captures.is_some_and(|captures| captures["2"]["name"] == "keyword.other.unit.sensedsl") {
            let (_, rest) = pattern.split_once("[ \\t]*(").unwrap();
            let (units, rest) = rest.split_once(')').unwrap();
            found_units.extend(units.split('|').map(|unit| unit.replace('\\', "")));
            found_units.extend(rest.contains("(%)").then(|| "%".to_owned()));
        }
    });
    assert_eq!(found_keywords, keywords());
    assert_eq!(found_units, units());
}

fn walk(value: &Value, see: &mut impl FnMut(&Value)) {
    match value {
        Value::Object(fields) => {
            see(value);
            fields.values().for_each(|field| walk(field, see));
        }
        Value::Array(items) => items.iter().for_each(|item| walk(item, see)),
        _ => {}
    }
}

/// The words of `\b(one|other)`, `\bone` and `\b(?:one|other)`.
fn first_words(pattern: &str) -> Vec<String> {
    let pattern =
        pattern.trim_start_matches("\\b").trim_start_matches("(?:").trim_start_matches('(');
    let is_end = |letter: char| !letter.is_ascii_lowercase() && letter != '|';
    let words = pattern.split(is_end).next().unwrap_or_default();
    words.split('|').map(str::to_owned).collect()
}

/// Their colours follow from what comes after a word; that each of these is right is `plugins`'.
#[test]
fn the_files_of_neovim_and_emacs_have_all_words() {
    for file in [VIM, EMACS] {
        let whole = text(file);
        let is_end = |letter: char| !letter.is_ascii_alphanumeric() && letter != '_';
        let words: BTreeSet<String> = whole.split(is_end).map(str::to_owned).collect();
        assert_eq!(keywords().difference(&words).next(), None, "{file}");
        let has = |unit: &String| {
            words.contains(unit)
                || whole.contains(&format!("{unit}\\|"))
                || whole.contains(&format!("\"{unit}\""))
        };
        assert_eq!(units().into_iter().find(|unit| unit != "%" && !has(unit)), None, "{file}");
    }
}

/// What all editors are tested on, so that none is forgotten where a word is new.
#[test]
fn a_text_has_all_words() {
    let parse = sensedsl_syntax::parse(&text(EVERY_WORD));
    assert_eq!(parse.errors(), []);
    let tokens =
        parse.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
    let (mut found_keywords, mut found_units) = (BTreeSet::new(), BTreeSet::new());
    for token in tokens {
        if token.kind() == SyntaxKind::Unit {
            found_units.extend([token.text().to_owned()]);
        } else if token.kind().word().is_some() {
            found_keywords.extend([token.text().to_owned()]);
        }
    }
    assert_eq!(found_keywords, keywords(), "{EVERY_WORD}");
    assert_eq!(found_units, units(), "{EVERY_WORD}");
}
