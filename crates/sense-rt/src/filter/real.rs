//! The steps of a filter in floating point.

use crate::scalar::Scalar;

/// Arithmetic in double precision, for items of float64: only their tables refer to it, so that
/// other boards do not link it.
#[derive(Clone, Copy, Debug)]
pub struct Wide {
    pub(super) smooth: fn(&mut [u8; 16], u32, &mut [u8]),
    pub(super) is_far: fn(u64, u64, u64) -> bool,
}

/// The only instance.
pub const WIDE: Wide = Wide { smooth: smooth_wide, is_far: is_far_wide };

/// The smoothed value so far, and its rounding error, without which small steps would be lost.
fn load(state: [u8; 16]) -> (u64, u64) {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = state;
    let both = [[a, b, c, d, e, f, g, h], [i, j, k, l, m, n, o, p]];
    let [old, rest] = both.map(u64::from_le_bytes);
    (old, rest)
}

fn store(state: &mut [u8; 16], old: u64, rest: u64) {
    let [a, b, c, d, e, f, g, h] = old.to_le_bytes();
    let [i, j, k, l, m, n, o, p] = rest.to_le_bytes();
    *state = [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p];
}

pub(super) fn smooth(state: &mut [u8; 16], decay: u32, element: &mut [u8]) {
    let bits = Scalar::Float32.load(element);
    let (old_bits, rest_bits) = load(*state);
    let single = |bits: u64| f32::from_bits(bits as u32);
    let (value, old, rest) = (single(bits), single(old_bits), single(rest_bits));
    if !value.is_finite() || !old.is_finite() || decay == 0 {
        store(state, bits, 0);
        return;
    }
    let gain = decay.wrapping_neg() as f32 / 4_294_967_296.0;
    let step = rest + (value - old - rest) * gain;
    let sum = old + step;
    store(state, sum.to_bits().into(), (step - (sum - old)).to_bits().into());
    Scalar::Float32.store(sum.to_bits().into(), element);
}

/// NaN is far from all other numbers.
pub(super) fn is_far(from: u64, to: u64, distance: u64) -> bool {
    let single = |bits: u64| f32::from_bits(bits as u32);
    let (difference, distance) = (single(from) - single(to), single(distance));
    !(difference < distance && difference > -distance)
}

fn smooth_wide(state: &mut [u8; 16], decay: u32, element: &mut [u8]) {
    let bits = Scalar::Float64.load(element);
    let (old_bits, rest_bits) = load(*state);
    let (value, old, rest) =
        (f64::from_bits(bits), f64::from_bits(old_bits), f64::from_bits(rest_bits));
    if !value.is_finite() || !old.is_finite() || decay == 0 {
        store(state, bits, 0);
        return;
    }
    let gain = 1.0 - f64::from(decay) / 4_294_967_296.0;
    let step = rest + (value - old - rest) * gain;
    let sum = old + step;
    store(state, sum.to_bits(), (step - (sum - old)).to_bits());
    Scalar::Float64.store(sum.to_bits(), element);
}

fn is_far_wide(from: u64, to: u64, distance: u64) -> bool {
    let difference = f64::from_bits(from) - f64::from_bits(to);
    let distance = f64::from_bits(distance);
    !(difference < distance && difference > -distance)
}
