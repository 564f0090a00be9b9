//! `sensedsl parts`: which MCU parts and boards can carry the devices of a file, or which there are.

use anyhow::{Result, bail};
use sensedsl_board::profile;
use sensedsl_parts::Part;

use super::sweep::sweep;
use super::table::table;
use crate::Status;
use crate::cli::PartsArgs;
use crate::terminal::Terminal;

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
        let target = args.target.as_deref().unwrap_or(profile::DEFAULT);
        let Some(text) = profile::text(target, name) else {
            bail!("there is no profile of {name} for the target {target}");
        };
        terminal.result(text)?;
        return Ok(Status::Done);
    }
    if let Some(search) = &args.list {
        terminal.result(&listing(args, search.as_deref().unwrap_or_default()))?;
        return Ok(Status::Done);
    }
    let Some(file) = &args.file else {
        bail!("which file? (`sensedsl parts --list` lists the parts)");
    };
    sweep(args, file, terminal)
}

/// The parts that the filters leave.
pub(super) fn parts(args: &PartsArgs) -> impl Iterator<Item = Part> {
    let upper = |text: &Option<String>| text.as_ref().map(|text| text.to_uppercase());
    let (family, package) = (upper(&args.family), upper(&args.package));
    let pins_max = args.max_pins;
    sensedsl_parts::all().filter(move |part| {
        fits(part.base(), part.package(), part.contacts(), family.as_deref(), package.as_deref())
            && pins_max.is_none_or(|most| part.contacts().is_some_and(|pins| pins <= most))
    })
}

/// Whether a part, or a board's MCU, is of the family and in the package asked for.
pub(super) fn fits(
    base: &str,
    of: Option<&str>,
    contacts: Option<u32>,
    family: Option<&str>,
    package: Option<&str>,
) -> bool {
    let begins = |family: &str| {
        base.starts_with(family)
            || base.strip_prefix("STM32").is_some_and(|base| base.starts_with(family))
    };
    let packed = |package: &str| {
        of.is_some_and(|of| of.to_uppercase().starts_with(package))
            || contacts.is_some_and(|contacts| contacts.to_string() == package)
    };
    family.is_none_or(begins) && package.is_none_or(packed)
}

fn listing(args: &PartsArgs, search: &str) -> String {
    let search = search.to_uppercase();
    let words: Vec<&str> = search.split_whitespace().collect();
    let rows = parts(args).filter_map(|part| {
        let package = part.package().unwrap_or("-");
        let numbers: Vec<String> = part.numbers().collect();
        let text = format!("{} {}", numbers.join(" "), package.to_uppercase());
        let found = words.iter().all(|word| text.contains(word));
        let others = numbers.get(1..).unwrap_or_default().join(" ");
        found.then(|| [part.name(), package.to_owned(), others])
    });
    let rows: Vec<[String; 3]> = rows.collect();
    let count = match rows.len() {
        1 => "1 part".to_owned(),
        some => format!("{some} parts"),
    };
    let heads = [("Part", false), ("Package", false), ("Also", false)];
    format!(
        "{}\n{count}; `sensedsl parts --table PART` prints the pins of one{}\n",
        table(heads, &rows),
        spelled_in_a_file(&rows)
    )
}

/// How a file spells a part whose name has a hyphen, where one is listed.
fn spelled_in_a_file(rows: &[[String; 3]]) -> String {
    let hyphened = rows.iter().find(|[name, ..]| name.contains('-'));
    hyphened.map_or_else(String::new, |[name, ..]| {
        format!("; in a file write `_` for `-`: `board Robot on {}`", name.replace('-', "_"))
    })
}
