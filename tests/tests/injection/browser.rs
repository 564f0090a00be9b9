//! A browser opens the picture of the pins, and the wiring sheet as HTML: it must show text, and
//! run no script.

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{TempDir, has, is_thorough, read};

use super::corpus::projects;

/// The browser's document for a file, after all scripts have run.
fn page(browser_folder: &Path, file: &Path) -> String {
    let mut command = Command::new("chromium");
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"]);
    command.args(["--disable-background-networking", "--disable-dev-shm-usage", "--dump-dom"]);
    command.arg(format!("--user-data-dir={}", browser_folder.display()));
    let output = command.arg(format!("file://{}", file.display())).output().unwrap();
    let page = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(page.contains("</"), "{}", String::from_utf8_lossy(&output.stderr));
    page
}

#[test]
fn the_picture_shows_hostile_text_and_runs_nothing() {
    if !is_thorough() || !has("chromium") {
        return;
    }
    let scratch = TempDir::new("browser");
    // One page contains all pictures and sheets, so that the browser starts once; each picture is also checked
    // as XML.
    let mut html = String::from("<!doctype html><meta charset=utf-8><title>calm</title>\n");
    for project in projects() {
        html.push_str(&read(&project.output.join("pinout.svg")));
        html.push_str(&read(&project.output.join("wiring.html")));
    }
    // A page with one more script, to check that this test would notice it.
    let control =
        scratch.write("control.html", format!("{html}<script>document.title='owned'</script>"));
    let calm = scratch.write("calm.html", html);
    assert!(page(&scratch.join("profile"), &control).contains("<title>owned</title>"));
    let shown = page(&scratch.join("profile"), &calm);
    assert!(shown.contains("<title>calm</title>"), "{shown}");
    for element in ["<script", "<img", "<a ", "<foreignObject"] {
        assert!(!shown.contains(element), "{element} in\n{shown}");
    }
    let mut tags = shown.split('<').filter_map(|rest| rest.split_once('>'));
    assert!(tags.all(|(tag, _)| !tag.contains("onerror")), "{shown}");
    // Places are cut to the available room.
    for text in ["&lt;script&gt;doc", "=cmd|'/c calc'!", "[31mred", "שלום"] {
        assert!(shown.contains(text), "{text} is missing in\n{shown}");
    }
    let picture = page(&scratch.join("profile"), &projects()[0].output.join("pinout.svg"));
    assert!(
        picture.contains("<title>Wiring</title>") && !picture.contains("parsererror"),
        "{picture}"
    );
}
