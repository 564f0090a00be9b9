//! Values that actuators take at the start or when nobody sets them, as literals of C.

use sensedsl_job::JobDevice;
use sensedsl_wire::ScalarType;

use crate::schema;

/// A value that is set when the host falls silent.
#[derive(Clone, Debug)]
pub struct FallBackPlan {
    /// The device's name, as in `SENSE_FIELD_`.
    pub field: String,
    /// The type of an element in C.
    pub c_type: &'static str,
    /// The elements, each as a C literal.
    pub elements: Vec<String>,
}

impl FallBackPlan {
    /// None if the device has no failsafe, or one that its driver applies by itself.
    #[must_use]
    pub fn new(one: &JobDevice<'_>) -> Option<Self> {
        Some(Self::of(one, one.device.coding.failsafe?))
    }

    /// All elements of a device with the same code.
    #[must_use]
    pub fn of(one: &JobDevice<'_>, code: f64) -> Self {
        let value = one.device.value.value;
        Self {
            field: one.name().to_owned(),
            c_type: schema::scalar(value.scalar).0,
            elements: vec![literal(value.scalar, code); value.count()],
        }
    }
}

/// The number as a literal of the type, whose range the model has checked.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the type holds it")]
fn literal(scalar: ScalarType, number: f64) -> String {
    match scalar {
        ScalarType::Bool => (number != 0.0).to_string(),
        ScalarType::Float32 => format!("{:?}F", number as f32),
        ScalarType::Float64 => format!("{number:?}"),
        ScalarType::Uint8 | ScalarType::Uint16 | ScalarType::Uint32 | ScalarType::Uint64 => {
            format!("UINT64_C({})", number as u64)
        }
        ScalarType::Int8 | ScalarType::Int16 | ScalarType::Int32 | ScalarType::Int64 => {
            match number as i64 {
                // C cannot spell the least one as a literal.
                i64::MIN => "INT64_MIN".to_owned(),
                whole => format!("INT64_C({whole})"),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ScalarType, literal};

    #[test]
    fn literals_of_all_sorts() {
        let all = [
            literal(ScalarType::Bool, 1.0),
            literal(ScalarType::Int8, -128.0),
            literal(ScalarType::Uint64, 18_446_744_073_709_551_615.0),
            literal(ScalarType::Int64, -9_223_372_036_854_775_808.0),
            literal(ScalarType::Int64, 9_223_372_036_854_775_808.0),
            literal(ScalarType::Float32, 0.1),
            literal(ScalarType::Float64, -2.0),
        ];
        let expected = [
            "true",
            "INT64_C(-128)",
            "UINT64_C(18446744073709551615)",
            "INT64_MIN",
            "INT64_C(9223372036854775807)",
            "0.1F",
            "-2.0",
        ];
        assert_eq!(all, expected);
    }
}
