//! The sound part of a design with mistakes: everything that was read and the diagnostics in, the
//! design without the parts in error out.
//!
//! A device is left out if there is an error in its block, in the driver it names or in the table
//! of its board, or if its board cannot be read. Everything else stays, so that one mistake does
//! not hide the rest.

use std::collections::BTreeSet;

use sensedsl_diagnostics::{Diagnostic, FileId, Severity, Span};

use crate::design::{Board, Design, Part};
use crate::driver::Drivers;
use crate::spanned::Spanned;

/// A design without the parts in error.
#[derive(Clone, Debug)]
pub struct Partial {
    /// The sound boards and devices. There may be no devices.
    pub design: Design,
    /// The names of the boards and devices left out, in file order.
    pub left_out: Vec<Spanned<String>>,
}

impl Partial {
    /// Leaves out the parts that an error is about, in addition to those left out already.
    #[must_use]
    pub fn without(self, diagnostics: &[Diagnostic]) -> Self {
        let errors = errors(diagnostics);
        self.keep(|part| !has_any(&errors, part.block))
    }

    /// Leaves out the parts of these drivers.
    pub(crate) fn without_drivers(self, drivers: &BTreeSet<String>) -> Self {
        self.keep(|part| part.driver.as_ref().is_none_or(|driver| !drivers.contains(driver)))
    }

    /// Leaves out what may be on a board whose table has an error, because what its pins can do is
    /// unknown.
    pub(crate) fn without_doubtful_tables(mut self, diagnostics: &[Diagnostic]) -> Self {
        let files: BTreeSet<FileId> = errors(diagnostics).into_iter().map(|at| at.file).collect();
        let is_doubtful = |board: &&Board| files.contains(&board.table_file);
        let doubtful = self.design.boards.iter().filter(is_doubtful);
        let names: Vec<_> = doubtful.map(|board| board.name.clone()).collect();
        if names.is_empty() {
            return self;
        }
        self.left_out.extend(names);
        let boards: Vec<bool> =
            self.design.boards.iter().map(|board| !is_doubtful(&board)).collect();
        self.keep(|part| part.board.is_some_and(|at| boards.get(at.0) == Some(&true)))
    }

    fn keep(self, is_sound: impl Fn(&Part) -> bool) -> Self {
        let Self { mut design, mut left_out } = self;
        let wrong = design.parts.iter().filter(|part| !is_sound(part));
        left_out.extend(wrong.map(|part| part.name.clone()));
        design.retain_parts(|_, part| is_sound(part));
        left_out.sort_by_key(|name| name.span);
        Self { design, left_out }
    }
}

/// The places of errors, in order.
fn errors(diagnostics: &[Diagnostic]) -> BTreeSet<Span> {
    let errors = diagnostics.iter().filter(|one| one.severity == Severity::Error);
    errors.map(|one| one.primary.span).collect()
}

/// Whether one of the places begins in a block.
fn has_any(places: &BTreeSet<Span>, block: Span) -> bool {
    let first = Span { end: block.start, ..block };
    let last = Span { start: block.end, end: u32::MAX, ..block };
    places.range(first..=last).next().is_some()
}

/// The names of the file's drivers that contain an error.
pub(crate) fn broken_drivers(drivers: &Drivers, diagnostics: &[Diagnostic]) -> BTreeSet<String> {
    let errors = errors(diagnostics);
    let broken = drivers.own_blocks().filter(|(_, block)| has_any(&errors, *block));
    broken.map(|(name, _)| name.to_owned()).collect()
}
