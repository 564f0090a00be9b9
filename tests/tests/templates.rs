//! `sensedsl new --template` as people run it: each robot drives in its world, and its tests notice broken code.

use sensedsl_tests::{Random, TempDir, has, is_exhaustive, missing, sensedsl};
use serde_json::Value;

/// Each template, the world to begin with, and the file of its controller's code in C.
const TEMPLATES: [(&str, &str, &str); 7] = [
    ("arm", "bench.toml", "trace.c"),
    ("balancer", "floor.toml", "balance.c"),
    ("line_follower", "oval.toml", "follow.c"),
    ("quadcopter", "world.toml", ""),
    ("rover", "corridor.toml", "stop.c"),
    ("thermostat", "oven.toml", "hold.c"),
    ("weather_station", "world.toml", ""),
];

/// Each template on the boards that people own: the design is clean, its firmware can be written where the board has any,
/// and the board agrees with the template's world. A board that is too small is told which ones are not.
#[test]
fn templates_drive_in_their_worlds() {
    if !has("cc") {
        missing("cc");
        return;
    }
    let scratch = TempDir::new("templates");
    let boards = ["NUCLEO-F446RE", "RASPBERRYPI-PICO", "STM32F407G-DISC1", "BluePill"];
    for (place, board) in boards.into_iter().enumerate().take(if is_exhaustive() { 4 } else { 2 }) {
        let mut made = 0;
        for (number, (name, world, code)) in TEMPLATES.into_iter().enumerate() {
            // A quick run tries each template on one of two boards.
            if !is_exhaustive() && number % 2 != place {
                continue;
            }
            let dir = scratch.join(&format!("{board}-{name}"));
            let folder = dir.display().to_string();
            let ran = sensedsl(["new", &folder, "--board", board, "--template", name]).run();
            if ran.status != 0 {
                assert!(ran.stderr.contains("--board NUCLEO"), "{}", ran.stderr);
                assert!(!dir.exists());
                continue;
            }
            made += 1;
            let file = dir.join("robot.sense").display().to_string();
            let check = sensedsl(["check", &file, "--format", "json"]).run().exits(0).json();
            let other = |one: &&Value| one["code"] != "W0605";
            let found = check["diagnostics"].as_array().unwrap().iter().find(other);
            assert!(found.is_none(), "{board} {name}: {found:?}");
            let _ = sensedsl(["fmt", "--check", &file]).run().exits(0);
            let world = dir.join(world).display().to_string();
            let judged = sensedsl(["simulate", &file, "--world", &world, "--judge"]).run().exits(0);
            assert!(judged.stdout.contains("agree with the world"), "{}", judged.stdout);
            if !code.is_empty() {
                let _ = sensedsl(["test", &file]).run().exits(0);
            }
            let build = dir.join("build").display().to_string();
            let _ = sensedsl(["generate", "-q", &file, "-o", &build]).run().exits(0);
        }
        assert!(
            made >= if is_exhaustive() { 3 } else { 1 },
            "{board} carries {made} of the templates"
        );
    }
}

/// What draws the slips.
const SEED: u64 = 1;
/// What a slip of the pen makes of a piece of C.
const SLIPS: &[(&str, &str)] = &[
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" < ", " > "),
    (" > ", " < "),
    (" && ", " || "),
    (" || ", " && "),
    (" += ", " -= "),
    (" = -", " = "),
    ("return ", "return 0.1f * "),
    ("_left", "_right"),
    ("!in->", "in->"),
];

/// All texts that differ from a code by one slip, each with its line.
fn slips(code: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    let body = code.find("*/").unwrap_or(0);
    let mut add = |at: usize, length: usize, other: &str| {
        let text = format!("{}{other}{}", &code[..at], &code[at + length..]);
        let begin = text[..at].rfind('\n').map_or(0, |line| line + 1);
        let line = text[begin..].lines().next().unwrap_or_default().trim();
        if !line.starts_with(['#', '*', '/']) && !line.contains("for (") {
            all.push((line.to_owned(), text.clone()));
        }
    };
    for (from, to) in SLIPS {
        for (at, _) in code.match_indices(from).filter(|(at, _)| *at > body) {
            add(at, from.len(), to);
        }
    }
    // A number ten times as great, and ten times as small.
    let mut rest = body;
    while let Some(found) = code[rest..].find(|letter: char| letter.is_ascii_digit()) {
        let at = rest + found;
        let length = code[at..].find(|letter: char| !letter.is_ascii_digit() && letter != '.');
        let length = length.unwrap_or(code.len() - at);
        rest = at + length;
        let is_own =
            !code[..at].ends_with(|letter: char| letter.is_alphanumeric() || letter == '_');
        if let Ok(number) = code[at..rest].parse::<f64>()
            && is_own
            && code[rest..].starts_with('f')
            && number != 0.0
        {
            add(at, length, &format!("{:?}", number * 10.0));
            add(at, length, &format!("{:?}", number / 10.0));
        }
    }
    all
}

/// Slips of the pen in the code of the templates' controllers, drawn by the seed: of forty, the templates' tests notice
/// at least 36: some change nothing that a robot does.
#[test]
fn tests_of_the_templates_notice_broken_code() {
    if !has("cc") {
        missing("cc");
        return;
    }
    let scratch = TempDir::new("slips");
    let mut all = Vec::new();
    for (name, _, code) in TEMPLATES.into_iter().filter(|one| !one.2.is_empty()) {
        let folder = scratch.join(name).display().to_string();
        let call = ["new", &folder, "--board", "NUCLEO-F446RE", "--template", name];
        let _ = sensedsl(call).run().exits(0);
        let file = scratch.join(name).join("build/firmware/Robot/user").join(code);
        let text = std::fs::read_to_string(&file).unwrap();
        all.extend(slips(&text).into_iter().map(|(line, text)| (name, file.clone(), line, text)));
    }
    assert!(all.len() > 100, "{}", all.len());
    let (count, least) = if is_exhaustive() { (40, 36) } else { (4, 3) };
    let mut chance = Random::new(SEED);
    let mut missed = Vec::new();
    for _ in 0..count {
        let (name, file, line, text) = all.swap_remove(chance.below(all.len()));
        let whole = std::fs::read_to_string(&file).unwrap();
        std::fs::write(&file, text).unwrap();
        let design = scratch.join(name).join("robot.sense").display().to_string();
        let ran = sensedsl(["test", &design]).run();
        std::fs::write(&file, whole).unwrap();
        if ran.status == 0 {
            missed.push(format!("{name}: {line}"));
        }
    }
    eprintln!("{} of {count} slips noticed; not: {missed:#?}", count - missed.len());
    assert!(count - missed.len() >= least, "{missed:#?}");
}
