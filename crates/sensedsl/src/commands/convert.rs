//! `sensedsl convert`: a record as a table, a summary, or a page with plots.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::time::Duration;

use anyhow::{Context as _, Result, bail};
use sensedsl_diagnostics::codes::e0565_not_a_record::no_such_name;
use sensedsl_record::convert::{ConvertError, Form, Part, convert};
use sensedsl_record::summary::{HEADS, Summary};
use sensedsl_record::{Ending, page, summary};

use super::in_the_way;
use crate::cli::{ConvertArgs, ConvertTo};
use crate::files::{Refused, is_stream, no_record, open_record, write_streamed};
use crate::status::Status;
use crate::terminal::Terminal;
use sensedsl_report::columns::table as aligned;

pub(crate) fn run(args: &ConvertArgs, terminal: &Terminal) -> Result<Status> {
    let form = form(args)?;
    if let Some(output) = &args.output
        && output.exists()
        && !is_stream(output)
        && !args.force
    {
        in_the_way::say(output, "convert", terminal)?;
        return Ok(Status::Misused);
    }
    let ending = match (form, args.summary) {
        (_, true) => {
            let summary = summarised(args)?;
            written(args, |mut to| Ok(to.write_all(text(&summary).as_bytes())?))?;
            summary.ending
        }
        (ConvertTo::Html, false) => {
            let summary = summarised(args)?;
            let name = args.record.file_name().unwrap_or_default().to_string_lossy();
            let page = page::html(&summary, &name);
            written(args, |mut to| Ok(to.write_all(page.as_bytes())?))?;
            summary.ending
        }
        (form, false) => table(args, form, terminal)?,
    };
    if ending == Ending::Cut {
        terminal.aside("the record was cut off: this is all up to its last whole chunk")?;
    }
    Ok(Status::Done)
}

/// The form that is asked for, or that the ending of the output says.
fn form(args: &ConvertArgs) -> Result<ConvertTo> {
    if let Some(to) = args.to {
        return Ok(to);
    }
    let ending =
        args.output.as_deref().and_then(Path::extension).and_then(|ending| ending.to_str());
    Ok(match ending {
        None | Some("csv") => ConvertTo::Csv,
        Some("ndjson" | "jsonl" | "json") => ConvertTo::Ndjson,
        Some("parquet") => ConvertTo::Parquet,
        Some("html" | "htm") => ConvertTo::Html,
        Some(_) if args.summary => ConvertTo::Csv,
        Some(other) => {
            bail!("a record cannot be converted to `.{other}`: choose a format with `--to`")
        }
    })
}

fn part(args: &ConvertArgs) -> Part {
    Part {
        board: args.board.clone(),
        devices: args.device.clone(),
        from: args.from.map(Duration::from_secs_f64),
        until: args.until.map(Duration::from_secs_f64),
    }
}

fn summarised(args: &ConvertArgs) -> Result<Summary> {
    summary::summary(open_record(&args.record)?, &part(args)).map_err(|error| refusal(args, error))
}

/// The summary for a terminal.
pub(crate) fn text(summary: &Summary) -> String {
    let [device, numbers @ ..] = HEADS;
    let heads = [device.to_owned()].into_iter().chain(numbers.map(|head| format!(">{head}")));
    let heads: Vec<String> = heads.collect();
    let mut out = String::new();
    for board in &summary.boards {
        let _ = writeln!(out, "{}: {}", board.name, board.head(summary.lasted));
        for note in board.notes() {
            let _ = writeln!(out, "  {note}");
        }
        let rows: Vec<[String; HEADS.len()]> =
            board.devices.iter().flat_map(|device| device.rows(summary.lasted)).collect();
        let heads = std::array::from_fn(|column| heads.get(column).map_or("", String::as_str));
        out.push_str(&aligned(heads, &rows));
    }
    out
}

fn table(args: &ConvertArgs, form: ConvertTo, terminal: &Terminal) -> Result<Ending> {
    let form = match form {
        ConvertTo::Csv | ConvertTo::Html => Form::Csv,
        ConvertTo::Wide => Form::WideCsv,
        ConvertTo::Ndjson => Form::Ndjson,
        ConvertTo::Parquet => Form::Parquet,
    };
    if form == Form::Parquet && args.output.is_none() && terminal.is_watched() {
        bail!("Parquet is no text for a terminal: name a file with `-o`");
    }
    let reader = open_record(&args.record)?;
    let converted = written(args, |to| {
        convert(reader, form, &part(args), to).map_err(|error| refusal(args, error))
    })?;
    if args.output.is_some() {
        terminal.aside(&format!("{} values", converted.values))?;
    }
    Ok(converted.ending)
}

/// Lets something be written to the output, which is whole or not there.
fn written<T>(
    args: &ConvertArgs,
    fill: impl FnOnce(Box<dyn Write + Send>) -> Result<T>,
) -> Result<T> {
    match &args.output {
        Some(path) => write_streamed(path, fill),
        None => fill(Box::new(BufWriter::new(io::stdout()))).context("cannot write the result"),
    }
}

fn refusal(args: &ConvertArgs, error: ConvertError) -> anyhow::Error {
    match error {
        ConvertError::Read(error) => no_record(&args.record, &error.to_string()).into(),
        ConvertError::Write(error) => error.into(),
        ConvertError::Name(name, all) => {
            Refused::new(&args.record, |at, shown| no_such_name(at, shown, &name, &all)).into()
        }
    }
}
