//! E0239: a value does not fit into its frame or message.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0239",
    title: "a value does not fit into its frame or message",
    explanation: r#"A frame of CAN has 8 bytes, or as many as `length` says, and a value must end in it. `bit` is the number of a bit as
a DBC file has it: 8 times the byte plus the place in the byte, where 0 is the lowest. With `order = little` it is the
lowest bit of the value, which goes on to higher bytes; with `order = big` it is the highest, and the value goes on to
lower bits and then to the highest of the next byte.

On a serial line the body of a message has as many bytes as the driver's `length` says, or its `body` where it is an
answer: without `start`, checksum and `end`. `byte` counts from the first of them, which is number 0. A `length` in a
reading is of its value alone.

Way out: let the value begin earlier, take fewer bits or a smaller type, or a longer frame or message."#,
});

/// `ends` says in words where the value ends.
pub fn outside_frame(span: Span, name: &str, ends: &str, frame_bytes: u8) -> Diagnostic {
    let bytes = if frame_bytes == 1 { "byte" } else { "bytes" };
    let message = format!("{name} ends {ends} into its frame, which has {frame_bytes} {bytes}");
    Diagnostic::new(CODE, span, message)
        .here("this place")
        .help("let it begin earlier (`byte`, `bit`), or take fewer bits or a smaller type")
}

/// `property` is that which says how many bytes the body has.
pub fn outside_message(
    span: Span,
    name: &str,
    (first, bytes): (u16, u16),
    (property, body): (&str, u16),
) -> Diagnostic {
    let end = first.saturating_add(bytes);
    let unit = |bytes: u16| if bytes == 1 { "byte" } else { "bytes" };
    let message = format!(
        "{name} ends {end} {} into its message, whose body has {body} {}",
        unit(end),
        unit(body)
    );
    Diagnostic::new(CODE, span, message)
        .here(format!("{bytes} {} from byte {first} on", unit(bytes)))
        .help(format!(
            "`byte` counts from the byte after `start`, and `{property}` is the whole body, without \
             `start`, checksum and `end`: correct one of the two, or give the value fewer bytes (`length` in the \
             reading, or a smaller type)"
        ))
}
