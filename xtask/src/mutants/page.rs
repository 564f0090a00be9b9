//! The results for the mistakes that were drawn, as Markdown.

use std::collections::BTreeMap;

/// The classes in the order of the table: as they are in the file, and as people read them.
const CLASSES: [(&str, &str); 6] = [
    ("compiler", "refused by the compiler"),
    ("same program", "the same program, byte for byte"),
    ("same behaviour", "the same levels, pulses, transfers, frames and values in both worlds"),
    ("command", "noticed by the command"),
    ("nobody", "noticed by nobody"),
    ("late", "not run to the end"),
];

/// The number of mistakes that the command has noticed, and of those that it has not noticed
/// although they change the output.
fn noticed(lines: &str) -> [usize; 2] {
    ["command", "nobody"].map(|class| {
        let is_of = |line: &&str| line.split('\t').nth(6) == Some(class);
        lines.lines().filter(is_of).count()
    })
}

/// The percentage noticed of those that change the output.
pub(super) fn share(lines: &str) -> usize {
    let [noticed, escaped] = noticed(lines);
    (100 * noticed).checked_div(noticed + escaped).unwrap_or(100)
}

/// A table of counts, and one of the mistakes that nobody noticed.
pub(super) fn page(lines: &str) -> String {
    let rows: Vec<Vec<&str>> = lines.lines().map(|line| line.split('\t').collect()).collect();
    let cell = |row: &[&str], at: usize| row.get(at).copied().unwrap_or_default().to_owned();
    let mut counts: BTreeMap<(String, String), usize> = BTreeMap::new();
    for row in &rows {
        *counts.entry((cell(row, 6), cell(row, 1))).or_default() += 1;
    }
    let count = |class: &str, target: &str| {
        counts.get(&(class.to_owned(), target.to_owned())).copied().unwrap_or(0)
    };
    let mut text = "| | ChibiOS | Embassy | both |\n| --- | --- | --- | --- |\n".to_owned();
    for (class, reported) in CLASSES {
        let (one, other) = (count(class, "chibios"), count(class, "embassy"));
        text.push_str(&format!("| {reported} | {one} | {other} | {} |\n", one + other));
    }
    let [noticed, escaped] = noticed(lines);
    let share = share(lines);
    text.push_str(&format!(
        "\n{} mistakes were drawn; of {} that change what comes out, {noticed} are noticed: {share} %.\n",
        rows.len(),
        noticed + escaped
    ));
    text.push_str("\n| mistake that nobody notices | |\n| --- | --- |\n");
    for row in rows.iter().filter(|row| cell(row, 6) == "nobody") {
        let [target, design, sort, place, reported] = [1, 2, 3, 4, 5].map(|at| cell(row, at));
        let messages = cell(row, 7).replace('|', "\\|");
        text.push_str(&format!(
            "| {target}, {design}: {sort} at {place}: {reported} | {messages} |\n"
        ));
    }
    text
}
