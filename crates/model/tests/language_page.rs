//! `docs/language.md` lists exactly the kinds and properties that exist. The binary contains
//! exactly the drivers in the folder `drivers/`, and all of them can be used.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use sensedsl_diagnostics::Severity;
use sensedsl_model::kind::{KindName, KindSpec, Role};
use sensedsl_model::{LIBRARY, NoFiles, Request, facts, resolve};
use sensedsl_syntax::parse;
use sensedsl_wire::Direction;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/language.md")).unwrap()
}

/// The names between backticks in the first column of the tables in the section `title`.
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
    distinct(|spec| spec.colour_on_dark.to_owned());
    distinct(|spec| spec.letter.to_string());
}

#[test]
fn every_kind_is_described_with_its_properties() {
    let page = page();
    let kinds: BTreeSet<String> = KindName::ALL.map(|kind| kind.name().to_owned()).into();
    assert_eq!(first_column(&page, "Kinds"), kinds);
    for kind in KindName::ALL {
        let described = first_column(&page, kind.name());
        // The page describes the properties that fix a wire once for all kinds. `trigger` is a wire
        // of an icu device and a property of its own for an i2c device.
        let wires = Role::ALL.map(Role::property);
        let is_wire = |name: &&&str| wires.contains(name) && !described.contains(**name);
        let own = kind.spec().properties.iter().filter(|name| !is_wire(name));
        let own: BTreeSet<String> = own.map(|name| (*name).to_owned()).collect();
        assert_eq!(described, own, "section {}", kind.name());
    }
}

#[test]
fn the_library_is_the_folder() {
    let entries = std::fs::read_dir(root().join("crates/model/drivers")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let names = names.filter(|name| name.ends_with(".sense"));
    let names: BTreeSet<String> = names.map(|name| format!("drivers/{name}")).collect();
    let embedded: BTreeSet<String> = LIBRARY.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(names, embedded);
}

/// Each driver is read as a part that uses everything the driver has: a chip with all values, or a
/// device.
#[test]
fn every_driver_serves_a_part() {
    let mistakes = facts::mistakes();
    let output = mistakes.iter().filter(|(_, one)| one.severity != Severity::Hint);
    let output: Vec<String> =
        output.map(|(name, one)| format!("{name}: {}", one.message)).collect();
    assert_eq!(output, [] as [&str; 0]);
    let written = LIBRARY.iter().flat_map(|(_, text)| parse(text).ast().drivers());
    let written: Vec<String> = written.map(|one| one.name().unwrap().text().to_owned()).collect();
    let read: Vec<String> = facts::all().into_iter().map(|part| part.name).collect();
    assert_eq!(read, written);
}

/// The facts that a part's page needs.
#[test]
fn every_driver_describes_its_part() {
    for part in facts::all() {
        let name = &part.name;
        assert!(!part.part.is_empty() && part.part != *name, "{name} lacks `part`");
        assert!(part.about.ends_with('.'), "{name}: `about` is not a sentence");
        assert!(part.sheet.is_some(), "{name} lacks `sheet`");
        assert!(!part.values.is_empty() && !part.connections.is_empty(), "{name}");
        let is_bus = part.kinds.contains(&KindName::I2c);
        assert!(!is_bus || !part.addresses.is_empty(), "{name} lacks `addresses`");
        let own = part.address.is_none_or(|one| part.addresses.contains(&one));
        assert!(own || !is_bus, "{name}: its address is not among its addresses");
        for value in &part.values {
            assert!(value.range().is_none_or(|(min, max)| min < max), "{name}: {value:?}");
        }
    }
}

/// Every name of a part finds it, and no two parts share a name.
#[test]
fn every_name_is_that_of_one_part() {
    let mut owners: BTreeMap<String, String> = BTreeMap::new();
    for part in facts::all() {
        let plain = |name: &String| name.to_lowercase().replace(['-', '_'], "");
        let mut names: Vec<String> = part.aliases.iter().map(plain).collect();
        names.push(plain(&part.name));
        names.sort();
        names.dedup();
        for name in names {
            let other = owners.insert(name.clone(), part.name.clone());
            assert_eq!(other, None, "`{name}` is also {}", part.name);
        }
    }
    let step = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 1 } else { 8 };
    for (name, owner) in owners.into_iter().step_by(step) {
        assert_eq!(facts::find(&name).unwrap().name, owner, "{name}");
    }
}

#[test]
fn misspelled_names_are_understood() {
    for (typed, meant) in [
        ("mpu605", "mpu6050"),
        ("hc_sr4", "hcsr04"),
        ("gy_52l", "mpu6050"),
        ("bme", "bme280"),
        ("vl53", "vl53l0x"),
        ("mpu6050_gyroscope", "mpu6050"),
        ("srf80", "srf08"),
        ("barometer", ""),
        ("bme688", ""),
        ("XYZ-9000", ""),
    ] {
        assert_eq!(facts::near(typed).meant.unwrap_or_default(), meant, "{typed}");
    }
}

/// A part that is not there leads to parts of its family, or of the sort that its name says; never to
/// one that only looks alike.
#[test]
fn parts_that_are_not_there_lead_to_similar_ones() {
    for (asked, first) in [
        ("bme688", "bme280"),
        ("ina233", "ina219"),
        ("max31850", "max31855"),
        ("lsm6dsl", "lsm6ds3"),
        ("barometer", "bmp280"),
        ("color_sensor", "tcs34725"),
        ("IMU", "mpu6050"),
        ("XYZ-9000", ""),
        ("max9814", ""),
        ("sensor", ""),
        ("esp32", ""),
        ("a1", ""),
    ] {
        let near = facts::near(asked);
        let found = near.meant.or_else(|| near.similar.first().cloned()).unwrap_or_default();
        assert_eq!(found, first, "{asked}: {:?}", near.similar);
    }
    for name in ["XYZ-9000", "3D-imu", "\u{e4}bc", ""] {
        let new = facts::identifier(name);
        assert!(new.starts_with(|one: char| one.is_ascii_alphabetic()), "{name}: {new}");
    }
}

/// The example of each part is in the canonical layout, short, and resolves.
#[test]
fn every_example_resolves() {
    let mut output = Vec::new();
    for part in facts::all() {
        let text = facts::example(&part);
        let name = &part.name;
        assert_eq!(sensedsl_syntax::format(&text).as_ref(), Ok(&text), "{name}");
        assert!(text.lines().count() <= 10, "{name}: {text}");
        let request = Request { path: "example.sense", text: &text, ..Request::default() };
        let resolved = resolve(&request, &NoFiles);
        let beyond = resolved.diagnostics.iter().filter(|one| one.severity != Severity::Hint);
        output.extend(beyond.map(|one| format!("{}: {}", part.name, one.message)));
    }
    assert_eq!(output, [] as [&str; 0]);
}

fn page_of_drivers() -> String {
    std::fs::read_to_string(root().join("docs/driver-language.md")).unwrap()
}

/// Every word that a driver can contain is in the first or second column of a table on the page,
/// and the properties listed there exist.
#[test]
fn the_driver_language_is_on_its_page() {
    let page = page_of_drivers();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| "));
    let cells = rows.clone().flat_map(|row| row.split(" | ").take(2));
    let quoted = |cell: &str| -> Vec<String> {
        cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    };
    let reported: BTreeSet<String> = cells.flat_map(quoted).collect();
    let words: BTreeSet<String> = facts::words_of_drivers().map(str::to_owned).collect();
    let missing: Vec<&String> = words.difference(&reported).collect();
    assert!(missing.is_empty(), "docs/driver-language.md lacks {missing:?}");
    for block in ["driver", "connection", "reading", "command"] {
        assert!(reported.iter().any(|one| one.starts_with(&format!("{block} "))), "{block}");
    }
    for title in ["How the part is started", "Where a value stands", "What is said of the part"] {
        let known = |name: &String| words.contains(name) || ["level", "pull"].contains(&&**name);
        let unknown: Vec<String> =
            first_column(&page, title).into_iter().filter(|name| !known(name)).collect();
        assert!(unknown.is_empty(), "{title}: {unknown:?}");
    }
}

/// The examples on the page are accepted as written.
#[test]
fn examples_of_the_driver_page_resolve() {
    let page = page_of_drivers();
    let examples: Vec<&str> =
        page.split("```sense\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(examples.len() >= 3);
    for text in examples {
        let request = Request { path: "example.sense", text, ..Request::default() };
        let output = resolve(&request, &NoFiles).diagnostics;
        let output: Vec<&str> = output
            .iter()
            .filter(|one| one.severity != Severity::Hint)
            .map(|one| one.message.as_str())
            .collect();
        assert!(output.is_empty(), "{text}\n{output:?}");
    }
}
