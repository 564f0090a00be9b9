//! E0556: a file is no `schema.json` that can be used.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0556",
    title: "not a schema",
    explanation: r#"`monitor --schema` takes the `schema.json` that `generate` writes: what each board's link carries. The file is not
one, is of a version that this program does not read, or was changed after it was generated, which its hash tells.

Way out: generate it again (`sensedsl generate FILE -o DIR`), or give the design itself: `sensedsl monitor DEVICE FILE`."#,
});

/// `why` is the reason, `file` its name.
pub fn not_a_schema(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{file}` is no schema to go by: {why}"))
        .help("generate it again, or give the `.sense` file itself: `sensedsl monitor DEVICE FILE`")
}
