//! E0551: a world contains more than is read.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0551",
    title: "a world holds too much",
    explanation: r#"Each table and each list of a world takes far more memory than its text, so their number is bounded, those within
others included ([limits.md](limits.md)).

Way out: long courses of values belong in a file of samples: `Speed = { csv = "drive.csv", column = "speed" }`."#,
});

/// `span` is the first table or list that is too much.
pub fn too_large(span: Span, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the world has more than {most} tables and lists"))
        .here("the first one beyond")
        .help("put long courses of values into a file: `Speed = { csv = \"drive.csv\", column = \"speed\" }`")
}
