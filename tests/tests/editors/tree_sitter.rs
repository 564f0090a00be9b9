//! The tree-sitter grammar as a program: the parser of `editors/tree-sitter-sensedsl` with the library of Debian's
//! `libtree-sitter-dev`, compiled in half a second. A crate with that library would be compiled for every test.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use sensedsl_tests::{TempDir, has, missing, printed, root, run};

use super::texts::Text;

/// A piece of a tree or a capture: bytes from and to, and the name.
pub(super) type Piece = (usize, usize, String);

/// What the grammar makes of a text.
#[derive(Debug, Default)]
pub(super) struct Tree {
    /// In the order of the text, parents before their children.
    pub(super) nodes: Vec<Node>,
    pub(super) captures: Vec<Piece>,
}

#[derive(Debug)]
pub(super) struct Node {
    pub(super) depth: usize,
    pub(super) piece: Piece,
    /// `named`, `token`, `missing` or `error`.
    pub(super) state: String,
}

pub(super) fn folder() -> PathBuf {
    root().join("editors/tree-sitter-sensedsl")
}

/// The program, if the compiler and the library are here.
pub(super) fn program() -> Option<&'static Path> {
    static PROGRAM: OnceLock<Option<(TempDir, PathBuf)>> = OnceLock::new();
    let built = PROGRAM.get_or_init(|| (has("gcc") && has_library()).then(build));
    built.as_ref().map(|(_, program)| program.as_path())
}

fn has_library() -> bool {
    let mut gcc = Command::new("gcc");
    gcc.args(["-E", "-include", "tree_sitter/api.h", "-x", "c", "/dev/null"]);
    let found = gcc.output().unwrap().status.success();
    if !found {
        missing("tree-sitter's library (libtree-sitter-dev)");
    }
    found
}

fn build() -> (TempDir, PathBuf) {
    let scratch = TempDir::new("tree-sitter");
    let program = scratch.join("parse");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1", "-I"]).arg(folder().join("src"));
    gcc.arg(root().join("tests/editors/parse.c")).arg(folder().join("src/parser.c"));
    let _ = run(gcc.args(["-ltree-sitter", "-o"]).arg(&program));
    (scratch, program)
}

/// The trees of texts with the names of fields, as the library writes them.
pub(super) fn shapes(program: &Path, texts: &[Text]) -> Vec<String> {
    let lines = answer(program, Path::new("+"), texts);
    let trees = lines.lines().filter_map(|line| line.strip_prefix("shape "));
    trees.map(str::to_owned).collect()
}

fn answer(program: &Path, query: &Path, texts: &[Text]) -> String {
    let scratch = TempDir::new("texts");
    let paths: Vec<PathBuf> = (texts.iter().enumerate())
        .map(|(at, text)| scratch.write(&format!("{at}.sense"), &text.text))
        .collect();
    printed(Command::new(program).arg(query).args(&paths))
}

/// The trees of texts, with the captures of a query where one is named.
pub(super) fn trees(program: &Path, query: Option<&Path>, texts: &[Text]) -> Vec<Tree> {
    let mut trees: Vec<Tree> = Vec::new();
    for line in answer(program, query.unwrap_or(Path::new("-")), texts).lines() {
        let mut words = line.split(' ');
        let mut word = || words.next().unwrap();
        let first = word();
        if first == "file" {
            trees.push(Tree::default());
            continue;
        }
        let tree = trees.last_mut().unwrap();
        let mut number = || word().parse().unwrap();
        if first == "node" {
            let (depth, from, to) = (number(), number(), number());
            let state = word().to_owned();
            let name = word().to_owned();
            tree.nodes.push(Node { depth, piece: (from, to, name), state });
        } else {
            let (from, to) = (number(), number());
            tree.captures.push((from, to, word().to_owned()));
        }
    }
    assert_eq!(trees.len(), texts.len());
    trees
}
