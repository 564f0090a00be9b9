//! A port, whatever the version of its block.
//!
//! In: the number of a pin. Out: its mode, its resistor and its level, in the words that all versions share.

/// The mode of a pad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Its level can be read.
    Input,
    /// The program sets its level.
    Output,
    /// A peripheral controls the pad; with the number that selects it, unless it selects its pads itself.
    Alternate(Option<u8>),
    /// For converters and the DAC. After a reset, all pads except the debugger's are [`Mode::Input`].
    Analog,
}

/// The internal pull resistor of a pad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pull {
    /// No resistor.
    None,
    /// A pull-up.
    Up,
    /// A pull-down.
    Down,
}

/// A port, in one of the block's versions.
pub(super) trait Port: Send {
    /// The offset of the register that has the levels on the pads.
    fn levels_at(&self) -> u32;
    /// Reads any other register.
    fn read(&self, offset: u32) -> u32;
    /// Writes a register; returns whether pads may be switched to other peripherals now.
    fn write(&mut self, offset: u32, value: u32, mask: u32) -> bool;
    fn mode(&self, pin: u8) -> Mode;
    fn pull(&self, pin: u8) -> Pull;
    fn is_open_drain(&self, pin: u8) -> bool;
    /// The level that the program has set for the time when the pad is an output.
    fn is_high(&self, pin: u8) -> bool;
    /// Its speed, from 0 to 3.
    fn speed(&self, pin: u8) -> u8;
}
