//! E0216: no such driver.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0216",
    severity: Severity::Error,
    title: "no such driver",
    explanation: r#"`driver = NAME;` takes over a protocol: a `driver NAME for KIND { … }` of this file, of a file brought in
by `use`, or of the library that ships with the tool. A part may also be called what else people call it (`GY_521`).

Way out: correct the spelling, look for the part with `sensedsl drivers --search WORD`, or write the driver.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `meant` is the nearest known driver.
#[must_use]
pub fn unknown_driver(span: Span, name: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("there is no driver `{name}`"));
    match meant {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .help(format!("write `{meant}` (`sensedsl drivers {meant}` shows it; `sensedsl drivers` lists all)"))
            .replace(format!("change to `{meant}`"), span, meant),
        None => diagnostic.help(
            "`sensedsl drivers --search WORD` looks for a part that measures the same, such as `temperature`; define \
             another with `driver NAME for KIND { … }`, or bring it in with `use`",
        ),
    }
}
