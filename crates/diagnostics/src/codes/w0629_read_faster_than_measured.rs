//! W0629: a controller reads a sensor much more often than it is measured.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0629",
    title: "a controller reads a sensor more often than it is measured",
    explanation: r#"A sensor is measured once in its `delay`, which is a second if the file gives none. A controller that runs more often
gets the same value again and again, and its input `age_us` says how old it is. A loop that reacts to values of a second
ago does not hold what it should hold.

Way out: `delay` of the sensor as long as the controller's cycle, or as short as the part allows.

If the slow value is meant: write the `delay` that the sensor has, which says so."#,
});

/// `delay` is the sensor's cycle, `every` the controller's, both as people write them.
pub fn read_faster_than_measured(
    span: Span,
    (name, delay): (&str, &str),
    (controller, every): (&str, &str),
    at: Span,
) -> Diagnostic {
    let message = format!("`{name}` is measured every {delay}, and `{controller}` reads it every {every}");
    Diagnostic::new(CODE, span, message)
        .here("its `delay` is the default")
        .label(at, "read here")
        .help(format!("write `delay = {every};`, or the `delay` that is meant"))
}
