//! E0322: an array has more elements than the board has wires for.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0322",
    title: "an array has more elements than there are wires for",
    explanation: r#"Each element of the array has a wire of its own, and the board offers fewer pins for it than the array has
elements. With `together = unit;` all of them must be on one peripheral instance, with `together = header;`,
`together = side;` or `sequence = header;` on one header or side, which has fewer still.

Way out: make the array shorter, or split it in two; write `prefer together = …;` where it need not be so; or take
another board."#,
});

/// `asked` is the number of wires that the array needs; `most` says how many of them there are at most, and where.
pub fn array_too_long(span: Span, array: &str, asked: usize, most: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{array}` needs {asked}, and {most}"))
        .here("this many wires")
        .help(help)
}
