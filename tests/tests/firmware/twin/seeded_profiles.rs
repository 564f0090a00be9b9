//! Mistakes put into target profiles, one at a time, from which a rover is wired, generated and built: who notices that
//! what we know of the system is wrong?
//!
//! The table is in `docs/seeded-mistakes.md`, written with that of `seeded.rs`.

use std::path::{Path, PathBuf};

use sensedsl_board::profile;
use sensedsl_codegen::job::jobs;
use sensedsl_codegen::target::firmware;
use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_model::design::Design;
use sensedsl_session::{On, Workspace};
use sensedsl_tests::assert_section;
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Search, Solved, Wiring};

use super::seeded::{SECONDS, made, noticed_in, table};
use super::trial::{NoFiles, System, greets, rover, rover_world, run_job};
use crate::firmware::chibios::tree;
use crate::firmware::embassy::{can_build, try_build};
use crate::firmware::tools::scratch;

const C: System = System::Chibios;
const E: System = System::Embassy;
const MCU: &str = "STM32F407VGT6";

/// What is wrong, and which texts are replaced by others, each time that they are there.
type Seed = (&'static str, System, &'static [(&'static str, &'static str)]);

const SEEDS: &[Seed] = &[
    (
        "ChibiOS: DMA stream of a converter",
        C,
        &[(r#"{ name = "ADC1", dma = ["2,4", "2,0"] }"#, r#"{ name = "ADC1", dma = ["2,1"] }"#)],
    ),
    (
        "ChibiOS: DMA streams of a bus",
        C,
        &[(
            r#"alternate = 4, rx = ["1,0", "1,5"], tx = ["1,6", "1,7"] }"#,
            r#"alternate = 4, rx = ["1,1"], tx = ["1,3"] }"#,
        )],
    ),
    (
        "ChibiOS: alternate function of a timer",
        C,
        &[(
            r#"{ name = "TIM3", bits = 16, clock = "STM32_TIMCLK1", alternate = 2"#,
            r#"{ name = "TIM3", bits = 16, clock = "STM32_TIMCLK1", alternate = 3"#,
        )],
    ),
    (
        "ChibiOS: alternate function of a bus",
        C,
        &[(r#"alternate = 5, clock = "STM32_PCLK1""#, r#"alternate = 6, clock = "STM32_PCLK1""#)],
    ),
    (
        "ChibiOS: clock of a timer",
        C,
        &[(
            r#"{ name = "TIM3", bits = 16, clock = "STM32_TIMCLK1""#,
            r#"{ name = "TIM3", bits = 16, clock = "STM32_TIMCLK2""#,
        )],
    ),
    (
        "ChibiOS: clock of SPI",
        C,
        &[(r#"alternate = 5, clock = "STM32_PCLK1""#, r#"alternate = 5, clock = "STM32_PCLK2""#)],
    ),
    (
        "ChibiOS: clock of CAN",
        C,
        &[(
            "rules.clock = \"STM32_PCLK1\"\ndividers = { range = [1, 1024]",
            "rules.clock = \"STM32_PCLK2\"\ndividers = { range = [1, 1024]",
        )],
    ),
    (
        "ChibiOS: clock of the I2C buses",
        C,
        &[("[i2cs]\nrules.clock = \"STM32_PCLK1\"", "[i2cs]\nrules.clock = \"STM32_PCLK2\"")],
    ),
    (
        "ChibiOS: clocks of a period of the fast I2C mode",
        C,
        &[(
            "speeds_hz = [100_001, 400_000], clocks = 3",
            "speeds_hz = [100_001, 400_000], clocks = 2",
        )],
    ),
    ("ChibiOS: divider of the converters", C, &[("ADC_CCR_ADCPRE_DIV4", "ADC_CCR_ADCPRE_DIV2")]),
    (
        "ChibiOS: bits of the converters",
        C,
        &[("facts.resolution_bits = 12", "facts.resolution_bits = 10")],
    ),
    (
        "ChibiOS: name of a driver",
        C,
        &[(r#"serials = { driver = "SD{n}""#, r#"serials = { driver = "UARTD{n}""#)],
    ),
    (
        "ChibiOS: an encoder on a timer without the mode",
        C,
        &[
            (", encoder = true", ""),
            (
                r#"{ name = "TIM9", bits = 16, clock = "STM32_TIMCLK2", alternate = 3, "#,
                r#"{ name = "TIM9", bits = 16, clock = "STM32_TIMCLK2", alternate = 3, encoder = true, "#,
            ),
        ],
    ),
    (
        "Embassy: DMA streams of a bus",
        E,
        &[(
            r#"clock = "PCLK1", rx = ["1,0", "1,5"], tx = ["1,6", "1,7"] }"#,
            r#"clock = "PCLK1", rx = ["1,1"], tx = ["1,3"] }"#,
        )],
    ),
    (
        "Embassy: DMA streams of SPI",
        E,
        &[(
            r#"clock = "PCLK1", rx = ["1,3"], tx = ["1,4"] }"#,
            r#"clock = "PCLK1", rx = ["1,4"], tx = ["1,3"] }"#,
        )],
    ),
    (
        "Embassy: interrupt of an edge",
        E,
        &[
            (r#"GLOBAL = "EXTI9_5""#, r#"GLOBAL = "EXTI15_10""#),
            (r#"GLOBAL = "EXTI0""#, r#"GLOBAL = "EXTI1""#),
            (r#"{ name = "EXTI1", GLOBAL = "EXTI1" }"#, r#"{ name = "EXTI1", GLOBAL = "EXTI2" }"#),
        ],
    ),
    (
        "Embassy: interrupt of a bus",
        E,
        &[(r#"EV = "I2C1_EV", ER = "I2C1_ER""#, r#"EV = "I2C1_ER", ER = "I2C1_EV""#)],
    ),
    (
        "Embassy: interrupt of a timer",
        E,
        &[(r#"{ name = "TIM3", CC = "TIM3" }"#, r#"{ name = "TIM3", CC = "TIM4" }"#)],
    ),
    (
        "Embassy: clock of a timer",
        E,
        &[(
            r#"{ name = "TIM3", bits = 16, clock = "PCLK1_TIM""#,
            r#"{ name = "TIM3", bits = 16, clock = "PCLK2_TIM""#,
        )],
    ),
    (
        "Embassy: clock of SPI",
        E,
        &[(r#"{ name = "SPI2", clock = "PCLK1""#, r#"{ name = "SPI2", clock = "PCLK2""#)],
    ),
    (
        "Embassy: divider of a bus clock",
        E,
        &[("apb1_pre = APBPrescaler::DIV4", "apb1_pre = APBPrescaler::DIV8")],
    ),
    (
        "Embassy: a bus clock that is too fast",
        E,
        &[("apb1_pre = APBPrescaler::DIV4", "apb1_pre = APBPrescaler::DIV1")],
    ),
    (
        "Embassy: divider of the core's clock",
        E,
        &[("divp: Some(PllPDiv::DIV2)", "divp: Some(PllPDiv::DIV4)")],
    ),
    (
        "Embassy: bits of the converters",
        E,
        &[("facts.resolution_bits = 12", "facts.resolution_bits = 10")],
    ),
    (
        "Embassy: an encoder on a timer without the mode",
        E,
        &[
            (", encoder = true", ""),
            (
                r#"{ name = "TIM9", bits = 16, clock = "PCLK2_TIM", "#,
                r#"{ name = "TIM9", bits = 16, clock = "PCLK2_TIM", encoder = true, "#,
            ),
        ],
    ),
    ("Embassy: how converters repeat", E, &[(r#"read = "again""#, r#"read = "each""#)]),
];

/// Those that nobody notices here, and why.
const UNSEEN: &[(&str, &str)] = &[];

const HEADING: &str = "In profiles";

const INTRO: &str = "\
The rover with a contact that counts edges is wired, generated and built from a changed file of `targets/`: as if we did
not know the system. The twin knows the STM32F407 from its reference manual, not from these files. Written by
`tests/tests/firmware/twin/seeded_profiles.rs`.

";

/// The rover with an interrupt line.
fn design() -> String {
    let edge = "sensor Drops returns uint32 { id = 12; type = digital; edge = rising; }\n    actuator Motor";
    rover().replacen("actuator Motor", edge, 1)
}

fn world() -> String {
    rover_world().replacen("[devices]\n", "[devices]\nDrops = { rate = 40 }\n", 1)
}

fn codes(found: &[Diagnostic]) -> String {
    let mut codes: Vec<String> = found.iter().map(|one| one.code.to_string()).collect();
    codes.dedup();
    format!("`generate` ({})", codes.join(", "))
}

/// The design's wiring with that profile; otherwise who noticed.
fn wired(system: System, profile: &str) -> Result<(Design, Assignment), String> {
    let problems = profile::check(profile).unwrap_or_else(|problem| vec![problem]);
    if !problems.is_empty() {
        return Err("the profile's own check".to_owned());
    }
    let mut workspace = Workspace::default();
    workspace.open("board.sense", design());
    let on = On { board: None, target: system.target() };
    let snapshot = workspace.snapshot("board.sense", on, &NoFiles);
    let mut design =
        snapshot.design().unwrap_or_else(|| panic!("{:#?}", snapshot.diagnostics())).clone();
    for board in &mut design.boards {
        board.target = profile::read(profile, MCU).unwrap();
    }
    let wiring = Wiring::new(&design, None);
    let mut found = wiring.check();
    match wiring.solve(&Search { any: false }) {
        Solved::Wired(assignment) => {
            found.extend(sensedsl_timing::check(&design, &assignment));
            found.retain(|one| one.severity == Severity::Error);
            if found.is_empty() { Ok((design, *assignment)) } else { Err(codes(&found)) }
        }
        Solved::Infeasible(conflict) => Err(codes(&[conflict.diagnostic(&design)])),
        Solved::Failed(failure) => Err(codes(&[*failure])),
    }
}

/// Writes the firmware of the only board into a folder.
fn written(system: System, design: &Design, wiring: &Assignment) -> Result<PathBuf, String> {
    let files = firmware(design, wiring).map_err(|found| codes(&found))?;
    let folder = scratch(&format!("seeded_profiles_{system:?}"));
    for (path, entry) in files.iter() {
        let path = folder.join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, &entry.bytes).unwrap();
    }
    Ok(folder.join(&design.boards[0].name.value))
}

/// The image, or the error with which the compiler refuses it.
fn built(system: System, board: &Path) -> Result<Vec<u8>, String> {
    match system {
        System::Chibios => made(&tree().unwrap(), board).ok_or_else(|| "compiler".to_owned()),
        System::Embassy => match try_build(board) {
            Ok(path) => Ok(std::fs::read(path).unwrap()),
            Err(said) => {
                let code = said.split("error[").nth(1).and_then(|rest| rest.split(']').next());
                let code = code.unwrap_or_else(|| panic!("{said}"));
                Err(format!("types ({code})"))
            }
        },
    }
}

/// Who noticed, in words; empty for nobody.
fn noticed(system: System, profile: &str) -> Result<String, String> {
    let (design, wiring) = wired(system, profile)?;
    let image = built(system, &written(system, &design, &wiring)?)?;
    let job = jobs(&design, &wiring).next().unwrap();
    Ok(noticed_in(&run_job(&job, &world(), &image, SECONDS, greets)))
}

fn changed(system: System, changes: &[(&str, &str)]) -> String {
    let target = system.target().unwrap_or(profile::DEFAULT);
    let mut text = profile::text(target, MCU).unwrap().to_owned();
    for (find, with) in changes {
        assert!(text.contains(find), "the profile of {target} has no `{find}`");
        text = text.replace(find, with);
    }
    text
}

#[test]
fn mistakes_in_profiles_are_noticed() {
    let is_whole = sensedsl_tests::is_exhaustive();
    if !is_whole || tree().is_none() || !can_build() {
        return;
    }
    for system in [System::Chibios, System::Embassy] {
        assert_eq!(noticed(system, &changed(system, &[])), Ok(String::new()), "{system:?}");
    }
    let mut rows = Vec::new();
    for (what, system, changes) in SEEDS {
        let by = noticed(*system, &changed(*system, changes)).unwrap_or_else(|by| by);
        eprintln!("{what}: {by}");
        rows.push((*what, by));
    }
    let table = table(&rows, UNSEEN);
    assert_section("docs/seeded-mistakes.md", HEADING, &format!("{INTRO}{table}"));
}

/// Each mistake is of a text that is there, so that the list follows the profiles.
#[test]
fn mistakes_in_profiles_are_of_texts_that_are_there() {
    for (what, system, changes) in SEEDS {
        assert!(!changed(*system, changes).is_empty(), "{what}");
    }
}
