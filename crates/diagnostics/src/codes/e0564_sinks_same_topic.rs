//! E0564: two devices would have the same topic.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0564",
    title: "two devices have one topic",
    explanation: r#"In a file for `monitor --config`, `topic` is the name under which other programs know a device. Without one it is
`BOARD/DEVICE`, or what the `topic` of its board puts in front. Under one name the values of two devices could not be
told apart.

Way out: give one of them another `topic`, or leave one out with `leave_out = true`."#,
});

/// `one` and `other` are the devices.
pub fn same_topic(span: Span, topic: &str, one: &str, other: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{one}` and `{other}` have the topic `{topic}`"))
        .help("give one of them another `topic`")
}

/// A topic has characters that not all programs take.
pub fn not_a_topic(span: Span, topic: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{topic}` is not a topic"))
        .here("not a topic")
        .help("write words of letters, digits and `_` with `/` between them, and begin each with a letter")
}
