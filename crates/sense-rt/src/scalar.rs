//! The scalar types of the language, and their elements in network byte order.

use crate::uses;

/// A scalar type. Its number without the two lowest bits is the exponent of its size, which boards need for each item
/// of each report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// One byte, 0 or 1.
    Bool = 0,
    /// 8 bits, unsigned.
    Uint8 = 1,
    /// 8 bits, two's complement.
    Int8 = 2,
    /// 16 bits, unsigned.
    Uint16 = 4,
    /// 16 bits, two's complement.
    Int16 = 5,
    /// 32 bits, unsigned.
    Uint32 = 8,
    /// 32 bits, two's complement.
    Int32 = 9,
    /// 64 bits, unsigned.
    Uint64 = 12,
    /// 64 bits, two's complement.
    Int64 = 13,
    /// IEEE 754 binary32.
    Float32 = 10,
    /// IEEE 754 binary64.
    Float64 = 14,
}

impl Scalar {
    /// Bytes of one element.
    #[must_use]
    #[inline]
    pub const fn bytes(self) -> usize {
        1 << (self as u8 >> 2)
    }

    /// Whether it is a signed integer.
    #[must_use]
    pub const fn is_signed(self) -> bool {
        matches!(self, Self::Int8 | Self::Int16 | Self::Int32 | Self::Int64)
    }

    /// Whether it is a floating-point number.
    #[must_use]
    pub const fn is_real(self) -> bool {
        uses::REALS && matches!(self, Self::Float32 | Self::Float64)
    }

    /// The highest bit of an element.
    pub(crate) const fn sign(self) -> u64 {
        match self.bytes() {
            1 => 0x80,
            2 => 0x8000,
            4 => 0x8000_0000,
            _ => 0x8000_0000_0000_0000,
        }
    }

    /// The bits of the element at the start of `bytes`, as an unsigned number of its size; 0 if it
    /// is incomplete.
    #[must_use]
    pub fn load(self, bytes: &[u8]) -> u64 {
        match self.bytes() {
            1 => bytes.first().copied().map_or(0, u64::from),
            2 => bytes.first_chunk().copied().map_or(0, |two| u64::from(u16::from_be_bytes(two))),
            4 => bytes.first_chunk().copied().map_or(0, |four| u64::from(u32::from_be_bytes(four))),
            _ => bytes.first_chunk().copied().map_or(0, u64::from_be_bytes),
        }
    }

    /// Writes the low bits as the element at the start of `bytes`; does nothing if it does not fit.
    pub fn store(self, bits: u64, bytes: &mut [u8]) {
        match self.bytes() {
            1 => {
                if let Some(byte) = bytes.first_mut() {
                    *byte = bits as u8;
                }
            }
            2 => {
                if let Some(two) = bytes.first_chunk_mut() {
                    *two = (bits as u16).to_be_bytes();
                }
            }
            4 => {
                if let Some(four) = bytes.first_chunk_mut() {
                    *four = (bits as u32).to_be_bytes();
                }
            }
            _ => {
                if let Some(eight) = bytes.first_chunk_mut() {
                    *eight = bits.to_be_bytes();
                }
            }
        }
    }

    /// The bits of the element at `index` of a value.
    #[must_use]
    pub fn load_at(self, value: &[u8], index: usize) -> u64 {
        self.load(value.get(index.wrapping_mul(self.bytes())..).unwrap_or_default())
    }

    /// Writes the element at `index` of a value.
    pub fn store_at(self, bits: u64, value: &mut [u8], index: usize) {
        self.store(bits, value.get_mut(index.wrapping_mul(self.bytes())..).unwrap_or_default());
    }

    /// The bits of an element, sign-extended if the type is signed.
    #[must_use]
    pub const fn extend(self, bits: u64) -> i64 {
        if self.is_signed() {
            (bits ^ self.sign()).wrapping_sub(self.sign()).cast_signed()
        } else {
            bits.cast_signed()
        }
    }
}
