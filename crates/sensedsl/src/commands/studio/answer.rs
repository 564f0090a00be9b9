//! Answers of the server, with the headers that all of them have.

use std::io::{self, Write as _};

use serde_json::{Value, json};
use tiny_http::{Request, StatusCode};

/// What is not the page's own may neither be loaded nor asked.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
    img-src 'self' data: blob:; connect-src 'self'; worker-src 'self' blob:; frame-src 'self' blob:; object-src 'none'; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// What all answers have.
const HEADERS: [(&str, &str); 6] = [
    ("Content-Security-Policy", POLICY),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

/// What a request wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    Get,
    Put,
    Post,
    Delete,
    Other,
}

impl Method {
    pub(super) fn of(request: &Request) -> Self {
        match request.method().as_str() {
            "GET" | "HEAD" => Self::Get,
            "PUT" => Self::Put,
            "POST" => Self::Post,
            "DELETE" => Self::Delete,
            _ => Self::Other,
        }
    }
}

/// The value of a header, if the request has it.
pub(super) fn header<'r>(request: &'r Request, name: &str) -> Option<&'r str> {
    let found =
        request.headers().iter().find(|one| one.field.as_str().as_str().eq_ignore_ascii_case(name));
    found.map(|one| one.value.as_str())
}

/// An answer.
pub(super) struct Answer {
    status: u16,
    kind: &'static str,
    tag: Option<String>,
    body: Vec<u8>,
}

impl Answer {
    /// A file of the page.
    pub(super) fn file(kind: &'static str, body: Vec<u8>) -> Self {
        Self { status: 200, kind, tag: None, body }
    }

    /// An answer for the page's program.
    pub(super) fn json(status: u16, value: &Value) -> Self {
        Self { status, kind: "application/json", tag: None, body: value.to_string().into_bytes() }
    }

    /// The same of what is JSON already.
    pub(super) fn json_text(text: String) -> Self {
        Self { status: 200, kind: "application/json", tag: None, body: text.into_bytes() }
    }

    /// A text of the folder with its tag, or only the tag.
    pub(super) fn text(status: u16, text: String, tag: String) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", tag: Some(tag), body: text.into_bytes() }
    }

    /// A request that is not answered: the reason.
    pub(super) fn refused(status: u16, why: &str) -> Self {
        Self::json(status, &json!({ "error": why }))
    }

    /// Sends it, in one piece: what comes in two waits for the other side to say that it has got the first one, which
    /// takes it 40 ms.
    pub(super) fn send(self, request: Request) -> io::Result<()> {
        let status = StatusCode(self.status);
        let mut head =
            format!("HTTP/1.1 {} {}\r\n", status.0, status.default_reason_phrase()).into_bytes();
        let mut line = |name: &str, value: &str| {
            head.extend_from_slice(format!("{name}: {value}\r\n").as_bytes());
        };
        line("Content-Type", self.kind);
        line("Content-Length", &self.body.len().to_string());
        for (name, value) in HEADERS {
            line(name, value);
        }
        // None of its signs can end the line: it is a digest.
        if let Some(tag) = &self.tag {
            line("ETag", tag);
        }
        head.extend_from_slice(b"\r\n");
        if *request.method() != tiny_http::Method::Head {
            head.extend_from_slice(&self.body);
        }
        let mut writer = request.into_writer();
        writer.write_all(&head)?;
        writer.flush()
    }
}
