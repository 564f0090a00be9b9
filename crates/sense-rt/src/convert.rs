//! From hardware measurements to the type of an item.
//!
//! Integers saturate instead of wrapping; bool is "not zero". Floating-point numbers are made with
//! integer arithmetic, so that no floating-point emulation is linked.

use crate::scalar::Scalar;
use crate::uses;

/// The greatest number of an integer type, and the magnitude of its least one.
const fn range(scalar: Scalar) -> (u64, u64) {
    match scalar {
        Scalar::Bool => (1, 0),
        Scalar::Uint8 => (u8::MAX as u64, 0),
        Scalar::Int8 => (i8::MAX as u64, i8::MIN.unsigned_abs() as u64),
        Scalar::Uint16 => (u16::MAX as u64, 0),
        Scalar::Int16 => (i16::MAX as u64, i16::MIN.unsigned_abs() as u64),
        Scalar::Uint32 => (u32::MAX as u64, 0),
        Scalar::Int32 => (i32::MAX as u64, i32::MIN.unsigned_abs() as u64),
        Scalar::Int64 => (i64::MAX as u64, i64::MIN.unsigned_abs()),
        Scalar::Uint64 | Scalar::Float32 | Scalar::Float64 => (u64::MAX, 0),
    }
}

/// The bits of `mantissa` times two to the `exponent`; `is_more`: the exact number is a little
/// greater. Rounded to nearest, ties to even, as hardware would.
fn real_bits(
    scalar: Scalar,
    is_negative: bool,
    mantissa: u64,
    exponent: i32,
    is_more: bool,
) -> u64 {
    let is_wide = scalar == Scalar::Float64;
    let fraction_bits = if is_wide { 52 } else { 23 };
    let half = 1_u64 << (62 - fraction_bits);
    if mantissa == 0 {
        return 0;
    }
    let places = mantissa.leading_zeros();
    let mantissa = mantissa.wrapping_shl(places);
    let exponent = exponent.wrapping_sub(places.cast_signed());
    let rest = mantissa & (2 * half - 1);
    let mut bits = mantissa >> (63 - fraction_bits);
    if rest > half || (rest == half && (is_more || bits & 1 != 0)) {
        bits += 1;
    }
    // The leading 1 is not stored: it adds one to the exponent, and so does a carry out of the
    // fraction.
    let biased = exponent.wrapping_add(63 + if is_wide { 1022 } else { 126 });
    bits = bits.wrapping_add((i64::from(biased).cast_unsigned()) << fraction_bits);
    bits | if is_negative { scalar.sign() } else { 0 }
}

/// The bits of a number, given by its sign and magnitude.
fn number_bits(scalar: Scalar, is_negative: bool, magnitude: u64) -> u64 {
    if scalar.is_real() {
        return real_bits(scalar, is_negative, magnitude, 0, false);
    }
    let (greatest, below) = range(scalar);
    if is_negative && scalar != Scalar::Bool {
        magnitude.min(below).wrapping_neg()
    } else {
        magnitude.min(greatest)
    }
}

/// Stores a number as one element.
pub fn store_unsigned(scalar: Scalar, raw: u64, element: &mut [u8]) {
    scalar.store(number_bits(scalar, false, raw), element);
}

/// Stores a signed number as one element.
pub fn store_signed(scalar: Scalar, raw: i64, element: &mut [u8]) {
    scalar.store(number_bits(scalar, raw < 0, raw.unsigned_abs()), element);
}

/// Quotient and remainder; the quotient is 0 if the denominator is 0. Small numbers are divided by
/// the core. Larger ones are rare, so a short loop divides them: the function that the compiler
/// would link is long.
pub(crate) fn divide(numerator: u64, denominator: u64) -> (u64, u64) {
    let small = (u32::try_from(numerator).ok(), u32::try_from(denominator).ok());
    if let (Some(numerator), Some(denominator)) = small {
        let quotient = numerator.checked_div(denominator).unwrap_or_default();
        let rest = numerator.wrapping_sub(quotient.wrapping_mul(denominator));
        return (quotient.into(), rest.into());
    }
    if denominator == 0 {
        return (0, numerator);
    }
    // The quotient's bits replace the numerator's as those are shifted out.
    let (mut quotient, mut rest) = (numerator, 0_u64);
    for _ in 0..u64::BITS {
        let is_carried = rest >> 63 != 0;
        rest = rest << 1 | quotient >> 63;
        quotient <<= 1;
        if is_carried || rest >= denominator {
            rest = rest.wrapping_sub(denominator);
            quotient |= 1;
        }
    }
    (quotient, rest)
}

fn real_ratio_bits(scalar: Scalar, is_negative: bool, numerator: u64, denominator: u64) -> u64 {
    let (mut quotient, mut rest) = divide(numerator, denominator);
    let mut exponent = 0;
    // Digit by digit, until there are more than a double holds.
    while numerator != 0 && quotient < 1 << 55 {
        let is_carried = rest >> 63 != 0;
        rest <<= 1;
        quotient <<= 1;
        exponent -= 1;
        if is_carried || rest >= denominator {
            rest = rest.wrapping_sub(denominator);
            quotient += 1;
        }
    }
    real_bits(scalar, is_negative, quotient, exponent, rest != 0)
}

/// Stores `numerator / denominator` with a sign: integers rounded half away from zero,
/// floating-point numbers to nearest. A denominator of 0 stores 0.
pub fn store_signed_ratio(
    scalar: Scalar,
    is_negative: bool,
    numerator: u64,
    denominator: u64,
    element: &mut [u8],
) {
    if denominator == 0 {
        store_unsigned(scalar, 0, element);
    } else if scalar.is_real() {
        let bits = real_ratio_bits(scalar, is_negative, numerator, denominator);
        scalar.store(bits, element);
    } else {
        let (quotient, rest) = divide(numerator, denominator);
        let round_up = u64::from(rest >= denominator.wrapping_sub(rest));
        let bits = number_bits(scalar, is_negative, quotient.wrapping_add(round_up));
        scalar.store(bits, element);
    }
}

/// Stores `numerator / denominator`, rounded as [`store_signed_ratio`] does.
pub fn store_ratio(scalar: Scalar, numerator: u64, denominator: u64, element: &mut [u8]) {
    store_signed_ratio(scalar, false, numerator, denominator, element);
}

/// The magnitude of a floating-point number without its sign, rounded half away from zero.
fn round_real(bits: u64, fraction_bits: i32, bias: i32) -> u64 {
    let mantissa = bits & ((1 << fraction_bits) - 1);
    let whole = mantissa | 1 << fraction_bits;
    let biased = (bits >> fraction_bits) as i32;
    let shift = biased - bias - fraction_bits;
    if biased == 2 * bias + 1 {
        return if mantissa == 0 { u64::MAX } else { 0 };
    }
    if biased == 0 || shift < -fraction_bits - 1 {
        return 0;
    }
    if shift > 63 - fraction_bits {
        return u64::MAX;
    }
    if shift >= 0 {
        return whole.wrapping_shl(shift.unsigned_abs());
    }
    ((whole.wrapping_shr((-shift - 1).unsigned_abs())) + 1) >> 1
}

/// The magnitude of one element, rounded half away from zero, and whether it is negative. NaN is 0,
/// and a number that is too large is `u64::MAX`.
#[must_use]
pub fn load_magnitude(scalar: Scalar, element: &[u8]) -> (u64, bool) {
    let bits = scalar.load(element);
    let sign = scalar.sign();
    let is_negative = (scalar.is_real() || scalar.is_signed()) && bits & sign != 0;
    let magnitude = if uses::REALS && scalar == Scalar::Float32 {
        round_real(bits & !sign, 23, 127)
    } else if uses::REALS && scalar == Scalar::Float64 {
        round_real(bits & !sign, 52, 1023)
    } else if is_negative {
        scalar.extend(bits).unsigned_abs()
    } else {
        bits
    };
    (magnitude, is_negative)
}

/// Stores the mean of every `stride`th sample, which is one channel of a converter that samples
/// several in turn; at most 65536 samples.
pub fn store_mean(scalar: Scalar, samples: &[u16], stride: usize, element: &mut [u8]) {
    // The sum of that many samples and half their number is less than 2^32.
    const SAMPLES_MAX: usize = 0x1_0000;
    let (mut sum, mut count) = (0_u32, 0_u32);
    for sample in samples.iter().step_by(stride.max(1)).take(SAMPLES_MAX) {
        sum += u32::from(*sample);
        count += 1;
    }
    if scalar.is_real() {
        store_ratio(scalar, sum.into(), count.into(), element);
    } else {
        let mean = (sum + count / 2).checked_div(count).unwrap_or_default();
        store_unsigned(scalar, mean.into(), element);
    }
}

/// Microseconds as milliseconds, which wrap.
#[must_use]
pub const fn milliseconds(now_us: u64) -> u32 {
    // In two halves, so that no 64-bit division is linked for it.
    let high = (now_us >> 32) as u32;
    let low = now_us as u32;
    let upper = (high % 1000) << 16 | low >> 16;
    let lower = (upper % 1000) << 16 | low & 0xFFFF;
    ((upper / 1000) << 16).wrapping_add(lower / 1000)
}
