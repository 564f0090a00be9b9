//! The USB port.

use super::wires::{NEVER, Wires};

/// The port.
#[derive(Debug)]
pub(super) struct Usb;

impl Usb {
    pub(super) fn new() -> Self {
        Self
    }

    pub(super) fn restart(&mut self, _: &mut Wires) {}

    pub(super) fn link_has_bytes(&mut self, _: &mut Wires) {}

    pub(super) fn deadline(&self) -> u64 {
        NEVER
    }

    pub(super) fn advance(&mut self, _: &mut Wires) {}

    pub(super) fn read(&mut self, _: u32, _: &mut Wires) -> u32 {
        0
    }

    pub(super) fn write(&mut self, _: u32, _: u32, _: u32, _: &mut Wires) {}
}
