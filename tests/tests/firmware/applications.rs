//! The designs that firmware is generated for, and their way from text to files.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_generate::target;
use sensedsl_model::{FileRequest, Files, ReadError, Request, resolve};
use sensedsl_wiring::{Search, Solved, Wiring};

/// The paper's Fig. 2.
pub(crate) const FIG2: &str = include_str!("../../../examples/fig2.sense");

/// The car whose firmware was written by hand in 2014, as far as ChibiOS can capture it.
pub(crate) const CAR: &str = include_str!("../../../examples/miniature_car.sense");

/// C keywords as names, every property that changes the code, a serial link with a checksum.
pub(crate) const ODD: &str = include_str!("../../firmware/designs/odd.sense");

/// A board of the user's with usages that Table 1 lacks.
const ODD_TABLE: &str = include_str!("../../firmware/designs/odd.csv");

/// Two boards in one file, each with its own devices.
pub(crate) const TWO: &str = include_str!("../../firmware/designs/two.sense");

/// All uses of timers and pins: arrays, chips, edges, bridges, a receiver, rangers.
pub(crate) const PINS: &str = include_str!("../../firmware/designs/pins.sense");

/// The files that a design may name.
struct Tables;

impl Files for Tables {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        match wanted.path {
            "odd.csv" => Ok(ODD_TABLE.to_owned()),
            "emulated.csv" => Ok(super::emulated::TABLE.to_owned()),
            _ => Err(ReadError::Missing),
        }
    }
}

/// The files for a text, or its diagnostics.
pub(crate) fn generate(text: &str) -> Result<FileSet, Vec<Diagnostic>> {
    let request = Request { path: "test.sense", text, ..Request::default() };
    let resolved = resolve(&request, &Tables);
    let Some(design) = resolved.design else { panic!("{:#?}", resolved.diagnostics) };
    match Wiring::new(&design, None).solve(&Search::default()) {
        Solved::Wired(assignment) => target::firmware(&design, &assignment),
        other @ (Solved::Infeasible(_) | Solved::Failed(_)) => panic!("{other:#?}"),
    }
}

/// The files of a design for which generation must succeed, by path.
pub(crate) fn files(text: &str) -> BTreeMap<String, String> {
    let files = generate(text).unwrap_or_else(|diagnostics| panic!("{diagnostics:#?}"));
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    files.iter().map(|(path, entry)| (path.to_owned(), text(&entry.bytes))).collect()
}

#[test]
fn generating_twice_gives_the_same_bytes() {
    for text in [FIG2, CAR, ODD, TWO, PINS] {
        assert_eq!(generate(text).unwrap(), generate(text).unwrap());
    }
}

#[test]
fn files_end_with_a_line_end_and_have_no_empty_runs() {
    for text in [FIG2, CAR, ODD, TWO, PINS] {
        for (path, text) in files(text) {
            assert!(text.ends_with('\n') && !text.ends_with("\n\n"), "{path}");
            assert!(!text.contains("\n\n\n"), "{path}");
            assert!(text.lines().all(|line| line == line.trim_end()), "{path}");
        }
    }
}
