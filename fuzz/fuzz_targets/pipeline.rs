//! Any text as a design, on a built-in board or on any text as a table, goes all the way to files.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sensedsl_codegen::host::HOSTS;
use sensedsl_diagnostics::{Severity, render};
use sensedsl_model::{Files, Request, apply_allows, resolve, Unread, Wanted};
use sensedsl_wiring::{Search, Solved, Wiring};

struct Table<'a>(Option<&'a str>);

impl Files for Table<'_> {
    fn read(&self, _: &Wanted<'_>) -> Result<String, Unread> {
        self.0.map(str::to_owned).ok_or(Unread::Missing)
    }
}

fuzz_target!(|input: (&str, Option<&str>)| {
    let (text, table) = input;
    let board = table.map(|_| "table.csv");
    let request = Request { path: "robot.sense", text, board, target: None };
    let resolved = resolve(&request, &Table(table));
    let mut diagnostics = resolved.diagnostics;
    if let Some(design) = &resolved.design {
        let wiring = Wiring::new(design, None);
        diagnostics.extend(wiring.check());
        if diagnostics.iter().all(|one| one.severity != Severity::Error) {
            match wiring.solve(&Search::default()) {
                Solved::Wired(assignment) => {
                    diagnostics.extend(wiring.warnings(&assignment));
                    let _ = sensedsl_codegen::project("fuzz", design, &assignment, &HOSTS);
                }
                Solved::Infeasible(conflict) => diagnostics.push(conflict.diagnostic(design)),
                Solved::Failed(failure) => panic!("{}", failure.message),
            }
        }
        apply_allows(design, &mut diagnostics);
    }
    diagnostics.truncate(5);
    let _ = render::human(&diagnostics, &resolved.sources, false);
});
