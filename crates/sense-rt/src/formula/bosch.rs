//! BMP280 and BME280: the integer formulas of their data sheets, with pressure in 64 bits. Results
//! that no working part and no air on earth can produce are rejected before they could overflow.

use super::{Formula, Outputs};
use crate::bytes::at;

/// BMP280. Outputs: 0 temperature in 0.01 degC, 1 pressure in Pa/256. Calibration: 0x88, 24 bytes.
/// Raw: 0xF7, 6 bytes.
pub const BMP280: Formula = Formula {
    calibration_bytes: 24,
    raw_bytes: 6,
    parameters_count: 0,
    outputs_count: 2,
    compute: bmp280,
};

/// BME280. Outputs: 0 and 1 as for BMP280, 2 relative humidity in %/1024. Calibration: 0x88, 24
/// bytes; 0xA1, 1; 0xE1, 7. Raw: 0xF7, 8 bytes.
pub const BME280: Formula = Formula {
    calibration_bytes: 32,
    raw_bytes: 8,
    parameters_count: 0,
    outputs_count: 3,
    compute: bme280,
};

/// The fine temperature has 5120 units per degree; the parts measure -40 to 85 degC.
const FINE_MIN: i64 = -60 * 5120;
const FINE_MAX: i64 = 110 * 5120;
/// The raw value of a quantity that is switched off, in 20 and in 16 bits.
const SKIPPED: i64 = 0x80000;
const SKIPPED_HUMIDITY: i64 = 0x8000;
/// The raw value of an undriven line.
const ONES: i64 = 0xFFFFF;
/// 100 %, in the unit before the last division by 2^12.
const HUMIDITY_FULL: i64 = 419_430_400;

fn unsigned16(bytes: &[u8], place: usize) -> i64 {
    u16::from_le_bytes([at(bytes, place), at(bytes, place + 1)]).into()
}

fn signed16(bytes: &[u8], place: usize) -> i64 {
    i16::from_le_bytes([at(bytes, place), at(bytes, place + 1)]).into()
}

fn signed8(bytes: &[u8], place: usize) -> i64 {
    at(bytes, place).cast_signed().into()
}

/// 20 bits, most significant first, in the upper bits of three bytes.
fn raw20(bytes: &[u8], place: usize) -> i64 {
    let all = [0, at(bytes, place), at(bytes, place + 1), at(bytes, place + 2)];
    i64::from(u32::from_be_bytes(all) >> 4)
}

/// The fine temperature; `None` if it is far out of range.
fn fine_temperature(calibration: &[u8], raw: &[u8]) -> Option<i64> {
    let t1 = unsigned16(calibration, 0);
    let (t2, t3) = (signed16(calibration, 2), signed16(calibration, 4));
    let adc = raw20(raw, 3);
    let near = (adc >> 4) - t1;
    let fine = ((((adc >> 3) - 2 * t1) * t2) >> 11) + ((((near * near) >> 12) * t3) >> 14);
    let is_real = adc != SKIPPED && adc != ONES && (FINE_MIN..=FINE_MAX).contains(&fine);
    is_real.then_some(fine)
}

/// Pressure in Pa times 256; `None` if there is none.
fn pressure(calibration: &[u8], raw: &[u8], fine: i64) -> Option<i64> {
    let p1 = unsigned16(calibration, 6);
    let p = |number: usize| signed16(calibration, 4 + 2 * number);
    let adc = raw20(raw, 0);
    let from = fine - 128_000;
    let offset = from * from * p(6) + from * p(5) * 131_072 + p(4) * (1 << 35);
    let bend = (from * from * p(3)) >> 8;
    let slope = (1 << 47) + bend + from * p(2) * 4096;
    if adc == SKIPPED || slope <= 0 || slope >= 1 << 48 {
        return None;
    }
    let divisor = (slope.cast_unsigned().wrapping_mul(p1.cast_unsigned()) >> 33).cast_signed();
    let gross = (1_048_576 - adc) * (1 << 31) - offset;
    if gross <= 0 || gross > i64::MAX / 3125 {
        return None;
    }
    let gross = (gross * 3125).checked_div(divisor)?;
    if gross >= 1 << 35 {
        return None;
    }
    let high = gross >> 13;
    let gross = gross + ((p(9) * high * high) >> 25) + ((p(8) * gross) >> 19);
    let result = (gross >> 8) + p(7) * 16;
    (result > 0).then_some(result)
}

/// Relative humidity in percent times 1024.
fn humidity(calibration: &[u8], raw: &[u8], fine: i64) -> i64 {
    let adc = i64::from(u16::from_be_bytes([at(raw, 6), at(raw, 7)]));
    let (h1, h3) = (i64::from(at(calibration, 24)), i64::from(at(calibration, 27)));
    let h2 = signed16(calibration, 25);
    // Two 12-bit numbers share a byte.
    let shared = i64::from(at(calibration, 29));
    let h4 = signed8(calibration, 28) * 16 + (shared & 0xF);
    let h5 = signed8(calibration, 30) * 16 + (shared >> 4);
    let h6 = signed8(calibration, 31);
    let from = fine - 76_800;
    let level = (adc * 16_384 - h4 * 1_048_576 - h5 * from + 16_384) >> 15;
    let bend = ((((from * h6) >> 10) * (((from * h3) >> 11) + 32_768)) >> 10) + 2_097_152;
    let result = level * ((bend * h2 + 8192) >> 14);
    let high = result >> 15;
    // Far out of range; the square must not overflow.
    let high = if (-131_072..=131_072).contains(&high) { high } else { 0 };
    let result = result - ((((high * high) >> 7) * h1) >> 4);
    result.clamp(0, HUMIDITY_FULL) >> 12
}

fn bmp280(calibration: &[u8], _: &[i32], raw: &[u8]) -> Option<Outputs> {
    let fine = fine_temperature(calibration, raw)?;
    Some([(fine * 5 + 128) >> 8, pressure(calibration, raw, fine)?, 0])
}

fn bme280(calibration: &[u8], parameters: &[i32], raw: &[u8]) -> Option<Outputs> {
    let [temperature, pressure, _] = bmp280(calibration, parameters, raw)?;
    let fine = fine_temperature(calibration, raw)?;
    let is_skipped = i64::from(u16::from_be_bytes([at(raw, 6), at(raw, 7)])) == SKIPPED_HUMIDITY;
    (!is_skipped).then(|| [temperature, pressure, humidity(calibration, raw, fine)])
}
