//! Calls of the program as users type them, with what must come of them: `tests/scripts/*.txt`. The README there
//! defines the lines. A file is a test; each case in it has a folder of its own. Quick runs take a
//! twelfth of the rows.

mod run;

use sensedsl_tests::{files, one_in, root, text};

use run::Place;

/// Runs all cases of a file.
fn check(file: &str) {
    let text = text(&format!("tests/scripts/{file}.txt"));
    let mut cases: Vec<(usize, Vec<&str>)> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        match cases.last_mut() {
            _ if line.starts_with("== ") => cases.push((number, vec![line])),
            Some((_, lines)) => lines.push(line),
            None => assert!(line.is_empty() || line.starts_with('#'), "{file}:{number}: {line}"),
        }
    }
    assert!(!cases.is_empty(), "{file} has no cases");
    let rows_of = |(number, lines): &(usize, Vec<&str>)| {
        let (name, lines) = lines.split_first().unwrap();
        let title = format!("{file}:{number}: {name}");
        rows(lines).into_iter().map(move |(row, lines)| (format!("{title} {row}"), lines))
    };
    for (title, lines) in one_in(12, cases.iter().flat_map(rows_of)) {
        Place::new(title).run(&lines);
    }
}

/// The lines of a case for each row of its table, with the row's cells for `$COLUMN`.
fn rows(lines: &[&str]) -> Vec<(String, Vec<String>)> {
    let start = lines.iter().position(|line| !line.starts_with('#')).unwrap_or_default();
    let lines = &lines[start..];
    let Some(names) = lines.first().and_then(|line| line.strip_prefix("for ")) else {
        return vec![(String::new(), lines.iter().map(|line| (*line).to_owned()).collect())];
    };
    let names: Vec<String> = names.split(" | ").map(|name| format!("${name}")).collect();
    let (table, rest) = (block(lines), &lines[1 + block(lines).len()..]);
    let table = table.iter().map(|row| row.trim()).filter(|row| !row.starts_with('#'));
    let filled = table.map(|row| {
        let whole = format!("{row} ");
        let cells: Vec<&str> = whole.splitn(names.len(), " | ").map(str::trim).collect();
        assert_eq!(cells.len(), names.len(), "{row}");
        let fill = |line: &&str| {
            let pairs = names.iter().zip(&cells);
            pairs.fold((*line).to_owned(), |line, (name, cell)| line.replace(name, cell))
        };
        (row.to_owned(), rest.iter().map(fill).collect())
    });
    filled.collect()
}

/// The indented lines below the first one.
fn block<S: AsRef<str>>(lines: &[S]) -> &[S] {
    let below = lines.iter().skip(1).take_while(|line| line.as_ref().starts_with("    "));
    &lines[1..=below.count()]
}

/// A test for each file.
macro_rules! scripts {
    ($($file:ident,)+) => {
        const ALL: &[&str] = &[$(stringify!($file)),+];

        $(
            #[test]
            fn $file() {
                check(stringify!($file));
            }
        )+
    };
}

scripts! {
    command_line,
    firmware,
    foreseen,
    generate,
    import,
    parts,
    silicon,
    simulate,
    single_files,
    timing,
    ways_out,
    wiring,
    wrong_designs,
}

#[test]
fn every_script_is_run() {
    for path in files(&root().join("tests/scripts"), "txt") {
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert!(ALL.contains(&name), "{name} has no test");
    }
}

/// What a script expects is compared: a line that does not hold fails.
#[test]
fn what_does_not_hold_is_noticed() {
    let fails = |line: &str| {
        let lines = ["> drivers --search bme280", line].map(str::to_owned);
        std::panic::catch_unwind(|| Place::new(String::new()).run(&lines)).is_err()
    };
    for right in ["out humidity", "no out motor", "rows 4", "count 1 humidity", ">2 boards x"] {
        assert!(!fails(right), "{right}");
    }
    let wrong = [
        "out motor",
        "no out humidity",
        "rows 1",
        "count 2 humidity",
        "err humidity",
        "no err drivers",
        "is",
        "silent",
        "same x",
        "json /a 1",
        "pins PA0",
        "wires TIM1",
        "told E0101",
        "exists x",
        "missing .",
        "holds x: y",
        "lacks x: y",
        "times 1 x: y",
        "files .: x",
        ">1 boards",
        "unknown word",
    ];
    for wrong in one_in(10, wrong) {
        assert!(fails(wrong), "{wrong}");
    }
}
