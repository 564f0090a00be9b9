//! All MCU files and projects of ST's open pin data, in the folder that `SENSEDSL_ST_PIN_DATA`
//! names: each is imported, or refused with a coded reason, and the output is read again without a
//! mistake.
#![cfg(test)]
#![allow(clippy::disallowed_methods, missing_docs, reason = "a test over files of the machine")]

use sensedsl_board::pin::PinName;
use sensedsl_board::silicon::{self, PinRole};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_board::table;
use sensedsl_import::{Format, Imported, Importer, Source};
use sensedsl_model::{FileRequest, Files, ReadError, Request, resolve};

/// The folder, or a note that the test is skipped.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("SENSEDSL_ST_PIN_DATA").map(PathBuf::from);
    if folder.is_none() {
        eprintln!("SKIPPED: SENSEDSL_ST_PIN_DATA names no folder with ST's open pin data");
    }
    folder
}

fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|found| found == ending)).collect();
    files.sort();
    files
}

fn imported(path: &Path) -> Imported {
    imported_with(&Importer::default(), path)
}

fn imported_with(importer: &Importer, path: &Path) -> Imported {
    let bytes = fs::read(path).unwrap();
    let folder = path.parent().unwrap();
    let name = path.file_name().unwrap().to_string_lossy();
    let beside = |path: &str| fs::read(folder.join(path)).map_err(|_| ReadError::Missing);
    importer.import(&Source {
        name: &name,
        bytes: &bytes,
        format: None,
        sheet: None,
        table: "pins.csv",
        beside: &beside,
    })
}

#[test]
fn every_mcu_is_imported() {
    let Some(data) = data() else { return };
    let paths = files(&data.join("mcu"), "xml");
    assert!(paths.len() >= 2_000, "{} files", paths.len());
    let importer = Importer::default();
    let mut reported: BTreeMap<String, usize> = BTreeMap::new();
    let mut distinct: BTreeMap<String, (PathBuf, String)> = BTreeMap::new();
    for path in &paths {
        let made = imported_with(&importer, path);
        assert!(!made.failed(), "{}: {:?}", path.display(), made.diagnostics);
        for one in &made.diagnostics {
            *reported.entry(one.code.to_string()).or_default() += 1;
        }
        let csv = made.table.unwrap();
        let rows = csv.split_once("\nPin").unwrap().1.to_owned();
        distinct.entry(rows).or_insert((path.clone(), csv));
    }
    let (mut pins, mut shared) = (0, 0);
    for (path, csv) in distinct.values() {
        let loaded = table::load(csv);
        assert!(loaded.findings.is_empty(), "{}: {:?}", path.display(), loaded.findings);
        assert_eq!(loaded.board.to_csv(), *csv, "{}", path.display());
        pins += loaded.board.pins.len();
        let mut positions: Vec<_> =
            loaded.board.pins.iter().map(|pin| pin.package_position()).collect();
        positions.sort();
        shared += usize::from(positions.windows(2).any(|pair| pair[0] == pair[1]));
    }
    eprintln!(
        "{} MCU files, {} tables, {pins} pins, {shared} with shared pads; said {reported:?}",
        paths.len(),
        distinct.len()
    );
    assert!(shared >= 40, "{shared} tables with shared pads");
}

/// Data read for one source is not mixed up with data for the next one.
#[test]
fn importing_many_is_importing_each() {
    let Some(data) = data() else { return };
    let importer = Importer::default();
    for path in files(&data.join("mcu"), "xml").iter().step_by(41) {
        let (one, of_many) = (imported(path), imported_with(&importer, path));
        assert_eq!(one.table, of_many.table, "{}", path.display());
        assert_eq!(one.diagnostics, of_many.diagnostics, "{}", path.display());
    }
}

#[test]
fn table_1_is_part_of_its_mcu() {
    let Some(data) = data() else { return };
    let made = imported(&data.join("mcu/STM32F407V(E-G)Tx.xml"));
    let chip = table::load(&made.table.unwrap()).board;
    assert_eq!(chip.mcu.as_deref(), Some("STM32F407VGTx"));
    let paper = sensedsl_board::catalog::find("STM32F4DiscoveryBoard").unwrap().table();
    assert_eq!(paper.pins.len(), 26);
    for pin in &paper.pins {
        let row = chip.pin(&pin.name).unwrap();
        for usage in &pin.usages {
            assert!(row.usage(&usage.signal).is_some(), "{} {}", pin.name, usage.spelled);
        }
    }
    let pb10 = chip.pin(&PinName::parse("PB10").unwrap()).unwrap();
    let scl = pb10.usages.iter().find(|usage| usage.spelled == "I2C2_SCL").unwrap();
    assert_eq!((scl.alternate, pb10.package_position()), (Some(4), Some("47")));
}

#[test]
fn pads_that_pins_share_have_one_position() {
    let Some(data) = data() else { return };
    let made = imported(&data.join("mcu/STM32G031J(4-6)Mx.xml"));
    let chip = table::load(&made.table.unwrap()).board;
    let on = |position: &str| -> Vec<String> {
        let pins = chip.pins.iter().filter(|pin| pin.package_position() == Some(position));
        pins.map(|pin| pin.name.to_string()).collect()
    };
    assert_eq!(on("4"), ["PA0", "PA1", "PA2", "PF2"]);
}

#[test]
fn remap_blocks_of_an_f1_are_at_its_usages() {
    let Some(data) = data() else { return };
    let made = imported(&data.join("mcu/STM32F103C(8-B)Tx.xml"));
    let chip = table::load(&made.table.unwrap()).board;
    let pb6 = chip.pin(&PinName::parse("PB6").unwrap()).unwrap();
    let blocks = |usage: &table::Usage| Some(format!("{}#{}", usage.signal.name(), usage.blocks?));
    let blocks: Vec<String> = pb6.usages.iter().filter_map(blocks).collect();
    assert_eq!(blocks, ["I2C1_SCL#0", "TIM4_CH1#0", "USART1_TX#1"]);
}

/// The only table of an imported project.
struct Pins(String);

impl Files for Pins {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        if wanted.path == "pins.csv" { Ok(self.0.clone()) } else { Err(ReadError::Missing) }
    }
}

#[test]
fn every_project_is_imported_or_refused_with_a_reason() {
    let Some(data) = data() else { return };
    let paths = files(&data.join("boards"), "ioc");
    assert!(paths.len() >= 250, "{} files", paths.len());
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    let mut reported: BTreeMap<String, usize> = BTreeMap::new();
    let (mut devices, mut done) = (0, 0);
    for path in &paths {
        let made = imported(path);
        for one in &made.diagnostics {
            *reported.entry(one.code.to_string()).or_default() += 1;
        }
        let (Some(program), Some(csv)) = (made.program, made.table) else {
            let code = made.diagnostics.first().unwrap().code;
            *refused.entry(code.to_string()).or_default() += 1;
            continue;
        };
        done += 1;
        let findings = table::load(&csv).findings;
        let findings: Vec<_> = findings
            .iter()
            .filter(|one| {
                !matches!(one.kind, sensedsl_board::finding::FindingKind::UnknownMcu { .. })
            })
            .collect();
        assert!(findings.is_empty(), "{}: {findings:?}\n{csv}", path.display());
        let request =
            Request { path: "b.sense", text: &program, board: None, target: Some("none") };
        let resolved = resolve(&request, &Pins(csv));
        let errors: Vec<_> = resolved
            .diagnostics
            .iter()
            .filter(|one| one.severity == sensedsl_diagnostics::Severity::Error)
            .collect();
        let empty = errors.iter().all(|one| one.message.contains("no device"));
        assert!(errors.is_empty() || empty, "{}: {errors:?}\n{program}", path.display());
        devices += resolved.design.map_or(0, |design| design.devices.len());
        let laid_out = sensedsl_syntax::format(&program);
        assert_eq!(laid_out.as_deref(), Ok(program.as_str()), "{}", path.display());
    }
    eprintln!(
        "{done} of {} projects imported, {devices} devices, refused {refused:?}, said {reported:?}",
        paths.len()
    );
    assert!(devices > 2_000, "{devices} devices");
}

#[test]
fn formats_are_told_by_content() {
    let Some(data) = data() else { return };
    for path in files(&data.join("mcu"), "xml").iter().step_by(97) {
        assert_eq!(sensedsl_import::detect(&fs::read(path).unwrap()), Some(Format::CubeMx));
    }
    for path in files(&data.join("boards"), "ioc").iter().step_by(17) {
        assert_eq!(sensedsl_import::detect(&fs::read(path).unwrap()), Some(Format::Ioc));
    }
}

/// The roles that ST's pin names imply (`PF2-NRST`, `PH3-BOOT0`, `PH0-OSC_IN`: reset, BOOT and
/// oscillators) are in `silicon/`.
#[test]
fn pins_that_the_mcu_needs_are_known() {
    let Some(data) = data() else { return };
    let mut seen = 0;
    for path in files(&data.join("mcu"), "xml") {
        let text = fs::read_to_string(&path).unwrap();
        let Some(mcu) = text.split("RefName=\"").nth(1).and_then(|rest| rest.split('"').next())
        else {
            continue;
        };
        // Parts that are not in the table.
        if mcu.starts_with("STM32MP") {
            continue;
        }
        let roles = silicon::pin_roles(mcu);
        for spelled in text.split("<Pin Name=\"").skip(1).filter_map(|rest| rest.split('"').next())
        {
            let Some(pin) = PinName::parse(spelled).filter(|pin| pin.as_str().starts_with('P'))
            else {
                continue;
            };
            let says = |words: &[&str]| words.iter().any(|word| spelled.contains(word));
            if says(&["NRST", "BOOT"]) {
                let vital = roles.get(&pin).is_some_and(|role| *role != PinRole::Oscillator);
                assert!(vital, "{mcu}: {spelled}");
                seen += 1;
            } else {
                let oscillator = roles.get(&pin) == Some(&PinRole::Oscillator);
                assert_eq!(oscillator, says(&["OSC"]), "{mcu}: {spelled}");
            }
        }
    }
    assert!(seen > 500, "{seen} pins");
}
