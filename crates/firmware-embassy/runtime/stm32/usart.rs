//! Serial ports in the HAL's words: how they are set, what their interrupts give, how they send.

use embassy_stm32::gpio::Pull;
use embassy_stm32::mode::Blocking;
use embassy_stm32::pac::usart::Usart;
use embassy_stm32::usart::{Config, DataBits, Parity, StopBits, UartTx};

use super::port::take;
use super::serial::{self, Heard, Said};

/// In the port's interrupt: takes the character that has come. `mask` has the bits that are data.
pub fn on_interrupt<const BYTES: usize>(heard: &Heard<BYTES>, port: Usart, mask: u8) {
    if let Some((byte, is_whole)) = take(port) {
        heard.take(byte, is_whole, mask);
    }
}

/// A port that also runs on a slow clock: the PAC has a type of its own for it, with the same registers.
pub const fn low_power(registers: *mut ()) -> Usart {
    // The pointer is one of the PAC's.
    unsafe { Usart::from_ptr(registers) }
}

/// Lets a port interrupt for each character.
pub fn listen(port: Usart) {
    port.cr1().modify(|register| register.set_rxneie(true));
}

/// How a port is set.
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

/// Sends what is queued, for ever.
pub async fn say<const BYTES: usize>(mut port: UartTx<'static, Blocking>, said: &'static Said<BYTES>, baud: u32) -> ! {
    // What it returns is always `Ok`: nothing is there that a device could be told of.
    let put = |bytes: &[u8]| {
        let _ = port.blocking_write(bytes);
    };
    serial::say(put, said, baud).await
}
