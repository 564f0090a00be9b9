//! Every listed command has help, and is in the table of `docs/commands.md`.
//!
//! The other tests of the program are in `tests/` of the repository. Because Cargo builds the
//! program for this test, they need not build it.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "a test runs the program")]

use std::process::Command;

/// The standard output of a call that must succeed.
fn says(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_sensedsl")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_command_explains_itself() {
    let help = says(&["--help"]);
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let listed = commands.lines().take_while(|line| !line.is_empty());
    let named: Vec<&str> = listed
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert!(named.contains(&"solve") && named.contains(&"generate"), "{named:?}");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/commands.md");
    let page = std::fs::read_to_string(path).unwrap();
    let (_, table) = page.split_once("| command | does |").unwrap();
    for command in named {
        let is_described = [' ', '`'].iter().any(|end| table.contains(&format!("`{command}{end}")));
        assert!(is_described, "docs/commands.md lacks {command}");
        let help = says(&[command, "--help"]);
        assert!(help.contains("Usage: sensedsl"), "{command}: {help}");
    }
}
