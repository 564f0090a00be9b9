//! `sensedsl import`: a board table, or a file with devices, from what other tools write.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0803_import_no_sheet;
use sensedsl_import::{Format, Imported, Source, import};

use crate::Status;
use crate::cli::{ImportArgs, ImportFormat};
use crate::files::{read_bytes, read_if_there, shown, write_whole};
use crate::terminal::Terminal;

pub(crate) fn run(args: &ImportArgs, terminal: &mut Terminal) -> Result<Status> {
    let bytes = read_bytes(&args.source)?;
    let table = table_path(args);
    let table_name = table.file_name().map(|name| name.to_string_lossy().into_owned());
    let folder = args.source.parent().unwrap_or(Path::new("")).to_path_buf();
    // What cannot be read is as good as not there: the importer says what it needs it for.
    let beside = |path: &str| read_if_there(&folder.join(path)).ok().flatten();
    let imported = import(&Source {
        name: &shown(&args.source),
        bytes: &bytes,
        format: format(args.format),
        sheet: args.sheet.as_deref(),
        table: &table_name.unwrap_or_default(),
        beside: &beside,
    });
    terminal.diagnostics(&imported.diagnostics, &imported.sources)?;
    let Some((result, beside)) = results(args, &imported) else {
        let no_sheet = &e0803_import_no_sheet::INFO;
        let by_flag = imported.diagnostics.iter().any(|one| one.code.info() == no_sheet);
        return Ok(if by_flag { Status::Misused } else { Status::Wrong });
    };
    let Some(output) = &args.output else {
        terminal.result(result)?;
        return Ok(Status::Done);
    };
    if beside.is_some() && table == *output {
        bail!("{} would hold both the devices and the table: end it in .sense", shown(output));
    }
    if let Some(csv) = beside {
        write_whole(&table, csv.as_bytes())?;
    }
    write_whole(output, result.as_bytes())?;
    Ok(Status::Done)
}

/// What is asked for, and the table that goes beside it; none when there is no result.
fn results<'a>(args: &ImportArgs, imported: &'a Imported) -> Option<(&'a str, Option<&'a str>)> {
    let table = imported.table.as_deref()?;
    match imported.program.as_deref() {
        Some(program) if !args.table => Some((program, Some(table))),
        Some(_) | None => Some((table, None)),
    }
}

/// Where the table of a project goes: beside the result, or beside the source.
fn table_path(args: &ImportArgs) -> PathBuf {
    let stdin = args.source == Path::new("-");
    let source = if stdin { Path::new("board") } else { args.source.as_path() };
    args.output.as_deref().unwrap_or(source).with_extension("csv")
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
    }
}
