//! The low-pass of integers, with 32 fractional bits, and its decay factor.

/// log2(e) - 1 and ln(2), times 2^32.
const LOG2E_REST: u64 = 1_901_360_723;
const LN2: u64 = 2_977_044_472;
/// exp(-23) is below 2^-32.
const DECAY_END: u32 = 23;

/// 2^-(2^-i) times 2^32, for i from 1.
const ROOTS: [u32; 16] = [
    0xB504_F334,
    0xD744_FCCB,
    0xEAC0_C6E8,
    0xF525_7D15,
    0xFA83_B2DB,
    0xFD3E_0C0D,
    0xFE9E_115C,
    0xFF4E_CB59,
    0xFFA7_5652,
    0xFFD3_A752,
    0xFFE9_D2B3,
    0xFFF4_E91C,
    0xFFFA_747F,
    0xFFFD_3A3B,
    0xFFFE_9D1D,
    0xFFFF_4E8E,
];

/// exp(-elapsed/constant) times 2^32, at most 2^32 - 1; 0 if the constant is 0. Within 6 of the
/// exact value.
#[must_use]
pub fn decay(elapsed_ms: u32, constant_ms: u32) -> u32 {
    let Some(whole) = elapsed_ms.checked_div(constant_ms).filter(|whole| *whole < DECAY_END) else {
        return 0;
    };
    let rest = elapsed_ms.wrapping_sub(whole.wrapping_mul(constant_ms));
    // exp(-x) is 2^-(x * log2(e)): halvings for the integer part, then a root for each bit of the
    // fraction.
    let mut exponent = (u64::from(rest) << 32).checked_div(constant_ms.into()).unwrap_or_default();
    exponent += (exponent * LOG2E_REST) >> 32;
    exponent += u64::from(whole) * ((1 << 32) + LOG2E_REST);
    let fraction = exponent as u32;
    let mut result = 1_u64 << 32;
    for (index, root) in ROOTS.iter().enumerate() {
        if fraction & (0x8000_0000 >> index) != 0 {
            result = (result * u64::from(*root) + 0x8000_0000) >> 32;
        }
    }
    result -= (result * ((u64::from(fraction & 0xFFFF) * LN2) >> 32)) >> 32;
    result = result.wrapping_shr((exponent >> 32) as u32);
    u32::try_from(result).unwrap_or(u32::MAX)
}

/// A 64-bit number with 32 more bits of fraction.
#[derive(Clone, Copy)]
struct Fixed {
    whole: u64,
    fraction: u32,
}

impl Fixed {
    fn times(self, decay: u32) -> Self {
        let decay = u64::from(decay);
        let low = (self.whole & 0xFFFF_FFFF) * decay;
        let fraction = (low & 0xFFFF_FFFF) + ((u64::from(self.fraction) * decay) >> 32);
        Self {
            whole: (self.whole >> 32) * decay + (low >> 32) + (fraction >> 32),
            fraction: fraction as u32,
        }
    }
}

/// The remaining distance to the input is rounded towards 0 from either side: there is no drift,
/// and the input is reached.
pub(super) fn smooth_key(state: &mut [u8; 16], decay: u32, key: u64) -> u64 {
    let [a, b, c, d, e, f, g, h, i, j, k, l, ..] = *state;
    let mut now = Fixed {
        whole: u64::from_le_bytes([a, b, c, d, e, f, g, h]),
        fraction: u32::from_le_bytes([i, j, k, l]),
    };
    if now.whole >= key {
        let distance = Fixed { whole: now.whole - key, fraction: now.fraction }.times(decay);
        now = Fixed { whole: key.wrapping_add(distance.whole), fraction: distance.fraction };
    } else {
        let below = u64::from(now.fraction > 0);
        let whole = key.wrapping_sub(now.whole).wrapping_sub(below);
        let distance = Fixed { whole, fraction: now.fraction.wrapping_neg() }.times(decay);
        let below = u64::from(distance.fraction > 0);
        now.whole = key.wrapping_sub(distance.whole).wrapping_sub(below);
        now.fraction = distance.fraction.wrapping_neg();
    }
    let [a, b, c, d, e, f, g, h] = now.whole.to_le_bytes();
    let [i, j, k, l] = now.fraction.to_le_bytes();
    *state = [a, b, c, d, e, f, g, h, i, j, k, l, 0, 0, 0, 0];
    now.whole.wrapping_add(u64::from(now.fraction >> 31))
}
