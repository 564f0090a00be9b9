//! Answers on one wire: the checksum of 1-Wire, and the burst of a DHT22 or DHT11.
//!
//! A system makes the slots and takes the times; nothing here waits.

use crate::outcome::Outcome;

/// Asks the only 1-Wire part of a wire for its address.
pub const READ_ROM: u8 = 0x33;
/// Calls the 1-Wire part whose address follows.
pub const MATCH_ROM: u8 = 0x55;
/// Calls the only 1-Wire part of a wire.
pub const SKIP_ROM: u8 = 0xCC;

/// The bytes of a burst.
pub const BURST_BYTES: usize = 5;
/// The falling edges of a burst: that of the answer, that before the first bit, and one after each bit.
pub const BURST_FALLS: usize = 2 + 8 * BURST_BYTES;

/// From one falling edge to the next, in microseconds: 50 low and 26 high are a zero, 50 low and 70
/// high are a one. An edge that is 14 late makes its own bit or the next one none of these.
const ZERO_LEAST_US: u32 = 62;
const ZERO_MOST_US: u32 = 91;
const ONE_LEAST_US: u32 = 105;
const ONE_MOST_US: u32 = 150;

/// Polynomial x^8 + x^5 + x^4 + 1, the lowest bit first, from 0.
fn crc(bytes: &[u8]) -> u8 {
    let mut crc = 0_u8;
    for byte in bytes {
        crc ^= byte;
        for _ in 0..8 {
            crc = if crc & 1 != 0 { crc >> 1 ^ 0x8C } else { crc >> 1 };
        }
    }
    crc
}

/// What the bytes of a 1-Wire part are, the last of which is their checksum: `Fresh`;
/// `NotAcknowledged` if the wire was left alone or held all the time; `WrongCrc`.
#[must_use]
pub fn check(bytes: &[u8]) -> Outcome {
    let are_all = |all: u8| bytes.iter().all(|byte| *byte == all);
    // The checksum of zeros is right.
    if are_all(0xFF) || are_all(0) {
        return Outcome::NotAcknowledged;
    }
    if crc(bytes) == 0 { Outcome::Fresh } else { Outcome::WrongCrc }
}

/// The bytes of a burst from the times of its falling edges, in microseconds from any moment; they may
/// wrap. `Fresh`; `NotAcknowledged` without any edge; `TimedOut` if there are not [`BURST_FALLS`];
/// `BusError` if a time is that of no bit, because an edge came or was seen late; `WrongCrc`.
pub fn burst(falls_us: &[u32], bytes: &mut [u8; BURST_BYTES]) -> Outcome {
    if falls_us.len() != BURST_FALLS {
        let is_silent = falls_us.is_empty();
        return if is_silent { Outcome::NotAcknowledged } else { Outcome::TimedOut };
    }
    let falls = falls_us.iter().skip(1).zip(falls_us.iter().skip(2));
    let mut bits = falls.map(|(from, to)| to.wrapping_sub(*from));
    for byte in bytes.iter_mut() {
        *byte = 0;
        for _ in 0..8 {
            let bit = match bits.next() {
                Some(ONE_LEAST_US..=ONE_MOST_US) => 1,
                Some(ZERO_LEAST_US..=ZERO_MOST_US) => 0,
                Some(_) | None => return Outcome::BusError,
            };
            *byte = *byte << 1 | bit;
        }
    }
    let [a, b, c, d, sum] = *bytes;
    let is_right = a.wrapping_add(b).wrapping_add(c).wrapping_add(d) == sum;
    if is_right { Outcome::Fresh } else { Outcome::WrongCrc }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edges of a burst whose bits last so long.
    fn falls(bytes: [u8; 5], us_of: impl Fn(usize, bool) -> u32) -> [u32; BURST_FALLS] {
        // Times wrap in the middle of it.
        let mut at_us = 0_u32.wrapping_sub(2_000);
        let mut falls = [0; BURST_FALLS];
        falls[0] = at_us;
        at_us = at_us.wrapping_add(160);
        falls[1] = at_us;
        for bit in 0..40 {
            let is_one = bytes[bit / 8] << (bit % 8) & 0x80 != 0;
            at_us = at_us.wrapping_add(us_of(bit, is_one));
            falls[bit + 2] = at_us;
        }
        falls
    }

    fn usual(_: usize, is_one: bool) -> u32 {
        if is_one { 120 } else { 76 }
    }

    /// The example of the AM2302's data sheet: 65.2 % and -10.1 degrees.
    const SHEET: [u8; 5] = [0x02, 0x8C, 0x80, 0x65, 0x73];

    #[test]
    fn the_burst_of_a_data_sheet_is_read() {
        let mut bytes = [0; 5];
        assert_eq!(burst(&falls(SHEET, usual), &mut bytes), Outcome::Fresh);
        assert_eq!(bytes, SHEET);
    }

    #[test]
    fn an_edge_that_is_late_is_never_another_bit() {
        for late_us in 0..200 {
            for bit in 0..39 {
                let shifted = |at: usize, is_one: bool| {
                    let us = usual(at, is_one);
                    if at == bit {
                        us + late_us
                    } else if at == bit + 1 {
                        us.saturating_sub(late_us)
                    } else {
                        us
                    }
                };
                let mut bytes = [0; 5];
                let outcome = burst(&falls(SHEET, shifted), &mut bytes);
                assert!(
                    outcome != Outcome::Fresh || bytes == SHEET,
                    "{late_us} us at bit {bit}: {bytes:x?}"
                );
                assert!(late_us > 13 || outcome == Outcome::Fresh, "{late_us} us at bit {bit}");
            }
        }
    }

    #[test]
    fn what_is_not_a_whole_burst_is_refused() {
        let (all, mut bytes) = (falls(SHEET, usual), [0; 5]);
        assert_eq!(burst(&[], &mut bytes), Outcome::NotAcknowledged);
        assert_eq!(burst(&all[..41], &mut bytes), Outcome::TimedOut);
        let wrong = falls([0x02, 0x8C, 0x80, 0x65, 0x74], usual);
        assert_eq!(burst(&wrong, &mut bytes), Outcome::WrongCrc);
    }

    #[test]
    fn a_scratchpad_is_checked() {
        // The state of a DS18B20 after its supply came: 85 degrees.
        let mut pad = [0x50, 0x05, 0x4B, 0x46, 0x7F, 0xFF, 0x0C, 0x10, 0x1C];
        assert_eq!(check(&pad), Outcome::Fresh);
        pad[0] ^= 1;
        assert_eq!(check(&pad), Outcome::WrongCrc);
        assert_eq!(check(&[0xFF; 9]), Outcome::NotAcknowledged);
        assert_eq!(check(&[0; 9]), Outcome::NotAcknowledged);
    }
}
