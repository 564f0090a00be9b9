//! `docs/language.md` lists the kinds, properties and drivers that there are, and the library that is
//! part of the binary is the folder `drivers/`.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_model::kind::{KindName, KindSpec, Role};
use sensedsl_model::{Files, LIBRARY, Request, Unread, Wanted, resolve};
use sensedsl_syntax::parse;
use sensedsl_wire::Direction;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/language.md")).unwrap()
}

/// The names between back quotes in the first column of the tables of the section `title`.
fn first_column(page: &str, title: &str) -> BTreeSet<String> {
    let section = page.split("\n#").find_map(|section| {
        let (head, body) = section.split_once('\n')?;
        (head.trim_start_matches('#').trim() == title).then_some(body)
    });
    let rows = section.unwrap_or_default().lines().filter_map(|line| line.strip_prefix("| "));
    let cells = rows.filter_map(|row| row.split(" |").next());
    cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(str::to_owned).collect()
}

/// The rows of the table of kinds.
fn table_of_kinds() -> String {
    let row = |kind: KindName| {
        let spec = kind.spec();
        let direction = match spec.directions {
            [Direction::Sensor] => "sensor",
            [Direction::Actuator] => "actuator",
            _ => "both",
        };
        format!("| `{}` | {direction} | {} | {} |\n", spec.name, spec.values.shown(), spec.wires)
    };
    KindName::ALL.into_iter().map(row).collect()
}

#[test]
fn the_table_of_kinds_is_that_of_the_registry() {
    const HEAD: &str = "| kind | direction | values | wires |\n| --- | --- | --- | --- |\n";
    let page = page();
    let (before, rest) = page.split_once(HEAD).unwrap();
    let (rows, after) = rest.split_once("\n\n").unwrap();
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        let table = format!("{before}{HEAD}{}\n{after}", table_of_kinds());
        std::fs::write(root().join("docs/language.md"), table).unwrap();
    } else {
        assert_eq!(format!("{rows}\n"), table_of_kinds(), "SENSEDSL_BLESS=1 writes it");
    }
}

#[test]
fn every_wire_is_named() {
    let page = page();
    let start = page.find("is least in natural order").unwrap();
    let order = page.get(..start).unwrap().rsplit("\n\n").next().unwrap();
    for role in Role::ALL {
        assert!(order.contains(&format!("`{role}`")), "the tie-break on the page lacks {role}");
    }
}

#[test]
fn kinds_can_be_told_apart() {
    let specs = KindName::ALL.map(KindName::spec);
    let distinct = |of: fn(&KindSpec) -> String| {
        let all: BTreeSet<String> = specs.iter().map(|spec| of(spec)).collect();
        assert_eq!(all.len(), specs.len(), "two kinds have one of these: {all:?}");
    };
    distinct(|spec| spec.name.to_owned());
    distinct(|spec| spec.colour.to_owned());
    distinct(|spec| spec.letter.to_string());
}

#[test]
fn every_kind_is_described_with_its_properties() {
    let page = page();
    let kinds: BTreeSet<String> = KindName::ALL.map(|kind| kind.name().to_owned()).into();
    assert_eq!(first_column(&page, "Kinds"), kinds);
    for kind in KindName::ALL {
        let described = first_column(&page, kind.name());
        // The page describes the properties that fix a wire once for all kinds. `trigger` is a wire of an
        // icu and a property of its own of an i2c device.
        let wires = Role::ALL.map(Role::property);
        let is_wire = |name: &&&str| wires.contains(name) && !described.contains(**name);
        let own = kind.spec().properties.iter().filter(|name| !is_wire(name));
        let own: BTreeSet<String> = own.map(|name| (*name).to_owned()).collect();
        assert_eq!(described, own, "section {}", kind.name());
    }
}

#[test]
fn every_driver_is_listed_under_its_kind() {
    let mut by_kind: BTreeMap<String, String> = BTreeMap::new();
    for (_, text) in LIBRARY {
        for driver in parse(text).ast().drivers() {
            let (name, kind) = (driver.name().unwrap(), driver.kind().unwrap());
            by_kind.insert(name.text().to_owned(), kind.text().to_owned());
        }
    }
    let page = page();
    let listed = first_column(&page, "Drivers and use");
    assert_eq!(listed, by_kind.keys().cloned().collect());
    for (name, kind) in by_kind {
        let row = page.lines().find(|line| line.starts_with("| `") && line.contains(&name));
        assert!(row.is_some_and(|row| row.contains(&format!("| {kind} |"))), "{name}: {row:?}");
    }
}

#[test]
fn the_library_is_the_folder() {
    let entries = std::fs::read_dir(root().join("drivers")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let names: BTreeSet<String> = names.map(|name| format!("drivers/{name}")).collect();
    let embedded: BTreeSet<String> = LIBRARY.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(names, embedded, "LIBRARY in crates/model/src/drivers.rs");
}

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, wanted: &Wanted<'_>) -> Result<String, Unread> {
        Err(Unread::Why(format!("{} is not there", wanted.path)))
    }
}

/// A device with each driver of the library: no property of a driver is unknown or wrong.
#[test]
fn every_driver_serves_a_device() {
    for (file, text) in LIBRARY {
        for driver in parse(text).ast().drivers() {
            let (name, kind) = (driver.name().unwrap(), driver.kind().unwrap());
            let head = match kind.text() {
                "pwm" | "dac" => "actuator A accepts uint16",
                _ => "sensor A returns int32",
            };
            let address = if kind.text() == "i2c" { "address = 0x40;" } else { "" };
            let (name, kind) = (name.text(), kind.text());
            let design = format!(
                "board STM32F407G_DISC1 {{ {head} {{ id = 1; type = {kind}; driver = {name}; {address} }} }}"
            );
            let request = Request { path: "test.sense", text: &design, ..Request::default() };
            let resolved = resolve(&request, &NoFiles);
            // How wide the value should be is another question: a warning at most.
            let errors = resolved.diagnostics.iter().filter(|one| one.severity == Severity::Error);
            assert_eq!(errors.collect::<Vec<_>>(), [] as [&Diagnostic; 0], "{file}: {name}");
        }
    }
}
