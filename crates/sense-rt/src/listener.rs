//! How a reporter listens to its host: with a decoder, or without actuators with a scanner for the
//! requests.

use crate::decode::Frame;
#[cfg(feature = "actuators")]
use crate::decode::Machine as Inner;
#[cfg(not(feature = "actuators"))]
use crate::requests::Requests as Inner;
use crate::schema::Schema;

#[derive(Debug)]
pub(crate) struct Listener(Inner);

impl Listener {
    pub(crate) const fn frames(&self) -> u32 {
        self.0.frames()
    }

    pub(crate) fn is_idle(&self) -> bool {
        self.0.is_idle()
    }
}

#[cfg(feature = "actuators")]
impl Listener {
    /// With too little memory, no frame is accepted.
    pub(crate) const fn new(schema: &'static Schema, is_enough: bool) -> Self {
        Self(Inner::new(schema, crate::schema::Direction::ToBoard, is_enough))
    }

    pub(crate) fn feed(
        &mut self,
        buffer: &mut [u8],
        bytes: &[u8],
        on_frame: &mut dyn FnMut(Frame<'_>),
    ) {
        self.0.feed(buffer, bytes, on_frame);
    }
}

#[cfg(not(feature = "actuators"))]
impl Listener {
    /// Requests need no memory.
    pub(crate) const fn new(schema: &'static Schema, _: bool) -> Self {
        Self(Inner::new(schema))
    }

    pub(crate) fn feed(&mut self, _: &mut [u8], bytes: &[u8], on_frame: &mut dyn FnMut(Frame<'_>)) {
        self.0.feed(bytes, on_frame);
    }
}
