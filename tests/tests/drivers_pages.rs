//! `docs/drivers/` agrees with the library of drivers, and each part's example can be wired.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests drivers_pages::` rewrites the pages.
#![expect(
    clippy::indexing_slicing,
    clippy::unwrap_used,
    reason = "a test reads its data, and a panic is its failure"
)]

use std::collections::BTreeMap;

use sensedsl_diagnostics::Severity;
use sensedsl_model::facts::{self, EXAMPLE_BOARD};
use sensedsl_report::drivers;
use sensedsl_tests::{Scratch, root, sensedsl};

const INTRO: &str = "# Drivers

The library of drivers that ships with the tool: what a part is, how it is wired, and what its values are. `driver =
NAME;` in a [device or a chip](../language.md#drivers-and-use) takes all of it over. A part is also found by what else
people call it, in letters of any case, with `-` or `_` or neither: `driver = \"GY-521\";` is `mpu6050`.

`sensedsl drivers` lists the drivers, `sensedsl drivers --search WORDS` those with all of the words in what is known of
them, `sensedsl drivers --kind i2c` those of a kind, and `sensedsl drivers NAME` tells all about one.

A page says where the figures are from, and with which second text they were compared. None of the parts was tried on a
bench. The names of parts are those of their makers.

These pages are made from `drivers/`.
";

/// All pages as the library gives them, by name.
fn pages() -> BTreeMap<String, String> {
    let parts = facts::all();
    let mut pages: BTreeMap<String, String> =
        parts.iter().map(|part| (format!("{}.md", part.name), drivers::page(part))).collect();
    pages.insert("README.md".to_owned(), drivers::index(&parts, INTRO));
    pages
}

#[test]
fn the_pages_are_fresh() {
    let folder = root().join("docs/drivers");
    let wanted = pages();
    if std::env::var("SENSEDSL_BLESS").is_ok() {
        std::fs::create_dir_all(&folder).unwrap();
        for entry in std::fs::read_dir(&folder).unwrap() {
            std::fs::remove_file(entry.unwrap().path()).unwrap();
        }
        for (name, text) in &wanted {
            std::fs::write(folder.join(name), text).unwrap();
        }
    }
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(&folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().to_string_lossy().into_owned();
        found.insert(name, std::fs::read_to_string(entry.path()).unwrap());
    }
    let names = |pages: &BTreeMap<String, String>| pages.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&wanted), "SENSEDSL_BLESS=1");
    let stale = wanted.iter().filter(|(name, text)| found.get(*name) != Some(text));
    let stale: Vec<&String> = stale.map(|(name, _)| name).collect();
    assert!(stale.is_empty(), "{stale:?} are not what drivers/ says: SENSEDSL_BLESS=1");
}

/// Each example is wired on a common board, with no diagnostics except hints.
#[test]
fn every_example_is_wired() {
    let mut said = Vec::new();
    for part in facts::all() {
        let text = facts::example(&part);
        let on = sensedsl_session::On::default();
        let mut workspace = sensedsl_session::Workspace::default();
        workspace.open("example.sense", text);
        let snapshot = workspace.snapshot("example.sense", on, &sensedsl_model::NoFiles);
        let answer = snapshot.solve(&sensedsl_session::Ask::default());
        if answer.wired().is_none() {
            said.push(format!("{EXAMPLE_BOARD} does not carry {}", part.name));
        }
        let beyond = answer.diagnostics.iter().filter(|one| one.severity != Severity::Hint);
        said.extend(beyond.map(|one| format!("{}: {} {}", part.name, one.code, one.message)));
    }
    assert_eq!(said, [] as [&str; 0]);
}

#[test]
fn the_list_fits_a_terminal_and_finds_parts() {
    let all = sensedsl(["drivers"]).run().exits(0);
    for part in facts::all() {
        let line = format!("\n  {} ", part.name);
        assert!(all.stdout.contains(&line), "{}", part.name);
    }
    for line in all.stdout.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let gyros = sensedsl(["drivers", "--kind", "spi", "--search", "InvenSense"]).run().exits(0);
    assert!(gyros.stdout.contains("mpu6500_spi"), "{}", gyros.stdout);
    assert!(!gyros.stdout.contains("as5047p"), "{}", gyros.stdout);
    assert!(gyros.stderr.contains("1 driver;"), "{}", gyros.stderr);
    let _ = sensedsl(["drivers", "--kind", "i3c"]).run().exits(2);
    for (words, found, other) in [
        ("barometer", "bmp280", "lm75"),
        ("expander", "mcp23017", "tb6612"),
        ("quad", "esc_400hz", "lm75"),
        ("imu", "mpu6050", "bh1750"),
        ("lidar", "tfmini", "srf08"),
        ("motor driver", "drv8833", "quadrature_encoder"),
        ("Motor Drivers", "drv8833", "quadrature_encoder"),
        ("can", "vesc", "relay"),
    ] {
        let list = sensedsl(["drivers", "--search", words]).run().exits(0).stdout;
        assert!(list.contains(&format!("\n  {found} ")), "{words}: {list}");
        assert!(!list.contains(&format!("\n  {other} ")), "{words}: {list}");
    }
}

#[test]
fn a_part_is_told_by_any_of_its_names() {
    let plain = sensedsl(["drivers", "mpu6050"]).run().exits(0).stdout;
    for name in ["GY-521", "MPU-6050", "Mpu_6050"] {
        assert_eq!(sensedsl(["drivers", name]).run().exits(0).stdout, plain, "{name}");
    }
    for told in ["InvenSense MPU-6050", "0x68", "RIOT", "1/16384", "-2 to 2", "AD0", "deg/s"] {
        assert!(plain.contains(told), "{told}: {plain}");
    }
    let missing = sensedsl(["drivers", "mpu6055"]).run().exits(2);
    assert!(missing.stderr.contains("did you mean mpu6050?"), "{}", missing.stderr);
    let word = sensedsl(["drivers", "barometer"]).run().exits(2);
    assert!(word.stderr.contains("sensedsl drivers"), "{}", word.stderr);
}

/// The description of a part fits a terminal, except for a single value that is too long by itself.
#[test]
fn what_is_told_fits_a_terminal() {
    let mut wide = Vec::new();
    for part in facts::all() {
        let text = drivers::one(&part);
        let long = text.lines().filter(|line| line.chars().count() > 80);
        wide.extend(long.map(|line| format!("{}: {line}", part.name)));
    }
    assert_eq!(wide, [] as [&str; 0]);
}

#[test]
fn programs_read_the_same() {
    let all = sensedsl(["drivers", "--format", "json"]).run().exits(0).json();
    assert_eq!(all["version"], 1);
    assert_eq!(all["drivers"].as_array().unwrap().len(), facts::all().len());
    let one = sensedsl(["drivers", "gy521", "--format", "json"]).run().exits(0).json();
    let part = &one["drivers"][0];
    assert_eq!(part["name"], "mpu6050");
    assert_eq!(part["identity"]["register"], 0x75);
    assert_eq!(part["values"][0]["type"], "int16[3]");
    assert_eq!(part["values"][0]["scale"], 1.0 / 16_384.0);
    // The example is a complete file that can be solved.
    let folder = Scratch::new("driver_example");
    let file = folder.write("example.sense", part["example"].as_str().unwrap());
    let _ = sensedsl(["solve"]).arg(file).run().exits(0);
}
