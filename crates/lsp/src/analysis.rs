//! What is known of a file and of what it uses, at one moment.
//!
//! In: the open texts, the other files. Out: a snapshot at once, and its wiring once somebody has had the time to look
//! for it. The diagnostics are those of `sensedsl check`.

use std::cell::OnceCell;
use std::rc::Rc;

use sensedsl_diagnostics::{Diagnostic, FileId};
use sensedsl_generate::target;
use sensedsl_model::design::Design;
use sensedsl_model::{Files, SyntaxTree};
use sensedsl_session::{Answer, On, Patience, Snapshot, Workspace};
use sensedsl_wiring::assignment::Assignment;

/// A snapshot with its wiring.
pub(crate) struct Analysis {
    pub(crate) snapshot: Snapshot,
    answer: OnceCell<Rc<Wired>>,
}

/// The wiring of a snapshot; what it is of may have been edited since.
pub(crate) struct Wired {
    pub(crate) answer: Answer<'static>,
    /// As `check` tells them.
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Wired {
    /// The wiring, with its design.
    pub(crate) fn wired(&self) -> Option<(&Design, &Assignment)> {
        self.answer.wired()
    }
}

impl Analysis {
    pub(crate) fn new(workspace: &Workspace, path: &str, files: &dyn Files) -> Self {
        let snapshot = workspace.snapshot(path, On::default(), files);
        Self { snapshot, answer: OnceCell::new() }
    }

    /// The wiring: the best, or what was found in time; none if it was stopped.
    pub(crate) fn answer(&self, patience: Patience<'_>) -> Option<Rc<Wired>> {
        if let Some(known) = self.answer.get() {
            return Some(Rc::clone(known));
        }
        let answer = self.snapshot.solve_best_or_any(patience);
        if patience.stop.is_over() {
            return None;
        }
        let mut diagnostics = answer.diagnostics.clone();
        if let Some((design, wiring)) = answer.wired().filter(|_| answer.left_out.is_empty()) {
            target::foresee(design, wiring, &mut diagnostics);
        }
        let wired = Rc::new(Wired { answer: answer.into_owned(), diagnostics });
        Some(Rc::clone(self.answer.get_or_init(|| wired)))
    }

    /// The wiring, if it has been looked for.
    pub(crate) fn known(&self) -> Option<Rc<Wired>> {
        self.answer.get().cloned()
    }

    /// The number of a file that was read.
    pub(crate) fn file(&self, path: &str) -> Option<FileId> {
        let read = self.snapshot.files().iter().copied();
        read.clone().find(|file| self.snapshot.sources().name(*file) == path)
    }

    /// The tree of a file.
    pub(crate) fn tree(&self, file: FileId) -> Option<&SyntaxTree> {
        self.snapshot.trees().iter().find(|(of, _)| *of == file).map(|(_, tree)| tree)
    }
}
