//! What each renderer makes of one diagnostic with two places in two files.

use sensedsl_diagnostics::codes::{e0203_duplicate_identifier, e0304_table_pin_twice};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, render};

fn example() -> (Vec<Diagnostic>, SourceMap) {
    let mut sources = SourceMap::default();
    let robot = sources.add("robot.sense", "sensor A { id = 17; }\nsensor B { id = 17; }\n");
    let table = sources.add("my table.csv", "Pin,ADC\nPA1,x\nPA1,y\n");
    let diagnostics = vec![
        e0203_duplicate_identifier::duplicate_identifier(
            Span::new(robot, 38..40),
            17,
            Span::new(robot, 16..18),
            Some(18),
        ),
        e0304_table_pin_twice::table_pin_twice(
            Span::new(table, 14..17),
            "PA1",
            3,
            Span::new(table, 8..11),
            2,
        ),
    ];
    (diagnostics, sources)
}

#[test]
fn human() {
    let (diagnostics, sources) = example();
    insta::assert_snapshot!(render::human(&diagnostics, &sources, false));
}

#[test]
fn json() {
    let (diagnostics, sources) = example();
    insta::assert_snapshot!(render::json(&diagnostics, &sources));
}

#[test]
fn sarif() {
    let (diagnostics, sources) = example();
    insta::assert_snapshot!(render::sarif(&diagnostics, &sources, "0.0.0"));
}

#[test]
fn github() {
    let (diagnostics, sources) = example();
    insta::assert_snapshot!(render::github(&diagnostics, &sources));
}

#[test]
fn spans_outside_the_text_do_not_panic() {
    let (mut diagnostics, sources) = example();
    for diagnostic in &mut diagnostics {
        diagnostic.primary.span.start = 1_000;
        diagnostic.primary.span.end = 10;
    }
    assert!(render::human(&diagnostics, &sources, true).contains("E0203"));
    assert!(render::json(&diagnostics, &sources).contains("E0203"));
}
