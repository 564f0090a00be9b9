//! Formulas that need more than scale and offset: from the raw bytes of one reading, the part's
//! calibration and its parameters to physical quantities, in integers.
//!
//! A table refers to its formula, so that only the formulas that a board uses are linked.

mod bosch;
mod hx711;
mod ntc;
mod tsl2561;

pub use self::bosch::{BME280, BMP280};
pub use self::hx711::HX711;
pub use self::ntc::NTC;
pub use self::tsl2561::TSL2561;

/// The most outputs that any formula has.
pub const OUTPUTS_MAX: usize = 3;

/// The outputs for a raw block.
pub type Outputs = [i64; OUTPUTS_MAX];

/// A function of calibration, parameters and raw block.
type Compute = fn(&[u8], &[i32], &[u8]) -> Option<Outputs>;

/// A formula.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// The size of all calibration blocks, one after the other.
    pub calibration_bytes: u16,
    /// The size of the raw block that it is computed from.
    pub raw_bytes: u16,
    /// The number of parameters.
    pub parameters_count: u8,
    /// The number of outputs.
    pub outputs_count: u8,
    compute: Compute,
}

impl Formula {
    /// The outputs for a calibration, parameters and a raw block. `None` if this is not a
    /// measurement (switched off, out of range, an open wire) or bytes are missing.
    #[must_use]
    pub fn compute(&self, calibration: &[u8], parameters: &[i32], raw: &[u8]) -> Option<Outputs> {
        let calibration = calibration.get(..self.calibration_bytes.into())?;
        (self.compute)(calibration, parameters, raw.get(..self.raw_bytes.into())?)
    }
}
