//! Mistakes put into target profiles, one at a time. A rover is wired, generated and built from
//! each, and the test finds what notices that the facts about the system are wrong.
//!
//! The table is in `docs/seeded-mistakes.md`, written together with that of `seeded.rs`.

use std::path::{Path, PathBuf};

use sensedsl_board::profile;
use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_files::FileSet;
use sensedsl_generate::target::firmware;
use sensedsl_job::jobs;
use sensedsl_model::NoFiles;
use sensedsl_model::design::Design;
use sensedsl_report::json;
use sensedsl_session::{On, Workspace};
use sensedsl_tests::assert_section;
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Search, Solved, Wiring};

use super::seeded::{SECONDS, made, noticed_in, table};
use super::trial::{System, greets, rover, rover_world, run_job};
use crate::firmware::chibios::tree;
use crate::firmware::embassy::{can_build, try_build};
use crate::firmware::tools::scratch;

const MCU: &str = "STM32F407VGT6";

/// A design, and the system whose profile is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Case {
    /// The rover with an interrupt line, on ChibiOS.
    Chibios,
    /// The rover with an interrupt line, on Embassy.
    Embassy,
    /// Fig. 2 on ChibiOS with the paper's pin table, which has no alternate functions.
    Paper,
}

use Case::{Chibios, Embassy, Paper};

/// A mistake: its name, its case, and the texts whose occurrences are all replaced, with the
/// replacements.
type Seed = (&'static str, Case, &'static [(&'static str, &'static str)]);

const SEEDS: &[Seed] = &[
    (
        "DMA stream of a converter",
        Chibios,
        &[(r#""ADC1", dma = ["2,4", "2,0"]"#, r#""ADC1", dma = ["2,1"]"#)],
    ),
    (
        "DMA streams of I2C",
        Chibios,
        &[(r#"rx = ["1,0", "1,5"], tx = ["1,6", "1,7"] }"#, r#"rx = ["1,1"], tx = ["1,5"] }"#)],
    ),
    (
        "DMA streams of SPI swapped",
        Chibios,
        &[(r#"rx = ["1,3"], tx = ["1,4"] }"#, r#"rx = ["1,4"], tx = ["1,3"] }"#)],
    ),
    (
        "alternate function of a timer",
        Paper,
        &[(
            r#""TIM3", bits = 16, clock = "STM32_TIMCLK1", alternate = 2"#,
            r#""TIM3", bits = 16, clock = "STM32_TIMCLK1", alternate = 3"#,
        )],
    ),
    (
        "alternate function of I2C",
        Paper,
        &[(
            r#"alternate = 4, rx = ["1,2"], tx = ["1,4"]"#,
            r#"alternate = 9, rx = ["1,2"], tx = ["1,4"]"#,
        )],
    ),
    ("alternate function of USB", Paper, &[("alternate = 10", "alternate = 12")]),
    (
        "clock of a timer",
        Chibios,
        &[(
            r#""TIM3", bits = 16, clock = "STM32_TIMCLK1""#,
            r#""TIM3", bits = 16, clock = "STM32_TIMCLK2""#,
        )],
    ),
    (
        "clock of SPI",
        Chibios,
        &[(r#"clock = "STM32_PCLK1", rx = ["1,3"]"#, r#"clock = "STM32_PCLK2", rx = ["1,3"]"#)],
    ),
    (
        "clock of CAN",
        Chibios,
        &[(
            "rules.clock = \"STM32_PCLK1\"\ndividers = { range = [1, 1024]",
            "rules.clock = \"STM32_PCLK2\"\ndividers = { range = [1, 1024]",
        )],
    ),
    (
        "clock of I2C",
        Chibios,
        &[("[i2cs]\nrules.clock = \"STM32_PCLK1\"", "[i2cs]\nrules.clock = \"STM32_PCLK2\"")],
    ),
    (
        "periods of the clock of fast I2C",
        Chibios,
        &[("[100_001, 400_000], clocks = 3", "[100_001, 400_000], clocks = 2")],
    ),
    ("divider of the converters", Chibios, &[("ADC_CCR_ADCPRE_DIV4", "ADC_CCR_ADCPRE_DIV2")]),
    (
        "name of a driver",
        Chibios,
        &[(r#"serials = { driver = "SD{n}""#, r#"serials = { driver = "UARTD{n}""#)],
    ),
    ("version of a driver", Chibios, &[(r#"i2c = "I2Cv1""#, r#"i2c = "I2Cv2""#)]),
    (
        "DMA streams of I2C",
        Embassy,
        &[(r#"rx = ["1,0", "1,5"], tx = ["1,6", "1,7"] }"#, r#"rx = ["1,1"], tx = ["1,5"] }"#)],
    ),
    (
        "DMA streams of SPI swapped",
        Embassy,
        &[(r#"rx = ["1,3"], tx = ["1,4"] }"#, r#"rx = ["1,4"], tx = ["1,3"] }"#)],
    ),
    (
        "vectors of interrupt lines",
        Embassy,
        &[
            (r#"GLOBAL = "EXTI"#, r#"GLOBAL = "ETI"#),
            ("ETI0", "EXTI1"),
            ("ETI1\"", "EXTI2\""),
            ("ETI2", "EXTI3"),
            ("ETI3", "EXTI4"),
            ("ETI4", "EXTI9_5"),
            ("ETI9_5", "EXTI15_10"),
            ("ETI15_10", "EXTI9_5"),
        ],
    ),
    (
        "vectors of I2C swapped",
        Embassy,
        &[(r#"EV = "I2C1_EV", ER = "I2C1_ER""#, r#"EV = "I2C1_ER", ER = "I2C1_EV""#)],
    ),
    ("vector of a timer", Embassy, &[(r#""TIM3", CC = "TIM3""#, r#""TIM3", CC = "TIM4""#)]),
    (
        "divider of a bus clock",
        Embassy,
        &[("apb1_pre = APBPrescaler::DIV4", "apb1_pre = APBPrescaler::DIV8")],
    ),
    (
        "a bus clock that is too fast",
        Embassy,
        &[("apb1_pre = APBPrescaler::DIV4", "apb1_pre = APBPrescaler::DIV2")],
    ),
    (
        "divider of the core's clock",
        Embassy,
        &[("divp: Some(PllPDiv::DIV2)", "divp: Some(PllPDiv::DIV4)")],
    ),
    ("how converters repeat", Embassy, &[(r#"read = "again""#, r#"read = "each""#)]),
    ("registers of serial ports", Embassy, &[(r#"usart = "v2""#, r#"usart = "v3""#)]),
];

/// Mistakes that nothing notices here, and why.
const UNSEEN: &[(&str, &str)] = &[
    (
        "ChibiOS: clock of a timer",
        "the driver has its clock from the tree; ours is in a guard, which holds for either.",
    ),
    ("ChibiOS: clock of I2C", "the same, and 400 kHz divide both clocks."),
    (
        "ChibiOS: periods of the clock of fast I2C",
        "the driver divides by itself: our 396 kHz become 400.",
    ),
];

const HEADING: &str = "In profiles";

const INTRO: &str = "\
The rover with a contact whose edges are counted, and the paper's Fig. 2, are wired, generated and built from a changed
file of `crates/board/targets/`, as if we did not know the system; only what has to moves from the right wiring. The
twin knows the STM32F407 from its reference manual and not from these files. Written by
`tests/tests/firmware/twin/seeded_profiles.rs`.

";

impl Case {
    fn system(self) -> System {
        match self {
            Chibios | Paper => System::Chibios,
            Embassy => System::Embassy,
        }
    }

    fn target(self) -> &'static str {
        self.system().target().unwrap_or(profile::DEFAULT)
    }

    fn text(self) -> String {
        let edge = "sensor Drops returns uint32 { id = 12; type = digital; edge = rising; }\n    ";
        match self {
            Chibios | Embassy => rover().replacen("actuator", &format!("{edge}actuator"), 1),
            Paper => sensedsl_tests::text("examples/fig2.sense"),
        }
    }

    fn world(self) -> String {
        match self {
            Chibios | Embassy => {
                rover_world().replacen("[devices]\n", "[devices]\nDrops = { rate = 40 }\n", 1)
            }
            Paper => sensedsl_tests::text("examples/worlds/fig2.toml"),
        }
    }

    /// The design, resolved with that profile.
    fn design(self, profile: &str) -> Design {
        let mut workspace = Workspace::default();
        workspace.open("board.sense", self.text());
        let on = On { board: None, target: Some(self.target()) };
        let snapshot = workspace.snapshot("board.sense", on, &NoFiles);
        let design = snapshot.design();
        let mut design = design.unwrap_or_else(|| panic!("{:#?}", snapshot.diagnostics())).clone();
        for board in &mut design.boards {
            board.target = profile::read(profile, MCU).unwrap();
        }
        design
    }

    /// The profile of the case, with those changes.
    fn profile(self, changes: &[(&str, &str)]) -> String {
        let mut text = profile::text(self.target(), MCU).unwrap().to_owned();
        for (find, with) in changes {
            assert!(text.contains(find), "the profile of {} has no `{find}`", self.target());
            text = text.replace(find, with);
        }
        text
    }

    /// The firmware from that profile, with its design and wiring; or the check that noticed the
    /// mistake.
    fn generated(self, profile: &str) -> Result<Generated, String> {
        let problems = profile::check(profile).unwrap_or_else(|problem| vec![problem]);
        if !problems.is_empty() {
            return Err("the profile's own check".to_owned());
        }
        let right = self.design(&self.profile(&[]));
        let keep = match Wiring::new(&right, None).solve(&Search { any: false }) {
            Solved::Wired(wiring) => json::keep(&json::wired(&right, &wiring)).unwrap(),
            other => panic!("{other:?}"),
        };
        let design = self.design(profile);
        let wiring = Wiring::new(&design, Some(&keep));
        let mut found = wiring.check();
        let solved = wiring.solve(&Search { any: false });
        let wiring = match solved {
            Solved::Wired(wiring) => *wiring,
            Solved::Infeasible(conflict) => return Err(codes(&[conflict.diagnostic(&design)])),
            Solved::Failed(failure) => return Err(codes(&[*failure])),
        };
        found.extend(sensedsl_timing::check(&design, &wiring));
        found.retain(|one| one.severity == Severity::Error);
        if !found.is_empty() {
            return Err(codes(&found));
        }
        let files = firmware(&design, &wiring).map_err(|found| codes(&found))?;
        Ok(Generated { design, wiring, files })
    }

    /// The checks that noticed the mistake, in words; empty if none did.
    fn noticed(self, profile: &str) -> Result<String, String> {
        let made = self.generated(profile)?;
        let image = built(self.system(), &made.written(self.system()))?;
        let job = jobs(&made.design, &made.wiring).next().unwrap();
        Ok(noticed_in(&run_job(&job, &self.world(), &image, SECONDS, greets)))
    }
}

/// The results for a design.
struct Generated {
    design: Design,
    wiring: Assignment,
    files: FileSet,
}

impl Generated {
    /// Writes the files, and returns the folder of the only board.
    fn written(&self, system: System) -> PathBuf {
        let folder = scratch(&format!("seeded_profiles_{system:?}"));
        for (path, entry) in self.files.iter() {
            let path = folder.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, &entry.bytes).unwrap();
        }
        folder.join(&self.design.boards[0].name.value)
    }

    fn texts(&self) -> Vec<(&str, &[u8])> {
        self.files.iter().map(|(path, entry)| (path, entry.bytes.as_slice())).collect()
    }
}

fn codes(found: &[Diagnostic]) -> String {
    let mut codes: Vec<String> = found.iter().map(|one| one.code.to_string()).collect();
    codes.dedup();
    format!("`generate` ({})", codes.join(", "))
}

/// The image, or the check that noticed the mistake if the compiler refuses it.
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

#[test]
fn mistakes_in_profiles_are_noticed() {
    if !sensedsl_tests::is_exhaustive() || tree().is_none() || !can_build() {
        return;
    }
    for case in [Chibios, Embassy, Paper] {
        assert_eq!(case.noticed(&case.profile(&[])), Ok(String::new()), "{case:?}");
    }
    let name = |what: &str, case: Case| match case.system() {
        System::Chibios => format!("ChibiOS: {what}"),
        System::Embassy => format!("Embassy: {what}"),
    };
    let mut rows = Vec::new();
    for (what, case, changes) in SEEDS {
        let by = case.noticed(&case.profile(changes)).unwrap_or_else(|by| by);
        let what = name(what, *case);
        eprintln!("{what}: {by}");
        rows.push((what, by));
    }
    let rows: Vec<(&str, String)> =
        rows.iter().map(|(what, by)| (what.as_str(), by.clone())).collect();
    let table = table(&rows, UNSEEN);
    assert_section("docs/seeded-mistakes.md", HEADING, &format!("{INTRO}{table}"));
}

/// The text that each mistake replaces must exist, and the output must change or be refused.
#[test]
fn mistakes_in_profiles_make_a_difference() {
    let mut same = Vec::new();
    for (what, case, changes) in SEEDS {
        let right = case.generated(&case.profile(&[])).unwrap_or_else(|by| panic!("{by}"));
        let is_same = match case.generated(&case.profile(changes)) {
            Ok(wrong) => wrong.texts() == right.texts(),
            Err(by) => {
                eprintln!("{case:?}, {what}: {by}");
                false
            }
        };
        if is_same {
            same.push(format!("{case:?}: {what}"));
        }
    }
    assert!(same.is_empty(), "{same:#?}");
}
