//! The limits of a part's data sheet: drivers state them, and checks compare a design with them.

/// The limits from a part's data sheet; empty where its driver gives none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bounds {
    /// The I2C addresses that the part can have, in 7-bit form.
    pub addresses: Vec<u8>,
    /// The greatest clock of its bus, in hertz.
    pub clock_max_hz: Option<u32>,
    /// The least and the greatest supply, in millivolts.
    pub supply_mv: Option<(u32, u32)>,
}
