//! The wire in the words of C: fields, types, sizes.

use sensedsl_wire::{Checksum, Direction, Item, ScalarType};

use super::context::Context;

/// The schema table and what depends on it.
#[derive(Clone, Debug)]
pub(super) struct SchemaPlan {
    pub(super) fields: Vec<FieldPlan>,
    pub(super) has_checksum: bool,
    /// As a C literal.
    pub(super) hash: String,
    pub(super) value_bytes_max: usize,
    pub(super) frame_bytes_max_to_host: usize,
    pub(super) frame_bytes_max_to_board: usize,
}

/// One value. Names are only ever printed behind a prefix, so that none is a word of C.
#[derive(Clone, Debug)]
pub(super) struct FieldPlan {
    pub(super) index: usize,
    pub(super) name: String,
    pub(super) id: u8,
    pub(super) c_type: &'static str,
    pub(super) type_macro: &'static str,
    pub(super) direction_macro: &'static str,
    pub(super) count: usize,
    pub(super) is_array: bool,
}

impl SchemaPlan {
    pub(super) fn new(context: &Context<'_>) -> Self {
        let schema = &context.job.schema;
        let sizes = schema.items.iter().map(|item| item.value.size_bytes());
        Self {
            fields: schema.items.iter().enumerate().map(FieldPlan::new).collect(),
            has_checksum: schema.checksum == Checksum::Crc16,
            hash: format!("0x{:08x}U", schema.hash()),
            value_bytes_max: sizes.max().unwrap_or(1),
            frame_bytes_max_to_host: schema.frame_bytes_max(Direction::Sensor),
            frame_bytes_max_to_board: schema.frame_bytes_max(Direction::Actuator),
        }
    }
}

impl FieldPlan {
    fn new((index, item): (usize, &Item)) -> Self {
        let (c_type, type_macro) = scalar(item.value.scalar);
        Self {
            index,
            name: item.name.clone(),
            id: item.id,
            c_type,
            type_macro,
            direction_macro: match item.direction {
                Direction::Sensor => "UP_TO_HOST",
                Direction::Actuator => "UP_TO_BOARD",
            },
            count: item.value.count(),
            is_array: item.value.length.is_some(),
        }
    }
}

/// The type of C and the runtime's name for it.
fn scalar(scalar: ScalarType) -> (&'static str, &'static str) {
    match scalar {
        ScalarType::Bool => ("bool", "UP_TYPE_BOOL"),
        ScalarType::Uint8 => ("uint8_t", "UP_TYPE_UINT8"),
        ScalarType::Int8 => ("int8_t", "UP_TYPE_INT8"),
        ScalarType::Uint16 => ("uint16_t", "UP_TYPE_UINT16"),
        ScalarType::Int16 => ("int16_t", "UP_TYPE_INT16"),
        ScalarType::Uint32 => ("uint32_t", "UP_TYPE_UINT32"),
        ScalarType::Int32 => ("int32_t", "UP_TYPE_INT32"),
        ScalarType::Uint64 => ("uint64_t", "UP_TYPE_UINT64"),
        ScalarType::Int64 => ("int64_t", "UP_TYPE_INT64"),
        ScalarType::Float32 => ("float", "UP_TYPE_FLOAT32"),
        ScalarType::Float64 => ("double", "UP_TYPE_FLOAT64"),
    }
}
