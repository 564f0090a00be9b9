//! A WebSocket client after RFC 6455: text messages both ways, and what a page of a browser would say of itself.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::Value;

/// The nonce of the RFC's example, and what a server must answer to it (section 1.3).
const NONCE: &str = "dGhlIHNhbXBsZSBub25jZQ==";
const ACCEPT: &str = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";
const MASK: [u8; 4] = [0x37, 0xfa, 0x21, 0x3d];

pub(crate) struct WebSocket {
    stream: TcpStream,
    received: Vec<u8>,
}

/// What came.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Message {
    Text(Value),
    Binary(Vec<u8>),
    Closed,
}

impl WebSocket {
    /// Connects; the status line if the server does not want it. `more` are lines of the head.
    pub(crate) fn connect(port: u16, more: &str) -> Result<Self, String> {
        Self::connect_to(port, "/", more)
    }

    /// The same with a path.
    pub(crate) fn connect_to(port: u16, path: &str, more: &str) -> Result<Self, String> {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
        let head = format!(
            "GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
             Sec-WebSocket-Key: {NONCE}\r\nSec-WebSocket-Version: 13\r\n{more}\r\n"
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        while !answer.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            if stream.read(&mut byte).unwrap_or(0) == 0 {
                return Err("closed".to_owned());
            }
            answer.push(byte[0]);
        }
        let answer = String::from_utf8(answer).unwrap();
        let (status, fields) = answer.split_once("\r\n").unwrap();
        if !status.starts_with("HTTP/1.1 101 ") {
            return Err(status.to_owned());
        }
        let accept = fields.lines().find_map(|line| {
            let (name, value) = line.split_once(": ")?;
            name.eq_ignore_ascii_case("Sec-WebSocket-Accept").then_some(value)
        });
        assert_eq!(accept, Some(ACCEPT));
        stream.set_read_timeout(Some(Duration::from_millis(50))).unwrap();
        Ok(Self { stream, received: Vec::new() })
    }

    /// The next message, within some time.
    pub(crate) fn next(&mut self, within: Duration) -> Option<Message> {
        let start = Instant::now();
        loop {
            if let Some((opcode, payload)) = self.frame() {
                match opcode {
                    1 => return Some(Message::Text(serde_json::from_slice(&payload).unwrap())),
                    2 => return Some(Message::Binary(payload)),
                    8 => return Some(Message::Closed),
                    9 => self.send(10, &payload),
                    _ => {}
                }
                continue;
            }
            let mut bytes = [0; 4_096];
            match self.stream.read(&mut bytes) {
                Ok(0) => return Some(Message::Closed),
                Ok(count) => self.received.extend_from_slice(&bytes[..count]),
                Err(error) if error.kind() == std::io::ErrorKind::ConnectionReset => {
                    return Some(Message::Closed);
                }
                Err(_) if start.elapsed() > within => return None,
                Err(_) => {}
            }
        }
    }

    /// The next text message that the test is waiting for.
    #[track_caller]
    pub(crate) fn wait(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(10) {
            match self.next(Duration::from_secs(10)) {
                Some(Message::Text(text)) if is_it(&text) => return text,
                Some(Message::Closed) => panic!("the server has closed"),
                _ => {}
            }
        }
        panic!("it did not come")
    }

    /// A whole frame of what was received; a server must not mask and need not fragment these.
    fn frame(&mut self) -> Option<(u8, Vec<u8>)> {
        let [first, second, ..] = self.received[..] else { return None };
        assert_eq!((first & 0xf0, second & 0x80), (0x80, 0), "a fragment, or a mask");
        let (start, length) = match second {
            126 => (4, u16::from_be_bytes(self.received.get(2..4)?.try_into().unwrap()).into()),
            127 => {
                let length = u64::from_be_bytes(self.received.get(2..10)?.try_into().unwrap());
                (10, usize::try_from(length).unwrap())
            }
            short => (2, usize::from(short)),
        };
        let payload = self.received.get(start..start + length)?.to_vec();
        self.received.drain(..start + length);
        Some((first & 0x0f, payload))
    }

    pub(crate) fn send(&mut self, opcode: u8, payload: &[u8]) {
        let mut frame = vec![0x80 | opcode];
        match u16::try_from(payload.len()) {
            Ok(length @ 0..126) => frame.push(0x80 | u8::try_from(length).unwrap()),
            Ok(length) => {
                frame.push(0x80 | 126);
                frame.extend(length.to_be_bytes());
            }
            Err(_) => {
                frame.push(0x80 | 127);
                frame.extend((payload.len() as u64).to_be_bytes());
            }
        }
        frame.extend(MASK);
        frame.extend(payload.iter().zip(MASK.iter().cycle()).map(|(byte, mask)| byte ^ mask));
        // One that is let go in the middle of it closes.
        let _ = self.stream.write_all(&frame);
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.send(1, text.as_bytes());
    }
}
