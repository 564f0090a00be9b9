//! Mistakes in the wiring, put into the crate of `check --typecheck` and into a generated project, one at a time: which
//! does the Rust compiler refuse?
//!
//! The table is in `docs/seeded-mistakes.md`, written by `SENSEDSL_THOROUGH=3 SENSEDSL_BLESS=1 cargo test --workspace
//! --test all embassy::seeds`. With `SENSEDSL_THOROUGH=1` only the crate of the check is tried,
//! with `SENSEDSL_THOROUGH=2` a twelfth of the mistakes in the project, too.

use std::path::Path;
use std::process::Command;

use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_tests::{
    Mistake, TempDir, assert_rows, assert_section, is_drawn, is_exhaustive, is_thorough, is_whole,
    mistakes, root, sensedsl, tree,
};

use super::{KINDS, checked, source};

/// The board with wires of all kinds, and its link over USB.
fn bench() -> String {
    let text = KINDS.replace("    link { transport = uart; unit = USART2; }\n", "");
    assert!(text.len() < KINDS.len());
    text
}

/// Texts that are replaced wherever they stand, as whole words.
type Swaps = [(String, String)];

/// Replaces whole words.
fn swapped(text: &str, swaps: &Swaps) -> String {
    let is_word = |one: Option<char>| one.is_some_and(|one| one == '_' || one.is_alphanumeric());
    let mut text = text.to_owned();
    for (from, to) in swaps {
        let (mut done, mut rest) = (String::new(), text.as_str());
        let (starts_word, ends_word) =
            (is_word(from.chars().next()), is_word(from.chars().next_back()));
        while let Some(at) = rest.find(from) {
            let (before, after) = (&rest[..at], &rest[at + from.len()..]);
            done.push_str(before);
            let is_part = starts_word && is_word(done.chars().next_back())
                || ends_word && is_word(after.chars().next());
            done.push_str(if is_part { from } else { to });
            rest = after;
        }
        done.push_str(rest);
        text = done;
    }
    text
}

/// The compiler's first error; none where it takes everything.
fn refusal(folder: &Path, target: &Path, triple: Option<&str>) -> Option<String> {
    let mut cargo = Command::new("cargo");
    cargo.args(["check", "--locked", "--quiet", "--target-dir"]).arg(target);
    cargo.args(triple.map(|triple| ["--target", triple]).iter().flatten());
    let output = cargo.env_remove("RUSTFLAGS").current_dir(folder).output().unwrap();
    if output.status.success() {
        return None;
    }
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = log.split_once("error[").and_then(|(_, rest)| rest.split_once(']'));
    Some(code.unwrap_or_else(|| panic!("{log}")).0.to_owned())
}

/// STM32F1 moves the pins of a unit as a block.
const MOVED: &str = "board BLUEPILL_F103C8 { link { transport = none; }\n\
                     sensor A returns uint32 { id = 1; type = icu; pin = PB4; } }";

/// What the crate of `check --typecheck` says of each mistake in a design. Where nothing is replaced there is nothing to
/// get wrong.
fn of_the_check(text: &str, all: &[&Swaps]) -> Vec<Option<Option<String>>> {
    let check = checked(text);
    let source = source(&check);
    let (folder, target) = (TempDir::new("seeds"), root().join("target/embassy-check"));
    for (path, file) in check.files.iter() {
        let _ = folder.write(path, &file.bytes);
    }
    let judge = |source: &str| {
        let _ = folder.write("src/lib.rs", source);
        refusal(folder.path(), &target, None)
    };
    assert_eq!(judge(&source), None, "the wiring is refused");
    let of = |swaps: &Swaps| {
        let wrong = swapped(&source, swaps);
        assert!(wrong != source, "{swaps:?} is not in\n{source}");
        judge(&wrong)
    };
    all.iter().map(|&swaps| (!swaps.is_empty()).then(|| of(swaps))).collect()
}

/// What the generated project says of each mistake.
fn of_the_project(all: &[&Mistake]) -> Vec<Option<Option<String>>> {
    let scratch = TempDir::new("seeds-project");
    let file = scratch.write("bench.sense", bench()).display().to_string();
    let out = scratch.join("out").display().to_string();
    let call = ["generate", &file, "--target", "embassy", "--without", "host", "-q", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    let project = scratch.join("out/firmware/Bench");
    let target = root().join("target/embassy-host");
    let host = Command::new("rustc").args(["--print", "host-tuple"]).output().unwrap();
    let host = String::from_utf8(host.stdout).unwrap();
    let sources: Vec<(String, String)> = tree(&project.join("src"))
        .into_iter()
        .filter(|(path, _)| path == "wiring.rs" || path == "main.rs")
        .map(|(path, bytes)| (path, String::from_utf8(bytes).unwrap()))
        .collect();
    let judge = |swaps: &Swaps| {
        let mut is_changed = swaps.is_empty();
        for (path, text) in &sources {
            let wrong = swapped(text, swaps);
            is_changed |= wrong != *text;
            std::fs::write(project.join("src").join(path), wrong).unwrap();
        }
        assert!(is_changed, "{swaps:?} is not in {}", sources[1].1);
        refusal(&project, &target, Some(host.trim()))
    };
    assert_eq!(judge(&[]), None, "the project is refused");
    let all = all.iter().map(|seed| seed.swaps("project"));
    all.map(|swaps| (!swaps.is_empty()).then(|| judge(swaps))).collect()
}

fn cell(judged: &Option<Option<String>>) -> String {
    match judged {
        None => "-".to_owned(),
        Some(None) => "taken".to_owned(),
        Some(Some(code)) => code.clone(),
    }
}

/// The wiring compiles, and no mistake does but those that are known to.
#[test]
fn mistakes_do_not_compile() {
    if !is_thorough() {
        return;
    }
    let all = mistakes("types.txt");
    let moved = all.iter().find(|one| !one.swaps("moved").is_empty()).unwrap();
    // The types also take mistakes that the profiles refuse: no crate is made with them.
    let is_tried = |one: &&Mistake| one.places.iter().any(|place| place.name != "moved");
    let seeds: Vec<&Mistake> = all.iter().filter(is_tried).collect();
    assert!(seeds.len() > 25, "{}", seeds.len());
    let swaps: Vec<&Swaps> = seeds.iter().map(|seed| seed.swaps("check")).collect();
    let check = of_the_check(&bench(), &swaps);
    let drawn: Vec<&Mistake> = seeds.iter().copied().filter(|one| is_drawn(&one.what)).collect();
    let mut of_project =
        if drawn.is_empty() { Vec::new() } else { of_the_project(&drawn) }.into_iter();
    let mut table =
        "| mistake | `check --typecheck` | the project |\n| --- | --- | --- |\n".to_owned();
    for (Mistake { what, why, .. }, check) in seeds.iter().zip(&check) {
        let project = &if is_drawn(what) { of_project.next().flatten() } else { None };
        let row = format!("| {what} | {} | {} |\n", cell(check), cell(project));
        if is_drawn(what) {
            table.push_str(&row);
        }
        let is_taken = *check == Some(None) || *project == Some(None);
        assert!(!is_taken || !why.is_empty(), "{what} compiles:\n{table}");
    }
    if is_exhaustive() {
        let what = &moved.what;
        let judged = of_the_check(MOVED, &[moved.swaps("moved")]).remove(0);
        assert_ne!(judged, Some(None), "{what} compiles");
        table.push_str(&format!("| {what} | {} | - |\n", cell(&judged)));
        if !is_whole() {
            return assert_rows("docs/seeded-mistakes.md", &table);
        }
        let mut section = format!("{table}\nThe types take:\n");
        for Mistake { what, why, .. } in all.iter().filter(|one| !one.why.is_empty()) {
            section.push_str(&format!("\n- **{what}**: {why}."));
        }
        section.push('\n');
        assert_section("docs/seeded-mistakes.md", HEADING, &section);
    }
}

const HEADING: &str = "In Rust, when it is compiled";

/// Two mistakes that the types of the HAL take: an encoder on a timer that decodes none, and periods on a timer of one
/// channel. The profiles of both targets refuse them.
#[test]
fn what_types_take_the_profile_refuses() {
    let is_wired = |target: &str, device: &str| {
        let mut workspace = Workspace::default();
        let link = "link { transport = none; }";
        workspace.open("x.sense", format!("board B on STM32F407VGT6 {{ {link}\n{device}\n}}\n"));
        let on = On { board: None, target: Some(target) };
        workspace.snapshot("x.sense", on, &NoFiles).solve(&Ask::default()).wired().is_some()
    };
    let encoder =
        |pins: &str| format!("sensor A returns int32 {{ id = 1; type = encoder; {pins} }}");
    let period = |pin: &str| {
        format!("sensor A returns uint32 {{ id = 1; type = icu; mode = period; pin = {pin}; }}")
    };
    for target in ["chibios", "embassy"] {
        assert!(is_wired(target, &encoder("a = PB4; b = PB5;")), "{target}: TIM3");
        assert!(!is_wired(target, &encoder("a = PE5; b = PE6;")), "{target}: TIM9");
        assert!(is_wired(target, &period("PB4")), "{target}: TIM3");
        assert!(!is_wired(target, &period("PB8")), "{target}: TIM10");
    }
}
