//! The sound part of a design with mistakes: what was read and the diagnostics in, the design without
//! what is in error out.
//!
//! A device is left out when an error is in its block, in the driver it names or in the table of its
//! board, or when its board cannot be read. Everything else stays: one mistake does not hide what is right or wrong elsewhere.

use std::collections::BTreeSet;

use sensedsl_diagnostics::{Diagnostic, FileId, Severity, Span};

use crate::design::{Board, BoardIndex, Design, Device, Spanned};
use crate::drivers::Drivers;

/// A design without what is in error.
#[derive(Clone, Debug)]
pub struct Partial {
    /// The boards and devices that are sound. It may have no device.
    pub design: Design,
    /// The names of the boards and devices that are not in it, in file order.
    pub left_out: Vec<Spanned<String>>,
}

impl Partial {
    /// Leaves out the devices that an error is about, in addition to those left out already.
    #[must_use]
    pub fn without(self, diagnostics: &[Diagnostic]) -> Self {
        let errors = errors(diagnostics);
        self.keep(|device| !has_any(&errors, device.block))
    }

    /// Leaves out the devices of these drivers.
    pub(crate) fn without_drivers(self, drivers: &BTreeSet<String>) -> Self {
        self.keep(|device| device.driver.as_ref().is_none_or(|driver| !drivers.contains(driver)))
    }

    /// Leaves out what may be on a board whose table has an error: what its pins can is not known.
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
        self.keep(|device| device.board.is_some_and(|at| boards.get(at.0) == Some(&true)))
    }

    fn keep(self, is_sound: impl Fn(&Device) -> bool) -> Self {
        let Self { mut design, mut left_out } = self;
        let (sound, wrong): (_, Vec<Device>) = design.devices.into_iter().partition(is_sound);
        design.devices = sound;
        left_out.extend(wrong.into_iter().map(|device| device.name));
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

/// The names of the drivers of the file that an error is in.
pub(crate) fn broken_drivers(drivers: &Drivers, diagnostics: &[Diagnostic]) -> BTreeSet<String> {
    let errors = errors(diagnostics);
    let broken = drivers.own_blocks().filter(|(_, block)| has_any(&errors, *block));
    broken.map(|(name, _)| name.to_owned()).collect()
}

/// The boards that could be read, and the devices that are certain to be on them; those left out.
///
/// Where a board is missing, a device that may go to any board may belong on that one.
pub(crate) fn on_known_boards(
    boards: Vec<Option<Board>>,
    names: &[Option<Spanned<String>>],
    devices: Vec<Device>,
) -> (Vec<Board>, Vec<Device>, Vec<Spanned<String>>) {
    let mut next = 0;
    let places: Vec<Option<BoardIndex>> = boards
        .iter()
        .map(|board| {
            let place = BoardIndex(next);
            next += usize::from(board.is_some());
            board.is_some().then_some(place)
        })
        .collect();
    let is_whole = next == places.len();
    let unread = boards.iter().zip(names).filter(|(board, _)| board.is_none());
    let mut left_out: Vec<Spanned<String>> = unread.filter_map(|(_, name)| name.clone()).collect();
    let mut sound = Vec::new();
    for mut device in devices {
        match device.board {
            None if is_whole => sound.push(device),
            Some(BoardIndex(index)) if let Some(Some(place)) = places.get(index) => {
                device.board = Some(*place);
                sound.push(device);
            }
            None | Some(_) => left_out.push(device.name),
        }
    }
    (boards.into_iter().flatten().collect(), sound, left_out)
}
