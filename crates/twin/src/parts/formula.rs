//! Conversion of physical quantities to the register contents of a part that needs a formula.
//!
//! The formulas are those that the data sheets give for floating point. The board computes with integers, so the two
//! share nothing. The board's result is close to the wanted quantity, and [`step`] tells how close.

use sensedsl_host::halved;
use sensedsl_model::protocol::{Formula, Output};

use crate::arith::{ln, number};

/// The calibration of a BME280 or BMP280 on this bench: that of the BMP280 data sheet, with humidity constants that
/// most parts have. The order is that of the registers: from 0x88 on, then 0xA1, then from 0xE1 on.
const CALIBRATION: [u8; 32] = [
    0x70, 0x6B, 0x43, 0x67, 0x18, 0xFC, 0x7D, 0x8E, 0x43, 0xD6, 0xD0, 0x0B, 0x27, 0x0B, 0x8C, 0x00,
    0xF9, 0xFF, 0x8C, 0x3C, 0xF8, 0xC6, 0x70, 0x17, 0x4B, 0x6B, 0x01, 0x00, 0x13, 0x2D, 0x03, 0x1E,
];
/// The calibration as numbers.
const T: [f64; 3] = [27_504.0, 26_435.0, -1_000.0];
const P: [f64; 9] =
    [36_477.0, -10_685.0, 3_024.0, 2_855.0, 140.0, -7.0, 15_500.0, -14_600.0, 6_000.0];
const H: [f64; 6] = [75.0, 363.0, 0.0, 317.0, 50.0, 30.0];

/// Values for outputs that are not among the devices of a part: 20 degrees, 1013.25 hPa, 50 % relative humidity.
const USUAL_AIR: [f64; 3] = [2_000.0, 101_325.0 * 256.0, 50.0 * 1_024.0];

/// The reading of the board's converter at full scale.
const FULL: f64 = 4_095.0;
const KELVIN: f64 = 273.15;
const T25: f64 = 298.15;

/// The counts of channel 1 of a TSL2561 for each count of channel 0: about the share of infrared in daylight.
const INFRARED: f64 = 0.2;
/// The formula's piece for that ratio: the weights of channels 0 and 1, in 2^-14 lux.
const TSL_B: f64 = 532.0;
const TSL_M: f64 = 721.0;

/// The least and the greatest number that a formula gives.
pub(crate) fn range(output: Output) -> (f64, f64) {
    match (output.of, output.number) {
        (Formula::Ntc, _) => (-4_000.0, 12_500.0),
        (Formula::Tsl2561, _) => (0.0, 20_000_000.0),
        (Formula::Hx711, _) => (-8_388_608.0, 8_388_607.0),
        (Formula::Bmp280 | Formula::Bme280, 0) => (-4_000.0, 8_500.0),
        (Formula::Bmp280 | Formula::Bme280, 1) => (30_000.0 * 256.0, 110_000.0 * 256.0),
        (Formula::Bmp280 | Formula::Bme280, _) => (0.0, 100.0 * 1_024.0),
    }
}

/// The numbers that a formula gives in a room.
pub(crate) fn likely(output: Output) -> (f64, f64) {
    match (output.of, output.number) {
        (Formula::Ntc, _) | (Formula::Bmp280 | Formula::Bme280, 0) => (1_500.0, 3_000.0),
        (Formula::Tsl2561, _) => (50_000.0, 500_000.0),
        (Formula::Hx711, _) => (-100_000.0, 1_000_000.0),
        (Formula::Bmp280 | Formula::Bme280, 1) => (98_000.0 * 256.0, 103_000.0 * 256.0),
        (Formula::Bmp280 | Formula::Bme280, _) => (30.0 * 1_024.0, 70.0 * 1_024.0),
    }
}

/// The bytes of the calibration registers, in the order in which they are read.
pub(crate) fn calibration(formula: Formula) -> &'static [u8] {
    match formula {
        Formula::Bme280 => &CALIBRATION,
        Formula::Bmp280 => CALIBRATION.get(..24).unwrap_or_default(),
        Formula::Ntc | Formula::Tsl2561 | Formula::Hx711 => &[],
    }
}

/// The raw bytes from which the board computes these outputs; an output that is not given has its usual value.
pub(crate) fn raw(formula: Formula, parameters: &[i32], wanted: [Option<f64>; 3]) -> Vec<u8> {
    let [first, second, third] = wanted;
    match formula {
        Formula::Bmp280 | Formula::Bme280 => {
            let [temperature, pressure, humidity] = USUAL_AIR;
            let t = temperature_raw(first.unwrap_or(temperature));
            let fine = fine(f64::from(t));
            let p = pressure_raw(second.unwrap_or(pressure), fine);
            let mut bytes = [word20(p), word20(t)].concat();
            if formula == Formula::Bme280 {
                let h = humidity_raw(third.unwrap_or(humidity), fine);
                bytes.extend(h.to_be_bytes().get(2..).unwrap_or_default());
            }
            bytes
        }
        Formula::Ntc => {
            let level = thermistor_level(parameters, first.unwrap_or(2_500.0));
            level.to_be_bytes().to_vec()
        }
        Formula::Tsl2561 => {
            let channel0 = light_counts(parameters, first.unwrap_or(0.0));
            let channel1 = whole(channel0 * INFRARED, 65_534.0);
            let channel0 = whole(channel0, 65_534.0);
            [low16(channel0), low16(channel1)].concat()
        }
        Formula::Hx711 => load_cell(first.unwrap_or(0.0)),
    }
}

/// By how much an output near a value changes from one raw number to the next: the error that the board may have.
pub(crate) fn step(output: Output, parameters: &[i32], near: f64) -> f64 {
    match (output.of, output.number) {
        (Formula::Bmp280 | Formula::Bme280, 0) => {
            let raw = f64::from(temperature_raw(near));
            (temperature(fine(raw + 1.0)) - temperature(fine(raw))).abs()
        }
        (Formula::Bmp280 | Formula::Bme280, 1) => {
            let fine = fine(f64::from(temperature_raw(2_000.0)));
            let raw = f64::from(pressure_raw(near, fine));
            // The fine temperature that the pressure is computed with is rounded as well.
            2.0 * (pressure(raw + 1.0, fine) - pressure(raw, fine)).abs() + 64.0
        }
        (Formula::Bmp280 | Formula::Bme280, _) => {
            let fine = fine(f64::from(temperature_raw(2_000.0)));
            let raw = f64::from(humidity_raw(near, fine));
            (humidity(raw + 1.0, fine) - humidity(raw, fine)).abs() + 4.0
        }
        (Formula::Ntc, _) => {
            let level = f64::from(thermistor_level(parameters, near)).clamp(2.0, FULL - 2.0);
            let [above, below] = [level + 1.0, level - 1.0].map(|at| thermistor(parameters, at));
            (above - below).abs()
        }
        (Formula::Hx711, _) => 1.0,
        // A count of either channel; the constants have nine bits.
        (Formula::Tsl2561, _) => {
            near.abs() * 0.004 + 2.0 * 1_000.0 * TSL_M / 16_384.0 * gain(parameters)
        }
    }
}

/// What an HX711 that is ready answers: low, each bit of the number twice, and high after the last clock.
fn load_cell(wanted: f64) -> Vec<u8> {
    #[expect(clippy::cast_possible_truncation, reason = "it is in the range of 24 bits")]
    let number = wanted.round().clamp(-8_388_608.0, 8_388_607.0) as i32;
    let doubled = |byte: u8| {
        (0..8).rev().fold(0_u16, |all, place| (all << 2) | (u16::from(byte >> place & 1) * 0b11))
    };
    let [_, bytes @ ..] = number.to_be_bytes();
    let clocked = bytes.map(|byte| doubled(byte).to_be_bytes()).concat();
    [vec![0], clocked, vec![0xFF]].concat()
}

fn fine(raw: f64) -> f64 {
    let [t1, t2, t3] = T;
    let near = raw / 131_072.0 - t1 / 8_192.0;
    (raw / 16_384.0 - t1 / 1_024.0) * t2 + near * near * t3
}

/// The temperature in hundredths of a degree.
fn temperature(fine: f64) -> f64 {
    fine / 51.2
}

fn temperature_raw(wanted: f64) -> u32 {
    least_raw(|raw| temperature(fine(raw)) < wanted)
}

/// The pressure in 1/256 Pa.
fn pressure(raw: f64, fine: f64) -> f64 {
    let [p1, p2, p3, p4, p5, p6, p7, p8, p9] = P;
    let from = fine / 2.0 - 64_000.0;
    let offset = (from * from * p6 / 32_768.0 + from * p5 * 2.0) / 4.0 + p4 * 65_536.0;
    let slope = (1.0 + (p3 * from * from / 524_288.0 + p2 * from) / 524_288.0 / 32_768.0) * p1;
    let gross = (1_048_576.0 - raw - offset / 4_096.0) * 6_250.0 / slope;
    let bend = p9 * gross * gross / 2_147_483_648.0 + gross * p8 / 32_768.0 + p7;
    (gross + bend / 16.0) * 256.0
}

fn pressure_raw(wanted: f64, fine: f64) -> u32 {
    least_raw(|raw| pressure(raw, fine) > wanted)
}

/// The relative humidity in 1/1024 per cent.
fn humidity(raw: f64, fine: f64) -> f64 {
    let [h1, h2, h3, h4, h5, h6] = H;
    let from = fine - 76_800.0;
    let bend = 1.0 + h6 / 67_108_864.0 * from * (1.0 + h3 / 67_108_864.0 * from);
    let level = (raw - (h4 * 64.0 + h5 / 16_384.0 * from)) * (h2 / 65_536.0 * bend);
    (level * (1.0 - h1 * level / 524_288.0)).clamp(0.0, 100.0) * 1_024.0
}

fn humidity_raw(wanted: f64, fine: f64) -> u32 {
    least_raw(|raw| humidity(raw, fine) < wanted).min(0xFFFF)
}

/// The least 20-bit raw number for which the condition does not hold.
fn least_raw(is_before: impl Fn(f64) -> bool) -> u32 {
    let (mut from, mut to) = (1_u32, 0xF_FFFE_u32);
    while from < to {
        let middle = from + (to - from) / 2;
        if is_before(f64::from(middle)) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    // This raw number stands for a skipped conversion.
    if from == 0x8_0000 { from + 1 } else { from }
}

/// A 20-bit number in the upper bits of three bytes.
fn word20(raw: u32) -> Vec<u8> {
    (raw << 4).to_be_bytes().get(1..).unwrap_or_default().to_vec()
}

fn low16(number: u16) -> Vec<u8> {
    number.to_le_bytes().to_vec()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is in the range")]
fn whole(real: f64, most: f64) -> u16 {
    real.round().clamp(0.0, most.min(65_535.0)) as u16
}

/// The temperature, in hundredths of a degree, for a reading of the converter.
fn thermistor(parameters: &[i32], level: f64) -> f64 {
    let [beta, r25, series] = three(parameters);
    let ratio = series * level / (r25 * (FULL - level));
    (1.0 / (1.0 / T25 + ln(ratio) / beta) - KELVIN) * 100.0
}

/// The reading for a temperature: the warmer, the lower.
fn thermistor_level(parameters: &[i32], wanted: f64) -> u16 {
    let level = halved(1.0, FULL - 1.0, |level| thermistor(parameters, level) > wanted);
    whole(level, FULL - 1.0)
}

fn three(parameters: &[i32]) -> [f64; 3] {
    let mut all = parameters.iter().map(|one| f64::from((*one).max(1)));
    [all.next(), all.next(), all.next()].map(|one| one.unwrap_or(1.0))
}

/// The weight of a TSL2561 count, relative to 402 ms and a gain of 16.
fn gain(parameters: &[i32]) -> f64 {
    let time: f64 = match parameters.first() {
        Some(13) => number(0x7517) / 1_024.0,
        Some(101) => number(0x0FE7) / 1_024.0,
        _ => 1.0,
    };
    if parameters.get(1) == Some(&1) { time * 16.0 } else { time }
}

/// The counts of channel 0 for an illuminance in millilux.
fn light_counts(parameters: &[i32], millilux: f64) -> f64 {
    let each = (TSL_B - TSL_M * INFRARED) / 16_384.0 * 1_000.0 * gain(parameters);
    let end = match parameters.first() {
        Some(13) => 5_046.0,
        Some(101) => 37_176.0,
        _ => 65_534.0,
    };
    (millilux / each).clamp(0.0, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_data_sheets_example_leads_to_its_raw_numbers() {
        // BMP280: 519888 and 415148 are 25.08 degrees and 100653.27 Pa.
        let fine = fine(519_888.0);
        assert!((temperature(fine) - 2_508.2).abs() < 0.1);
        assert!((pressure(415_148.0, fine) / 256.0 - 100_653.27).abs() < 0.1);
        let bytes = raw(Formula::Bmp280, &[], [Some(2_508.247), Some(100_653.27 * 256.0), None]);
        let at = |from: usize| {
            u32::from_be_bytes([0, bytes[from], bytes[from + 1], bytes[from + 2]]) >> 4
        };
        assert!(at(3).abs_diff(519_888) <= 1, "{}", at(3));
        assert!(at(0).abs_diff(415_148) <= 8, "{}", at(0));
        assert!((humidity(30_000.0, fine) / 1_024.0 - 53.7).abs() < 0.05);
    }

    #[test]
    fn the_calibration_is_what_the_formulas_compute_with() {
        let word = |at: usize| i16::from_le_bytes([CALIBRATION[at], CALIBRATION[at + 1]]);
        assert_eq!(f64::from(word(0)), T[0]);
        assert_eq!((f64::from(word(2)), f64::from(word(4))), (T[1], T[2]));
        assert_eq!(f64::from(u16::from_le_bytes([CALIBRATION[6], CALIBRATION[7]])), P[0]);
        for (index, wanted) in P.iter().enumerate().skip(1) {
            assert_eq!(f64::from(word(6 + 2 * index)), *wanted);
        }
        assert_eq!(f64::from(CALIBRATION[24]), H[0]);
        assert_eq!(f64::from(word(25)), H[1]);
        assert_eq!(i32::from(CALIBRATION[28]) * 16 + i32::from(CALIBRATION[29] & 0xF), 317);
        assert_eq!(i32::from(CALIBRATION[30]) * 16 + i32::from(CALIBRATION[29] >> 4), 50);
    }

    #[test]
    fn a_thermistor_at_25_degrees_halves_the_supply() {
        let parameters = [3_950, 10_000, 10_000];
        assert!(thermistor_level(&parameters, 2_500.0).abs_diff(2_047) <= 1);
        for wanted in [-1_000.0, 0.0, 4_000.0, 8_000.0] {
            let level = f64::from(thermistor_level(&parameters, wanted));
            let off = (thermistor(&parameters, level) - wanted).abs();
            assert!(
                off <= step(Output { of: Formula::Ntc, number: 0 }, &parameters, wanted),
                "{wanted}: {off}"
            );
        }
    }
}
