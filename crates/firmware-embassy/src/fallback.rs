//! The values that actuators take when the host is silent, where they are applied like values of the host.

use sensedsl_wire::ScalarType;

use super::context::Context;

/// The bytes of each value as they are on the wire, by the index of its item.
pub(super) fn values(context: &Context<'_>) -> Vec<(usize, Vec<u8>)> {
    let all = context.job.devices.iter().enumerate();
    let bytes_of = |(index, one): (usize, &sensedsl_job::JobDevice<'_>)| {
        Some((index, value(one, one.device.coding.failsafe?)))
    };
    all.filter_map(bytes_of).collect()
}

/// The bytes of a device whose elements all have the same code.
pub(super) fn value(one: &sensedsl_job::JobDevice<'_>, code: f64) -> Vec<u8> {
    let value = one.device.value.value;
    bytes(value.scalar, code).repeat(value.count())
}

/// The bytes of a number. The model has seen to it that the type holds it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the type holds it")]
fn bytes(scalar: ScalarType, number: f64) -> Vec<u8> {
    match scalar {
        ScalarType::Bool => vec![u8::from(number != 0.0)],
        ScalarType::Uint8 => (number as u8).to_be_bytes().to_vec(),
        ScalarType::Int8 => (number as i8).to_be_bytes().to_vec(),
        ScalarType::Uint16 => (number as u16).to_be_bytes().to_vec(),
        ScalarType::Int16 => (number as i16).to_be_bytes().to_vec(),
        ScalarType::Uint32 => (number as u32).to_be_bytes().to_vec(),
        ScalarType::Int32 => (number as i32).to_be_bytes().to_vec(),
        ScalarType::Uint64 => (number as u64).to_be_bytes().to_vec(),
        ScalarType::Int64 => (number as i64).to_be_bytes().to_vec(),
        ScalarType::Float32 => (number as f32).to_be_bytes().to_vec(),
        ScalarType::Float64 => number.to_be_bytes().to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::{ScalarType, bytes};

    #[test]
    fn values_of_all_sorts() {
        assert_eq!(bytes(ScalarType::Bool, 1.0), [1]);
        assert_eq!(bytes(ScalarType::Int16, -2.0), [0xFF, 0xFE]);
        assert_eq!(bytes(ScalarType::Uint32, 258.0), [0, 0, 1, 2]);
        assert_eq!(bytes(ScalarType::Int64, i64::MIN as f64), [0x80, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(bytes(ScalarType::Float32, -1.5), [0xBF, 0xC0, 0, 0]);
    }
}
