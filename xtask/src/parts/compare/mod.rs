//! `cargo xtask parts --compare FOLDER`: compares the parts table with ST's open pin data in the
//! folder.
//!
//! Both sides become sets of facts by part number: which pin carries which usage of the peripherals
//! that device kinds need, with its alternate function or its remap blocks, and which contact each
//! pin is on. Each difference must belong to a class that `crates/parts/data/differences.md`
//! explains, no class may grow, and at least 99.5 % of the usages must agree.

mod classes;
mod read;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Result, ensure};

use super::super::say;
use classes::{Classes, Difference, Side};
use read::{Chip, Facts};

/// The least percentage of usages that must agree.
const AGREEMENT_MIN: f64 = 99.5;
/// The most unexplained differences that are shown.
const SHOWN_MAX: usize = 40;

/// The counts of a comparison.
#[derive(Default)]
struct Tally {
    parts: BTreeSet<String>,
    families: BTreeSet<String>,
    same: u64,
    positions: u64,
    packages: u64,
    shared: u64,
    only_st: BTreeSet<String>,
    differences: Vec<Difference>,
}

/// Runs the command.
pub(crate) fn run(root: &Path, folder: &Path) -> Result<()> {
    let imported = read::import_all(folder)?;
    let work = imported.work.map_or(String::new(), |work| format!(", {work:.2?} of work"));
    let build = if cfg!(debug_assertions) { "development" } else { "release" };
    say(&format!(
        "{} MCU files imported in {:.2?}{work} ({build} build)\n",
        imported.tables.len(),
        imported.wall,
    ))?;
    let mut tally = Tally::default();
    for csv in &imported.tables {
        let chip = read::chip(csv)?;
        for number in &chip.numbers {
            compare(&chip, number, &mut tally)?;
        }
    }
    let path = root.join("crates/parts/data/differences.md");
    let mut classes = Classes::parse(&super::sources::text(&path)?)?;
    let (mut unexplained, mut usages) = (Vec::new(), 0_u64);
    for difference in &tally.differences {
        usages += u64::from(difference.is_usage());
        if !classes.count(difference) {
            unexplained.push(difference.to_string());
        }
    }
    judge(&tally, &classes, &unexplained, usages)
}

fn judge(tally: &Tally, classes: &Classes, unexplained: &[String], usages: u64) -> Result<()> {
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^52")]
    let agreement = 100.0 * tally.same as f64 / (tally.same + usages) as f64;
    say(&format!(
        "{} part numbers of {} families in both, {} only in ST's data\n\
         {} usages agree, {usages} differ: {agreement:.3} %\n\
         {} packages and {} positions agree, {} of them on shared contacts\n",
        tally.parts.len(),
        tally.families.len(),
        tally.only_st.len(),
        tally.same,
        tally.packages,
        tally.positions,
        tally.shared,
    ))?;
    for line in classes.report() {
        say(&format!("{line}\n"))?;
    }
    for line in unexplained.iter().take(SHOWN_MAX) {
        say(&format!("unexplained: {line}\n"))?;
    }
    ensure!(unexplained.is_empty(), "{} differences are not explained", unexplained.len());
    ensure!(tally.parts.len() >= 2_000, "too few parts are in both to compare");
    let grown = classes.grown();
    ensure!(grown.is_empty(), "there are more differences than before: {}", grown.join("; "));
    ensure!(agreement >= AGREEMENT_MIN, "less than {AGREEMENT_MIN} % agree");
    Ok(())
}

/// Compares one of ST's part numbers with the table's part that has the same number.
fn compare(chip: &Chip, number: &str, tally: &mut Tally) -> Result<()> {
    let found = sensedsl_parts::find(number);
    let Some(found) = found.filter(|found| found.mcu.len() == number.len()) else {
        tally.only_st.insert(number.to_owned());
        return Ok(());
    };
    let own = read::facts(&found.csv())?;
    let st = &chip.facts;
    tally.parts.insert(number.to_owned());
    tally.families.insert(number.get(..7).unwrap_or(number).to_owned());
    let mut differ = |side, pin: &str, what: &str| {
        tally.differences.push(Difference {
            side,
            part: number.to_owned(),
            pin: pin.to_owned(),
            what: what.to_owned(),
        });
    };
    // A part without positions has all pins of its die.
    let known = found.package().is_some();
    for ((pin, usage), theirs) in &st.usages {
        match (theirs, own.usages.get(&(pin.clone(), usage.clone()))) {
            (_, None) => differ(Side::St, pin, usage),
            // If ST's data do not give it, there is nothing to compare.
            (theirs, Some(ours)) if theirs.is_known() && theirs != ours => {
                differ(Side::Both, pin, &format!("{usage} {theirs} {ours}"));
            }
            _ => tally.same += 1,
        }
    }
    for (pin, usage) in own.usages.keys() {
        let brought_out = known || st.positions.contains_key(pin);
        if brought_out && !st.usages.contains_key(&(pin.clone(), usage.clone())) {
            differ(Side::Own, pin, usage);
        }
    }
    if !known {
        return Ok(());
    }
    let package = found.package().unwrap_or_default();
    if package == chip.package {
        tally.packages += 1;
    } else {
        differ(Side::Both, "package", &format!("{}/{package}", chip.package));
    }
    positions(st, &own, tally, number);
    Ok(())
}

/// Compares the contact of each pin.
fn positions(st: &Facts, own: &Facts, tally: &mut Tally, number: &str) {
    let mut on: BTreeMap<&str, u64> = BTreeMap::new();
    for position in st.positions.values() {
        *on.entry(position).or_default() += 1;
    }
    let pins: BTreeSet<&String> = st.positions.keys().chain(own.positions.keys()).collect();
    for pin in pins {
        let (theirs, ours) = (st.positions.get(pin), own.positions.get(pin));
        let side = match (theirs, ours) {
            (Some(theirs), Some(ours)) if theirs == ours => {
                tally.positions += 1;
                tally.shared += u64::from(on.get(theirs.as_str()).is_some_and(|pins| *pins > 1));
                continue;
            }
            (Some(_), None) => Side::St,
            (None, Some(_)) => Side::Own,
            _ => Side::Both,
        };
        let shown = |place: Option<&String>| place.cloned().unwrap_or_else(|| "-".to_owned());
        tally.differences.push(Difference {
            side,
            part: number.to_owned(),
            pin: pin.clone(),
            what: format!("contact {}/{}", shown(theirs), shown(ours)),
        });
    }
}
