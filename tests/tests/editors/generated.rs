//! `src/` of the tree-sitter grammar is what the tool makes of `grammar.js`; `SENSEDSL_BLESS=1` writes it. The tool takes
//! minutes to compile, so only exhaustive runs must have it.

use std::fs;
use std::process::Command;

use sensedsl_tests::{TempDir, assert_tree, is_exhaustive, missing, printed, run, tree};

use super::tree_sitter::folder;

/// Another one may write other code.
const VERSION: &str = "0.27.1";
/// Of the parser: the newest that Neovim 0.7 and Debian's library take, and that all later ones do.
const ABI: &str = "14";

#[test]
fn the_parser_is_that_of_the_grammar() {
    let version = Command::new("tree-sitter").arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    if !version.unwrap_or_default().starts_with(&format!("tree-sitter {VERSION}")) {
        let what = format!("tree-sitter {VERSION} (cargo install --locked tree-sitter-cli)");
        if is_exhaustive() {
            missing(&what);
        } else {
            eprintln!("SKIPPED: {what} is not here");
        }
        return;
    }
    assert!(printed(Command::new("node").arg("--version")).starts_with('v'));
    let scratch = TempDir::new("generated");
    for name in ["grammar.js", "tree-sitter.json"] {
        let _ = fs::copy(folder().join(name), scratch.join(name)).unwrap();
    }
    let mut tool = Command::new("tree-sitter");
    let _ = run(tool.args(["generate", "--abi", ABI]).current_dir(scratch.path()));
    let mut wanted = tree(&scratch.join("src"));
    // These are for scanners that are written by hand.
    wanted
        .retain(|path, _| !["tree_sitter/alloc.h", "tree_sitter/array.h"].contains(&path.as_str()));
    assert_tree("editors/tree-sitter-sensedsl/src", &wanted);
}
