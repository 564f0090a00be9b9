//! Serial ports in the HAL's words: how they are set, what their interrupts give, how they send.

use embassy_rp::pac::uart::Uart;
use embassy_rp::uart::{Blocking, Config, DataBits, Parity, StopBits, UartTx};

use crate::serial::{self, RxQueue, TxQueue};

/// In the port's interrupt: takes the characters that have come. `mask` has the bits that are data.
pub fn on_interrupt<const BYTES: usize>(queue: &RxQueue<BYTES>, port: Uart, mask: u8) {
    while !port.uartfr().read().rxfe() {
        let come = port.uartdr().read();
        let is_damaged = come.pe() || come.fe() || come.be();
        queue.take((!is_damaged).then_some(come.data()), !is_damaged && !come.oe(), mask);
    }
    // A FIFO that was emptied before the line fell silent still says that it had.
    port.uarticr().write(|clear| clear.set_rtic(true));
}

/// Lets a port interrupt when characters have come, at the latest when the line falls silent.
pub fn listen(port: Uart) {
    port.uartifls().modify(|levels| levels.set_rxiflsel(0));
    port.uartimsc().modify(|mask| {
        mask.set_rxim(true);
        mask.set_rtim(true);
    });
}

/// How a port is set. `is_inverted`: its wires rest low.
pub fn config(baud: u32, bits: u8, parity: Parity, stop_bits: u8, is_inverted: bool) -> Config {
    let mut config = Config::default();
    config.baudrate = baud;
    config.data_bits = if bits == 7 { DataBits::DataBits7 } else { DataBits::DataBits8 };
    config.parity = parity;
    config.stop_bits = if stop_bits == 2 { StopBits::STOP2 } else { StopBits::STOP1 };
    config.invert_rx = is_inverted;
    config.invert_tx = is_inverted;
    config
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
