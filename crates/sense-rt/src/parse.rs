//! Numbers in the text of a device, converted to the type of an item. Integers are rounded half
//! away from zero and saturate.
//!
//! Spaces around a number are ignored. Empty text gives `Nothing`; text that is not a number gives
//! `Invalid`. Neither stores anything.

use crate::convert::{divide, store_signed_ratio, store_unsigned};
use crate::outcome::Outcome;
use crate::scalar::Scalar;

const POWER_MAX: u32 = 19;
const MINUTES_DIGITS: u32 = 9;
/// 1e-9 minutes in 1e-7 degrees.
const NANOMINUTES: u64 = 6000;
const NANO: u64 = 1_000_000_000;

/// Field `index` of a text; `None` if there are fewer. With separator 0 the whole text is field 0.
#[must_use]
pub fn field(text: &[u8], separator: u8, index: usize) -> Option<&[u8]> {
    text.split(|byte| separator != 0 && *byte == separator).nth(index)
}

fn trimmed(mut text: &[u8]) -> &[u8] {
    while let [b' ', rest @ ..] | [rest @ .., b' '] = text {
        text = rest;
    }
    text
}

const fn power_of_ten(exponent: u32) -> u64 {
    10_u64.wrapping_pow(exponent)
}

/// Digits, a point, digits: the number is `digits / 10^places`.
struct Decimal {
    digits: u64,
    /// The number of digits after the point; further ones are cut off.
    places: u32,
    /// The number of digits before the point.
    whole_count: u32,
    is_too_large: bool,
}

impl Decimal {
    fn take(&mut self, digit: u64, is_behind: bool, places_max: u32) {
        let has_room = self.digits <= (u64::MAX - digit) / 10;
        if !is_behind {
            self.whole_count = self.whole_count.saturating_add(1);
            self.is_too_large |= !has_room;
        } else if !has_room || self.places >= places_max {
            return;
        } else {
            self.places += 1;
        }
        if has_room {
            self.digits = 10 * self.digits + digit;
        }
    }

    fn read(text: &[u8], places_max: u32) -> Option<Self> {
        let mut decimal = Self { digits: 0, places: 0, whole_count: 0, is_too_large: false };
        let (mut is_behind, mut has_digit) = (false, false);
        for byte in text {
            match byte {
                b'.' if !is_behind => is_behind = true,
                b'0'..=b'9' => {
                    decimal.take(u64::from(*byte - b'0'), is_behind, places_max);
                    has_digit = true;
                }
                _ => return None,
            }
        }
        has_digit.then_some(decimal)
    }
}

/// The number times `10^decimals` (0 to 18): sign, digits, a point, digits; also `.5` and `5.`.
/// Digits after the point count only if they are among the first 19 digits in all.
#[must_use]
pub fn parse_decimal(text: &[u8], decimals: u8, scalar: Scalar, element: &mut [u8]) -> Outcome {
    let text = trimmed(text);
    let (is_negative, digits) = match text {
        [] => return Outcome::Nothing,
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let decimals = u32::from(decimals);
    let Some(decimal) = Decimal::read(digits, POWER_MAX).filter(|_| decimals < POWER_MAX) else {
        return Outcome::Invalid;
    };
    let (number, power) = if decimal.is_too_large {
        (u64::MAX, 1)
    } else if decimal.places > decimals {
        (decimal.digits, power_of_ten(decimal.places - decimals))
    } else {
        (decimal.digits.saturating_mul(power_of_ten(decimals - decimal.places)), 1)
    };
    store_signed_ratio(scalar, is_negative, number, power, element);
    Outcome::Fresh
}

/// `[d]ddmm.mmmm` and its hemisphere, in 1e-7 degrees; minutes are below 60, latitude is at most 90
/// degrees, longitude at most 180.
#[must_use]
pub fn parse_degrees(
    text: &[u8],
    hemisphere: &[u8],
    scalar: Scalar,
    element: &mut [u8],
) -> Outcome {
    let text = trimmed(text);
    if text.is_empty() {
        return Outcome::Nothing;
    }
    let (degrees_max, is_negative) = match trimmed(hemisphere) {
        b"N" => (90, false),
        b"S" => (90, true),
        b"E" => (180, false),
        b"W" => (180, true),
        _ => return Outcome::Invalid,
    };
    let decimal = Decimal::read(text, MINUTES_DIGITS);
    let Some(decimal) = decimal.filter(|read| (3..=5).contains(&read.whole_count)) else {
        return Outcome::Invalid;
    };
    let (whole, rest) = divide(decimal.digits, power_of_ten(decimal.places));
    let minutes = whole % 100;
    let nano = rest.wrapping_mul(power_of_ten(MINUTES_DIGITS - decimal.places.min(MINUTES_DIGITS)));
    let angle = (whole / 100 * 60 + minutes).wrapping_mul(NANO).wrapping_add(nano);
    if minutes >= 60 || angle > degrees_max * 60 * NANO {
        return Outcome::Invalid;
    }
    store_signed_ratio(scalar, is_negative, angle, NANOMINUTES, element);
    Outcome::Fresh
}

/// Hexadecimal digits, upper or lower case.
#[must_use]
pub fn parse_hex(text: &[u8], scalar: Scalar, element: &mut [u8]) -> Outcome {
    let text = trimmed(text);
    if text.is_empty() {
        return Outcome::Nothing;
    }
    let mut number = 0_u64;
    for byte in text {
        let Some(digit) = char::from(*byte).to_digit(16) else { return Outcome::Invalid };
        number = if number > u64::MAX >> 4 { u64::MAX } else { number << 4 | u64::from(digit) };
    }
    store_unsigned(scalar, number, element);
    Outcome::Fresh
}
