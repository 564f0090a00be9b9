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
    let output =
        bash.env("CHECKS", checks).env("SARIF", findings).env("JUNIT", "results").output().unwrap();
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

const TESTED: &str = "
test IsBright {
    for = 1 s;
    always Light < 4096;
}
";

/// Tests in a design are a check of their own; a file without any is left out.
#[test]
fn tests_in_designs_are_run() {
    if !has("bash") {
        return;
    }
    let folder = TempDir::new("tested");
    let _ = folder.write("robots/plain.sense", RIGHT);
    let _ = folder.write("robots/rover.sense", format!("{RIGHT}{TESTED}"));
    let (status, printed) = checks(&folder, "test");
    assert_eq!(status, 0, "{printed}");
    assert!(printed.contains("::group::test robots/rover.sense") && !printed.contains("plain"));
    let results = std::fs::read_to_string(folder.join("results/test-robots-rover.xml")).unwrap();
    assert!(results.contains("IsBright"), "{results}");
    let _ = folder.write("robots/rover.sense", format!("{RIGHT}{}", TESTED.replace("4096", "1")));
    let (status, printed) = checks(&folder, "test");
    assert!(
        status == 1 && printed.contains("::error::test robots/rover.sense failed"),
        "{printed}"
    );

    // The hook's command on all files of a commit.
    let hooks = std::fs::read_to_string(root().join(".pre-commit-hooks.yaml")).unwrap();
    let entry = hooks.lines().find_map(|line| line.strip_prefix("  entry: sh -c '")).unwrap();
    let (script, _) = entry.split_once('\'').unwrap();
    let tools = binary().parent().unwrap().display().to_string();
    let path = format!("{tools}:{}", std::env::var("PATH").unwrap_or_default());
    let mut hook = Command::new("sh");
    hook.args(["-c", script, "sh", "robots/plain.sense", "robots/rover.sense"]);
    let ended = hook.current_dir(folder.path()).env("PATH", path).output().unwrap();
    assert_eq!(ended.status.code(), Some(1), "{ended:?}");
    assert!(String::from_utf8_lossy(&ended.stderr).contains("E0538"), "{ended:?}");
}

/// What a build server reads is XML, with a case for each file and each device, and the failures that the program tells.
#[test]
fn build_servers_read_what_was_checked() {
    if !has("bash") {
        return;
    }
    let folder = TempDir::new("junit");
    let _ = folder.write("robots/rover.sense", RIGHT);
    let _ = folder.write("wrong.sense", RIGHT.replace("analog", "analogue"));
    assert_eq!(checks(&folder, "check simulate").0, 1);
    let cases = |name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        let cases = document.descendants().filter(|one| one.has_tag_name("testcase"));
        let of = |one: roxmltree::Node<'_, '_>| {
            let failure = one.children().find(|one| one.has_tag_name("failure"));
            let code = failure.map(|one| one.attribute("type").unwrap().to_owned());
            (one.attribute("name").unwrap().to_owned(), code)
        };
        cases.map(of).collect::<Vec<_>>()
    };
    let (rover, wrong) = ("robots/rover.sense".to_owned(), "wrong.sense".to_owned());
    assert_eq!(cases("results/check.xml"), [(rover, None), (wrong, Some("E0207".to_owned()))]);
    let simulated = cases("results/simulate-robots-rover.xml");
    assert_eq!(simulated, [("run".to_owned(), None), ("Light".to_owned(), None)]);
    assert!(!folder.join("results/simulate-wrong.xml").exists());
}
