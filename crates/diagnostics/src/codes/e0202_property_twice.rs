//! E0202: a property is given twice.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0202",
    title: "a property is given twice",
    explanation: r#"A property may be given once in a block. With two values there is no telling which one counts.

Way out: remove one of them."#,
});

/// `first` is the earlier place of the name.
pub fn property_twice(span: Span, name: &str, first: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is given twice"))
        .here("again here")
        .label(first, "first here")
        .help("remove one of the two lines")
        .remove("remove this one", span)
        .remove("remove the first one", first)
}
