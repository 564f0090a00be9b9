//! E0239: a value does not fit into its frame.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0239",
    title: "a value does not fit into its frame",
    explanation: r#"A frame of CAN has 8 bytes, or as many as `length` says, and a value must end in it. `bit` is the number of a bit as
a DBC file has it: 8 times the byte plus the place in the byte, where 0 is the lowest. With `order = little` it is the
lowest bit of the value, which goes on to higher bytes; with `order = big` it is the highest, and the value goes on to
lower bits and then to the highest of the next byte.

Way out: let the value begin earlier, take fewer bits or a smaller type, or a longer frame."#,
});

/// `ends` says in words where the value ends.
pub fn outside_frame(span: Span, name: &str, ends: &str, frame_bytes: u8) -> Diagnostic {
    let bytes = if frame_bytes == 1 { "byte" } else { "bytes" };
    let message = format!("{name} ends {ends} into its frame, which has {frame_bytes} {bytes}");
    Diagnostic::new(CODE, span, message)
        .here("this place")
        .help("let it begin earlier (`byte`, `bit`), or take fewer bits or a smaller type")
}
