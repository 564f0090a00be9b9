//! `sensedsl parts`: the MCU parts and boards that can carry the devices of a file, or all that there are.

use anyhow::{Result, bail};
use sensedsl_board::profile;
use sensedsl_parts::Part;
use serde_json::json;

use super::against;
use super::facts::{Facts, Filter, units};
use super::sweep::sweep;
use crate::cli::{PartsArgs, PartsOrder, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;
use sensedsl_report::columns::table;

pub(crate) fn run(args: &PartsArgs, terminal: &mut Terminal) -> Result<Status> {
    if let Some(name) = &args.table {
        let Some(found) = sensedsl_parts::find(name) else {
            let meant = sensedsl_parts::nearest_name(name);
            let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
            bail!("there is no part {name}{meant} (`sensedsl parts --list` lists them)");
        };
        terminal.result(&found.csv())?;
        return Ok(Status::Done);
    }
    if let Some(name) = &args.profile {
        let target = args.target.as_deref().unwrap_or_else(|| profile::usual(name));
        let Some(text) = profile::text(target, name) else {
            bail!("there is no profile of {name} for the target {target}");
        };
        terminal.result(text)?;
        return Ok(Status::Done);
    }
    if let Some(search) = &args.list {
        terminal.result(&listing(args, search.as_deref().unwrap_or_default())?)?;
        return Ok(Status::Done);
    }
    let Some(file) = &args.file else {
        bail!("which file? (`sensedsl parts --list` lists the parts)");
    };
    match &args.against {
        Some(other) => against::run(args, file, other, terminal),
        None => sweep(args, file, terminal),
    }
}

/// The parts that pass the filters.
pub(super) fn parts(args: &PartsArgs) -> impl Iterator<Item = (Part, Facts)> {
    let filter = Filter::of(args);
    let with_facts = sensedsl_parts::all().map(|part| (part, Facts::of(part)));
    with_facts.filter(move |(part, facts)| filter.leaves(part.base(), facts))
}

/// The rank of a part in an order; the cost of a wiring is not known here.
pub(super) fn rank(order: Option<PartsOrder>, facts: &Facts) -> usize {
    match order {
        None | Some(PartsOrder::Cost) => 0,
        Some(PartsOrder::Pins) => {
            facts.contacts.and_then(|pins| pins.try_into().ok()).unwrap_or(usize::MAX)
        }
        Some(PartsOrder::Flash) => facts.flash_bytes.unwrap_or(usize::MAX),
        Some(PartsOrder::Ram) => facts.ram_bytes.unwrap_or(usize::MAX),
    }
}

fn listing(args: &PartsArgs, search: &str) -> Result<String> {
    if args.sort == Some(PartsOrder::Cost) {
        bail!("a list has no wirings to sort by cost: name a file, or sort by pins, flash or ram");
    }
    let search = search.to_uppercase();
    let words: Vec<&str> = search.split_whitespace().collect();
    let found = parts(args).filter(|(part, facts)| {
        let package = facts.package.unwrap_or("-").to_uppercase();
        let text = part.numbers().chain([package]).collect::<Vec<_>>().join(" ");
        words.iter().all(|word| text.contains(word))
    });
    let mut found: Vec<(Part, Facts)> = found.collect();
    // Equal parts stay in the order of their names.
    found.sort_by_key(|(_, facts)| rank(args.sort, facts));
    if args.format == TableFormat::Json {
        return Ok(found.iter().map(|(part, facts)| value(*part, facts)).collect());
    }
    let row = |(part, facts): &(Part, Facts)| {
        let [package, core, flash, ram] = facts.cells();
        let code = |number: String| number.replacen(part.base(), "…", 1);
        let others: Vec<String> = part.numbers().skip(1).map(code).collect();
        [part.name(), package, core, flash, ram, others.join(" ")]
    };
    let rows: Vec<[String; 6]> = found.iter().map(row).collect();
    let count = match rows.len() {
        0 => return Ok("0 parts\n".to_owned()),
        1 => "1 part".to_owned(),
        some => format!("{some} parts"),
    };
    Ok(format!(
        "{}\n{count}; {}\n`sensedsl parts --table PART` prints the pins of one{}\n",
        table(HEADS, &rows),
        units(found.iter().map(|(_, facts)| facts)),
        spelled_in_a_file(&rows)
    ))
}

const HEADS: [&str; 6] = ["Part", "Package", "Core", ">Flash", ">RAM", "Also"];

/// A line of JSON.
fn value(part: Part, facts: &Facts) -> String {
    let numbers: Vec<String> = part.numbers().collect();
    facts.json_line(&part.name(), [("numbers", json!(numbers))])
}

/// Explains the spelling in a file if a listed part's name has a hyphen.
fn spelled_in_a_file(rows: &[[String; 6]]) -> String {
    let hyphened = rows.iter().find(|[name, ..]| name.contains('-'));
    hyphened.map_or_else(String::new, |[name, ..]| {
        format!("\nin a file write `_` for `-`: `board Robot on {}`", name.replace('-', "_"))
    })
}
