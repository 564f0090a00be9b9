//! How the value of a part on a register bus is accessed, whichever bus it is.

use super::Kind;

/// What is sent and waited for before the bytes come, and the number of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegisterAccess<'a> {
    /// Bytes that start a measurement; empty if the part measures on its own.
    pub trigger: &'a [u8],
    /// Time from the trigger to the value, in microseconds.
    pub wait_us: u32,
    /// The register that is read or written; none if the part has only one, or none.
    pub register: Option<u16>,
    /// Bytes sent in place of a register's number; only on SPI.
    pub read: &'a [u8],
    /// Bytes of the value.
    pub length_bytes: u16,
}

impl Kind {
    /// The access to a value on I2C or SPI; none if it is not on a register bus.
    #[must_use]
    pub fn register_access(&self) -> Option<RegisterAccess<'_>> {
        match self {
            Self::I2c(own) => Some(RegisterAccess {
                trigger: &own.trigger,
                wait_us: own.wait_us,
                register: own.register,
                read: &[],
                length_bytes: own.length_bytes,
            }),
            Self::Spi(own) => Some(RegisterAccess {
                trigger: &own.trigger,
                wait_us: own.wait_us,
                register: own.register,
                read: &own.read,
                length_bytes: own.length_bytes,
            }),
            Self::Analog(_)
            | Self::Icu(_)
            | Self::Encoder(_)
            | Self::Digital(_)
            | Self::Uart(_)
            | Self::Pwm(_)
            | Self::Dac(_)
            | Self::Can(_) => None,
        }
    }
}
