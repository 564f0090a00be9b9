//! The two sides of the unit, whatever its block.
//!
//! In: accesses of the program, and what the host does on the bus. Out: what each of them gets, as a trait.

use crate::wires::Wires;

/// The unit as the program sees it.
pub(crate) trait Usb: Send {
    /// Restarts it in its state after a reset: the host finds it gone.
    fn restart(&mut self, wires: &mut Wires);
    fn deadline(&self) -> u64;
    fn advance(&mut self, wires: &mut Wires);
    fn read(&mut self, offset: u32, wires: &mut Wires) -> u32;
    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires);

    /// Reads the memory for packets, if it is apart from the registers.
    fn read_memory(&self, _: u32) -> u32 {
        0
    }

    fn write_memory(&mut self, _offset: u32, _value: u32, _mask: u32) {}
}

/// The unit as the host sees it.
pub(super) trait Function {
    /// The number of endpoints in each direction.
    fn endpoints(&self) -> usize;
    /// The host resets the bus.
    fn reset(&mut self);
    /// The host ends the reset.
    fn enumerated(&mut self);
    /// The host starts a frame of 1 ms.
    fn start_frame(&mut self);
    /// Whether the device listens to an address.
    fn hears(&self, address: u8) -> bool;
    /// The host makes a request at endpoint 0.
    fn setup(&mut self, packet: [u8; 8]);
    /// Whether an endpoint refuses to go on, to the host (`is_in`) or from it.
    fn has_stalled(&self, endpoint: usize, is_in: bool) -> bool;
    /// Whether endpoint 0 can take a request: the program has taken everything that came before.
    fn is_idle(&self) -> bool;
    /// Sends a packet to an endpoint; `false` if it is not ready for one.
    fn send(&mut self, endpoint: usize, data: &[u8]) -> bool;
    /// Takes a packet from an endpoint, if there is one.
    fn fetch(&mut self, endpoint: usize) -> Option<Vec<u8>>;
}
