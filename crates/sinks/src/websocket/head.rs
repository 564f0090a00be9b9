//! The head of a client's request: what is read before the WebSocket begins, and the page for those who want none.
//!
//! A browser that somebody points at the address asks for a page, not for a WebSocket. It gets one that shows the
//! values, which needs no other file.

use std::io::{self, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// The page.
const PAGE: &str = include_str!("page.html");
/// The most bytes of a head.
const HEAD_BYTES_MAX: usize = 8 << 10;
const POLL: Duration = Duration::from_millis(5);

/// What a client wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// A WebSocket.
    Socket,
    /// The page.
    Page,
    /// Something else.
    Other,
}

/// Waits for the whole head, and leaves it where it is.
pub(super) fn wanted(stream: &TcpStream, within: Duration) -> io::Result<Wanted> {
    let began = Instant::now();
    let mut bytes = vec![0; HEAD_BYTES_MAX];
    loop {
        let count = stream.peek(&mut bytes)?;
        let head = bytes.get(..count).unwrap_or_default();
        if head.windows(4).any(|four| four == b"\r\n\r\n") {
            return Ok(of_head(&String::from_utf8_lossy(head)));
        }
        if count == 0 || count == HEAD_BYTES_MAX || began.elapsed() > within {
            return Err(io::Error::other("no head"));
        }
        std::thread::sleep(POLL);
    }
}

fn of_head(head: &str) -> Wanted {
    let mut lines = head.split("\r\n");
    let request = lines.next().unwrap_or_default();
    let is_upgrade = lines.filter_map(|line| line.split_once(':')).any(|(name, value)| {
        name.eq_ignore_ascii_case("upgrade") && value.trim().eq_ignore_ascii_case("websocket")
    });
    let mut words = request.split(' ');
    match (is_upgrade, words.next(), words.next()) {
        (true, ..) => Wanted::Socket,
        (false, Some("GET"), Some("/")) => Wanted::Page,
        (false, ..) => Wanted::Other,
    }
}

/// Answers one who wants no WebSocket.
pub(super) fn answer(stream: &mut TcpStream, wanted: Wanted) -> io::Result<()> {
    let (status, sort, body) = match wanted {
        Wanted::Page | Wanted::Socket => ("200 OK", "text/html", PAGE),
        Wanted::Other => ("404 Not Found", "text/plain", "the page is at /\n"),
    };
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {sort}; charset=utf-8\r\nContent-Length: {length}\r\nCache-Control: \
         no-store\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nContent-Security-Policy: default-src \
         'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self' ws:\r\nConnection: \
         close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body.as_bytes())?;
    stream.flush()?;
    // What is unread when a connection closes would take the answer back.
    let mut rest = [0; HEAD_BYTES_MAX];
    let _ = io::Read::read(stream, &mut rest);
    stream.shutdown(std::net::Shutdown::Write)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_told_apart() {
        for (head, wanted) in [
            ("GET / HTTP/1.1\r\nHost: a\r\nUpgrade: WebSocket\r\n\r\n", Wanted::Socket),
            ("GET /chat HTTP/1.1\r\nupgrade:websocket\r\n\r\n", Wanted::Socket),
            ("GET / HTTP/1.1\r\nHost: a\r\n\r\n", Wanted::Page),
            ("GET /favicon.ico HTTP/1.1\r\n\r\n", Wanted::Other),
            ("POST / HTTP/1.1\r\n\r\n", Wanted::Other),
            ("\r\n\r\n", Wanted::Other),
        ] {
            assert_eq!(of_head(head), wanted, "{head}");
        }
    }
}
