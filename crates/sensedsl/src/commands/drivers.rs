//! `sensedsl drivers`: the library of drivers, everything that is known about one part, or a driver to begin with.

use anyhow::{Result, bail};
use sensedsl_diagnostics::{render, visible};
use sensedsl_model::facts::{self, PartFacts};
use sensedsl_model::kind::KindName;
use sensedsl_report::drivers;

use crate::cli::{DriversArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &DriversArgs, terminal: &Terminal) -> Result<Status> {
    match (&args.new, &args.name) {
        (Some(name), _) => begin(name, args.kind.unwrap_or(KindName::I2c), terminal)?,
        (None, Some(name)) if args.source => source(name, terminal)?,
        (None, Some(name)) => one(name, args.format, terminal)?,
        (None, None) => list(args, terminal)?,
    }
    Ok(Status::Done)
}

/// The kinds that there is a driver to begin with for.
const BEGINNINGS: [(KindName, &str); 10] = [
    (KindName::I2c, include_str!("../../templates/drivers/i2c.sense")),
    (KindName::Spi, include_str!("../../templates/drivers/spi.sense")),
    (KindName::Uart, include_str!("../../templates/drivers/uart.sense")),
    (KindName::Analog, include_str!("../../templates/drivers/analog.sense")),
    (KindName::Icu, include_str!("../../templates/drivers/icu.sense")),
    (KindName::Pwm, include_str!("../../templates/drivers/pwm.sense")),
    (KindName::Can, include_str!("../../templates/drivers/can.sense")),
    (KindName::Digital, include_str!("../../templates/drivers/digital.sense")),
    (KindName::Encoder, include_str!("../../templates/drivers/encoder.sense")),
    (KindName::OneWire, include_str!("../../templates/drivers/onewire.sense")),
];

/// Prints a driver to begin with.
fn begin(name: &str, kind: KindName, terminal: &Terminal) -> Result<()> {
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !is_name {
        bail!(
            "`{}` cannot be a name: use letters, digits and `_`, and begin with no digit",
            visible(name)
        );
    }
    let Some((_, text)) = BEGINNINGS.iter().find(|(one, _)| *one == kind) else {
        let kind = kind.spec().name;
        bail!(
            "there is no driver to begin with for {kind}: `sensedsl drivers --kind {kind}` lists some to copy from"
        );
    };
    if let Some(part) = facts::find(name) {
        terminal
            .aside(&format!("the library has `{}` for {}; yours wins", part.name, part.part))?;
    }
    terminal.result(&text.replace("NAME", name))?;
    Ok(())
}

/// Prints the driver itself, as the library has it.
fn source(name: &str, terminal: &Terminal) -> Result<()> {
    let Some(text) = facts::source(name) else { bail!("{}", missing(name)) };
    terminal.result(&text)?;
    Ok(())
}

fn one(name: &str, format: TableFormat, terminal: &Terminal) -> Result<()> {
    let Some(part) = facts::find(name) else { bail!("{}", missing(name)) };
    match format {
        TableFormat::Human => terminal.result(&drivers::one(&part))?,
        TableFormat::Json => terminal.result(&render::json_text(&drivers::values(&[part])))?,
    }
    Ok(())
}

/// What to say of a name that no driver has: what is nearest, and how to write one.
fn missing(name: &str) -> String {
    let near = facts::near(name);
    let mut hints = Vec::new();
    if !near.similar.is_empty() {
        hints.push(format!("of the same sort: {}", near.similar.join(", ")));
    }
    match found(&facts::all(), None, name) {
        0 => hints.push("`sensedsl drivers` lists all".to_owned()),
        some => hints.push(format!("`sensedsl drivers --search {}` finds {some}", visible(name))),
    }
    let meant = near.meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
    format!("there is no driver {}{meant} ({}). {}", visible(name), hints.join("; "), begun(name))
}

/// How to write a driver of that name.
fn begun(name: &str) -> String {
    let new = facts::identifier(name);
    format!(
        "`sensedsl drivers --new {new}` begins one; docs/driver-language.md says what can stand in it"
    )
}

fn found(parts: &[PartFacts], kind: Option<KindName>, words: &str) -> usize {
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
        0 if !search.is_empty() => {
            let near = facts::near(search);
            let similar: Vec<String> = near.meant.into_iter().chain(near.similar).collect();
            let hint = match similar.as_slice() {
                [] => "try another word, such as `temperature`".to_owned(),
                some => format!("near to it: {}", some.join(", ")),
            };
            return aside_of_none(&hint, search, terminal);
        }
        1 => "1 driver".to_owned(),
        some => format!("{some} drivers"),
    };
    terminal.aside(&format!("{count}; `sensedsl drivers NAME` tells all about one"))?;
    Ok(())
}

/// What is said of a search that finds nothing.
fn aside_of_none(hint: &str, search: &str, terminal: &Terminal) -> Result<()> {
    terminal.aside(&format!("0 drivers; {hint}. {}", begun(search)))?;
    Ok(())
}
