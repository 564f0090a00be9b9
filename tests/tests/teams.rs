//! What the action runs (`packaging/action.sh`), on a design that is right and on one that is wrong.

use std::process::Command;

use sensedsl_tests::{TempDir, binary, has, root};

const RIGHT: &str = "board Rover on NUCLEO_F401RE {\n    sensor Light returns uint16 { id = 1; type = analog; }\n}\n";

/// How the checks end, and what they print; the findings go to that file.
fn checks_into(folder: &TempDir, checks: &str, findings: &str) -> (i32, String) {
    let tools = binary().parent().unwrap().display().to_string();
    let path = format!("{tools}:{}", std::env::var("PATH").unwrap_or_default());
    let mut bash = Command::new("bash");
    bash.arg(root().join("packaging/action.sh")).current_dir(folder.path()).env("PATH", path);
    let output = bash.env("CHECKS", checks).env("SARIF", findings).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stdout).unwrap())
}

fn checks(folder: &TempDir, checks: &str) -> (i32, String) {
    checks_into(folder, checks, "findings.sarif")
}

#[test]
fn changes_are_checked() {
    if !has("bash") {
        return;
    }
    let folder = TempDir::new("teams");
    assert_eq!(checks(&folder, "check"), (2, "::error::no file fits **/*.sense\n".to_owned()));
    let _ = folder.write("robots/rover.sense", RIGHT);
    let (status, printed) = checks(&folder, "check fmt simulate");
    assert_eq!(status, 0, "{printed}");
    assert!(printed.contains("agree with the world"), "{printed}");
    let (status, printed) = checks_into(&folder, "check", "no/such/folder.sarif");
    assert_eq!((status, printed.contains("could not be written")), (2, true), "{printed}");
    let (status, printed) = checks(&folder, "generate");
    assert_eq!(
        (status, printed.contains("::error::generate robots/rover.sense failed")),
        (1, true),
        "{printed}"
    );
    let _ = folder
        .write("robots/rover.sense", RIGHT.replace("analog", "analogue").replace("    ", "  "));
    let (status, printed) = checks(&folder, "check fmt");
    assert_eq!(status, 1);
    for wanted in
        ["::error file=robots/rover.sense,line=2", "::error::check failed", "::error::fmt failed"]
    {
        assert!(printed.contains(wanted), "{printed}");
    }
    let findings = std::fs::read_to_string(folder.join("findings.sarif")).unwrap();
    assert!(findings.contains("rover.sense") && findings.contains("\"2.1.0\""), "{findings}");
}
