//! The pages of `docs/start`, followed as a reader would: files are saved, commands are typed, and what comes out must be
//! what the page shows.
//!
//! A block `sense NAME` (or another language and a name) is a file. A block `sh` is typed into a shell in the folder of the
//! files; `status=1` says how it ends if not with 0, and `board` that it needs a board or installs something: its lines must
//! be commands of the program, and are not run. A block `output` is what the block before it printed, where a line
//! `…` stands for any lines.

use std::process::{Command, Stdio};

use sensedsl_tests::{TempDir, binary, has, read, root, sensedsl};

/// A fenced block: what stands behind the fence, and its lines.
struct Block<'a> {
    line: usize,
    info: &'a str,
    text: String,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let (mut all, mut open) = (Vec::new(), None::<Block<'_>>);
    for (line, text) in (1..).zip(page.lines()) {
        match (&mut open, text.strip_prefix("```")) {
            (None, Some(info)) => open = Some(Block { line, info, text: String::new() }),
            (Some(_), Some("")) => all.extend(open.take()),
            (Some(block), _) => block.text.push_str(&format!("{text}\n")),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block has no end");
    all
}

/// Whether a text is what a page shows of it.
fn shows(shown: &[&str], text: &[&str]) -> bool {
    match (shown.split_first(), text.split_first()) {
        (None, None) => true,
        (Some((&"…", rest)), None) => shows(rest, text),
        (Some((&"…", rest)), Some((_, others))) => shows(rest, text) || shows(shown, others),
        (Some((line, rest)), Some((other, others))) => {
            line.trim_end() == other.trim_end() && shows(rest, others)
        }
        (None, Some(_)) | (Some(_), None) => false,
    }
}

/// What a shell prints on both streams, in the order of the page: messages first, as people see them.
fn typed(folder: &TempDir, block: &Block<'_>) -> String {
    let wanted = block.info.strip_prefix("sh status=").map_or(0, |status| status.parse().unwrap());
    let tools = binary().parent().unwrap().display().to_string();
    let path = format!("{tools}:{}", std::env::var("PATH").unwrap_or_default());
    let mut shell = Command::new("sh");
    shell.args(["-e", "-c", &block.text]).current_dir(folder.path()).env("PATH", path);
    let output = shell.env("NO_COLOR", "1").stdin(Stdio::null()).output().unwrap();
    let text = [output.stderr, output.stdout].map(|one| String::from_utf8(one).unwrap()).concat();
    assert_eq!(output.status.code(), Some(wanted), "line {}: {text}", block.line);
    text
}

/// What cannot be run here must at least be a command of the program, where it is one.
fn known(block: &Block<'_>) {
    let calls = block.text.lines().filter_map(|line| line.strip_prefix("sensedsl "));
    for command in calls.filter_map(|line| line.split_whitespace().next()) {
        let _ = sensedsl([command, "--help"]).run().exits(0);
    }
}

fn follow(name: &str) {
    if !has("python3") {
        return;
    }
    let page = read(&root().join("docs/start").join(name));
    let (folder, mut printed) = (TempDir::new("tutorial"), String::new());
    for block in blocks(&page) {
        match block.info.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["sh", "board"] => known(&block),
            ["sh", ..] => printed = typed(&folder, &block),
            ["output"] => {
                let (shown, text): (Vec<_>, Vec<_>) =
                    (block.text.lines().collect(), printed.trim_end().lines().collect());
                assert!(shows(&shown, &text), "{name}:{}: it prints\n{printed}", block.line);
            }
            [_, file] => drop(folder.write(file, &block.text)),
            _ => {}
        }
    }
}

/// A page that no test follows would not be held to anything.
#[test]
fn every_page_is_followed() {
    let entries = std::fs::read_dir(root().join("docs/start")).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let wanted =
        ["with-a-blue-pill.md", "with-a-nucleo.md", "with-a-pico.md", "without-a-board.md"];
    assert_eq!(names, wanted);
}

#[test]
fn with_a_blue_pill() {
    follow("with-a-blue-pill.md");
}

#[test]
fn with_a_nucleo() {
    follow("with-a-nucleo.md");
}

#[test]
fn with_a_pico() {
    follow("with-a-pico.md");
}

#[test]
fn without_a_board() {
    follow("without-a-board.md");
}
