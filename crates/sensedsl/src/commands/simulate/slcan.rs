//! CAN adapters on a serial line, with frames as lines of text, as python-can (`slcan`) and Linux (`slcand`) expect
//! them.
//!
//! `t1232AABB` is a two-byte frame with an 11-bit identifier; `T0000012321234` is one with a 29-bit identifier; `r` and
//! `R` are remote frames. A line ends with a carriage return. `O` opens the bus, `C` closes it, and each command is
//! answered.

use sensedsl_surroundings::CanFrame;

/// The longest line of the protocol.
const LINE_MAX: usize = 32;
const DONE: u8 = b'\r';
const REFUSED: u8 = 7;

/// The adapter's end of a line.
#[derive(Debug, Default)]
pub(super) struct Slcan {
    line: Vec<u8>,
    is_open: bool,
}

impl Slcan {
    /// Takes bytes from the host. Returns the frames that it sends, and appends the answers.
    pub(super) fn feed(&mut self, bytes: &[u8], answer: &mut Vec<u8>) -> Vec<CanFrame> {
        let mut frames = Vec::new();
        for byte in bytes {
            match byte {
                b'\r' => {
                    let line = std::mem::take(&mut self.line);
                    frames.extend(self.command(&line, answer));
                }
                // Lines may also end with `\n` after the carriage return.
                b'\n' => {}
                _ if self.line.len() < LINE_MAX => self.line.push(*byte),
                _ => {}
            }
        }
        frames
    }

    fn command(&mut self, line: &[u8], answer: &mut Vec<u8>) -> Option<CanFrame> {
        match line {
            [] => {}
            [b'O' | b'L'] => self.is_open = true,
            [b'C'] => self.is_open = false,
            // Bit rates, time stamps, filters: none of the settings changes anything on this bus.
            [b'S' | b's' | b'Z' | b'M' | b'm' | b'X' | b'W' | b'U', ..] => {}
            [b'V'] => answer.extend_from_slice(b"V1013"),
            [b'N'] => answer.extend_from_slice(b"NSENS"),
            [b'F'] => answer.extend_from_slice(b"F00"),
            _ => {
                let frame = frame(line).filter(|_| self.is_open);
                answer.push(if frame.is_some() { DONE } else { REFUSED });
                return frame;
            }
        }
        answer.push(DONE);
        None
    }

    /// Appends a frame that the board has sent, if somebody listens.
    pub(super) fn show(&self, frame: &CanFrame, to: &mut Vec<u8>) {
        if !self.is_open {
            return;
        }
        let (letter, id) = match (frame.extended, frame.remote) {
            (false, false) => ('t', format!("{:03X}", frame.id)),
            (false, true) => ('r', format!("{:03X}", frame.id)),
            (true, false) => ('T', format!("{:08X}", frame.id)),
            (true, true) => ('R', format!("{:08X}", frame.id)),
        };
        let count = if frame.remote { 0 } else { usize::from(frame.length.min(8)) };
        let data: String =
            frame.data.iter().take(count).map(|byte| format!("{byte:02X}")).collect();
        to.extend_from_slice(format!("{letter}{id}{}{data}\r", frame.length.min(8)).as_bytes());
    }
}

/// Parses a frame; `None` if it is not one.
fn frame(line: &[u8]) -> Option<CanFrame> {
    let (extended, remote) = match line.first()? {
        b't' => (false, false),
        b'r' => (false, true),
        b'T' => (true, false),
        b'R' => (true, true),
        _ => return None,
    };
    let (digits, most) = if extended { (8, 0x1FFF_FFFF) } else { (3, 0x7FF) };
    let id = number(line.get(1..=digits)?).filter(|id| *id <= most)?;
    let length = number(line.get(digits + 1..digits + 2)?).filter(|length| *length <= 8)?;
    let rest = line.get(digits + 2..)?;
    let length = u8::try_from(length).ok()?;
    let count = if remote { 0 } else { usize::from(length) };
    let mut data = [0; 8];
    for (place, pair) in data.iter_mut().zip(rest.chunks(2)).take(count) {
        *place = u8::try_from(number(pair).filter(|_| pair.len() == 2)?).ok()?;
    }
    // A time stamp of four digits may follow.
    let is_whole = rest.len() == 2 * count || rest.len() == 2 * count + 4;
    is_whole.then_some(CanFrame { id, extended, remote, length, data })
}

fn number(digits: &[u8]) -> Option<u32> {
    let is_hex = digits.iter().all(u8::is_ascii_hexdigit);
    u32::from_str_radix(std::str::from_utf8(digits).ok().filter(|_| is_hex)?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::{CanFrame, Slcan};

    fn fed(text: &str) -> (Vec<CanFrame>, String) {
        let (mut line, mut answer) = (Slcan::default(), Vec::new());
        let frames = line.feed(text.as_bytes(), &mut answer);
        (frames, String::from_utf8(answer).unwrap())
    }

    #[test]
    fn frames_are_read_as_the_protocol_writes_them() {
        let (frames, answer) = fed("S6\rO\rt1232AABB\rT1FFFFFFF8000102030405060F\rr7FF4\r");
        assert_eq!(answer, "\r".repeat(5));
        let data = [0xAA, 0xBB, 0, 0, 0, 0, 0, 0];
        let first = CanFrame { id: 0x123, extended: false, remote: false, length: 2, data };
        assert_eq!(frames[0], first);
        assert_eq!((frames[1].id, frames[1].extended, frames[1].data[7]), (0x1FFF_FFFF, true, 15));
        assert_eq!((frames[2].remote, frames[2].length), (true, 4));
    }

    #[test]
    fn what_is_not_a_frame_is_refused() {
        for line in [
            "t8000",
            "T200000000",
            "t1239",
            "t1232AAB",
            "t12",
            "t1232AABBCC",
            "t1 30",
            "q",
            "t1231+A",
        ] {
            let (frames, answer) = fed(&format!("O\r{line}\r"));
            assert!(frames.is_empty() && answer == "\r\u{7}", "{line}: {answer:?}");
        }
        let (frames, answer) = fed("t1230\r");
        assert!(frames.is_empty() && answer == "\u{7}", "the bus is closed");
    }

    #[test]
    fn a_frame_is_written_as_it_is_read() {
        let (mut line, mut answer, mut text) = (Slcan::default(), Vec::new(), Vec::new());
        for frame in ["t1232AABB\r", "T0000030540000 03E8\r".replace(' ', "").as_str(), "r7FF4\r"] {
            let sent = line.feed(format!("O\r{frame}").as_bytes(), &mut answer);
            text.clear();
            line.show(&sent[0], &mut text);
            assert_eq!(String::from_utf8_lossy(&text), frame);
        }
    }
}
