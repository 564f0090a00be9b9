//! E0540: a world is not the TOML that it should be.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0540",
    title: "a world cannot be read",
    explanation: r#"A world is a text in TOML: a line for each device that has something to do, and a block for each fault.

    seed = 7

    [devices]
    IRFront = { sine = 15, offset = 40, period = "5 s" }
    Button = { square = [0, 1], period = "2 s" }

    [[fault]]
    kind = "no_answer"
    device = "USRear"
    at = "3 s"
    for = "500 ms"

`docs/simulate.md` has everything that can stand in it.

Way out: mend what the message points at."#,
});

/// `why` is the message of the TOML parser.
pub fn not_toml(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the world is not TOML: {why}"))
        .help("a world is a text in TOML: `[devices]`, then a line such as `IRFront = 20.0`")
}

/// A value of another sort is needed: `a number`, `a table`.
pub fn wrong_sort(span: Span, what: &str, wanted: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{what} must be {wanted}"))
        .here(format!("not {wanted}"))
        .help(format!("write for example `{example}`"))
}

/// Something required is missing.
pub fn missing(span: Span, what: &str, needs: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{what} needs `{needs}`"))
        .here(format!("`{needs}` is missing"))
        .help(format!("add for example `{example}`"))
}

/// Two things exclude each other, or nothing says what happens.
pub fn unclear(span: Span, what: &str, why: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{what}: {why}")).help(format!("write for example `{example}`"))
}
