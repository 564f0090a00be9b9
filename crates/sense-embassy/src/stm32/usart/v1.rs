//! The registers of a serial port: one for the bytes of both directions, and a status that reading clears.

use embassy_stm32::pac::usart::Usart;

/// The character that has come, if it was not lost, and whether all is well; none where the interrupt means nothing.
pub(super) fn take(port: Usart) -> Option<(Option<u8>, bool)> {
    let status = port.sr().read();
    if !status.rxne() && !status.ore() {
        return None;
    }
    let byte = port.dr().read().dr() as u8;
    let is_damaged = status.pe() || status.fe();
    let is_here = status.rxne() && !is_damaged;
    Some((is_here.then_some(byte), !is_damaged && !status.ore()))
}
