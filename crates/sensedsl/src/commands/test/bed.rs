//! What tests run with, and where.

use std::path::{Path, PathBuf};

use sensedsl_diagnostics::codes::e0539_board_of_test as no_board;
use sensedsl_diagnostics::{Diagnostic, SourceMap};
use sensedsl_job::BoardJob;
use sensedsl_model::design::{Design, Test};

use crate::cli::TestArgs;
use crate::terminal::Terminal;

/// What tests run with.
pub(super) struct Bed<'a> {
    pub(super) args: &'a TestArgs,
    pub(super) terminal: &'a Terminal,
    pub(super) design: &'a Design,
    pub(super) sources: &'a SourceMap,
    pub(super) jobs: &'a [BoardJob<'a>],
    pub(super) place: Place,
}

/// A place for boards.
pub(super) enum Place {
    /// In this program.
    Soft,
    /// An image, at that path or where `build` has made it.
    Image(Option<PathBuf>),
    /// A real board.
    Port(String),
}

impl Place {
    pub(super) fn of(word: &str) -> Self {
        match word {
            "soft" => Self::Soft,
            "image" => Self::Image(None),
            path if Path::new(path).is_file() => Self::Image(Some(path.into())),
            port => Self::Port(port.to_owned()),
        }
    }

    /// One image and one port have one board.
    pub(super) fn suits(
        &self,
        test: &Test,
        boards: &[&BoardJob<'_>],
    ) -> Result<(), Box<Diagnostic>> {
        if boards.len() < 2 || matches!(self, Self::Soft | Self::Image(None)) {
            return Ok(());
        }
        let names: Vec<&str> = boards.iter().map(|job| job.board.name.value.as_str()).collect();
        let (at, name) = (test.name.span, &test.name.value);
        Err(no_board::several(at, name, &names.join(", ")).into())
    }
}
