//! E0568: a design is not the one that a recorded run is of.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0568",
    title: "the record is of another design",
    explanation: r#"`simulate --judge --world FILE.mcap` holds a design against a recorded run: its sensors measure what was measured then,
and what it reports must be what was reported. Here the design itself differs in what a host sees: a device that is gone,
another type, another unit or conversion, another cycle time. The message has each difference, with a value of the record
and what it would be now.

Way out: undo the change if it was not meant; otherwise record a new run with `sensedsl monitor --record`. Without
`--judge` the record is a world like any other, and sensors measure what was shown then."#,
});

/// `changes` are the differences, in words.
pub fn changed(span: Span, record: &str, changes: &[String]) -> Diagnostic {
    let first = changes.first().map_or("", String::as_str);
    let report = Diagnostic::new(CODE, span, format!("the design differs from the one in {record}: {first}"));
    let report = changes.iter().skip(1).fold(report, |report, change| report.help(change.clone()));
    report.help("undo the change, or record a new run: `sensedsl monitor --record FILE.mcap`")
}
