//! E0532: the type check did not finish.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0532",
    title: "the type check did not come to an end",
    explanation: r#"`check --typecheck` builds crates in exact versions, which cargo downloads the first time: for that it needs the
network, a registry that has these versions, and a Rust compiler that is new enough. Here cargo ended before it could
judge the wiring.

Way out: the message has what cargo says. Without a network, run the check once where there is one and copy the
folder of `CARGO_HOME`; with an old compiler, run `rustup update`."#,
});

/// `said` is cargo's output.
pub fn stopped(span: Span, board: &str, log: &str) -> Diagnostic {
    let help = if log.contains("rustc") && log.contains("requires") {
        "the crates need a newer compiler: `rustup update`"
    } else if log.contains("download") || log.contains("network") || log.contains("offline") {
        "the first check of a chip downloads crates: connect to the network and try again"
    } else {
        "`sensedsl -v check --typecheck` shows the folder; run `cargo check` in it to see all that cargo says"
    };
    Diagnostic::new(CODE, span, format!("the wiring of {board} was not judged: {log}")).help(help)
}
