//! `docs/limits.md` agrees with `crates/limits`, and every limit has a diagnostic that exists.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests limits_page::` rewrites the page.
#![expect(clippy::unwrap_used, reason = "a test of a page reads it")]

use std::fmt::Write as _;

use sensedsl_diagnostics::Code;
use sensedsl_limits::ALL;
use sensedsl_tests::assert_page;

fn page() -> String {
    let mut text = "| limit | of | code |\n| ---: | --- | --- |\n".to_owned();
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
    assert_page("docs/limits.md", "| limit ", &page());
}

#[test]
fn every_limit_has_its_diagnostic() {
    for limit in ALL {
        assert!(Code::find(limit.code).is_some(), "{}: {}", limit.name, limit.code);
    }
}
