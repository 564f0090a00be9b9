//! What is known about a file at one moment.

use sensedsl_diagnostics::{Diagnostic, FileId, Severity, SourceMap, Span};
use sensedsl_model::design::{Design, Spanned};
use sensedsl_model::{Constants, Partial, Resolved, SyntaxTree};

/// A file as it was read: its tree, its design, and all their diagnostics.
#[derive(Debug)]
pub struct Snapshot {
    resolved: Resolved,
}

/// A design without mistakes, or the rest of a design without the parts in error.
#[derive(Clone, Copy, Debug)]
pub struct Sound<'a> {
    /// The design.
    pub design: &'a Design,
    /// The names of the boards and devices left out, in file order.
    pub left_out: &'a [Spanned<String>],
}

impl Snapshot {
    pub(crate) fn new(resolved: Resolved) -> Self {
        Self { resolved }
    }

    /// The snapshot of a file that could not be read.
    #[must_use]
    pub fn unread(why: Diagnostic, sources: SourceMap) -> Self {
        let diagnostics = vec![why];
        Self { resolved: Resolved { diagnostics, sources, ..Resolved::default() } }
    }

    /// The design, if it has no mistakes.
    #[must_use]
    pub fn design(&self) -> Option<&Design> {
        self.resolved.design.as_ref()
    }

    /// The sound part of the design; none if no board can be read.
    #[must_use]
    pub fn sound(&self) -> Option<Sound<'_>> {
        match (&self.resolved.design, &self.resolved.partial) {
            (Some(design), _) => Some(Sound { design, left_out: &[] }),
            (None, Some(Partial { design, left_out })) => Some(Sound { design, left_out }),
            (None, None) => None,
        }
    }

    pub(crate) fn partial(&self) -> Option<&Partial> {
        self.resolved.partial.as_ref()
    }

    /// The diagnostics from reading the file, in the order of their places. [`Self::solve`] adds
    /// those of the wiring.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.resolved.diagnostics
    }

    /// All texts that were read, and those that are built in.
    #[must_use]
    pub fn sources(&self) -> &SourceMap {
        &self.resolved.sources
    }

    /// The files that were read, each once: the requested one, those it uses, and tables.
    #[must_use]
    pub fn files(&self) -> &[FileId] {
        &self.resolved.files
    }

    /// The syntax trees of the files in the language, in the order of reading.
    #[must_use]
    pub fn trees(&self) -> &[(FileId, SyntaxTree)] {
        &self.resolved.trees
    }

    /// The constants of all files.
    #[must_use]
    pub fn constants(&self) -> &Constants {
        &self.resolved.constants
    }

    /// The place for diagnostics about the whole design: the name of its first board.
    #[must_use]
    pub fn place(&self) -> Option<Span> {
        let Sound { design, .. } = self.sound()?;
        let board = design.boards.first();
        Some(board.map_or_else(|| Span::new(design.file, 0..0), |board| board.name.span))
    }
}

/// Whether anything makes the input unusable.
#[must_use]
pub fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|one| one.severity == Severity::Error)
}
