//! E0562: an address for `monitor` is not one.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0562",
    title: "not an address",
    explanation: r#"`monitor` needs to know where another program is, or at which address of this machine it listens for one. An
address is a host and a port: `localhost:1883`, `192.168.1.20:9870`, `[::1]:8765`. Where it listens, the host is a
number: `127.0.0.1:8765` for programs of this machine alone, `0.0.0.0:8765` for all that can reach it.

Way out: write a host, a colon and a port from 1 to 65535."#,
});

/// `why` says what is wrong, `example` is an address for this key.
pub fn not_an_address(span: Span, text: &str, why: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{text}` is not an address: {why}"))
        .here("not an address")
        .help(format!("write for example `{example}`"))
}
