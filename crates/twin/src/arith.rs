//! Arithmetic that is the same to the last bit on every machine. A system's math library may round a sine or a
//! logarithm its own way, and a run must be repeatable to the byte.

/// A full turn of [`sine`].
pub(crate) const TURN: u64 = 1 << 32;

/// The sine of a phase, given as a fraction of a turn in units of 2^-32.
pub(crate) fn sine(phase: u64) -> f64 {
    let phase = phase % TURN;
    let quarter = TURN / 4;
    let (within, is_negative) = (phase % (TURN / 2), phase >= TURN / 2);
    let rising = if within > quarter { TURN / 2 - within } else { within };
    let x = number(rising) / number(quarter) * std::f64::consts::FRAC_PI_2;
    // The series up to x^15: the error at a right angle is below 1e-11.
    let square = x * x;
    let mut term = x;
    let mut sum = x;
    for step in 1..8_u32 {
        let below = f64::from(2 * step) * f64::from(2 * step + 1);
        term = -term * square / below;
        sum += term;
    }
    if is_negative { -sum } else { sum }
}

/// The natural logarithm of a number above 0.
pub(crate) fn ln(x: f64) -> f64 {
    let bits = x.to_bits();
    let exponent = (bits >> 52) & 0x7FF;
    let mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | (1023 << 52));
    // From sqrt(1/2) to sqrt(2), a few terms of the inverse hyperbolic tangent's series are enough.
    let (mantissa, exponent) = if mantissa > std::f64::consts::SQRT_2 {
        (mantissa / 2.0, exponent + 1)
    } else {
        (mantissa, exponent)
    };
    let ratio = (mantissa - 1.0) / (mantissa + 1.0);
    let square = ratio * ratio;
    let (mut term, mut sum) = (ratio, 0.0);
    for step in 0..20_u32 {
        sum += term / f64::from(2 * step + 1);
        term *= square;
    }
    2.0 * sum + (number(exponent) - 1023.0) * std::f64::consts::LN_2
}

/// The exponential of the negative of a number from 0 to 1.
pub(crate) fn decay(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for step in 1..20_u32 {
        term = -term * x / f64::from(step);
        sum += term;
    }
    sum
}

/// A pseudo-random number that depends only on the input (`SplitMix64`).
pub(crate) fn scrambled(mut state: u64) -> u64 {
    state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    state = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    state ^ (state >> 31)
}

/// A pseudo-random number from -1 to 1 that depends only on the input.
pub(crate) fn chance(state: u64) -> f64 {
    number(scrambled(state) >> 32) / number(TURN / 2) - 1.0
}

/// A whole number as a real one; exact up to 2^53, which in nanoseconds is 104 days.
#[expect(clippy::cast_precision_loss, reason = "what does not fit is rounded the same everywhere")]
pub(crate) const fn number(whole: u64) -> f64 {
    whole as f64
}

/// A whole number as a real one.
#[expect(clippy::cast_precision_loss, reason = "what does not fit is rounded the same everywhere")]
pub(crate) const fn signed_number(whole: i64) -> f64 {
    whole as f64
}

/// The nearest whole number. A value that does not fit saturates; a NaN is 0.
#[expect(clippy::cast_possible_truncation, reason = "it saturates")]
pub(crate) fn rounded(real: f64) -> i64 {
    real.round() as i64
}

/// A time in nanoseconds, rounded; 0 if it is negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it saturates, and nothing is before the start"
)]
pub(crate) fn nanoseconds(real: f64) -> u64 {
    real.round() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sine_is_a_sine() {
        for step in 0..1_000_u32 {
            let turn = f64::from(step) / 1_000.0;
            let phase = TURN * u64::from(step) / 1_000;
            let wanted = (turn * std::f64::consts::TAU).sin();
            assert!((sine(phase) - wanted).abs() < 1e-8, "{turn}");
        }
    }

    #[test]
    fn the_logarithm_is_a_logarithm() {
        for step in 1..2_000_u32 {
            let x = f64::from(step * step) / 777.0;
            assert!((ln(x) - x.ln()).abs() < 1e-12 * x.ln().abs().max(1.0), "{x}");
        }
    }

    #[test]
    fn chance_stays_within_its_bounds() {
        let all: Vec<f64> = (0..10_000).map(chance).collect();
        assert!(all.iter().all(|one| (-1.0..=1.0).contains(one)));
        let mean: f64 = all.iter().sum::<f64>() / 10_000.0;
        assert!(mean.abs() < 0.03, "{mean}");
    }
}
