//! The subject of a certificate: the files that were read, what is built in, the options.

use std::collections::BTreeSet;

use sensedsl_board::{catalog, profile, table};
use sensedsl_certify::{Subject, sha256};
use sensedsl_diagnostics::SourceMap;
use sensedsl_model::design::{Board, Design};
use sensedsl_model::normal_path;
use sensedsl_parts::Completion;

use crate::{On, Snapshot};

/// How a snapshot was made, as its certificate states it.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    /// The program with its version.
    pub tool: &'a str,
    /// The requested file, with the path of its snapshot.
    pub path: &'a str,
    /// The board and target that the file was read for.
    pub on: On<'a>,
    /// The path and text of the earlier answer, if wires were to be kept.
    pub keep: Option<(&'a str, &'a str)>,
}

impl Snapshot {
    /// The subject of a certificate for the design. If there is no design, it is only the origin.
    #[must_use]
    pub fn subject(&self, origin: &Origin<'_>) -> Subject {
        let sources = self.sources();
        let mut files: Vec<(String, String)> = Vec::new();
        for file in self.files() {
            let text = sources.text(*file);
            files.push((named(origin.path, sources.name(*file)), sha256(text.as_bytes())));
        }
        let keep = origin.keep;
        files.extend(keep.map(|(path, text)| (path.to_owned(), sha256(text.as_bytes()))));
        let options = [
            ("--board", origin.on.board),
            ("--target", origin.on.target),
            ("--keep", keep.map(|(path, _)| path)),
        ];
        let options =
            options.into_iter().filter_map(|(name, value)| Some((name.into(), value?.into())));
        Subject {
            tool: origin.tool.to_owned(),
            options: options.collect(),
            files: BTreeSet::from_iter(files).into_iter().collect(),
            built_in: self.design().map(|design| built_in(design, sources)).unwrap_or_default(),
        }
    }
}

/// The built-in data in use: the arguments that print each, with the checksum of the output.
fn built_in(design: &Design, sources: &SourceMap) -> Vec<(String, String)> {
    let mut found = BTreeSet::new();
    for board in &design.boards {
        found.extend(pins(board, sources).map(|(how, text)| (how, sha256(text.as_bytes()))));
        found.extend(drivers(board).map(|(how, text)| (how, sha256(text.as_bytes()))));
    }
    found.into_iter().collect()
}

/// The name of a file as the requested file gives it, relative to that file's folder.
fn named(main: &str, path: &str) -> String {
    let folder = main.rfind('/').map_or("", |end| main.get(..=end).unwrap_or_default());
    normal_path(path.strip_prefix(folder).unwrap_or(path))
}

/// The built-in pins, and the arguments that print them.
fn pins(board: &Board, sources: &SourceMap) -> Option<(String, String)> {
    let shown = sources.name(board.table_file);
    if board.built_in {
        let name = shown.strip_prefix("boards/")?.strip_suffix("/pins.csv")?;
        return Some((format!("boards {name}"), printed_board(catalog::find(name)?)));
    }
    // A table without usages has those of its part, and so does a bare part.
    let mut table = table::load(sources.text(board.table_file)).board;
    table.mcu.clone_from(&board.mcu);
    let found = match sensedsl_parts::complete(&mut table) {
        Completion::Part { found, .. } => *found,
        Completion::Own | Completion::Unknown => {
            let part = shown.strip_prefix("parts/")?.strip_suffix(".csv")?;
            sensedsl_parts::find(part)?
        }
    };
    Some((format!("parts --table {}", found.mcu), found.csv()))
}

/// The profile of a board's target, and the arguments that print it.
fn drivers(board: &Board) -> Option<(String, String)> {
    let (target, mcu) = (&board.profile()?.name, board.mcu.as_deref()?);
    let text = profile::text(target, mcu)?;
    Some((format!("parts --profile {mcu} --target {target}"), text.to_owned()))
}

/// The table of a built-in board with the usages of its MCU, as `sensedsl boards` prints it.
#[must_use]
pub fn printed_board(board: &catalog::Entry) -> String {
    let mut table = board.table();
    match sensedsl_parts::complete(&mut table) {
        Completion::Part { .. } => table.to_csv(),
        // A table that lists its usages is printed unchanged.
        Completion::Own | Completion::Unknown => board.csv().to_owned(),
    }
}
