//! Queries of the tree-sitter grammar: each editor's colours tell apart what the compiler does, and each query fits the
//! grammar.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sensedsl_tests::{files, root, text};

use super::classes::{Class, classes};
use super::texts::as_written;
use super::tree_sitter::{program, trees};

/// The folders with queries, and their words for what is told apart, in the order of [`Class`].
const QUERIES: [(&str, [&str; 11]); 3] = [
    ("editors/tree-sitter-sensedsl/queries", SHARED),
    ("editors/zed/languages/sensedsl", SHARED),
    (
        "editors/helix/queries/sensedsl",
        [
            "comment",
            "constant",
            "function",
            "function.builtin",
            "keyword",
            "constant.numeric",
            "variable.other.member",
            "string",
            "type",
            "type.builtin",
            "type.builtin",
        ],
    ),
];
const SHARED: [&str; 11] = [
    "comment",
    "constant",
    "function",
    "function.builtin",
    "keyword",
    "number",
    "property",
    "string",
    "type",
    "type.builtin",
    "type.builtin",
];

#[test]
fn colours_tell_apart_what_the_compiler_does() {
    let Some(program) = program() else { return };
    let texts = as_written();
    for (folder, words) in QUERIES {
        let query = root().join(folder).join("highlights.scm");
        for (text, tree) in texts.iter().zip(trees(program, Some(&query), &texts)) {
            let mut captures: BTreeMap<(usize, usize), Vec<&str>> = BTreeMap::new();
            for (from, to, name) in &tree.captures {
                captures.entry((*from, *to)).or_default().push(name);
            }
            for (mut from, to, class) in classes(&text.text) {
                let of = |from| captures.get(&(from, to));
                if class == Class::Number && of(from).is_none() {
                    // The sign of a code belongs to its number.
                    from -= 1;
                }
                let word = words[class as usize];
                let found = of(from).map(Vec::as_slice);
                let what = &text.text[from..to];
                assert_eq!(found, Some(&[word][..]), "{folder}, {}: {what} at {from}", text.name);
            }
        }
    }
}

#[test]
fn every_query_fits_the_grammar() {
    let Some(program) = program() else { return };
    let queries: Vec<PathBuf> =
        QUERIES.iter().flat_map(|(folder, _)| files(&root().join(folder), "scm")).collect();
    assert!(queries.len() > 8, "{queries:?}");
    let texts = as_written();
    for query in queries {
        let of_all = trees(program, Some(&query), &texts);
        let count: usize = of_all.iter().map(|tree| tree.captures.len()).sum();
        assert!(count > 0, "{} finds nothing in any text", shown(&query));
    }
}

/// Zed has its queries beside its settings; its colours have the same names.
#[test]
fn zed_has_the_colours_of_the_grammar() {
    let patterns = |folder: &str| {
        let file = text(&format!("{folder}/highlights.scm"));
        file.split_once("\n\n").map(|(_, patterns)| patterns.to_owned()).unwrap()
    };
    assert_eq!(patterns(QUERIES[0].0), patterns(QUERIES[1].0));
}

fn shown(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}
