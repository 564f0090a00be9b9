//! Formulas that need more than scale and offset: from the raw bytes of one reading, the part's
//! calibration and its parameters to physical quantities, in integers.
//!
//! A table refers to its formula, so that only the formulas that a board uses are linked.

mod bosch;
mod ntc;
mod tsl2561;

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

/// BMP280. Outputs: 0 temperature in 0.01 degC, 1 pressure in Pa/256. Calibration: 0x88, 24 bytes.
/// Raw: 0xF7, 6 bytes.
pub const BMP280: Formula = Formula {
    calibration_bytes: 24,
    raw_bytes: 6,
    parameters_count: 0,
    outputs_count: 2,
    compute: bosch::bmp280,
};

/// BME280. Outputs: 0 and 1 as for BMP280, 2 relative humidity in %/1024. Calibration: 0x88, 24
/// bytes; 0xA1, 1; 0xE1, 7. Raw: 0xF7, 8 bytes.
pub const BME280: Formula = Formula {
    calibration_bytes: 32,
    raw_bytes: 8,
    parameters_count: 0,
    outputs_count: 3,
    compute: bosch::bme280,
};

/// A thermistor from the pin to ground, with a series resistor to the supply. Output: 0 temperature
/// in 0.01 degC. Parameters: beta in K (1 to 20000), resistance at 25 degC in ohms, series
/// resistance in ohms (both 1 to 100000000). Raw: the analog value 0 to 4095, 2 bytes, most
/// significant first; 0 and 4095 mean a short circuit and an open circuit.
pub const NTC: Formula = Formula {
    calibration_bytes: 0,
    raw_bytes: 2,
    parameters_count: 3,
    outputs_count: 1,
    compute: ntc::compute,
};

/// TSL2561 in the T, FN and CL packages. Output: 0 illuminance in mlx. Parameters: integration time
/// in ms (13, 101 or 402), gain (1 or 16); none: 402 and 16. Raw: both channels from 0x8C, 4 bytes,
/// each least significant first; a saturated channel is not a measurement.
pub const TSL2561: Formula = Formula {
    calibration_bytes: 0,
    raw_bytes: 4,
    parameters_count: 2,
    outputs_count: 1,
    compute: tsl2561::compute,
};
