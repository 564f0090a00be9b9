//! `sensedsl import`: a board table, or a file with devices, from the files of other tools.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0803_import_no_sheet;
use sensedsl_import::{Format, Imported, Importer, Source, detect};
use sensedsl_model::FileUse;

use super::in_the_way;
use crate::cli::{ImportArgs, ImportFormat};
use crate::files::{Disk, is_stream, read_bytes, real_folder, shown, write_together};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &ImportArgs, terminal: &mut Terminal) -> Result<Status> {
    let bytes = read_bytes(&args.source, FileUse::Source)?;
    let table = table_path(args);
    let table_name = table.file_name().map(|name| name.to_string_lossy().into_owned());
    let (folder, root) = folders(args, &bytes);
    let disk = Disk::below(&root, &args.reach.allow_outside);
    let beside = |path: &str| disk.bytes(&folder.join(path), FileUse::Source);
    let source = Source {
        name: &shown(&args.source),
        bytes: &bytes,
        format: format(args.format),
        sheet: args.sheet.as_deref(),
        table: &table_name.unwrap_or_default(),
        beside: &beside,
    };
    let imported = Importer::default().import_for(&source, args.node.as_deref());
    terminal.diagnostics(&imported.diagnostics, &imported.sources)?;
    let Some((result, beside)) = results(args, &imported) else {
        let no_sheet = e0803_import_no_sheet::CODE;
        let by_flag = imported.diagnostics.iter().any(|one| one.code == no_sheet);
        return Ok(if by_flag { Status::Misused } else { Status::Wrong });
    };
    let Some(output) = file_to_write(args) else {
        terminal.result(result)?;
        return Ok(Status::Done);
    };
    if beside.is_some() && table == output {
        bail!("{} would hold both the devices and the table: end it in .sense", shown(output));
    }
    // The table comes first: a file is useless without the table that it names.
    let mut files: Vec<(&Path, &[u8])> = Vec::new();
    let beside = beside.filter(|_| !is_stream(output));
    files.extend(beside.map(|csv| (table.as_path(), csv.as_bytes())));
    files.push((output, result.as_bytes()));
    if !args.force {
        let refused = in_the_way::refuse(&files, "what was imported", terminal)?;
        if refused {
            return Ok(Status::Misused);
        }
    }
    write_together(&files)?;
    Ok(Status::Done)
}

/// The requested output file; `None` if the result is printed, or goes to a device, which cannot
/// have a table beside it.
fn file_to_write(args: &ImportArgs) -> Option<&Path> {
    args.output.as_deref().filter(|output| *output != Path::new("-"))
}

/// The folder of the source, and the one whose files it may name, which is the same. Boards of
/// ArduPilot and Zephyr include others in neighbouring folders, so for these it is the parent folder.
fn folders(args: &ImportArgs, bytes: &[u8]) -> (PathBuf, PathBuf) {
    let folder = args.source.parent().unwrap_or(Path::new("")).to_path_buf();
    let format = format(args.format).or_else(|| detect(bytes));
    if !matches!(format, Some(Format::Hwdef | Format::Zephyr)) {
        return (folder.clone(), folder);
    }
    // A folder such as `..` has no name, so it has no parent that could be named.
    let own = match folder.file_name() {
        Some(_) => folder,
        None => real_folder(&folder),
    };
    let above = own.parent().unwrap_or(Path::new("")).to_path_buf();
    (own, above)
}

/// The requested result, and the table that belongs beside it; `None` if there is no result.
fn results<'a>(args: &ImportArgs, imported: &'a Imported) -> Option<(&'a str, Option<&'a str>)> {
    let Some(table) = imported.table.as_deref() else {
        return imported.program.as_deref().map(|program| (program, None));
    };
    match imported.program.as_deref() {
        Some(program) if !args.table => Some((program, Some(table))),
        Some(_) | None => Some((table, None)),
    }
}

/// The place of a project's table: beside the result, or beside the source.
fn table_path(args: &ImportArgs) -> PathBuf {
    let stdin = args.source == Path::new("-");
    let source = if stdin { Path::new("board") } else { args.source.as_path() };
    file_to_write(args).filter(|output| !is_stream(output)).unwrap_or(source).with_extension("csv")
}

fn format(format: ImportFormat) -> Option<Format> {
    match format {
        ImportFormat::Auto => None,
        ImportFormat::Csv => Some(Format::Csv),
        ImportFormat::Xlsx => Some(Format::Xlsx),
        ImportFormat::Ods => Some(Format::Ods),
        ImportFormat::Cubemx => Some(Format::CubeMx),
        ImportFormat::Ioc => Some(Format::Ioc),
        ImportFormat::Hwdef => Some(Format::Hwdef),
        ImportFormat::Micropython => Some(Format::MicroPython),
        ImportFormat::Betaflight => Some(Format::Betaflight),
        ImportFormat::Zephyr => Some(Format::Zephyr),
        ImportFormat::Arduino => Some(Format::Arduino),
        ImportFormat::Dbc => Some(Format::Dbc),
    }
}
