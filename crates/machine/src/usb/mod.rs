//! USB as a device, with a file for each block, and the host at the other end of the cable.
//!
//! In: accesses of the program, and the bytes that a program on the host sends. Out: interrupts, and the bytes that the
//! host receives. Each unit owns its host: what one does to the other takes no time.

mod fs;
mod host;
mod otg;
mod unit;

pub(crate) use self::unit::Usb;
use crate::mcu::Mcu;

/// The unit of an MCU in its state after a reset.
pub(crate) fn new(mcu: &Mcu) -> Box<dyn Usb> {
    match mcu.block("USB") {
        "usb_v1" | "usb_v3" => Box::new(fs::Device::new(mcu)),
        _ => Box::new(otg::Otg::new(mcu)),
    }
}
