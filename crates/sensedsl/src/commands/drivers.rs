//! `sensedsl drivers`: the library of drivers, or everything that is known about one part.

use anyhow::{Result, bail};
use sensedsl_diagnostics::{render, visible};
use sensedsl_model::facts::{self, PartFacts};
use sensedsl_report::drivers;

use crate::cli::{DriversArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &DriversArgs, terminal: &Terminal) -> Result<Status> {
    match &args.name {
        Some(name) => one(name, args.format, terminal)?,
        None => list(args, terminal)?,
    }
    Ok(Status::Done)
}

fn one(name: &str, format: TableFormat, terminal: &Terminal) -> Result<()> {
    let Some(part) = facts::find(name) else {
        let meant = facts::nearest_name(name);
        let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        let hint = match found(&facts::all(), None, name) {
            0 => "`sensedsl drivers` lists them".to_owned(),
            some => format!("`sensedsl drivers --search {}` finds {some}", visible(name)),
        };
        bail!("there is no driver {name}{meant} ({hint})");
    };
    match format {
        TableFormat::Human => terminal.result(&drivers::one(&part))?,
        TableFormat::Json => terminal.result(&render::json_text(&drivers::values(&[part])))?,
    }
    Ok(())
}

fn found(parts: &[PartFacts], kind: Option<sensedsl_model::kind::KindName>, words: &str) -> usize {
    parts.iter().filter(|part| drivers::is_wanted(part, kind, words)).count()
}

fn list(args: &DriversArgs, terminal: &Terminal) -> Result<()> {
    let mut parts = facts::all();
    let search = args.search.as_deref().unwrap_or_default();
    parts.retain(|part| drivers::is_wanted(part, args.kind, search));
    if args.format == TableFormat::Json {
        terminal.result(&render::json_text(&drivers::values(&parts)))?;
        return Ok(());
    }
    terminal.result(&drivers::listing(&parts))?;
    let count = match parts.len() {
        1 => "1 driver".to_owned(),
        some => format!("{some} drivers"),
    };
    terminal.aside(&format!("{count}; `sensedsl drivers NAME` tells all about one"))?;
    Ok(())
}
