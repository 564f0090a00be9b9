//! E0255: a test that asks nothing.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0255",
    title: "a test without rules",
    explanation: r#"A test holds the run of a board to rules: `always`, `never`, `eventually … within`, `when … then … within`. Without
one it could not fail.

Way out: say what must hold, such as `always Heat < 250 degC;`."#,
});

/// It has no rules.
pub fn without_rules(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the test `{name}` has no rules, so it could not fail"))
        .help("say what must hold: `always`, `never`, `eventually` or `when`")
}
