//! What is needed to read boards besides their blocks: texts, tables that were read before, and what is left of the
//! budgets.

use std::collections::BTreeMap;

use sensedsl_board::table::Table;
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap};
use sensedsl_limits::{BOARDS_MAX, PLACES_MAX, TABLES_BYTES_MAX};

use crate::request::Request;
use crate::source::files::Files;
use crate::value::constants::Constants;

/// What is needed to read boards, besides the syntax node.
pub(crate) struct Context<'a> {
    pub(crate) request: &'a Request<'a>,
    pub(crate) files: &'a dyn Files,
    pub(crate) sources: &'a mut SourceMap,
    pub(crate) diagnostics: &'a mut Vec<Diagnostic>,
    pub(crate) constants: &'a Constants,
    /// The tables already completed, each with its MCU.
    pub(crate) completed: BTreeMap<(FileId, Option<String>), Table>,
    /// The tables already read from files.
    pub(crate) tables: BTreeMap<FileId, Table>,
    /// The built-in tables already read.
    pub(crate) built_in: BTreeMap<FileId, Table>,
    pub(crate) left: RemainingBudget,
}

/// The part of the budgets for all boards that is not yet used.
pub(crate) struct RemainingBudget {
    pub(super) boards: usize,
    pub(super) places: usize,
    pub(super) bytes: usize,
}

impl Default for RemainingBudget {
    fn default() -> Self {
        Self { boards: BOARDS_MAX, places: PLACES_MAX, bytes: TABLES_BYTES_MAX }
    }
}

impl RemainingBudget {
    /// Takes from a budget. If less than `taken` is left of it, the error names the budget and its
    /// full size.
    pub(super) fn take(
        left: &mut usize,
        taken: usize,
        what: &'static str,
        most: usize,
    ) -> Result<(), (&'static str, usize)> {
        *left = left.checked_sub(taken).ok_or((what, most))?;
        Ok(())
    }
}
