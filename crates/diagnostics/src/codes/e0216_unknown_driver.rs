//! E0216: no such driver.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0216",
    title: "no such driver",
    explanation: r#"`driver = NAME;` takes over a protocol: a `driver NAME for KIND { … }` of this file, of a file brought in
by `use`, or of the library that ships with the tool. A part may also be called what else people call it (`GY_521`).

Way out: correct the spelling, look for the part with `sensedsl drivers --search WORD`, or write the driver."#,
});

/// `meant` is the nearest known driver.
pub fn unknown_driver(span: Span, name: &str, meant: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("there is no driver `{name}`"));
    match meant {
        Some(name) => diagnostic
            .meant(meant)
            .help(format!("write `{name}` (`sensedsl drivers {name}` shows it; `sensedsl drivers` lists all)")),
        None => diagnostic.help(
            "`sensedsl drivers --search WORD` looks for a part that measures the same, such as `temperature`; define \
             another with `driver NAME for KIND { … }`, or bring it in with `use`",
        ),
    }
}
