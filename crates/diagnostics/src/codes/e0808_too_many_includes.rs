//! E0808: hwdef files include too many others.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0808",
    title: "hwdef files include too many others",
    explanation: r#"An `hwdef.dat` may include up to 64 files, directly or through others, and up to 8 that include each other
in a chain. A file that includes itself never ends.

Way out: remove the `include` that leads back."#,
});

/// `limit` is the limit exceeded by `path`, in words.
pub fn too_many_includes(span: Span, path: &str, limit: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{path}` is not included: {limit}"))
        .help("remove the `include` that leads back to a file that includes it")
}
