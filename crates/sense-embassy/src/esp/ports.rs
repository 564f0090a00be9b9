//! The link: a serial port, or the USB device that every chip has beside its debugger. Both carry bytes, and a task
//! moves them between the port and the queues.

use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::peripherals::USB_DEVICE;
use esp_hal::uart::{Instance, Uart, UartRx, UartTx};
use esp_hal::usb::usb_serial_jtag::{UsbSerialJtag, UsbSerialJtagRx, UsbSerialJtagTx};

use super::OneCore;
use super::uart::{Ones, config};
use crate::link::Link;
use crate::link_stream::carry;

/// The directions of a serial port.
pub struct Port(OneCore<(UartRx<'static, Async>, UartTx<'static, Async>)>);

/// A serial port with its pins.
pub fn port(
    unit: impl Instance + 'static,
    rx: impl PeripheralInput<'static>,
    tx: impl PeripheralOutput<'static>,
    baud: u32,
) -> Port {
    match Uart::new(unit, config(baud, 8, Ones::Any, 1)) {
        Ok(port) => Port(OneCore(port.into_async().with_rx(rx).with_tx(tx).split())),
        Err(_) => crate::restart(),
    }
}

impl Port {
    /// Carries bytes, for ever.
    pub async fn run<const BYTES: usize>(self, link: &'static Link<BYTES>) -> ! {
        let (rx, tx) = self.0.0;
        carry(rx, tx, link).await
    }
}

/// The directions of the USB device.
pub struct Usb(OneCore<(UsbSerialJtagRx<'static, Async>, UsbSerialJtagTx<'static, Async>)>);

/// The USB device. It says itself what it is.
pub fn usb(unit: USB_DEVICE<'static>) -> Usb {
    Usb(OneCore(UsbSerialJtag::new(unit).into_async().split()))
}

impl Usb {
    /// Carries bytes, for ever. Without a host it waits with those that it has.
    pub async fn run<const BYTES: usize>(self, link: &'static Link<BYTES>) -> ! {
        let (rx, tx) = self.0.0;
        carry(rx, tx, link).await
    }
}
