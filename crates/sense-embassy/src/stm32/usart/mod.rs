//! Serial ports in the HAL's words: how they are set, what their interrupts give, how they send.

use embassy_stm32::gpio::Pull;
use embassy_stm32::mode::Blocking;
use embassy_stm32::pac::usart::Usart;
use embassy_stm32::usart::{Config, ConfigError, DataBits, OutputConfig, Parity, StopBits, UartTx};

use crate::serial::{self, RxQueue, TxQueue};

#[cfg(feature = "usart-v1")]
mod v1;
#[cfg(feature = "usart-v3")]
mod v3;
#[cfg(feature = "usart-v1")]
use v1::take;
#[cfg(feature = "usart-v3")]
use v3::take;

/// In the port's interrupt: takes the character that has come. `mask` has the bits that are data.
pub fn on_interrupt<const BYTES: usize>(queue: &RxQueue<BYTES>, port: Usart, mask: u8) {
    if let Some((byte, is_whole)) = take(port) {
        queue.take(byte, is_whole, mask);
    }
}

/// A port that also runs on a slow clock. The PAC has a type of its own for it, with the same registers.
///
/// # Safety
///
/// The pointer must be the one of an `LPUART` of the PAC.
#[must_use]
pub const unsafe fn low_power(registers: *mut ()) -> Usart {
    // SAFETY: the caller promises it.
    unsafe { Usart::from_ptr(registers) }
}

/// Lets a port interrupt for each character.
pub fn listen(port: Usart) {
    port.cr1().modify(|register| register.set_rxneie(true));
}

/// How a device's port is set.
#[must_use]
pub fn config(baud: u32, bits: u8, parity: Parity, stop_bits: u8) -> Config {
    let mut config = Config::default();
    config.baudrate = baud;
    config.data_bits = if bits == 7 { DataBits::DataBits7 } else { DataBits::DataBits8 };
    config.parity = parity;
    config.stop_bits = if stop_bits == 2 { StopBits::STOP2 } else { StopBits::STOP1 };
    // A wire that nothing drives rests.
    config.rx_pull = Pull::Up;
    config
}

/// How the link's port is set; a host that is not there leaves its wire at rest.
#[must_use]
pub fn link(baud: u32) -> Config {
    let mut config = Config::default();
    config.baudrate = baud;
    config.rx_pull = Pull::Up;
    config
}

/// The same for a port whose wires rest low.
#[cfg(feature = "usart-v3")]
#[must_use]
pub fn inverted(mut config: Config) -> Config {
    config.invert_rx = true;
    config.invert_tx = true;
    config.rx_pull = Pull::Down;
    config
}

/// The same for a port with both directions at TX: each end of the wire pulls it low, or lets it go.
#[must_use]
pub fn one_wire(mut config: Config) -> Config {
    config.tx_config = OutputConfig::OpenDrain;
    config
}

/// A port that could be made; the generator has checked its rate.
pub fn port<T>(made: Result<T, ConfigError>) -> T {
    match made {
        Ok(port) => port,
        Err(_) => crate::restart(),
    }
}

/// Sends queued bytes, forever.
pub async fn transmit<const BYTES: usize>(
    mut port: UartTx<'static, Blocking>,
    queue: &'static TxQueue<BYTES>,
    baud: u32,
) -> ! {
    // A blocking write to a port has no error to report: the HAL always returns `Ok`.
    let put = |bytes: &[u8]| {
        let _ = port.blocking_write(bytes);
    };
    serial::transmit(put, queue, baud).await
}
