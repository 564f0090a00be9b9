//! The table of a run, as Markdown.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use anyhow::{Context as _, Result, ensure};

use super::cells::{ALL, KINDS};
use super::{Done, Outcome, PAGE};
use crate::{head, say};

/// By how much a size may differ from the page's, beside 16 bytes.
const SIZE_PERCENT: u64 = 2;

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
        let cell = |kind: &&str| {
            let is = |one: &&Done| one.cell.board == first.cell.board && one.cell.kind == **kind;
            done.iter().find(is).map(|one| text(&one.outcome)).unwrap_or_default()
        };
        let cells: Vec<String> = columns.iter().map(cell).collect();
        let _ = writeln!(page, "| {} | {} |", first.cell.board, cells.join(" | "));
    }
    page.push_str(&summary(done, &boards));
    Ok(page)
}

/// What the table says about a cell.
fn text(outcome: &Outcome) -> String {
    match outcome {
        Outcome::NotOffered => "·".to_owned(),
        Outcome::NoWiring(_) => "-".to_owned(),
        Outcome::Built(built, notes) if notes.rules.is_empty() => built.sizes(),
        Outcome::Built(built, _) => format!("{} *", built.sizes()),
        Outcome::TooLarge(_) => "too large".to_owned(),
        Outcome::Failed(_) => "**failed**".to_owned(),
    }
}

/// Whether two cells say the same. Sizes may be a little apart: the page is not written anew for each change.
fn is_alike(one: &str, other: &str) -> bool {
    let is_near = |one: &str, other: &str| match (one.parse::<u64>(), other.parse::<u64>()) {
        (Ok(one), Ok(other)) => one.abs_diff(other) * 100 <= one.max(other) * SIZE_PERCENT + 1_600,
        (_, _) => false,
    };
    let is_same = |(one, other): (&str, &str)| {
        let (sizes, others): (Vec<&str>, Vec<&str>) =
            (one.split('/').collect(), other.split('/').collect());
        let mut pairs = sizes.iter().zip(&others);
        one == other
            || (sizes.len() == 3
                && others.len() == 3
                && pairs.all(|(one, other)| is_near(one, other)))
    };
    one.split(' ').count() == other.split(' ').count()
        && one.split(' ').zip(other.split(' ')).all(is_same)
}

/// Compares cells with those of the page.
///
/// # Errors
///
/// Fails if a cell differs, and says which.
pub(super) fn compare(done: &[Done]) -> Result<()> {
    let page = std::fs::read_to_string(PAGE).with_context(|| PAGE.to_owned())?;
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split(" | ").collect()).collect();
    let kinds = rows.first().with_context(|| format!("{PAGE} has no table"))?;
    let on_page = |one: &Done| {
        let row = rows.iter().find(|row| row.first() == Some(&one.cell.board.as_str()))?;
        row.get(kinds.iter().position(|kind| *kind == one.cell.kind)?).copied()
    };
    let differences: Vec<String> = done
        .iter()
        .filter(|one| !on_page(one).is_some_and(|cell| is_alike(cell, &text(&one.outcome))))
        .map(|one| {
            let (cell, found) = (&one.cell, text(&one.outcome));
            format!(
                "{} {}: {found}, not {}",
                cell.board,
                cell.kind,
                on_page(one).unwrap_or("there")
            )
        })
        .collect();
    ensure!(differences.is_empty(), "{PAGE} differs:\n{}", differences.join("\n"));
    say(&format!("{} cells are as {PAGE} says\n", done.len()))
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

#[cfg(test)]
mod tests {
    use super::is_alike;

    #[test]
    fn sizes_may_be_a_little_apart() {
        assert!(is_alike("34446/100/8380 *", "34718/104/8388 *"));
        assert!(is_alike("·", "·"));
        for (one, other) in [
            ("34446/100/8380", "36446/100/8380"),
            ("34446/100/8380", "34446/100/8380 *"),
            ("34446/100/8380", "too large"),
            ("34446/100/8380 2 W", "34446/100/8380 3 W"),
            ("-", "·"),
        ] {
            assert!(!is_alike(one, other), "{one}, {other}");
        }
    }
}
