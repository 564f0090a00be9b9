//! The output of every command on a terminal contains nothing that would move its cursor, colour
//! it, or reverse its text.

use std::ffi::OsString;

use sensedsl_diagnostics::is_hidden;
use sensedsl_tests::{RunOutput, sensedsl};

use super::corpus::projects;

/// A file name with a line end, an escape sequence and a direction mark.
const NAME: &str = "x\u{1b}]0;owned\u{7}\u{202e}\n::error::owned.sense";

#[track_caller]
fn is_calm(ran: &RunOutput) {
    for text in [&ran.stdout, &ran.stderr] {
        let hidden = text.chars().find(|&c| is_hidden(c) && !matches!(c, '\n' | '\t'));
        assert_eq!(hidden, None, "{text:?}");
        assert!(!text.lines().any(|line| line.starts_with("::error::owned")), "{text}");
    }
}

#[test]
fn no_command_lets_a_hostile_text_through() {
    for project in projects() {
        let (folder, source) = (project.source.parent().unwrap(), &project.source);
        let call =
            |arguments: &[&str]| is_calm(&sensedsl(arguments).arg(source).within(folder).run());
        for arguments in [
            &["check"][..],
            &["solve"],
            &["solve", "--format", "json"],
            &["solve", "--format", "markdown"],
            &["solve", "--format", "csv"],
            &["capacity"],
            &["fmt", "--check"],
            &["generate", "-o", "again"],
        ] {
            call(arguments);
        }
        is_calm(&sensedsl(["explain", "wiring"]).arg(source).arg("S1").run());
        is_calm(&sensedsl(["explain", "wiring"]).arg(source).arg(NAME).run());
        is_calm(&sensedsl(["import", "robot.csv"]).within(folder).run());
        // Mistakes beside each text, in a file and a table with hostile names.
        let text = sensedsl_tests::read(source)
            .replace("analog", "anal\u{1b}[31mog")
            .replace(';', "\u{202e}");
        std::fs::write(folder.join(NAME), text).unwrap();
        for command in ["check", "solve", "fmt"] {
            is_calm(&sensedsl([command, NAME]).within(folder).run());
        }
        let board = format!("board Robot on \"{}\" {{}}", NAME.replace('\n', "\\n"));
        is_calm(&sensedsl(["check", "-"]).stdin(board).within(folder).run());
    }
}

#[test]
fn arguments_are_shown_as_text() {
    let name = || OsString::from(NAME);
    for arguments in [
        vec![name()],
        vec!["check".into(), name()],
        vec!["check".into(), "--format".into(), name(), "x".into()],
        vec!["explain".into(), name()],
        vec!["boards".into(), name()],
        vec!["new".into(), "--board".into(), name(), "x".into()],
        vec!["import".into(), name()],
        vec![
            "generate".into(),
            "examples/fig2.sense".into(),
            "--host".into(),
            name(),
            "-o".into(),
            "x".into(),
        ],
    ] {
        let ran = sensedsl(&arguments).run();
        assert_ne!(ran.status, 0);
        is_calm(&ran);
    }
}

/// On a real terminal, where colours are on, the only escape sequences are the program's own
/// colours.
#[test]
#[cfg(target_os = "linux")]
fn a_terminal_gets_no_sequence_but_our_colours() {
    if !sensedsl_tests::has("script") {
        return;
    }
    for project in projects() {
        for command in ["solve", "check"] {
            let line = format!("{} {command} robot.sense", sensedsl_tests::binary().display());
            let mut script = std::process::Command::new("script");
            script
                .args(["-qefc", &line, "/dev/null"])
                .current_dir(project.source.parent().unwrap());
            let output = script.env("TERM", "xterm-256color").output().unwrap();
            let log = String::from_utf8_lossy(&output.stdout);
            assert!(command == "check" || log.contains('\u{1b}'), "{log:?}");
            for sequence in log.split('\u{1b}').skip(1) {
                let end = sequence.find(|c: char| !matches!(c, '[' | ';' | '0'..='9'));
                let (start, rest) = sequence.split_at(end.unwrap());
                assert!(start.starts_with('[') && rest.starts_with('m'), "{sequence:?}");
                assert!(
                    !rest.contains(|c| is_hidden(c) && !matches!(c, '\n' | '\r' | '\t')),
                    "{rest:?}"
                );
                assert!(!rest.starts_with("mred"), "{sequence:?}");
            }
        }
    }
}
