//! The pages that a reader types, followed as a reader would: files are saved, commands are typed, and what comes out must
//! be what the page shows.
//!
//! A block `sense NAME` (or another language and a name) is a file. A block `sh` is typed into a shell in the folder of the
//! files; `status=1` says how it ends if not with 0. Lines of `board` need a board or install something: they must be
//! commands of the program, and are not run. Those of `chibios` build firmware in C: they are run where `CHIBIOS` names a
//! tree, and are otherwise as those of `board`. A block `output` is what the block before it printed, where a line `…`
//! stands for any lines, and a `…` in a line for any letters. A picture on the page with the name of a file that the commands wrote is that file, and a table
//! of wires is in the `build/wiring.md` that they wrote.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Stdio};

use sensedsl_tests::{TempDir, binary, has, read, root, sensedsl, write_file};

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

/// Whether a line is what a page shows of it.
fn shows_line(shown: &str, line: &str) -> bool {
    match shown.split_once('…') {
        None => shown.trim_end() == line.trim_end(),
        Some((begin, rest)) => line.strip_prefix(begin).is_some_and(|line| {
            let starts = line.char_indices().map(|(at, _)| at).chain([line.len()]);
            starts.into_iter().any(|at| shows_line(rest, line.get(at..).unwrap_or_default()))
        }),
    }
}

/// Whether a text is what a page shows of it.
fn shows(shown: &[&str], text: &[&str]) -> bool {
    match (shown.split_first(), text.split_first()) {
        (None, None) => true,
        (Some((&"…", rest)), None) => shows(rest, text),
        (Some((&"…", rest)), Some((_, others))) => shows(rest, text) || shows(shown, others),
        (Some((line, rest)), Some((other, others))) => {
            shows_line(line, other) && shows(rest, others)
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

/// Whether what the block needs is on this machine.
fn can_run(block: &Block<'_>) -> bool {
    match block.info {
        "sh board" => false,
        "sh chibios" => {
            std::env::var_os("CHIBIOS").is_some_and(|tree| !tree.is_empty())
                && has("arm-none-eabi-gcc")
        }
        _ => true,
    }
}

/// The pictures of a page that its commands have written are those beside the page; with `SENSEDSL_BLESS=1`, writes them.
fn pictures(page: &Path, text: &str, folder: &TempDir) {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    for link in links.filter(|link| link.ends_with(".svg") && !link.contains("://")) {
        let shown = page.parent().unwrap().join(link);
        let made = folder.path().join(shown.file_name().unwrap());
        if !made.exists() {
            continue;
        }
        if std::env::var_os("SENSEDSL_BLESS").is_some() {
            write_file(&shown, read(&made));
        }
        assert!(shown.exists() && read(&shown) == read(&made), "{link}: SENSEDSL_BLESS=1");
    }
}

/// The rows of a page's tables of wires are those of the sheet.
fn wires(page: &str, folder: &TempDir) {
    let rows = |text: &str| -> Vec<String> {
        let mut is_wires = false;
        let lines = text.lines().filter(|line| {
            is_wires = line.starts_with("| At the part |") || is_wires && line.starts_with('|');
            is_wires
        });
        lines.map(str::to_owned).collect()
    };
    let shown = rows(page);
    if shown.is_empty() {
        return;
    }
    let sheet = rows(&read(&folder.path().join("build/wiring.md")));
    for row in shown {
        assert!(sheet.contains(&row), "the sheet has no row {row}\n{}", sheet.join("\n"));
    }
}

/// Types a page.
fn follow(name: &str) {
    if !has("python3") {
        return;
    }
    let path = root().join("docs").join(name);
    let page = read(&path);
    let (folder, mut printed) = (TempDir::new("tutorial"), None);
    for block in blocks(&page) {
        match block.info.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["sh", ..] if !can_run(&block) => {
                known(&block);
                printed = None;
            }
            ["sh", ..] => printed = Some(typed(&folder, &block)),
            ["output"] => {
                let Some(printed) = &printed else { continue };
                let (shown, text): (Vec<_>, Vec<_>) =
                    (block.text.lines().collect(), printed.trim_end().lines().collect());
                assert!(shows(&shown, &text), "{name}:{}: it prints\n{printed}", block.line);
            }
            [_, file] => drop(folder.write(file, &block.text)),
            _ => {}
        }
    }
    wires(&page, &folder);
    pictures(&path, &page, &folder);
}

/// A test for each page, so that they are followed at the same time, and the list of them.
macro_rules! pages {
    ($($test:ident $page:literal)*) => {
        const PAGES: &[&str] = &[$($page),*];
        $(
            #[test]
            fn $test() {
                follow($page);
            }
        )*
    };
}

pages! {
    start_drive_in_simulation "start/drive-in-simulation.md"
    start_with_a_blue_pill "start/with-a-blue-pill.md"
    start_with_a_nucleo "start/with-a-nucleo.md"
    start_with_a_pico "start/with-a-pico.md"
    start_with_an_uno "start/with-an-uno.md"
    start_without_a_board "start/without-a-board.md"
    tutorials_can_robot "tutorials/can-robot.md"
    tutorials_line_follower "tutorials/line-follower.md"
    tutorials_quadcopter_bench "tutorials/quadcopter-bench.md"
    tutorials_robot_arm "tutorials/robot-arm.md"
    tutorials_rover "tutorials/rover.md"
    tutorials_weather_station "tutorials/weather-station.md"
    guides_readme "guides/README.md"
    guides_build "guides/build.md"
    guides_check "guides/check.md"
    guides_flash "guides/flash.md"
    guides_lamps "guides/lamps.md"
    guides_python "guides/python.md"
    guides_record "guides/record.md"
    guides_ros2 "guides/ros2.md"
    guides_test "guides/test.md"
    guides_watch "guides/watch.md"
    guides_wire "guides/wire.md"
    guides_write_a_driver "guides/write-a-driver.md"
    migrate_readme "migrate/README.md"
    migrate_arduino "migrate/arduino.md"
    migrate_ardupilot_betaflight "migrate/ardupilot-betaflight.md"
    migrate_cubemx "migrate/cubemx.md"
    migrate_micropython "migrate/micropython.md"
    migrate_platformio_esphome "migrate/platformio-esphome.md"
    migrate_zephyr "migrate/zephyr.md"
    why "why.md"
}

/// A page that no test follows would not be held to anything.
#[test]
fn every_page_is_followed() {
    let mut found = BTreeSet::new();
    for folder in ["start", "tutorials", "guides", "migrate"] {
        for entry in std::fs::read_dir(root().join("docs").join(folder)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if name.ends_with(".md") {
                found.insert(format!("{folder}/{name}"));
            }
        }
    }
    found.insert("why.md".to_owned());
    let followed: BTreeSet<String> = PAGES.iter().map(|page| (*page).to_owned()).collect();
    assert_eq!(followed, found);
}
