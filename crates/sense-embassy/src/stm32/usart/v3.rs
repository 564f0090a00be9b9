//! The registers of a serial port: one for each direction, and a status that is cleared by writing.

use embassy_stm32::pac::usart::Usart;

/// The character that has come, if it was not lost, and whether all is well; none where the interrupt means nothing.
pub(super) fn take(port: Usart) -> Option<(Option<u8>, bool)> {
    let status = port.isr().read();
    if !status.rxne() && !status.ore() {
        return None;
    }
    let byte = port.rdr().read().dr() as u8;
    port.icr().write(|clear| {
        clear.set_pe(true);
        clear.set_fe(true);
        clear.set_ne(true);
        clear.set_ore(true);
    });
    let is_damaged = status.pe() || status.fe();
    let is_here = status.rxne() && !is_damaged;
    Some((is_here.then_some(byte), !is_damaged && !status.ore()))
}
