//! E0558: the board runs other firmware.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0558",
    title: "the board runs other firmware",
    explanation: r#"Host and board know by the hash of their schema that they speak of the same devices. The board told another hash, so no
value of it is believed. Where the board's shell answers, the devices that differ are named.

Way out: build and flash the firmware of this file (`sensedsl flash FILE`), or monitor with the file that the board's
firmware was made from."#,
});

/// `hashes` are that of the design and that of the board; `differences` is empty where the board does not say.
pub fn other_firmware(span: Span, board: &str, hashes: (u32, u32), differences: &[String]) -> Diagnostic {
    let (own, other) = hashes;
    let what = format!("the board is not `{board}` of this file: its schema is 0x{other:08x} and not 0x{own:08x}");
    let what = if differences.is_empty() { what } else { format!("{what} ({})", differences.join("; ")) };
    Diagnostic::new(CODE, span, what)
        .help("flash the firmware of this file (`sensedsl flash FILE`), or name the file that the board was made from")
}
