//! The link over a serial port.

use core::sync::atomic::Ordering;

use embassy_futures::join::join;
use embassy_stm32::usart::BufferedUart;
use embedded_io_async::{Read, Write};

use super::link::Link;

/// Moves bytes both ways, for ever.
pub async fn run<const SAID: usize>(uart: BufferedUart<'static>, link: &'static Link<SAID>) -> ! {
    let (mut tx, mut rx) = uart.split();
    link.is_open.store(true, Ordering::Relaxed);
    let say = async {
        let mut bytes = [0; 64];
        loop {
            let size = link.said.read(&mut bytes).await;
            link.is_sending.store(true, Ordering::Relaxed);
            let _ = tx.write_all(bytes.get(..size).unwrap_or_default()).await;
            let _ = tx.flush().await;
            link.is_sending.store(false, Ordering::Relaxed);
        }
    };
    let hear = async {
        let mut bytes = [0; 64];
        loop {
            // Noise and overruns cost bytes, which the decoder notices.
            if let Ok(size) = rx.read(&mut bytes).await {
                link.heard.write_all(bytes.get(..size).unwrap_or_default()).await;
            }
        }
    };
    join(say, hear).await.0
}
