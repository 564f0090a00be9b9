//! E0626: the board's memory does not hold this.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0626",
    title: "the memory of the board does not hold this",
    explanation: r#"The latest value of each device, the longest frame, the samples of converters and the stacks of threads are all in the
board's memory at once. Together they are more than there is, and the linker would refuse the program.

Way out: shorter arrays, fewer `samples`, fewer different cycle times, or a board with more memory."#,
});

/// `device` takes the most memory; `needed_kib` is needed, `there_kib` is available.
pub fn memory_full(span: Span, board: &str, device: &str, needed_kib: u64, there_kib: u32) -> Diagnostic {
    let message = format!("{board} needs {needed_kib} KiB of memory for its values and buffers, and has {there_kib}");
    Diagnostic::new(CODE, span, message)
        .here("takes most of it")
        .help(format!("make the array of {device} shorter or its `samples` fewer, or take a board with more memory"))
}
