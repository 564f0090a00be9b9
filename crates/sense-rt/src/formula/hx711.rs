//! HX711 on SPI: the data line of the port is the part's clock, so each of its bits is read twice.

use super::{Formula, Outputs};

/// HX711, channel A, gain 128. Output: 0 the conversion, 24 bits with sign. Raw: 8 bytes that come
/// back while 00, six times AA and 80 are sent. Each pair of bits is one clock: the second one is
/// read while the clock is low, when the part's bit is stable. Not a measurement: the part was not
/// ready before the first clock (its output was high), or its output is not high after the last one.
pub const HX711: Formula =
    Formula { calibration_bytes: 0, raw_bytes: 8, parameters_count: 0, outputs_count: 1, compute };

/// The last byte: the output goes high with the 25th clock, of which the first bit is the rising edge.
const LAST: u8 = 0x7F;

fn compute(_: &[u8], _: &[i32], raw: &[u8]) -> Option<Outputs> {
    let [0, data @ .., last] = raw else { return None };
    if last & LAST != LAST {
        return None;
    }
    let bits = data.iter().flat_map(|byte| [6, 4, 2, 0].map(|place| (byte >> place) & 1));
    let code = bits.fold(0_u32, |code, bit| (code << 1) | u32::from(bit));
    // The sign is in bit 23.
    let signed = (code << 8).cast_signed() >> 8;
    Some([signed.into(), 0, 0])
}
