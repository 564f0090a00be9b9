//! The generated module `registry` matches `boards/` and `targets/`, and every file there is sound.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-board --test registry` writes the module again.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sensedsl_board::catalog::{self, Board};
use sensedsl_board::pin::natural;
use sensedsl_board::{form, profile, table};

/// The boards of which no public source says where their pins are, and the paper's, whose table has none.
const WITHOUT_PLACES: &[&str] = &[
    "B-G474E-DPOW1",
    "NUCLEO-L4P5ZG",
    "OLIMEX-STM32-E407",
    "P-NUCLEO-WB55-USBDONGLE",
    "STM32C0116-DK",
    "STM32F0DISCOVERY",
    "STM32F4DiscoveryBoard",
    "STM32F072B-DISCO",
    "STM32F3348-DISCO",
];

/// Contacts of which no public source says what they carry: how many of each connector.
const UNKNOWN_CONTACTS: &[(&str, &str, usize)] = &[
    ("ARDUINO-NANO-RP2040-CONNECT", "JP_VIN", 2),
    ("CLICKER2-STM32", "HDR2", 1),
    ("FEATHER-M0-ADALOGGER", "Feather", 1),
    ("FEATHER-M0-EXPRESS", "Feather", 1),
    ("FEATHER-RP2040-CAN", "Feather", 1),
    ("FEATHER-RP2350", "Feather", 2),
    ("METRO-ESP32-S2", "POWER", 1),
    ("METRO-M0-EXPRESS", "POWER", 1),
    ("METRO-M4-EXPRESS", "POWER", 1),
    ("METRO-NRF52840", "POWER", 1),
    ("METRO-RP2040", "POWER", 1),
    ("METRO-RP2350", "POWER", 1),
    ("NRF5340-DK", "P4_DIGITAL_H", 1),
    ("NUCLEO-C071RB", "CN10", 2),
    ("NUCLEO-C071RB", "CN7", 5),
    ("NUCLEO-H503RB", "CN10", 7),
    ("NUCLEO-H503RB", "CN7", 12),
    ("NUCLEO-H563ZI", "CN11", 1),
    ("NUCLEO-H563ZI", "CN12", 1),
    ("NUCLEO-L412RB-P", "CN5", 1),
    ("NUCLEO-L412RB-P", "CN6", 1),
    ("NUCLEO-L433RC-P", "CN5", 1),
    ("NUCLEO-L433RC-P", "CN6", 1),
    ("NUCLEO-L452RE-P", "CN5", 1),
    ("NUCLEO-L452RE-P", "CN6", 1),
    ("NUCLEO-L552ZE-Q", "CN11", 51),
    ("NUCLEO-L552ZE-Q", "CN12", 45),
    ("NUCLEO-U083RC", "CN10", 5),
    ("NUCLEO-U083RC", "CN7", 9),
    ("NUCLEO-U385RG-Q", "CN10", 19),
    ("NUCLEO-U385RG-Q", "CN7", 24),
    ("NUCLEO-WL55JC1", "CN10", 7),
    ("NUCLEO-WL55JC1", "CN7", 17),
    ("STM32F469I-DISCO", "CN12", 1),
    ("STM32H735G-DK", "ARD_DIGITAL_H", 4),
    ("STM32H735G-DK", "STMOD+", 4),
    ("STM32L-DISCOVERY", "P1", 4),
    ("STM32L-DISCOVERY", "P2", 4),
];

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
    text.push_str("];\n\n#[rustfmt::skip]\npub(crate) const FORMS: &[&str] = &[\n");
    for (file, _) in entries(&root().join("crates/board/forms")) {
        writeln!(text, "    {:?},", file.strip_suffix(".toml").unwrap()).unwrap();
    }
    text.push_str("];\n\n#[rustfmt::skip]\npub(crate) const TARGETS: &[Target] = &[\n");
    for (target, file, path) in targets() {
        let (family, parts) = (family(&read(&path)), parts(&read(&path)).join(" "));
        writeln!(text, "    target!({target:?}, {file:?}, {family:?}, {parts:?}),").unwrap();
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
    let mut names = BTreeSet::new();
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
            // The HALs of Embassy set the clocks, as their profiles say, and an Arduino has one.
            let is_of_profile = ["embassy", "arduino"].contains(&system.as_str());
            let has_clocks = !facts.clocks_hz.is_empty() || is_of_profile;
            assert!(has_clocks, "{}: no clocks", board.name);
        }
    }
}

/// Outline, connectors and sides of every form are consistent.
#[test]
fn every_form_is_sound() {
    for name in form::names() {
        let form = form::find(name).unwrap_or_else(|| panic!("{name} cannot be read"));
        assert_eq!(form.name, name);
        for connector in &form.connector {
            let mut numbers: Vec<u32> = connector.numbers().collect();
            numbers.sort_unstable();
            let all: Vec<u32> = (1..=u32::try_from(numbers.len()).unwrap()).collect();
            assert_eq!(numbers, all, "{name} {}", connector.name);
            for number in numbers {
                let at = connector.contact(number).unwrap();
                let is_inside = (0.0..=form.width_mm).contains(&at.x_mm)
                    && (0.0..=form.height_mm).contains(&at.y_mm);
                assert!(is_inside, "{name} {}.{number}: {at:?}", connector.name);
            }
        }
    }
}

/// A board has no places, or every pin on a connector has one, and all contacts of a connector are there.
#[test]
fn buttons_and_leds_are_on_their_boards() {
    let mut with = 0;
    for entry in catalog::all() {
        let table = entry.table();
        let landmarks = table.landmarks();
        with += usize::from(!landmarks.is_empty());
        let name = entry.name;
        for (at, one) in landmarks.iter().enumerate() {
            let form = table.form().unwrap();
            let [x, y] = one.at_mm;
            let is_inside =
                (0.0..=form.width_mm).contains(&x) && (0.0..=form.height_mm).contains(&y);
            assert!(is_inside, "{name}: {one:?}");
            for other in &landmarks[..at] {
                assert_ne!((&one.name, one.kind), (&other.name, other.kind), "{name}");
                let [dx, dy] = [x - other.at_mm[0], y - other.at_mm[1]];
                assert!(dx.hypot(dy) > 1.0, "{name}: {one:?} and {other:?}");
            }
        }
    }
    assert!(with >= 110, "{with} boards");
}

#[test]
fn places_are_complete() {
    let (mut without, mut unknown) = (Vec::new(), Vec::new());
    for entry in catalog::all() {
        let table = entry.table();
        if !table.has_places() {
            without.push(entry.name);
            continue;
        }
        let pins = table.pins.iter().flat_map(|pin| &pin.places);
        let places = pins.chain(table.contacts.iter().map(|contact| &contact.place));
        let mut numbers: BTreeMap<String, BTreeSet<u32>> = BTreeMap::new();
        for place in places {
            let header = place.header.clone().unwrap();
            let number = place.position.as_ref().unwrap().parse().unwrap();
            assert!(numbers.entry(header).or_default().insert(number), "{} {place:?}", entry.name);
        }
        for (header, numbers) in numbers {
            let form = table.form().and_then(|form| form.connector(&header));
            let all: BTreeSet<u32> = match form {
                Some(connector) => connector.numbers().collect(),
                None => (*numbers.first().unwrap()..=*numbers.last().unwrap()).collect(),
            };
            let missing = all.difference(&numbers).count();
            if missing > 0 {
                unknown.push((entry.name, header, missing));
            }
        }
    }
    assert_eq!(without, WITHOUT_PLACES);
    let unknown: Vec<_> =
        unknown.iter().map(|(board, header, count)| (*board, header.as_str(), *count)).collect();
    assert_eq!(unknown, UNKNOWN_CONTACTS);
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
