//! The place of a value in a frame: `byte`, or `bit` and `bits` with the numbering of DBC files.

use sensedsl_diagnostics::codes::e0239_outside_frame;
use sensedsl_wire::{ScalarType, ValueType};

use crate::fields::Fields;
use crate::kind::i2c::ByteOrder;

/// Bytes in a frame.
pub const FRAME_BYTES: u8 = 8;
/// Bits in a frame.
const FRAME_BITS: u8 = 64;

/// The bits of a value in a word of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitField {
    /// Bytes of the word, 1 to 8.
    pub word_bytes: u8,
    /// The lowest of the value's bits.
    pub low: u8,
    /// The number of bits.
    pub bits: u8,
}

/// The first byte of the value, and its bits in the word there.
pub(super) fn read(
    fields: &mut Fields<'_>,
    order: ByteOrder,
    value: ValueType,
) -> (u8, Option<BitField>) {
    let byte = fields.integer("byte", 0..=63).and_then(|n| u8::try_from(n.value).ok());
    let Some(bit) = fields.integer("bit", 0..=i64::from(FRAME_BITS) - 1) else {
        return (byte.unwrap_or(0), None);
    };
    if byte.is_some() {
        let message = "`bit` says where the value begins, and so does `byte`";
        fields.contradiction(bit.span, "byte", message);
    }
    if value.length.is_some() {
        let message = "an array begins at a `byte`: its elements stand one behind the other";
        fields.contradiction(bit.span, "bit", message);
        return (0, None);
    }
    let bits = fields.integer("bits", 1..=i64::from(FRAME_BITS));
    let bits = bits.and_then(|n| u8::try_from(n.value).ok()).unwrap_or_else(|| width(value.scalar));
    let bit = u8::try_from(bit.value).unwrap_or(0);
    let Some((byte, field)) = BitField::at(bit, bits, order) else {
        let end = u16::from(first_in_line(bit, order)) + u16::from(bits);
        let at = fields.value_span("bits").or_else(|| fields.value_span("bit"));
        let at = at.unwrap_or_else(|| fields.owner_span());
        let (name, ends) = (fields.owner().to_owned(), format!("{end} bits"));
        fields.say(e0239_outside_frame::outside_frame(at, &name, &ends, FRAME_BYTES));
        return (0, None);
    };
    (byte, Some(field))
}

/// The position of a bit in transmission order: low bits first, or high bits first.
const fn first_in_line(bit: u8, order: ByteOrder) -> u8 {
    match order {
        ByteOrder::Little => bit,
        ByteOrder::Big => bit / 8 * 8 + (7 - bit % 8),
    }
}

/// Bits of a number; 1 for a truth value.
fn width(scalar: ScalarType) -> u8 {
    if scalar == ScalarType::Bool {
        return 1;
    }
    u8::try_from(8 * scalar.size_bytes()).unwrap_or(FRAME_BITS)
}

impl BitField {
    /// The first byte of `bits` bits from `bit` on, and their place in the word that begins there;
    /// none if they are not all in the frame.
    #[must_use]
    pub fn at(bit: u8, bits: u8, order: ByteOrder) -> Option<(u8, Self)> {
        let first = first_in_line(bit, order);
        let end = first.checked_add(bits).filter(|end| *end <= FRAME_BITS && bits > 0)?;
        let (byte, behind) = (first / 8, end.div_ceil(8));
        let low = match order {
            ByteOrder::Little => first % 8,
            ByteOrder::Big => 8 * behind - end,
        };
        Some((byte, Self { word_bytes: behind - byte, low, bits }))
    }
}

#[cfg(test)]
mod tests {
    use super::{BitField, ByteOrder};

    fn at(bit: u8, bits: u8, order: ByteOrder) -> Option<(u8, u8, u8, u8)> {
        let (byte, field) = BitField::at(bit, bits, order)?;
        Some((byte, field.word_bytes, field.low, field.bits))
    }

    /// Worked out by hand from the picture in `docs/language.md`.
    #[test]
    fn bits_are_numbered_as_in_a_dbc_file() {
        assert_eq!(at(0, 16, ByteOrder::Little), Some((0, 2, 0, 16)));
        assert_eq!(at(12, 10, ByteOrder::Little), Some((1, 2, 4, 10)));
        assert_eq!(at(7, 16, ByteOrder::Big), Some((0, 2, 0, 16)));
        assert_eq!(at(3, 10, ByteOrder::Big), Some((0, 2, 2, 10)));
        assert_eq!(at(3, 12, ByteOrder::Big), Some((0, 2, 0, 12)));
        assert_eq!(at(1, 64, ByteOrder::Little), None);
        assert_eq!(at(7, 64, ByteOrder::Big), Some((0, 8, 0, 64)));
        assert_eq!(at(6, 64, ByteOrder::Big), None);
        assert_eq!(at(63, 1, ByteOrder::Little), Some((7, 1, 7, 1)));
        assert_eq!(at(56, 1, ByteOrder::Big), Some((7, 1, 0, 1)));
        assert_eq!(at(56, 2, ByteOrder::Big), None);
    }
}
