//! TSL2561: the piecewise linear formula of the data sheet for the T, FN and CL packages, in
//! integers, but in millilux instead of rounded to lux.

use super::{Formula, Outputs};
use crate::bytes::at;
use crate::convert::divide;

/// TSL2561 in the T, FN and CL packages. Output: 0 illuminance in mlx. Parameters: integration time
/// in ms (13, 101 or 402), gain (1 or 16); none: 402 and 16. Raw: both channels from 0x8C, 4 bytes,
/// each least significant first; a saturated channel is not a measurement.
pub const TSL2561: Formula =
    Formula { calibration_bytes: 0, raw_bytes: 4, parameters_count: 2, outputs_count: 1, compute };

/// The integration time and gain that the constants are for.
const NOMINAL_MS: i32 = 402;
const NOMINAL_GAIN: i32 = 16;

/// Up to each ratio of channel 1 to channel 0 (times 2^9), lux = (b * channel 0 - m * channel 1) /
/// 2^14. Columns: ratio, b, m.
const PIECES: [(u64, i64, i64); 7] = [
    (0x0040, 0x01F2, 0x01BE),
    (0x0080, 0x0214, 0x02D1),
    (0x00C0, 0x023F, 0x037B),
    (0x0100, 0x0270, 0x03FE),
    (0x0138, 0x016F, 0x01FC),
    (0x019A, 0x00D2, 0x00FB),
    (0x029A, 0x0018, 0x0012),
];

/// An integration time in ms, its factor to counts at 402 ms times 2^10, and the count at which it
/// saturates.
const TIMINGS: [(i32, u64, u16); 3] =
    [(13, 0x7517, 5047), (101, 0x0FE7, 37_177), (402, 0x0400, 65_535)];

fn millilux(channel0: u64, channel1: u64) -> i64 {
    let ratio = match channel0 {
        0 => 0,
        _ => (divide(channel1 << 10, channel0).0 + 1) >> 1,
    };
    let piece = PIECES.iter().find(|(up_to, ..)| ratio <= *up_to);
    let sum = piece.map_or(0, |(_, b, m)| channel0.cast_signed() * b - channel1.cast_signed() * m);
    if sum <= 0 { 0 } else { (sum * 1000 + 8192) >> 14 }
}

fn compute(_: &[u8], parameters: &[i32], raw: &[u8]) -> Option<Outputs> {
    let (time_ms, gain) = match *parameters {
        [time_ms, gain, ..] => (time_ms, gain),
        _ => (NOMINAL_MS, NOMINAL_GAIN),
    };
    let channel0 = u16::from_le_bytes([at(raw, 0), at(raw, 1)]);
    let channel1 = u16::from_le_bytes([at(raw, 2), at(raw, 3)]);
    let (_, scale, end) = TIMINGS.iter().find(|(time, ..)| *time == time_ms)?;
    let factor = match gain {
        1 => 16,
        NOMINAL_GAIN => 1,
        _ => return None,
    };
    if channel0 >= *end || channel1 >= *end {
        return None;
    }
    let scaled = |channel: u16| (u64::from(channel) * scale * factor) >> 10;
    Some([millilux(scaled(channel0), scaled(channel1)), 0, 0])
}
