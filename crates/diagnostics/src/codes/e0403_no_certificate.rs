//! E0403: an answer without a certificate.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0403",
    title: "no certificate was found",
    explanation: r#"`solve --proof` records the search that proves the answer, for a separate checker to follow. A record has a
bounded number of steps and a certificate a bounded size; or `--timeout` came first. This says nothing against the
answer, which is printed as always; no certificate was written.

Way out: solve without `--proof`, give `--timeout` more seconds, or fix some pins, units or boards: the fewer
choices are left, the shorter is the proof."#,
});

/// `span` is the board; `why` is the reason why there is none.
pub fn no_certificate(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no certificate: {why}"))
        .help("`solve` without `--proof` gives the answer with the proof of its own search alone; fixed pins and units make proofs shorter")
}
