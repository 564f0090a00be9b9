//! Clients that others have written: pytest-lsp, Neovim, Emacs with Eglot.

use std::process::Command;

use sensedsl_tests::{TempDir, answered, binary, has, has_python, missing, root, run};

/// A text with a mistake, behind a character that UTF-16 takes two units for.
const WRONG: &str = "/* \u{1d11e} */ sensor Leg returns uint16 { id = 1; type = analgo; }\nboard B on STM32F407G_DISC1 {}\n";

fn script(name: &str) -> String {
    root().join("tests/tests/language_server/clients").join(name).to_str().unwrap().to_owned()
}

#[test]
fn pytest_lsp_is_answered() {
    if !has_python("pytest_lsp, pytest_asyncio") {
        return missing("pytest-lsp");
    }
    let folder = TempDir::new("pytest-lsp");
    let mut command = Command::new("python3");
    command.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "--asyncio-mode=strict"]);
    command.arg(script("test_lsp.py")).current_dir(folder.path());
    command.env("SENSEDSL", binary()).env("PYTHONDONTWRITEBYTECODE", "1");
    let output = run(&mut command);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && said.contains("passed"), "{said}");
}

#[test]
fn neovim_shows_what_is_wrong_and_lays_out() {
    if !has("nvim") {
        return missing("neovim");
    }
    let folder = TempDir::new("nvim");
    let file = folder.write("a.sense", WRONG);
    let mut command = Command::new("nvim");
    command.args(["--headless", "-u", "NONE", "-i", "NONE", "-c"]);
    command.arg(format!("luafile {}", script("nvim.lua"))).arg(&file).env("SENSEDSL", binary());
    let said = answered(&mut command, "");
    assert!(said.contains("wrong 0:54-60 E0207"), "{said}");
    assert!(said.contains("outline Leg") && said.contains("hover **Leg**"), "{said}");
    let after = sensedsl_tests::read(&file);
    assert!(
        after.contains("uint16 {\n") || after.contains("uint16 { id = 1; type = analog; }"),
        "{after}"
    );
}

#[test]
fn emacs_shows_what_is_wrong() {
    let has_eglot =
        has("emacs") && std::path::Path::new("/usr/share/emacs/site-lisp/elpa-src").exists();
    if !has_eglot {
        return missing("emacs with elpa-eglot");
    }
    let folder = TempDir::new("emacs");
    let file = folder.write("a.sense", WRONG);
    let mut command = Command::new("emacs");
    command.args(["-Q", "--batch", "-l"]).arg(script("eglot.el"));
    command.env("SENSEDSL", binary()).env("SENSE_FILE", &file).env("HOME", folder.path());
    let said = answered(&mut command, "");
    assert!(said.contains("analgo"), "{said}");
}
