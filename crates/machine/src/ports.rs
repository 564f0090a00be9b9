//! How ports are set up: what a plan can be compared with, in the units that a file has.

/// How a port is set up that has started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortState {
    /// Which, as in `USART2`.
    pub unit: String,
    /// Its speed and what else both ends must agree on.
    pub setting: Setting,
}

/// What both ends of a wire must agree on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// A serial port.
    Serial {
        /// Bits per second.
        baud: u64,
        /// Bits of a character between start and parity.
        data_bits: u8,
        /// Whether a parity bit follows them; `Some(true)` for an odd one.
        odd_parity: Option<bool>,
        /// Stop bits, a half one counted as none.
        stop_bits: u8,
    },
    /// An SPI port.
    Spi {
        /// Its clock.
        clock_hz: u64,
        /// The fastest clock that it could have.
        fastest_hz: u64,
        /// Polarity and phase of the clock, 0 to 3.
        mode: u8,
    },
    /// An I2C bus.
    I2c {
        /// Its clock.
        clock_hz: u64,
        /// The fastest clock that its unit is made for.
        fastest_hz: u64,
    },
    /// A CAN bus.
    Can {
        /// Bits per second.
        bitrate_hz: u64,
    },
}
