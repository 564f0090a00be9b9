//! The registers of ranges and rates act on a part's values, as its data sheet says.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use sensedsl_model::facts;
use sensedsl_model::protocol::InitStep;

use crate::run::{mistaken, with_job};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// A driver of the library with another name and a changed text.
fn changed(driver: &str, find: &str, with: &str) -> String {
    let mut files: Vec<_> = fs::read_dir(root().join("crates/model/drivers"))
        .unwrap()
        .map(|one| one.unwrap().path())
        .collect();
    files.sort();
    let head = format!("driver {driver} for ");
    let found = files.iter().find_map(|path| {
        let text = fs::read_to_string(path).unwrap();
        let from = text.find(&head)?;
        let end = text[from..].find("\n}\n")?;
        Some(text[from..from + end + 3].to_owned())
    });
    let own = found.unwrap_or_else(|| panic!("no {driver}"));
    assert!(own.contains(find), "{driver} has no {find}");
    let aliases = own.lines().filter(|line| !line.trim_start().starts_with("aliases"));
    let text = aliases.collect::<Vec<_>>().join("\n");
    text.replacen(&head, "driver mistaken_part for ", 1).replacen(find, with, 1)
}

/// The values with findings when a part is set up in another way.
fn wrong(driver: &str, find: &str, with: &str, world: &str) -> Vec<String> {
    let board = |driver: &str| {
        format!("board STM32F407G_DISC1 {{ chip Part {{ driver = {driver}; delay = 20 ms; }} }}")
    };
    let mistake = format!("{}\n{}", changed(driver, find, with), board("mistaken_part"));
    let run = mistaken(&board(driver), &mistake, world, 6);
    run.judged.iter().filter(|one| one.wrong > 0).map(|one| one.name.clone()).collect()
}

#[test]
fn another_range_is_seen() {
    let cases: [(&str, &str, &str, &[&str]); 11] = [
        ("mpu6050", "[0x1C, 0x00]", "[0x1C, 0x08]", &["PartAcceleration"]),
        ("mpu6050", "[0x1B, 0x00]", "[0x1B, 0x18]", &["PartRate"]),
        ("mpu6500", ", [0x1B, 0x00]", "", &[]),
        ("lsm6ds3", "[0x10, 0x50]", "[0x10, 0x5C]", &["PartAcceleration"]),
        ("lsm6ds3", "[0x11, 0x50]", "[0x11, 0x00]", &["PartRate"]),
        ("lsm9ds1", "[0x20, 0x60]", "[0x20, 0x68]", &["PartAcceleration"]),
        ("adxl345", "[0x31, 0x0B]", "[0x31, 0x01]", &["Part"]),
        ("adxl345", "[0x31, 0x0B]", "[0x31, 0x08]", &[]),
        ("l3gd20", "[0x23, 0x80]", "[0x23, 0xA0]", &["Part"]),
        ("hmc5883l", "[0x01, 0x20]", "[0x01, 0x60]", &["Part"]),
        ("bme280", "[0xF2, 0x01], ", "", &["PartHumidity"]),
    ];
    for (driver, find, with, names) in cases {
        let found = wrong(driver, find, with, "");
        let is_right = |name: &&str| found.iter().any(|own| own.starts_with(*name));
        assert!(found.len() == names.len() && names.iter().all(is_right), "{driver}: {found:?}");
    }
}

/// A board built from a driver without `identity` reads the part but not its identity.
#[test]
fn an_identity_that_is_not_read_is_seen() {
    let board = |driver: &str| {
        format!("board STM32F407G_DISC1 {{ chip Part {{ driver = {driver}; delay = 20 ms; }} }}")
    };
    let other = changed("bmp280", "identity = [0xD0, 0x58];", "");
    let run = mistaken(&board("bmp280"), &format!("{other}\n{}", board("mistaken_part")), "", 3);
    let found: Vec<_> = run.unasked.iter().map(|one| (one.name.as_str(), one.is_known)).collect();
    assert_eq!(found, [("Part", true)]);
    let right = mistaken(&board("bmp280"), &board("bmp280"), "", 3);
    assert!(right.unasked.is_empty(), "{:?}", right.unasked);
}

#[test]
fn another_rate_is_seen() {
    let world = "[devices]\nPartAcceleration = { sine = 1.5, offset = 0, period = \"1 s\" }\n";
    assert_eq!(wrong("adxl345", "[0x2C, 0x0A]", "[0x2C, 0x09]", world), [""; 0]);
    let found = wrong("adxl345", "[0x2C, 0x0A]", "[0x2C, 0x05]", world);
    assert_eq!(found.len(), 1, "{found:?}");
}

/// The table and the library have the same numbers from different sources: with the registers that a driver writes, a
/// unit has as many counts as its scale says.
#[test]
fn the_scales_of_the_library_are_those_of_the_table() {
    let table = fs::read_to_string(root().join("crates/twin/src/parts/ranges.csv")).unwrap();
    let parts = facts::all();
    let mut compared = 0;
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [driver, reading, register, mask, reset, codes] = cells[..] else { panic!("{line}") };
        let part = parts.iter().find(|part| part.name == driver);
        let part = part.unwrap_or_else(|| panic!("no driver {driver}"));
        let value =
            part.values.iter().find(|one| one.name.as_deref().is_none_or(|name| name == reading));
        let value = value.unwrap_or_else(|| panic!("{line}"));
        let (Some(scale), None) = (value.shown.scale, value.coding.output) else { continue };
        let number = |text: &str| u16::from_str_radix(&text[2..], 16).unwrap();
        let written = init(part);
        let code = written.get(&number(register)).copied();
        let code = code.unwrap_or(number(reset) as u8) & number(mask) as u8;
        let counts = codes.split(' ').find_map(|one| {
            let (own, counts) = one.split_once('=').unwrap();
            (number(own) == u16::from(code)).then(|| counts.parse::<f64>().unwrap())
        });
        let counts = counts.unwrap_or_else(|| panic!("{line}: 0x{code:02X}"));
        assert!((counts * scale - 1.0).abs() < 0.01, "{line}: {counts} counts of {scale}");
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

/// The register contents that a driver leaves in its part.
fn init(part: &facts::PartFacts) -> BTreeMap<u16, u8> {
    let text = facts::example(part);
    with_job(&text, |job| {
        let mut all = BTreeMap::new();
        for step in job
            .connections
            .iter()
            .filter_map(|one| one.part.chip.as_ref())
            .flat_map(|own| &own.init)
        {
            if let InitStep::Write(bytes) = step {
                all.extend((u16::from(bytes[0])..).zip(bytes[1..].iter().copied()));
            }
        }
        all
    })
}
