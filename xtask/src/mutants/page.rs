//! What came of the mistakes that were drawn, as Markdown.

use std::collections::BTreeMap;

/// The classes in the order of the table: as they are written down, and as people read them.
const CLASSES: [(&str, &str); 5] = [
    ("compiler", "refused by the compiler"),
    ("same program", "the same program, byte for byte"),
    ("same behaviour", "the same bytes, levels and pulses at the same times, in both worlds"),
    ("command", "noticed by the command"),
    ("nobody", "noticed by nobody"),
];

/// A table of counts, and one of those that nobody noticed.
pub(super) fn page(lines: &str) -> String {
    let rows: Vec<Vec<&str>> = lines.lines().map(|line| line.split('\t').collect()).collect();
    let cell = |row: &[&str], at: usize| row.get(at).copied().unwrap_or_default().to_owned();
    let mut counts: BTreeMap<(String, String), usize> = BTreeMap::new();
    for row in &rows {
        *counts.entry((cell(row, 5), cell(row, 0))).or_default() += 1;
    }
    let count = |class: &str, target: &str| {
        counts.get(&(class.to_owned(), target.to_owned())).copied().unwrap_or(0)
    };
    let mut text = "| | ChibiOS | Embassy | both |\n| --- | --- | --- | --- |\n".to_owned();
    for (class, told) in CLASSES {
        let (one, other) = (count(class, "chibios"), count(class, "embassy"));
        text.push_str(&format!("| {told} | {one} | {other} | {} |\n", one + other));
    }
    text.push_str(&format!("\n{} mistakes were drawn.\n", rows.len()));
    text.push_str("\n| mistake that nobody notices | |\n| --- | --- |\n");
    for row in rows.iter().filter(|row| cell(row, 5) == "nobody") {
        let [target, design, sort, place, told] = [0, 1, 2, 3, 4].map(|at| cell(row, at));
        let said = cell(row, 6).replace('|', "\\|");
        text.push_str(&format!("| {target}, {design}: {sort} at {place}: {told} | {said} |\n"));
    }
    text
}
