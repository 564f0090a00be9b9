//! The requests of a host to a board without actuators: there are two, and each always has the same
//! bytes.

use crate::checksum::Checksum;
use crate::decode::Frame;
use crate::schema::Schema;

/// The request for a hello and the one for health.
const fn requests(checksum: Checksum) -> (&'static [u8], &'static [u8]) {
    match checksum {
        Checksum::None => (b"1:\0,", b"2:\0\x01,"),
        Checksum::Crc16 => (b"4:\0\xFF\xE1\xF0,", b"5:\0\x01\xFF\x0D\x2E,"),
        Checksum::Crc32 => (b"6:\0\xFF\xD2\x02\xEF\x8D,", b"7:\0\x01\xFF\x36\xDE\x22\x69,"),
    }
}

/// Finds the requests in a stream. A [`crate::Decoder`] finds the same ones if the schema has no
/// actuators, but its code is six times as large.
#[derive(Clone, Copy, Debug)]
pub struct Requests {
    checksum: Checksum,
    /// The number of bytes of each request that the stream now ends with.
    hello: usize,
    health: usize,
    frames: u32,
}

/// Advances by one byte; a request contains its first byte only once, so no other request can begin
/// within it.
fn follow(request: &[u8], place: &mut usize, byte: u8) -> bool {
    if request.get(*place) != Some(&byte) {
        *place = 0;
    }
    *place += usize::from(request.get(*place) == Some(&byte));
    *place == request.len()
}

impl Requests {
    /// The state at the start.
    #[must_use]
    pub const fn new(schema: &Schema) -> Self {
        Self { checksum: schema.checksum, hello: 0, health: 0, frames: 0 }
    }

    /// Takes the next bytes of the stream and passes on each request.
    pub fn feed(&mut self, bytes: &[u8], on_frame: &mut dyn FnMut(Frame<'_>)) {
        let (hello, health) = requests(self.checksum);
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

    /// Whether no request has begun: the next byte is the first of one, or garbage.
    #[must_use]
    pub const fn is_idle(&self) -> bool {
        self.hello == 0 && self.health == 0
    }

    /// The requests so far; wraps.
    #[must_use]
    pub const fn frames(&self) -> u32 {
        self.frames
    }
}
