//! The settings of ports, in units in which they can be compared with a plan.

/// The settings of a port that has started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortState {
    /// The port, as in `USART2`.
    pub unit: String,
    /// Its speed, and the other settings that both ends must agree on.
    pub setting: Setting,
}

/// The settings that both ends of a wire must agree on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// A serial port.
    Serial {
        /// The bits per second.
        baud: u64,
        /// The number of bits in a character between start and parity.
        data_bits: u8,
        /// The parity bit that follows them: `Some(true)` for an odd one, `None` without parity.
        odd_parity: Option<bool>,
        /// The number of stop bits; a half one does not count.
        stop_bits: u8,
    },
    /// An SPI port.
    Spi {
        /// The clock frequency.
        clock_hz: u64,
        /// The highest clock frequency that it could have.
        fastest_hz: u64,
        /// Polarity and phase of the clock, 0 to 3.
        mode: u8,
    },
    /// An I2C bus.
    I2c {
        /// The clock frequency.
        clock_hz: u64,
        /// The highest clock frequency that its unit supports.
        fastest_hz: u64,
    },
    /// A CAN bus.
    Can {
        /// The bits per second.
        bitrate_hz: u64,
    },
}
