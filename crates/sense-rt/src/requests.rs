//! What a board without actuators hears of its host: two requests, each of them always the same bytes.

use crate::decode::Frame;
use crate::schema::Schema;

const HELLO: &[u8] = b"1:\0,";
const HEALTH: &[u8] = b"2:\0\x01,";
/// With a checksum.
const HELLO_CHECKED: &[u8] = b"4:\0\xFF\xE1\xF0,";
const HEALTH_CHECKED: &[u8] = b"5:\0\x01\xFF\x0D\x2E,";

/// Finds the requests in a stream. A [`crate::Decoder`] finds the same where the schema has no
/// actuator, and is six times as long.
#[derive(Clone, Copy, Debug)]
pub struct Requests {
    has_checksum: bool,
    /// So many bytes of each request are the last ones of the stream.
    hello: usize,
    health: usize,
    frames: u32,
}

/// One more byte of a request; its first byte comes once in it, so that nothing else begins in it.
fn follow(request: &[u8], place: &mut usize, byte: u8) -> bool {
    if request.get(*place) != Some(&byte) {
        *place = 0;
    }
    *place += usize::from(request.get(*place) == Some(&byte));
    *place == request.len()
}

impl Requests {
    /// At the start.
    #[must_use]
    pub const fn new(schema: &Schema) -> Self {
        Self { has_checksum: schema.checksum, hello: 0, health: 0, frames: 0 }
    }

    /// Takes the next bytes of the stream and hands on each request.
    pub fn feed(&mut self, bytes: &[u8], on_frame: &mut dyn FnMut(Frame<'_>)) {
        let (hello, health) =
            if self.has_checksum { (HELLO_CHECKED, HEALTH_CHECKED) } else { (HELLO, HEALTH) };
        for byte in bytes {
            let frame = if follow(hello, &mut self.hello, *byte) {
                Frame::HelloRequest
            } else if follow(health, &mut self.health, *byte) {
                Frame::HealthRequest
            } else {
                continue;
            };
            (self.hello, self.health) = (0, 0);
            self.frames = self.frames.wrapping_add(1);
            on_frame(frame);
        }
    }

    /// Whether no request has begun: what comes next is the first byte of one, or garbage.
    #[must_use]
    pub const fn is_idle(&self) -> bool {
        self.hello == 0 && self.health == 0
    }

    /// Requests so far; wraps.
    #[must_use]
    pub const fn frames(&self) -> u32 {
        self.frames
    }
}
