//! The link over a serial port, whose own queues lie between the reporter and the interrupt.

use core::task::Poll;

use embassy_futures::poll_once;
use embedded_io_async::{Read, Write};
use sense_rt::Channel;

/// A port whose queue to the host takes a whole frame.
pub struct Port<P> {
    port: P,
    frame_bytes: usize,
}

impl<P> Port<P> {
    /// `frame_bytes`: of the longest frame, which the port's own queue takes whole.
    pub fn new(port: P, frame_bytes: usize) -> Self {
        Self { port, frame_bytes }
    }
}

impl<P: Read + Write> Channel for Port<P> {
    fn is_open(&mut self) -> bool {
        true
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        // Noise and overruns cost bytes, which the decoder notices.
        match poll_once(self.port.read(bytes)) {
            Poll::Ready(Ok(size)) => size,
            Poll::Ready(Err(_)) | Poll::Pending => 0,
        }
    }

    fn room(&mut self) -> usize {
        if self.is_empty() { self.frame_bytes } else { 0 }
    }

    fn is_empty(&mut self) -> bool {
        poll_once(self.port.flush()).is_ready()
    }

    fn write(&mut self, bytes: &[u8]) -> usize {
        let mut rest = bytes;
        while !rest.is_empty() {
            // A queue that begins anew in the middle of a frame takes it in two pieces.
            match poll_once(self.port.write(rest)) {
                Poll::Ready(Ok(size)) if size > 0 => rest = rest.get(size..).unwrap_or_default(),
                Poll::Ready(Ok(_) | Err(_)) | Poll::Pending => break,
            }
        }
        bytes.len().saturating_sub(rest.len())
    }
}
