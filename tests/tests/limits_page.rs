//! `docs/limits.md` agrees with `crates/limits`, and every limit has a diagnostic that exists.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests limits_page::` rewrites the page.
#![expect(clippy::unwrap_used, reason = "a test of a page reads it")]

use std::fmt::Write as _;

use sensedsl_diagnostics::Code;
use sensedsl_limits::ALL;
use sensedsl_tests::root;

const HEAD: &str = "# Limits

What is read has budgets, so that no file, however large or hostile, takes more than a second to be refused, or more
than 200 MB. They are far above what a real project needs. What is beyond gets the diagnostic of the last column:
`sensedsl explain CODE` says what to do.

The figures stand in `crates/limits/src/lib.rs`. `sensedsl-verify` reads certificates of up to 8 MiB with 120,000 lists
and objects, and refuses proofs that look at more than 150,000,000 choices; `solve --proof` writes none that are larger
(E0403).

Measured with a release build on the inputs of `tests/tests/limits`, one by one, on a quiet machine: at most 0.5 s and
156 MB.

Only regular files are read; a pipe only where the command line names it, and `-` is the standard input. What a file
names by `use`, as a table or as an include is in the folder of the file on the command line or below it, also when
symbolic links are followed; for an `hwdef.dat` it may be in a folder beside that. `--allow-outside FOLDER` allows
another folder.

| limit | of | code |
| ---: | --- | --- |
";

fn page() -> String {
    let mut text = HEAD.to_owned();
    for limit in ALL {
        let most = limit.most;
        let shown = if most % (1 << 20) == 0 { format!("{} Mi", most >> 20) } else { digits(most) };
        writeln!(text, "| {shown} | {} | {} |", limit.of, limit.code).unwrap();
    }
    text
}

/// A number with thousands separators: `400,000`.
fn digits(number: usize) -> String {
    let text = number.to_string();
    let groups: Vec<_> = text.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join(",")
}

#[test]
fn the_page_is_fresh() {
    let path = root().join("docs/limits.md");
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        std::fs::write(&path, page()).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == page(), "docs/limits.md is not what crates/limits says: SENSEDSL_BLESS=1");
}

#[test]
fn every_limit_has_its_diagnostic() {
    for limit in ALL {
        assert!(Code::find(limit.code).is_some(), "{}: {}", limit.name, limit.code);
    }
}
