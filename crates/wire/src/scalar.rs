//! Scalar and array types of the language and their bytes on the wire.

use alloc::vec::Vec;
use core::fmt;

/// Makes the type of a table of scalars, each with its name in the language.
macro_rules! scalars {
    ($($(#[$doc:meta])* $scalar:ident = $name:literal,)+) => {
        /// A scalar type of the language.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum ScalarType {
            $($(#[$doc])* $scalar,)+
        }

        impl ScalarType {
            /// All types, in the order of the language reference.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$scalar),+];

            /// The name in the language.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$scalar => $name,)+
                }
            }
        }
    };
}

scalars! {
    /// One byte, 0 or 1.
    Bool = "bool",
    /// 8 bits, unsigned.
    Uint8 = "uint8",
    /// 8 bits, two's complement.
    Int8 = "int8",
    /// 16 bits, unsigned.
    Uint16 = "uint16",
    /// 16 bits, two's complement.
    Int16 = "int16",
    /// 32 bits, unsigned.
    Uint32 = "uint32",
    /// 32 bits, two's complement.
    Int32 = "int32",
    /// 64 bits, unsigned.
    Uint64 = "uint64",
    /// 64 bits, two's complement.
    Int64 = "int64",
    /// IEEE-754 binary32.
    Float32 = "float32",
    /// IEEE-754 binary64.
    Float64 = "float64",
}

impl ScalarType {
    /// The type with that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scalar| scalar.name() == name)
    }

    /// Bytes of one value.
    #[must_use]
    pub const fn size_bytes(self) -> usize {
        match self {
            Self::Bool | Self::Uint8 | Self::Int8 => 1,
            Self::Uint16 | Self::Int16 => 2,
            Self::Uint32 | Self::Int32 | Self::Float32 => 4,
            Self::Uint64 | Self::Int64 | Self::Float64 => 8,
        }
    }

    /// Least and greatest value of an integer type (0 and 1 for bool); none for floats.
    #[must_use]
    pub const fn integer_range(self) -> Option<(i128, i128)> {
        match self {
            Self::Bool => Some((0, 1)),
            Self::Uint8 => Some((0, u8::MAX as i128)),
            Self::Int8 => Some((i8::MIN as i128, i8::MAX as i128)),
            Self::Uint16 => Some((0, u16::MAX as i128)),
            Self::Int16 => Some((i16::MIN as i128, i16::MAX as i128)),
            Self::Uint32 => Some((0, u32::MAX as i128)),
            Self::Int32 => Some((i32::MIN as i128, i32::MAX as i128)),
            Self::Uint64 => Some((0, u64::MAX as i128)),
            Self::Int64 => Some((i64::MIN as i128, i64::MAX as i128)),
            Self::Float32 | Self::Float64 => None,
        }
    }

    /// Reads one value from exactly [`Self::size_bytes`] bytes in network byte order.
    #[must_use]
    pub fn read(self, bytes: &[u8]) -> Option<Scalar> {
        Some(match self {
            Self::Bool => match bytes {
                [0] => Scalar::Bool(false),
                [1] => Scalar::Bool(true),
                _ => return None,
            },
            Self::Uint8 => Scalar::Unsigned(u8::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Int8 => Scalar::Signed(i8::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Uint16 => Scalar::Unsigned(u16::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Int16 => Scalar::Signed(i16::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Uint32 => Scalar::Unsigned(u32::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Int32 => Scalar::Signed(i32::from_be_bytes(bytes.try_into().ok()?).into()),
            Self::Uint64 => Scalar::Unsigned(u64::from_be_bytes(bytes.try_into().ok()?)),
            Self::Int64 => Scalar::Signed(i64::from_be_bytes(bytes.try_into().ok()?)),
            Self::Float32 => Scalar::Float32(f32::from_be_bytes(bytes.try_into().ok()?)),
            Self::Float64 => Scalar::Float64(f64::from_be_bytes(bytes.try_into().ok()?)),
        })
    }

    /// Appends `value` in network byte order. Returns false, and appends nothing, if the value does
    /// not have this type or is out of its range.
    #[must_use]
    pub fn write(self, value: Scalar, out: &mut Vec<u8>) -> bool {
        match (self, value) {
            (Self::Float32, Scalar::Float32(number)) => {
                out.extend_from_slice(&number.to_be_bytes());
            }
            (Self::Float64, Scalar::Float64(number)) => {
                out.extend_from_slice(&number.to_be_bytes());
            }
            (_, Scalar::Bool(_) | Scalar::Unsigned(_) | Scalar::Signed(_)) => {
                let (number, is_bool) = match value {
                    Scalar::Bool(flag) => (i128::from(flag), true),
                    Scalar::Unsigned(number) => (i128::from(number), false),
                    Scalar::Signed(number) => (i128::from(number), false),
                    Scalar::Float32(_) | Scalar::Float64(_) => return false,
                };
                let Some((least, most)) = self.integer_range() else { return false };
                if number < least || number > most || is_bool != (self == Self::Bool) {
                    return false;
                }
                let bytes = number.to_be_bytes();
                let Some(tail) = bytes.get(bytes.len() - self.size_bytes()..) else { return false };
                out.extend_from_slice(tail);
            }
            (_, Scalar::Float32(_) | Scalar::Float64(_)) => return false,
        }
        true
    }
}

impl fmt::Display for ScalarType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A decoded scalar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// A `bool`.
    Bool(bool),
    /// A `uint8` to `uint64`.
    Unsigned(u64),
    /// An `int8` to `int64`.
    Signed(i64),
    /// A `float32`.
    Float32(f32),
    /// A `float64`.
    Float64(f64),
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(value) => write!(f, "{value}"),
            Self::Unsigned(value) => write!(f, "{value}"),
            Self::Signed(value) => write!(f, "{value}"),
            Self::Float32(value) => write!(f, "{value}"),
            Self::Float64(value) => write!(f, "{value}"),
        }
    }
}

/// The type after `returns` or `accepts`: a scalar or an array of scalars.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ValueType {
    /// The element type.
    pub scalar: ScalarType,
    /// Array length; none for a plain scalar (which is a different type from an array of one).
    pub length: Option<u16>,
}

impl ValueType {
    /// A plain scalar.
    #[must_use]
    pub const fn scalar(scalar: ScalarType) -> Self {
        Self { scalar, length: None }
    }

    /// Number of elements; 1 for a scalar.
    #[must_use]
    pub fn count(self) -> usize {
        self.length.map_or(1, usize::from)
    }

    /// Bytes of the value, without its identifier.
    #[must_use]
    pub fn size_bytes(self) -> usize {
        self.scalar.size_bytes() * self.count()
    }
}

impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.length {
            None => write!(f, "{}", self.scalar),
            Some(length) => write!(f, "{}[{length}]", self.scalar),
        }
    }
}
