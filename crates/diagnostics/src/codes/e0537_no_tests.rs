//! E0537: there are no tests to run.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0537",
    title: "no tests to run",
    explanation: r#"`sensedsl test FILE` runs the `test` blocks of a file and of those it uses; names after the file choose some of them.
A file without tests fails, so that a build server does not take it for one whose tests all passed.

Way out: write a test:

    test StaysCool {
        for = 10 s;
        always Heat < 250 degC;
    }"#,
});

/// The file has none.
pub fn no_tests(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "the file has no tests")
        .help("write one: `test StaysCool { for = 10 s; always Heat < 250 degC; }`")
}

/// None has that name.
pub fn unknown(span: Span, name: &str, near: Option<&str>, all: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("no test is called `{name}`"));
    match near {
        Some(near) => report.help(format!("did you mean `{near}`?")),
        None => report.help(format!("the tests are {all}")),
    }
}
