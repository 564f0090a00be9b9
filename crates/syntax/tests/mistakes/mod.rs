//! Texts and what is reported for each: `line:column`, the marked text and the mistake.

use sensedsl_syntax::{SyntaxError, parse};

fn describe(text: &str, error: &SyntaxError) -> String {
    let before = &text[..usize::from(error.range.start())];
    let line = before.split('\n').count();
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("{line}:{column} `{}` {:?}", &text[error.range], error.kind)
}

pub(crate) fn check(cases: &[(&str, &[&str])]) {
    for (text, expected) in cases {
        let parsed = parse(text);
        assert_eq!(parsed.syntax().text(), *text);
        let errors: Vec<String> =
            parsed.errors().iter().map(|error| describe(text, error)).collect();
        assert_eq!(errors, *expected, "{text}");
    }
}
