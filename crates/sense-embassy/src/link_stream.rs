//! The link over a port that carries bytes, whose driver waits: a task moves them between it and the queues.

use core::sync::atomic::Ordering;

use embassy_futures::join::join;
use embedded_io_async::{Read, Write};

use crate::link::Link;

/// Bytes that are moved at once.
const CHUNK_BYTES: usize = 64;

/// Carries bytes between a port and the queues of a link, for ever. There is always a host that may listen.
pub async fn carry<const BYTES: usize>(
    mut rx: impl Read,
    mut tx: impl Write,
    link: &Link<BYTES>,
) -> ! {
    link.is_open.store(true, Ordering::Relaxed);
    let send = async {
        loop {
            let mut chunk = [0; CHUNK_BYTES];
            let size = link.tx.read(&mut chunk).await;
            link.is_sending.store(true, Ordering::Relaxed);
            // What is lost with a fault of the port is noticed by the host's decoder.
            let _ = tx.write_all(chunk.get(..size).unwrap_or_default()).await;
            let _ = tx.flush().await;
            link.is_sending.store(false, Ordering::Relaxed);
        }
    };
    let receive = async {
        loop {
            let mut chunk = [0; CHUNK_BYTES];
            if let Ok(size) = rx.read(&mut chunk).await {
                link.rx.write_all(chunk.get(..size).unwrap_or_default()).await;
            }
        }
    };
    join(send, receive).await.0
}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::convert::Infallible;
    use core::future::pending;
    use std::vec::Vec;

    use embassy_futures::poll_once;
    use embedded_io_async::{ErrorType, Read, Write};
    use sense_rt::Channel as _;

    use super::carry;
    use crate::link::{Link, Near};

    /// Gives these bytes, then none.
    struct Host<'a>(&'a [u8]);

    impl ErrorType for Host<'_> {
        type Error = Infallible;
    }

    impl Read for Host<'_> {
        async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
            let size = self.0.len().min(bytes.len());
            if size == 0 {
                return pending().await;
            }
            let (now, rest) = self.0.split_at(size);
            bytes[..size].copy_from_slice(now);
            self.0 = rest;
            Ok(size)
        }
    }

    /// Keeps what it is given, three bytes at a time.
    struct Port<'a>(&'a mut Vec<u8>);

    impl ErrorType for Port<'_> {
        type Error = Infallible;
    }

    impl Write for Port<'_> {
        async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
            let size = bytes.len().min(3);
            self.0.extend_from_slice(&bytes[..size]);
            Ok(size)
        }

        async fn flush(&mut self) -> Result<(), Infallible> {
            Ok(())
        }
    }

    #[test]
    fn bytes_go_both_ways() {
        static LINK: Link<128> = Link::new();
        let mut near = Near(&LINK);
        assert!(!near.is_open());
        let frame: Vec<u8> = (0..100).collect();
        assert_eq!((near.write(&frame), near.is_empty()), (frame.len(), false));
        let mut sent = Vec::new();
        assert!(poll_once(carry(Host(b"set"), Port(&mut sent), &LINK)).is_pending());
        assert_eq!(sent, frame);
        assert!(near.is_open() && near.is_empty());
        let mut heard = [0; 8];
        assert_eq!(near.read(&mut heard), 3);
        assert_eq!(heard[..3], *b"set");
    }
}
