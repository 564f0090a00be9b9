//! A word in, the value type that it means out: the names of types in other languages.

use sensedsl_diagnostics::nearest;
use sensedsl_wire::ScalarType;

/// Type names of C, C++, Rust, Python, Java and PLCs, in lower case and without `_t`. An `int` has
/// the size that it has on the boards that firmware exists for.
const OTHERS: &[(&str, ScalarType)] = &[
    ("boolean", ScalarType::Bool),
    ("bit", ScalarType::Bool),
    ("byte", ScalarType::Uint8),
    ("char", ScalarType::Uint8),
    ("uchar", ScalarType::Uint8),
    ("unsigned char", ScalarType::Uint8),
    ("signed char", ScalarType::Int8),
    ("short", ScalarType::Int16),
    ("short int", ScalarType::Int16),
    ("word", ScalarType::Uint16),
    ("ushort", ScalarType::Uint16),
    ("unsigned short", ScalarType::Uint16),
    ("int", ScalarType::Int32),
    ("integer", ScalarType::Int32),
    ("signed", ScalarType::Int32),
    ("signed int", ScalarType::Int32),
    ("long", ScalarType::Int32),
    ("long int", ScalarType::Int32),
    ("uint", ScalarType::Uint32),
    ("unsigned", ScalarType::Uint32),
    ("unsigned int", ScalarType::Uint32),
    ("unsigned long", ScalarType::Uint32),
    ("dword", ScalarType::Uint32),
    ("long long", ScalarType::Int64),
    ("unsigned long long", ScalarType::Uint64),
    ("float", ScalarType::Float32),
    ("single", ScalarType::Float32),
    ("real", ScalarType::Float32),
    ("double", ScalarType::Float64),
    ("u8", ScalarType::Uint8),
    ("i8", ScalarType::Int8),
    ("u16", ScalarType::Uint16),
    ("i16", ScalarType::Int16),
    ("u32", ScalarType::Uint32),
    ("i32", ScalarType::Int32),
    ("u64", ScalarType::Uint64),
    ("i64", ScalarType::Int64),
    ("f32", ScalarType::Float32),
    ("f64", ScalarType::Float64),
];

/// The type that an unknown word probably means.
pub(crate) fn meant(word: &str) -> Option<&'static str> {
    let lower = word.to_ascii_lowercase();
    let plain = lower.strip_suffix("_t").unwrap_or(&lower);
    let other = OTHERS.iter().find(|(name, _)| *name == plain);
    other
        .map(|(_, scalar)| scalar.name())
        .or_else(|| nearest(plain, ScalarType::ALL.map(ScalarType::name)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_other_languages() {
        assert_eq!(meant("int"), Some("int32"));
        assert_eq!(meant("Float"), Some("float32"));
        assert_eq!(meant("uint8_t"), Some("uint8"));
        assert_eq!(meant("unsigned long"), Some("uint32"));
        assert_eq!(meant("unit16"), Some("uint16"));
        assert_eq!(meant("string"), None);
    }
}
