//! `spi`: a device on an SPI bus, with a chip select of its own.

use sensedsl_wire::ValueType;

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["clock", "mode", "read", "length", "sck", "miso", "mosi", "cs"];

/// Clock where the file says nothing.
const CLOCK_DEFAULT_HZ: u32 = 1_000_000;

/// A device on a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spi {
    /// Highest clock the device takes.
    pub clock_hz: u32,
    /// Where it is given.
    pub clock_span: Option<sensedsl_diagnostics::Span>,
    /// 0 to 3: clock polarity and phase.
    pub mode: u8,
    /// Bytes sent before the value is read; may be empty.
    pub read: Vec<u8>,
    /// Bytes of the value.
    pub length_bytes: u16,
}

pub(crate) fn read(fields: &mut Fields<'_>, value: ValueType) -> Spi {
    let clock = fields.frequency_hz("clock", 1_000..=100_000_000);
    let mode = fields.integer("mode", 0..=3).and_then(|n| u8::try_from(n.value).ok());
    let read = fields.bytes("read", 0..=32).map(|bytes| bytes.value).unwrap_or_default();
    let size_bytes = i64::try_from(value.size_bytes()).unwrap_or(i64::MAX);
    let length = fields.integer("length", 1..=1024).map_or(size_bytes, |n| n.value);
    Spi {
        clock_hz: clock.map_or(CLOCK_DEFAULT_HZ, |clock| clock.value),
        clock_span: clock.map(|clock| clock.span),
        mode: mode.unwrap_or(0),
        read,
        length_bytes: u16::try_from(length).unwrap_or(u16::MAX),
    }
}

impl Default for Spi {
    fn default() -> Self {
        Self {
            clock_hz: CLOCK_DEFAULT_HZ,
            clock_span: None,
            mode: 0,
            read: Vec::new(),
            length_bytes: 1,
        }
    }
}
