//! The places in generated code and in the runtime at which one thing can be replaced by another, and a random choice
//! of them.

use std::path::{Path, PathBuf};

use anyhow::Result;

/// A replacement at a place.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) file: PathBuf,
    /// The line, counted from 1.
    pub(super) line: usize,
    range: std::ops::Range<usize>,
    with: String,
    /// The sort of mistake, for the table: `number`, `operator`, `row`, `line`.
    pub(super) sort: &'static str,
}

const OPERATORS: [(&str, &str); 17] = [
    (" == ", " != "),
    (" != ", " == "),
    (" < ", " <= "),
    (" <= ", " < "),
    (" > ", " >= "),
    (" >= ", " > "),
    (" && ", " || "),
    (" || ", " && "),
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" << ", " >> "),
    (" & ", " | "),
    (" | ", " & "),
    ("true", "false"),
    ("false", "true"),
];

/// The starts of lines that only declare something.
const SAYING: [&str; 12] = [
    "static", "const", "extern", "typedef", "struct", "return", "uint", "int", "bool", "use ",
    "pub ", "let ",
];

impl Site {
    /// The text with the mistake in it.
    pub(super) fn made(&self, text: &str) -> String {
        let (before, rest) = text.split_at(self.range.start);
        format!("{before}{}{}", self.with, rest.get(self.range.len()..).unwrap_or_default())
    }

    /// The old and the new text, for people.
    pub(super) fn reported(&self, text: &str) -> String {
        let was = text.get(self.range.clone()).unwrap_or_default();
        let [was, with] = [was, &self.with].map(|one| {
            let one = one.split_whitespace().collect::<Vec<&str>>().join(" ");
            one.chars().take(60).collect::<String>()
        });
        format!("`{was}` is `{with}`").replace('|', "\\|")
    }
}

/// All sites in a file.
pub(super) fn sites(file: &Path, text: &str) -> Vec<Site> {
    let mut all = Vec::new();
    let mut start = 0;
    let mut is_comment = false;
    let mut before: Option<(usize, &str)> = None;
    for (number, line) in (1..).zip(text.split_inclusive('\n')) {
        let trimmed = line.trim();
        is_comment |= trimmed.starts_with("/*") && !trimmed.contains("*/");
        let is_code = !is_comment && !["#", "//", "*"].iter().any(|one| trimmed.starts_with(one));
        is_comment &= !trimmed.contains("*/");
        if is_code {
            let mut add = |range: std::ops::Range<usize>, with: String, sort| {
                let file = file.to_owned();
                let range = start + range.start..start + range.end;
                all.push(Site { file, line: number, range, with, sort });
            };
            of_line(line, &mut add);
        }
        if let Some((at, above)) = before.filter(|_| is_code)
            && let Some(with) = swapped(above, line)
        {
            let (file, range) = (file.to_owned(), at..start + line.len());
            all.push(Site { file, line: number, range, with, sort: "row" });
        }
        before = is_code.then_some((start, line));
        start += line.len();
    }
    all
}

fn of_line(line: &str, add: &mut impl FnMut(std::ops::Range<usize>, String, &'static str)) {
    for (operator, with) in OPERATORS {
        for (at, _) in line.match_indices(operator) {
            let is_inside = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_alphanumeric);
            let bytes = line.as_bytes();
            let is_word = operator.starts_with(|one: char| one.is_alphabetic());
            let before = at.checked_sub(1).and_then(|at| bytes.get(at));
            let is_part = is_inside(before) || is_inside(bytes.get(at + operator.len()));
            if !(is_word && (is_part || before == Some(&b'_'))) {
                add(at..at + operator.len(), with.to_owned(), "operator");
            }
        }
    }
    numbers(line, add);
    let trimmed = line.trim();
    let does = trimmed.ends_with(';') && trimmed.contains(['(', '=']);
    if does && !SAYING.iter().any(|one| trimmed.starts_with(one)) {
        let at = line.len() - line.trim_start().len();
        add(at..at + trimmed.len(), ";".to_owned(), "line");
    }
}

/// Replaces each number by another one: one more, zero, or twice as much.
fn numbers(line: &str, add: &mut impl FnMut(std::ops::Range<usize>, String, &'static str)) {
    let code = line.find("/*").filter(|at| !line.trim_start().starts_with("/*") && *at > 0);
    let code = line.get(..code.unwrap_or(line.len())).unwrap_or(line);
    let is_of_word = |one: char| one.is_ascii_alphanumeric() || one == '_';
    let mut at = 0;
    let mut is_quoted = false;
    while let Some(rest) = code.get(at..).filter(|rest| !rest.is_empty()) {
        let length = rest.find(|one| !is_of_word(one)).unwrap_or(rest.len());
        let word = rest.get(..length).unwrap_or_default();
        let digits = word.trim_end_matches(['U', 'L']);
        let number = digits
            .strip_prefix("0x")
            .map_or_else(|| digits.parse::<u64>().ok(), |hex| u64::from_str_radix(hex, 16).ok());
        if let Some(number) = number.filter(|_| !is_quoted) {
            let end = word.get(digits.len()..).unwrap_or_default();
            for other in [number + 1, u64::from(number == 0), 2 * number] {
                if other != number {
                    add(at..at + length, format!("{other}{end}"), "number");
                }
            }
        }
        let step = length.max(rest.chars().next().map_or(1, char::len_utf8));
        is_quoted ^= length == 0 && rest.starts_with('"');
        at += step;
    }
}

/// Exchanges two rows of a table, or the values of two fields.
fn swapped(above: &str, below: &str) -> Option<String> {
    let [first, second] = [above, below].map(str::trim);
    if first == second || !first.ends_with(',') || !second.ends_with(',') {
        return None;
    }
    if first.starts_with(['{', '&', '/']) && second.starts_with(['{', '&', '/']) {
        return Some(format!("{below}{above}"));
    }
    let field = |line: &str| {
        let (name, value) = line.trim().strip_prefix('.')?.split_once(" = ")?;
        Some((name.to_owned(), value.to_owned()))
    };
    let ((one, value), (other, its)) = (field(first)?, field(second)?);
    let is_plain = |value: &str| !value.contains('{');
    (value != its && is_plain(&value) && is_plain(&its))
        .then(|| format!("    .{one} = {its}\n    .{other} = {value}\n"))
}

/// Random numbers that are the same for the same seed.
pub(crate) struct Chance(pub(super) u64);

impl Chance {
    /// The random numbers for the mistake with that number, whatever was drawn before it.
    pub(crate) fn of(seed: u64, number: usize) -> Self {
        let mut chance = Self(seed ^ u64::try_from(number).unwrap_or(0).rotate_right(16));
        let _ = chance.below(2);
        chance
    }

    /// A number below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut state = self.0;
        state = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let count = u64::try_from(count.max(1)).unwrap_or(1);
        usize::try_from((state ^ (state >> 31)) % count).unwrap_or(0)
    }
}

/// The sites of all files below a folder whose names have that ending.
pub(super) fn below(folder: &Path, ends: &str) -> Result<Vec<Site>> {
    let mut all = Vec::new();
    let mut entries: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        entries.push(entry?.path());
    }
    entries.sort();
    for path in entries {
        if path.is_dir() {
            all.extend(below(&path, ends)?);
        } else if path.extension().is_some_and(|extension| extension == ends) {
            all.extend(sites(&path, &std::fs::read_to_string(&path)?));
        }
    }
    Ok(all)
}
