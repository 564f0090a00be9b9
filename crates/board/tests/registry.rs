//! The generated module `registry` matches `boards/` and `targets/`, and every file there is sound.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-board --test registry` writes the module again.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sensedsl_board::catalog::{self, Board};
use sensedsl_board::pin::natural;
use sensedsl_board::{profile, table};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The entries of a folder in natural order of their names.
fn entries(folder: &Path) -> Vec<(String, PathBuf)> {
    let mut found: Vec<(String, PathBuf)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), path))
        .collect();
    found.sort_by(|(a, _), (b, _)| natural(a, b));
    found
}

fn boards() -> Vec<(String, PathBuf)> {
    entries(&root().join("crates/board/boards"))
        .into_iter()
        .filter(|(_, path)| path.is_dir())
        .collect()
}

/// Target files as (`chibios-21.11`, `stm32f4.toml`, path).
fn targets() -> Vec<(String, String, PathBuf)> {
    let folders =
        entries(&root().join("crates/board/targets")).into_iter().filter(|(_, path)| path.is_dir());
    folders
        .flat_map(|(target, path)| {
            entries(&path).into_iter().map(move |(file, path)| (target.clone(), file, path))
        })
        .collect()
}

/// The family that a profile file is for.
fn family(text: &str) -> String {
    let file: toml::Table = toml::from_str(text).unwrap();
    file["family"].as_str().unwrap().to_owned()
}

/// The part-number prefixes that a profile file covers.
fn parts(text: &str) -> Vec<String> {
    let file: toml::Table = toml::from_str(text).unwrap();
    let lines = file["line"].as_array().unwrap();
    let parts = lines.iter().flat_map(|line| line["parts"].as_array().unwrap());
    parts.map(|part| part.as_str().unwrap().to_owned()).collect()
}

/// The module with its lists made anew.
fn generate(module: &str) -> String {
    let lists = "#[rustfmt::skip]\npub(crate) const BOARDS: &[Entry] = &[\n";
    let (head, _) = module.split_once(lists).unwrap();
    let mut text = format!("{head}{lists}");
    for (folder, path) in boards() {
        let board = Board::parse(&read(&path.join("board.toml"))).unwrap();
        assert_eq!(board.name, folder, "a board's folder has its name");
        writeln!(
            text,
            "    board!({:?}, &{:?}, {:?}, {:?}),",
            board.name, board.aliases, board.mcu, board.description,
        )
        .unwrap();
    }
    text.push_str("];\n\n#[rustfmt::skip]\npub(crate) const TARGETS: &[Target] = &[\n");
    for (target, file, path) in targets() {
        let (family, parts) = (family(&read(&path)), parts(&read(&path)));
        writeln!(text, "    target!({target:?}, {file:?}, {family:?}, &{parts:?}),").unwrap();
    }
    text.push_str("];\n");
    text
}

#[test]
fn the_registry_is_fresh() {
    let path = root().join("crates/board/src/registry.rs");
    let text = generate(&read(&path));
    if std::env::var("SENSEDSL_BLESS").is_ok() {
        std::fs::write(&path, &text).unwrap();
    }
    assert_eq!(read(&path), text, "run this test with SENSEDSL_BLESS=1");
}

#[test]
fn every_board_is_sound() {
    let mut names = std::collections::BTreeSet::new();
    for entry in catalog::all() {
        for name in std::iter::once(&entry.name).chain(entry.aliases) {
            assert_eq!(catalog::find(name), Some(entry), "{name} is the name of two boards");
            assert!(names.insert(name.to_lowercase()), "{name} stands twice");
        }
        let board = entry.board().unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        assert!(!board.source.is_empty(), "{}: no source", board.name);
        let loaded = table::load(entry.csv());
        assert_eq!(loaded.findings, [], "{}", entry.name);
        assert!(!loaded.board.pins.is_empty(), "{}: no pins", entry.name);
        let mcu = loaded.board.mcu.unwrap_or_else(|| board.mcu.clone());
        assert_eq!(mcu, board.mcu, "table and board name different MCUs");
        for (system, facts) in &board.system {
            // For a family without a profile, only the folders are known.
            let target = profile::find(system, &board.mcu);
            let known = matches!(target, Ok(_) | Err(profile::NoProfile::UnknownMcu { .. }));
            assert!(known, "{}: {target:?}", board.name);
            assert!(!facts.clocks_hz.is_empty(), "{}: no clocks", board.name);
        }
    }
}

#[test]
fn every_target_is_sound() {
    let files = targets();
    assert!(!files.is_empty());
    for (target, file, path) in files {
        let text = read(&path);
        assert_eq!(profile::check(&text), Ok(vec![]), "{target}/{file}");
        for part in parts(&text) {
            let found = profile::find(&target, &part.replace('?', "V"));
            let profile::Target::Profile(found) = found.unwrap() else { panic!("no profile") };
            assert_eq!(found.name, target);
        }
    }
}
