//! E0573: a program that is a part of a world did not do its work.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0573",
    title: "a program of the world failed",
    explanation: r#"A plant of the kind `process` is a program of yours. For each step it gets a line on its standard input and must answer
with a line on its standard output, in JSON:

    {"t": 0.005, "set": {"Left": 50, "Right": 48.5}}
    {"sensors": {"Wheels": [12, 11], "Front": 87.5}}

`t` is the moment in seconds that the answer is for, `set` has the actuators as they are shown (null before they were
set), and the answer all sensors that the world names for it. It failed in one of these ways: it could not be started,
it ended, it gave no answer within two seconds, or the answer is not JSON, has a sensor that the world does not name,
lacks one, or has a value that is not a number.

Way out: run it by itself and type a line. Programs that keep what they print must flush it after each line:
`print(..., flush=True)` in Python, `fflush(stdout)` in C. What it writes to its standard error is shown."#,
});

/// `why` is a sentence without its end.
pub fn process_failed(span: Span, plant: &str, seconds: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the program of `{plant}` failed at {seconds}: {why}"))
        .help("run it by itself and type the line `{\"t\": 0, \"set\": {}}`: it must answer with one line")
}
