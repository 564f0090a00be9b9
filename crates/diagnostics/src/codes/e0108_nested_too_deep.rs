//! E0108: blocks, lists or expressions are nested too deep.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0108",
    title: "nested too deep",
    explanation: r#"Blocks, lists and expressions may stand in one another, but no property needs more than a few levels;
anything deeper is taken for a typing mistake. In a chain such as `1 + 2 + 3` each operator is a level.

Way out: remove brackets, or give parts of a long expression names: `const TOTAL = 1 + 2;`."#,
});

/// `most` is the greatest depth allowed.
pub fn nested_too_deep(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this is nested more than {most} deep"))
        .help("remove brackets, or give parts of a long expression names with `const`")
}
