//! Cores, flash and RAM of the parts, and what ST's open pin data say of them if
//! `SENSEDSL_ST_PIN_DATA` names the folder.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use sensedsl_parts::{Part, all, find};

/// Cores, flash and RAM in KB.
type Facts = (String, f64, f64);

#[expect(clippy::cast_precision_loss, reason = "memories are far below 2^52 bytes")]
fn facts(part: Part) -> Facts {
    let cores: Vec<&str> = part.cores().collect();
    let kb = |bytes: usize| bytes as f64 / 1024.0;
    (cores.join(" + "), kb(part.flash_bytes().unwrap_or(0)), kb(part.ram_bytes()))
}

/// Figures of data sheets.
#[test]
fn memory_is_that_of_the_data_sheets() {
    for (name, core, flash, ram) in [
        ("STM32F030F4P6", "Cortex-M0", 16.0, 4.0),
        ("STM32F103C8T6", "Cortex-M3", 64.0, 20.0),
        // With memory that only the core reaches.
        ("STM32F303VCT6", "Cortex-M4", 256.0, 48.0),
        ("STM32F407VGT6", "Cortex-M4", 1024.0, 192.0),
        // Two banks of flash, or one: the sum is the same.
        ("STM32F767ZIT6", "Cortex-M7", 2048.0, 528.0),
        ("STM32F413ZHT6", "Cortex-M4", 1536.0, 320.0),
        ("STM32G031J6M6", "Cortex-M0+", 32.0, 8.0),
        // SRAM2 is elsewhere than SRAM1.
        ("STM32L476RGT6", "Cortex-M4", 1024.0, 128.0),
        ("STM32H563ZIT6", "Cortex-M33", 2048.0, 640.0),
        ("STM32H743ZIT6", "Cortex-M7", 2048.0, 1056.0),
        ("STM32H745ZIT6", "Cortex-M7 + Cortex-M4", 2048.0, 1056.0),
        ("STM32H7R3V8T6", "Cortex-M7", 64.0, 616.0),
        ("STM32U575ZIT6", "Cortex-M33", 2048.0, 784.0),
        ("STM32WB05KZV6", "Cortex-M0+", 192.0, 24.0),
        ("STM32WB55CGU6", "Cortex-M4", 1024.0, 256.0),
        ("STM32WL55CCU6", "Cortex-M4 + Cortex-M0+", 256.0, 64.0),
        // No flash inside.
        ("STM32N657X0", "Cortex-M55", 0.0, 4224.0),
        ("RP2040", "Cortex-M0+ + Cortex-M0+", 0.0, 264.0),
        ("RP2350B", "Cortex-M33 + Cortex-M33", 0.0, 520.0),
        ("ATMEGA168-20AU", "AVR8", 16.0, 1.0),
        ("ATMEGA328P-AU", "AVR8", 32.0, 2.0),
        ("ATMEGA32U4-AU", "AVR8", 32.0, 2.5),
        ("ATMEGA1284P-AU", "AVR8", 128.0, 16.0),
        ("ATMEGA2560-16AU", "AVR8", 256.0, 8.0),
        ("ESP32-S3", "Xtensa LX7 + Xtensa LX7", 0.0, 480.0),
        ("NRF52840-QIAA", "Cortex-M4", 1024.0, 256.0),
        ("ATSAMD21G18A-AU", "Cortex-M0+", 256.0, 32.0),
        ("ATSAMD51J19A-AU", "Cortex-M4", 512.0, 192.0),
    ] {
        let found = find(name).unwrap_or_else(|| panic!("{name}"));
        assert_eq!(facts(found.parts[0]), (core.to_owned(), flash, ram), "{name}");
    }
}

#[test]
fn every_part_has_a_core_and_ram() {
    let mut cores: BTreeMap<String, usize> = BTreeMap::new();
    let mut without_flash = BTreeSet::new();
    for part in all() {
        let (core, flash, ram) = facts(part);
        *cores.entry(core).or_default() += 1;
        assert!((1.0..8192.0).contains(&ram), "{}: {ram}", part.name());
        assert!(flash <= 4096.0, "{}: {flash}", part.name());
        if part.flash_bytes().is_none() {
            without_flash.insert(part.name().chars().take(6).collect::<String>());
        }
    }
    let names: Vec<&str> = cores.keys().map(String::as_str).collect();
    let expected = "AVR8, Cortex-M0, Cortex-M0+, Cortex-M0+ + Cortex-M0+, Cortex-M3, Cortex-M33, \
                    Cortex-M33 + Cortex-M33, Cortex-M4, Cortex-M4 + Cortex-M0+, Cortex-M55, \
                    Cortex-M7, Cortex-M7 + Cortex-M4, RISC-V, Xtensa LX6 + Xtensa LX6, Xtensa LX7, \
                    Xtensa LX7 + Xtensa LX7";
    assert_eq!(names.join(", "), expected);
    let expected = ["ESP32", "ESP32-", "MIMXRT", "RP2040", "RP2350", "STM32N"];
    assert_eq!(Vec::from_iter(without_flash), expected);
}

/// The facts of ST's file of an MCU, by part number.
fn of_st(path: &Path) -> Vec<(String, Facts)> {
    let text = fs::read_to_string(path).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    let texts = |name: &str| -> Vec<String> {
        let nodes = root.children().filter(|node| node.tag_name().name() == name);
        nodes.filter_map(|node| Some(node.text()?.replace("ARM", "Arm"))).collect()
    };
    let numbers =
        |name: &str| -> Vec<f64> { texts(name).iter().map(|text| text.parse().unwrap()).collect() };
    // `STM32F407V(E-G)Tx` is two parts, with as many sizes of flash and of RAM, or one for both.
    let reference = root.attribute("RefName").unwrap();
    let names: Vec<String> = match reference.split_once('(') {
        None => vec![reference.to_owned()],
        Some((start, rest)) => {
            let (sizes, end) = rest.split_once(')').unwrap();
            sizes.split('-').map(|size| format!("{start}{size}{end}")).collect()
        }
    };
    let of = |sizes: &[f64], at: usize| *sizes.get(at).or(sizes.last()).unwrap_or(&0.0);
    let (flash, ram, ccm) = (numbers("Flash"), numbers("Ram"), numbers("CCMRam"));
    let cores: Vec<String> = texts("Core").iter().map(|core| core.replace("Arm ", "")).collect();
    let facts = |at: usize| (cores.join(" + "), of(&flash, at), of(&ram, at) + of(&ccm, at));
    names.into_iter().enumerate().map(|(at, name)| (name, facts(at))).collect()
}

/// Differences in RAM between ST's data and the table: parts, how many KB more ST's data have, for
/// how many part numbers, and why. The data sheets agree with the table.
const DIFFERENCES: [(&str, f64, usize, &str); 13] = [
    ("F303 F358", -8.0, 10, "the RAM of the core (CCM) is left out"),
    ("F303 F398", -16.0, 10, "the RAM of the core (CCM) is left out"),
    ("F72 F73 F76 F77", -16.0, 86, "the RAM for instructions (ITCM) is left out"),
    ("F745 F746 F750 F756", 48.0, 37, "64 KB of DTCM are counted twice, 16 KB of ITCM left out"),
    ("G491 G4A1", 16.0, 27, "16 KB of CCM are counted twice"),
    ("H72 H73 H7R H7S", 4.0, 76, "the RAM of the backup domain is counted"),
    ("U5", 2.0, 162, "the RAM of the backup domain is counted"),
    ("H742", 368.0, 16, "the figures are those of H743"),
    ("H7A3 H7B", 48.0, 50, "more than the 1376 KB, and 4 KB of backup, of the data sheets"),
    ("L100C6", 6.0, 1, "the figure is that of the largest part before revision A"),
    ("L100R8", 2.0, 1, "the figure is that of the largest part before revision A"),
    ("L100RB", -6.0, 1, "the figure is that of the largest part before revision A"),
    ("N6", -24.0, 24, "4224 KB are rounded to 4200"),
];

#[test]
fn memory_is_that_of_st() {
    let Some(folder) = std::env::var_os("SENSEDSL_ST_PIN_DATA") else {
        return eprintln!("SKIPPED: SENSEDSL_ST_PIN_DATA names no folder with ST's open pin data");
    };
    let entries = fs::read_dir(Path::new(&folder).join("mcu")).unwrap();
    let paths: BTreeSet<_> = entries.map(|entry| entry.unwrap().path()).collect();
    let (mut seen, mut agreeing) = (0, 0);
    let mut counts = [0; DIFFERENCES.len()];
    for path in paths.iter().filter(|path| path.extension().is_some_and(|end| end == "xml")) {
        for (name, theirs) in of_st(path) {
            let Some(found) = find(&name).filter(|found| found.mcu.len() == name.len()) else {
                continue;
            };
            seen += 1;
            let ours = facts(found.parts[0]);
            assert_eq!((&ours.0, ours.1), (&theirs.0, theirs.1), "{name}");
            let more = theirs.2 - ours.2;
            if more == 0.0 {
                agreeing += 1;
                continue;
            }
            let known = DIFFERENCES.iter().position(|(lines, by, ..)| {
                let line = name.strip_prefix("STM32").unwrap_or_default();
                *by == more && lines.split(' ').any(|start| line.starts_with(start))
            });
            let at = known.unwrap_or_else(|| panic!("{name}: RAM {} of us, {}", ours.2, theirs.2));
            counts[at] += 1;
        }
    }
    for ((lines, by, most, why), count) in DIFFERENCES.iter().zip(counts) {
        assert_eq!(count, *most, "{lines}: ST has {by} KB more: {why}");
    }
    eprintln!("{seen} parts: cores and flash agree on all, RAM on {agreeing}");
    assert!(seen > 2_300 && agreeing * 100 > seen * 75, "{agreeing} of {seen}");
}
