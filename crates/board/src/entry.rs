//! What the registry has of each built-in board.

/// A board in the registry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name.
    pub name: &'static str,
    /// Other names.
    pub aliases: &'static [&'static str],
    /// The part number of the MCU.
    pub mcu: &'static str,
    /// A one-line description.
    pub description: &'static str,
}
