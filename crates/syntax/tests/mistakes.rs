//! Malformed texts and exactly what is reported for each, case by case in `mistakes.txt`.
#![allow(clippy::indexing_slicing, clippy::expect_used, reason = "a test may panic")]

use sensedsl_syntax::{SyntaxError, parse};

/// The texts, each with what is reported for it.
fn cases() -> Vec<(String, Vec<&'static str>)> {
    let mut cases: Vec<(String, Vec<&str>)> = Vec::new();
    let mut is_text = false;
    for line in include_str!("mistakes.txt").lines().skip_while(|line| !line.starts_with("## ")) {
        match (line.strip_prefix("> "), cases.last_mut()) {
            (Some(report), Some((_, reports))) => {
                reports.push(report);
                is_text = false;
            }
            (None, Some((text, _))) if is_text => text.extend(["\n", line]),
            // Headings and blank lines between the cases.
            _ if line.is_empty() || line.starts_with("## ") => {}
            _ => {
                cases.push((line.to_owned(), Vec::new()));
                is_text = true;
            }
        }
    }
    cases
}

fn describe(text: &str, error: &SyntaxError) -> String {
    let before = &text[..usize::from(error.range.start())];
    let line = before.split('\n').count();
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("{line}:{column} `{}` {:?}", &text[error.range], error.kind)
}

#[test]
fn each_mistake_is_reported_at_its_place_and_once() {
    let cases = cases();
    assert!(cases.len() > 150, "{} cases", cases.len());
    for (text, expected) in cases {
        let parsed = parse(&text);
        assert_eq!(parsed.syntax().text(), text.as_str());
        let found: Vec<String> =
            parsed.errors().iter().map(|error| describe(&text, error)).collect();
        assert_eq!(found, expected, "{text}");
    }
}

/// The parts of a broken file that are understood appear in the views as if the file were correct.
#[test]
fn mistakes_leave_the_rest_intact() {
    let text = "board A { Sensor X return uint8 { id 17; delay = 60 mss } reserve PA0 PA1; }";
    let board = parse(text).ast().boards().next().expect("a board");
    let device = board.devices().next().expect("a device");
    let names: Vec<_> = device
        .properties()
        .filter_map(|property| property.name())
        .map(|name| name.text().to_owned())
        .collect();
    assert_eq!(names, ["id", "delay"]);
    assert!(device.properties().all(|property| property.value().is_some()));
    assert_eq!(device.ty().and_then(|ty| ty.scalar()).expect("a type").text(), "uint8");
    assert_eq!(board.rules().count(), 1);
}
