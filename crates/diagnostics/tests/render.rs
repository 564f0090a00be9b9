//! The output of each renderer for one diagnostic with two places in two files.

use sensedsl_diagnostics::codes::{e0203_duplicate_identifier, e0304_table_pin_twice};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, render};

fn example() -> (Vec<Diagnostic>, SourceMap) {
    let mut sources = SourceMap::default();
    let robot = sources.add("robot.sense", "sensor A { id = 17; }\nsensor B { id = 17; }\n");
    let table = sources.add("my table.csv", "Pin,ADC\nPA1,x\nPA1,y\n");
    let diagnostics = vec![
        e0203_duplicate_identifier::duplicate_identifier(
            (Span::new(robot, 38..40), true),
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

#[test]
fn hidden_characters_are_shown_by_their_codes() {
    let mut sources = SourceMap::default();
    let text =
        "// \u{1b}]0;x\u{7}\nsensor \u{202e}A\u{9b} { id = 17; } \u{2028}\nB { id = 17; }\r\n";
    let file = sources.add("a\u{1b}[31m\n::error::.sense", text);
    let at = |needle: &str| {
        let start = text.rfind(needle).unwrap();
        Span::new(file, start..start + needle.len())
    };
    let table = sources.add("t\u{202e}.csv", "Pin\nPA1\u{9b}\n");
    let mut diagnostic = e0203_duplicate_identifier::duplicate_identifier(
        (at("A\u{9b}"), true),
        17,
        Span::new(table, 4..7),
        Some(18),
    );
    diagnostic.message = "no `\u{1b}[2J\n`, see [a](b) and {0}".to_owned();
    let human = render::human(std::slice::from_ref(&diagnostic), &sources, false);
    insta::assert_snapshot!("hidden_human", human);
    let machine = [
        render::json(std::slice::from_ref(&diagnostic), &sources),
        render::sarif(std::slice::from_ref(&diagnostic), &sources, "0.0.0"),
        render::github(std::slice::from_ref(&diagnostic), &sources),
    ];
    for text in machine.iter().chain([&human]) {
        let is_safe = |c: char| c == '\n' || !sensedsl_diagnostics::is_hidden(c);
        assert!(text.chars().all(is_safe), "{text:?}");
    }
    assert!(machine[1].contains(r"see [a\\](b) and {{0}}"), "{}", machine[1]);
    assert_eq!(machine[2].lines().count(), 1);
}
