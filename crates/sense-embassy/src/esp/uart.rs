//! Serial ports of devices.

use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::uart::{self, DataBits, Instance, Parity, StopBits};

use super::OneCore;
use crate::serial::{self, RxQueue, TxQueue};

/// What a port sends with.
pub struct UartTx(OneCore<uart::UartTx<'static, Async>>);

/// What a port receives with.
pub struct UartRx(OneCore<uart::UartRx<'static, Async>>);

/// A port with both directions.
pub struct Uart(UartRx, UartTx);

/// A unit that has no pin yet; what the wiring of a port cannot be is a program that starts over.
fn port(unit: impl Instance + 'static, config: uart::Config) -> uart::Uart<'static, Async> {
    match uart::Uart::new(unit, config) {
        Ok(port) => port.into_async(),
        Err(_) => crate::restart(),
    }
}

impl Uart {
    /// A port with its pins.
    pub fn new(
        unit: impl Instance + 'static,
        rx: impl PeripheralInput<'static>,
        tx: impl PeripheralOutput<'static>,
        config: uart::Config,
    ) -> Self {
        let (rx, tx) = port(unit, config).with_rx(rx).with_tx(tx).split();
        Self(UartRx(OneCore(rx)), UartTx(OneCore(tx)))
    }

    /// Its directions: what sends, and what receives.
    #[must_use]
    pub fn split(self) -> (UartTx, UartRx) {
        (self.1, self.0)
    }
}

impl UartTx {
    /// A port that only sends.
    pub fn new(
        unit: impl Instance + 'static,
        tx: impl PeripheralOutput<'static>,
        config: uart::Config,
    ) -> Self {
        Self(OneCore(port(unit, config).with_tx(tx).split().1))
    }
}

impl UartRx {
    /// A port that only receives.
    pub fn new(
        unit: impl Instance + 'static,
        rx: impl PeripheralInput<'static>,
        config: uart::Config,
    ) -> Self {
        Self(OneCore(port(unit, config).with_rx(rx).split().0))
    }
}

/// What is even or odd about a character.
#[derive(Clone, Copy)]
pub enum Ones {
    /// Nothing: it has no parity.
    Any,
    /// The number of its ones is even.
    Even,
    /// The number of its ones is odd.
    Odd,
}

/// A configuration.
#[must_use]
pub fn config(baud: u32, data_bits: u8, parity: Ones, stop_bits: u8) -> uart::Config {
    uart::Config::default()
        .with_baudrate(baud)
        .with_data_bits(if data_bits == 7 { DataBits::_7 } else { DataBits::_8 })
        .with_parity(match parity {
            Ones::Any => Parity::None,
            Ones::Even => Parity::Even,
            Ones::Odd => Parity::Odd,
        })
        .with_stop_bits(if stop_bits == 2 { StopBits::_2 } else { StopBits::_1 })
}

/// Takes what comes, for ever. `mask` has the bits that are data.
pub async fn receive<const BYTES: usize>(
    mut port: UartRx,
    queue: &'static RxQueue<BYTES>,
    mask: u8,
) -> ! {
    loop {
        let mut bytes = [0; 32];
        match port.0.0.read_async(&mut bytes).await {
            Ok(size) => {
                let came = bytes.get(..size).unwrap_or_default();
                came.iter().for_each(|byte| queue.take(Some(*byte), true, mask));
            }
            Err(_) => queue.take(None, false, mask),
        }
    }
}

/// Sends queued bytes, for ever.
pub async fn transmit<const BYTES: usize>(
    mut port: UartTx,
    queue: &'static TxQueue<BYTES>,
    baud: u32,
) -> ! {
    // The port has room: the last byte was given the time that it takes.
    let put = |bytes: &[u8]| {
        let _ = port.0.0.write(bytes);
    };
    serial::transmit(put, queue, baud).await
}
