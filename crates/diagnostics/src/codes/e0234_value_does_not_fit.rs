//! E0234: a value that the device cannot take.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0234",
    title: "a value that does not fit the device",
    explanation: r#"A value that is given for a device (`failsafe`, `min`, `max`) is the one that a host shows: after `scale`, `offset`
and `curve`, in its `quantity`. `raw 307` is the code that goes over the wire. A unit may be written, and
must then be one that the quantity converts to (`0.5 m` where `cm` is shown). The value lies between
`min` and `max`, and where the part and the type can take it.

Way out: write the value in the unit that the message names, or its code behind `raw`."#,
});

/// `message` says what does not fit, `help` what to write; `code` is the number if it can be a code.
pub fn value_does_not_fit(span: Span, message: &str, help: &str, code: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, message).here("this value").help(help);
    match code {
        Some(code) => diagnostic.one_of([format!("raw {code}").as_str()]),
        None => diagnostic,
    }
}
