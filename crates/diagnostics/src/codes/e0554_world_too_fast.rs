//! E0554: a quantity of a world changes too fast to be simulated.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0554",
    title: "a quantity changes too fast to be simulated",
    explanation: r#"Each edge is a step of the simulation: what makes more than a million of them in a second would go on for
hours. A period must last 10 microseconds at least, and what counts edges grows by a million a second at most.

Way out: a smaller `rate` or amplitude, a longer `period` or `over`; look for a power of ten too much."#,
});

/// `wanted` is what is asked of a device (`1000000000 edges a second`), `most` the maximum.
pub fn too_fast(span: Span, name: &str, wanted: &str, most: &str) -> Diagnostic {
    let what = format!("`{name}` cannot have {wanted}: {most} a second are simulated at most");
    Diagnostic::new(CODE, span, what)
        .here("too fast")
        .help("let it change more slowly: a smaller `rate` or a longer `period`")
}
