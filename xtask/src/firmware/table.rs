//! The table of a run, as Markdown.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use anyhow::Result;

use super::cells::{ALL, KINDS};
use super::{Done, Outcome, PAGE};
use crate::head;

/// The whole page.
pub(super) fn page(done: &[Done]) -> Result<String> {
    let mut page = head(PAGE, "\n| board | ")?;
    let columns: Vec<&str> = KINDS
        .into_iter()
        .chain([ALL, "fig2", "car"])
        .filter(|kind| done.iter().any(|one| one.cell.kind == *kind))
        .collect();
    // Writing to a string cannot fail.
    let _ = writeln!(page, "| board | {} |", columns.join(" | "));
    let _ = writeln!(page, "|{}", " --- |".repeat(columns.len() + 1));
    let boards: Vec<&Done> = {
        let mut seen = BTreeSet::new();
        done.iter().filter(|one| seen.insert(&one.cell.board)).collect()
    };
    for first in &boards {
        let of = |kind: &&str| {
            let is = |one: &&Done| one.cell.board == first.cell.board && one.cell.kind == **kind;
            done.iter().find(is).map_or("", |one| mark(&one.outcome)).to_owned()
        };
        let sizes = |kind: &&str| {
            let is = |one: &&Done| one.cell.board == first.cell.board && one.cell.kind == **kind;
            match done.iter().find(is).map(|one| &one.outcome) {
                Some(Outcome::Built(built, notes)) => {
                    let mark = if notes.rules.is_empty() { "" } else { " *" };
                    format!("{}{mark}", built.sizes())
                }
                _ => of(kind),
            }
        };
        let cells: Vec<String> = columns.iter().map(sizes).collect();
        let _ = writeln!(page, "| {} | {} |", first.cell.board, cells.join(" | "));
    }
    page.push_str(&summary(done, &boards));
    Ok(page)
}

fn mark(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::NotOffered => "·",
        Outcome::NoWiring(_) => "-",
        Outcome::Built(..) => "built",
        Outcome::TooLarge(_) => "too large",
        Outcome::Failed(_) => "**failed**",
    }
}

/// The facts that the table cannot show.
fn summary(done: &[Done], boards: &[&Done]) -> String {
    let count = |mark: fn(&Outcome) -> bool| done.iter().filter(|one| mark(&one.outcome)).count();
    let built = count(|outcome| matches!(outcome, Outcome::Built(..)));
    let failed = count(|outcome| matches!(outcome, Outcome::Failed(_)));
    let none = count(|outcome| matches!(outcome, Outcome::NoWiring(_)));
    let large = count(|outcome| matches!(outcome, Outcome::TooLarge(_)));
    let not = count(|outcome| matches!(outcome, Outcome::NotOffered));
    let families: BTreeSet<&str> = boards.iter().map(|one| one.cell.family.as_str()).collect();
    let mut text = format!(
        "\n{} boards of {} families: {built} cells built, {failed} failed, {large} larger than the \
         memory, {none} without a wiring, {not} not offered.\n",
        boards.len(),
        families.len()
    );
    let mut list = |title: &str, line: &dyn Fn(&Done) -> Option<String>| {
        let lines: Vec<String> = done
            .iter()
            .filter_map(|one| {
                Some(wrapped(&format!("- {} {}: {}", one.cell.board, one.cell.kind, line(one)?)))
            })
            .collect();
        if !lines.is_empty() {
            let _ = write!(text, "\n## {title}\n\n{}", lines.concat());
        }
    };
    list("Failed", &|one| {
        let Outcome::Failed(why) = &one.outcome else { return None };
        Some(format!("`{}`", why.replace('`', "'")))
    });
    list("Larger than the MCU's memory", &|one| {
        let Outcome::TooLarge(why) = &one.outcome else { return None };
        Some(why.clone())
    });
    list("Warnings of our files", &|one| {
        let Outcome::Built(built, _) = &one.outcome else { return None };
        let first = built.warnings.first()?;
        Some(format!("{}, the first `{}`", built.warnings.len(), first.replace('`', "'")))
    });
    list("With rules for the board", &|one| {
        let Outcome::Built(_, notes) = &one.outcome else { return None };
        (!notes.rules.is_empty()).then(|| format!("`{}`", notes.rules.join(" ")))
    });
    list("Without a wiring", &|one| {
        let Outcome::NoWiring(why) = &one.outcome else { return None };
        Some(why.clone())
    });
    list("Left out of `all`", &|one| {
        let Outcome::Built(_, notes) = &one.outcome else { return None };
        (!notes.left_out.is_empty()).then(|| notes.left_out.join(", "))
    });
    text
}

/// A list item, wrapped to the width of prose.
pub(super) fn wrapped(item: &str) -> String {
    const LETTERS: usize = 120;
    let mut text = String::new();
    let mut letters = 0;
    for word in item.split(' ') {
        let own = word.chars().count();
        if letters > 0 && letters + 1 + own > LETTERS {
            text.push_str("\n  ");
            letters = 2;
        } else if letters > 0 {
            text.push(' ');
            letters += 1;
        }
        text.push_str(word);
        letters += own;
    }
    text.push('\n');
    text
}
