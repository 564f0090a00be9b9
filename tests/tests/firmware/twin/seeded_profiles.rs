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
use sensedsl_tests::{Place, mistakes, write_all};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Search, Solved, Wiring};

use super::seeded::{SECONDS, assert_table, made, noticed_in, table, tried};
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

const HEADING: &str = "In profiles";

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
        let edge = "sensor Drops returns uint32 { id = 13; type = digital; edge = rising; }\n    ";
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

    /// The case that a mistake names.
    fn of(place: &Place) -> Self {
        let named = |case: &Self| format!("{case:?}") == place.name;
        [Chibios, Embassy, Paper].into_iter().find(named).unwrap()
    }

    /// The right profile of the case.
    fn profile(self) -> &'static str {
        profile::text(self.target(), MCU).unwrap()
    }

    /// The firmware from that profile, with its design and wiring; or the check that noticed the
    /// mistake.
    fn generated(self, profile: &str) -> Result<Generated, String> {
        let problems = profile::check(profile).unwrap_or_else(|problem| vec![problem]);
        if !problems.is_empty() {
            return Err("the profile's own check".to_owned());
        }
        let right = self.design(self.profile());
        let keep = match Wiring::new(&right, None).solve(&Search::default()) {
            Solved::Wired(wiring) => json::keep(&json::wired(&right, &wiring)).unwrap(),
            other => panic!("{other:?}"),
        };
        let design = self.design(profile);
        let wiring = Wiring::new(&design, Some(&keep));
        let mut found = wiring.check();
        let solved = wiring.solve(&Search::default());
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
        write_all(&folder, self.files.iter().map(|(path, entry)| (path, &entry.bytes)));
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
            Err(reported) => {
                let code = reported.split("error[").nth(1).and_then(|rest| rest.split(']').next());
                let code = code.unwrap_or_else(|| panic!("{reported}"));
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
        assert_eq!(case.noticed(case.profile()), Ok(String::new()), "{case:?}");
    }
    let (all, mut rows) = (mistakes("profiles.txt"), Vec::new());
    for mistake in tried(&all) {
        let place = &mistake.places[0];
        let case = Case::of(place);
        let by = case.noticed(&place.everywhere(case.profile())).unwrap_or_else(|by| by);
        eprintln!("{}: {by}", mistake.what);
        rows.push((mistake, by));
    }
    assert_table(HEADING, &table(&rows));
}

/// The text that each mistake replaces must exist, and the output must change or be refused.
#[test]
fn mistakes_in_profiles_make_a_difference() {
    let mut same = Vec::new();
    for mistake in mistakes("profiles.txt") {
        let (what, place) = (&mistake.what, &mistake.places[0]);
        let case = Case::of(place);
        let right = case.generated(case.profile()).unwrap_or_else(|by| panic!("{by}"));
        let is_same = match case.generated(&place.everywhere(case.profile())) {
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
