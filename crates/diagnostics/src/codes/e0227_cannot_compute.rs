//! E0227: an expression cannot be computed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0227",
    title: "an expression cannot be computed",
    explanation: r#"Expressions are made of numbers, units, constants, `+ - * /` and parentheses. Something in this one is not a
number, the units do not go together (a time can be added to a time, not to a voltage), or the result is too large.

Way out: the message says what is wrong; a name in an expression must be that of a `const`."#,
});

/// `message` says what is wrong, `help` what to do.
pub fn cannot_compute(span: Span, message: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, message).help(help)
}

/// A name that is not the name of a constant.
pub fn not_a_constant(span: Span, name: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("`{name}` is not a constant"));
    match meant {
        Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
        None => diagnostic.help(format!("define it: `const {name} = 10;` at the top of the file")),
    }
}
