//! E0554: a quantity of a world changes too fast to be simulated.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0554",
    severity: Severity::Error,
    title: "a quantity changes too fast to be simulated",
    explanation: r#"Each edge is a step of the simulation: what makes more than a million of them in a second would go on for
hours. A period must last 10 microseconds at least, and what counts edges grows by a million a second at most.

Way out: a smaller `rate` or amplitude, a longer `period` or `over`; look for a power of ten too much.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `wanted` is what is asked of a device (`1000000000 edges a second`), `most` the maximum.
#[must_use]
pub fn too_fast(span: Span, name: &str, wanted: &str, most: &str) -> Diagnostic {
    let what = format!("`{name}` cannot have {wanted}: {most} a second are simulated at most");
    Diagnostic::new(CODE, span, what)
        .here("too fast")
        .help("let it change more slowly: a smaller `rate` or a longer `period`")
}
