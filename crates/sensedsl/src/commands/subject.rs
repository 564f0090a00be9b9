//! What a certificate is of: the files that were read, what is built in, the options.

use std::collections::BTreeSet;
use std::path::Path;

use sensedsl_board::{catalog, profile, table};
use sensedsl_certify::{Subject, sha256};
use sensedsl_diagnostics::SourceMap;
use sensedsl_model::design::{Board, Design};
use sensedsl_model::{Resolved, normal_path};
use sensedsl_parts::Completion;

use super::boards;
use crate::cli::SolveArgs;
use crate::files::shown;

/// The program with its version.
const TOOL: &str = concat!("sensedsl ", env!("CARGO_PKG_VERSION"));

/// What the problem of a design was made of; `kept` is the text of the earlier answer.
pub(crate) fn of(
    args: &SolveArgs,
    resolved: &Resolved,
    design: &Design,
    kept: Option<String>,
) -> Subject {
    let sources = &resolved.sources;
    let main = shown(&args.file);
    let mut files: Vec<(String, String)> = Vec::new();
    for file in &resolved.files {
        let text = sources.text(*file);
        files.push((named(&main, sources.name(*file)), sha256(text.as_bytes())));
    }
    let keep = args.keep.as_deref().map(shown);
    files.extend(keep.clone().zip(kept).map(|(path, text)| (path, sha256(text.as_bytes()))));
    let mut built_in = BTreeSet::new();
    for board in &design.boards {
        built_in.extend(pins(board, sources).map(|(how, text)| (how, sha256(text.as_bytes()))));
        built_in.extend(drivers(board).map(|(how, text)| (how, sha256(text.as_bytes()))));
    }
    let options = [
        ("--board", args.on.board.clone()),
        ("--target", args.on.target.clone()),
        ("--keep", keep),
    ];
    let options = options.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
    Subject {
        tool: TOOL.to_owned(),
        options: options.collect(),
        files: BTreeSet::from_iter(files).into_iter().collect(),
        built_in: built_in.into_iter().collect(),
    }
}

/// The name of a file as the one that was asked for gives it: seen from that one's folder.
fn named(main: &str, path: &str) -> String {
    let folder = Path::new(main).parent().unwrap_or(Path::new(""));
    let inside = Path::new(path).strip_prefix(folder).unwrap_or(Path::new(path));
    normal_path(&inside.to_string_lossy())
}

/// The pins that are built in, and the arguments that print them.
fn pins(board: &Board, sources: &SourceMap) -> Option<(String, String)> {
    let shown = sources.name(board.table_file);
    if board.built_in {
        let name = shown.strip_prefix("boards/")?.strip_suffix("/pins.csv")?;
        return Some((format!("boards {name}"), boards::printed(catalog::find(name)?)));
    }
    // A table without usages has those of its part, and so has a bare part.
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
