//! A thermistor by its beta formula, 1/T = 1/T25 + ln(R/R25)/beta, in integers.

use super::{Formula, Outputs};
use crate::bytes::at;

/// A thermistor from the pin to ground, with a series resistor to the supply. Output: 0 temperature
/// in 0.01 degC. Parameters: beta in K (1 to 20000), resistance at 25 degC in ohms, series
/// resistance in ohms (both 1 to 100000000). Raw: the analog value 0 to 4095, 2 bytes, most
/// significant first; 0 and 4095 mean a short circuit and an open circuit.
pub const NTC: Formula =
    Formula { calibration_bytes: 0, raw_bytes: 2, parameters_count: 3, outputs_count: 1, compute };

const FULL: u64 = 4095;
const T25_CENTI: i64 = 29_815;
const ZERO_CENTI: i64 = 27_315;
const RESISTANCE_MAX: i64 = 100_000_000;
const BETA_MAX: i64 = 20_000;
/// ln(2) times 2^24.
const LN2_Q24: i64 = 11_629_080;
/// Fractional bits of the logarithm.
const LOG_BITS: u32 = 24;

/// log2(number) times 2^24, for a number of at least 1: the position of the highest bit, then one
/// fractional bit for each squaring.
fn log2_q24(number: u64) -> i64 {
    let places = number.leading_zeros().min(63);
    let mut result = i64::from(63 - places);
    // Here 2^31 stands for 1.
    let mut mantissa = number.wrapping_shl(places) >> 32;
    for _ in 0..LOG_BITS {
        let square = mantissa * mantissa;
        let is_two = square >> 63 != 0;
        result = 2 * result + i64::from(is_two);
        mantissa = if is_two { square >> 32 } else { square >> 31 } & 0xFFFF_FFFF;
    }
    result
}

fn compute(_: &[u8], parameters: &[i32], raw: &[u8]) -> Option<Outputs> {
    let [beta, r25, series, ..] = *parameters else { return None };
    let (beta, r25, series) = (i64::from(beta), i64::from(r25), i64::from(series));
    let level = u64::from(u16::from_be_bytes([at(raw, 0), at(raw, 1)]));
    let are_right = (1..=BETA_MAX).contains(&beta)
        && (1..=RESISTANCE_MAX).contains(&r25)
        && (1..=RESISTANCE_MAX).contains(&series);
    if level == 0 || level >= FULL || !are_right {
        return None;
    }
    // The resistance is series * level / (FULL - level).
    let log_ratio =
        log2_q24(series.cast_unsigned() * level) - log2_q24(r25.cast_unsigned() * (FULL - level));
    let log_ratio = log_ratio * LN2_Q24 / (1 << LOG_BITS);
    // T = T25 * beta / (beta + T25 * ln), everything times 100 * 2^24.
    let divisor = beta * 100 * (1 << LOG_BITS) + T25_CENTI * log_ratio;
    if divisor <= 0 {
        return None;
    }
    let numerator = beta * 100 * T25_CENTI * (1 << LOG_BITS) + divisor / 2;
    Some([numerator.checked_div(divisor)? - ZERO_CENTI, 0, 0])
}
