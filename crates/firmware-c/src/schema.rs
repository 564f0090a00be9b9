//! The wire in terms of C: fields, types, sizes, and the lines that pack and unpack each value.

use sensedsl_wire::{Checksum, Direction, Item, ScalarType, Schema};

/// Up to this frame size, and up to this number of items, checking a candidate again takes no more time than the
/// decoder's memory of failed candidates would (`UP_WIRE_PLAIN_BYTES`, `UP_WIRE_PLAIN_ITEMS`).
const PLAIN_BYTES: usize = 96;
const PLAIN_ITEMS: usize = 16;
/// The time and counter before a report, with their identifier.
const STAMP_BYTES: usize = 6;
/// The sizes of health: for the board and for each device.
const HEALTH_BOARD_BYTES: usize = 19;
const HEALTH_DEVICE_BYTES: usize = 17;

/// The end of a link that code is for: what only the other end does is not printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Packs reports, unpacks commands.
    Board,
    /// Unpacks reports, packs commands.
    Host,
    /// Both, for testing one against the other.
    Both,
}

/// The schema table and everything derived from it.
#[derive(Clone, Debug)]
pub struct SchemaPlan {
    pub(crate) fields: Vec<FieldPlan>,
    pub(crate) checksum: &'static str,
    /// The schema hash as a C literal.
    pub(crate) hash: String,
    /// The size of the largest value of a field.
    pub value_bytes_max: usize,
    /// The reports and the commands.
    pub(crate) wires: [WirePlan; 2],
}

/// One direction of the link.
#[derive(Clone, Debug)]
pub(crate) struct WirePlan {
    /// `report`
    pub(crate) name: &'static str,
    /// The title for people.
    pub(crate) title: &'static str,
    pub(crate) direction_macro: &'static str,
    pub(crate) items: Vec<FieldPlan>,
    pub(crate) values_bytes_max: usize,
    pub(crate) health_bytes: usize,
    pub(crate) payload_bytes_max: usize,
    pub(crate) frame_bytes_max: usize,
    pub(crate) head_bytes: usize,
    pub(crate) checksum: Checksum,
    pub(crate) has_stamp: bool,
    pub(crate) has_memo: bool,
    pub(crate) is_packed: bool,
    pub(crate) is_taken: bool,
}

/// One value. Names are only printed after a prefix, so that none can be a C keyword.
#[derive(Clone, Debug)]
pub(crate) struct FieldPlan {
    pub(crate) index: usize,
    pub(crate) name: String,
    pub(crate) id: u8,
    pub(crate) c_type: &'static str,
    pub(crate) type_macro: &'static str,
    pub(crate) direction_macro: &'static str,
    pub(crate) count: usize,
    pub(crate) element_bytes: usize,
    pub(crate) is_array: bool,
    scalar: ScalarType,
}

impl SchemaPlan {
    /// Spells a schema for one end of its link.
    #[must_use]
    pub fn new(schema: &Schema, role: Role) -> Self {
        let sizes = schema.items.iter().map(|item| item.value.size_bytes());
        let wires = [Direction::Sensor, Direction::Actuator];
        Self {
            fields: schema.items.iter().enumerate().map(FieldPlan::new).collect(),
            checksum: schema.checksum.name(),
            hash: format!("0x{:08x}U", schema.hash()),
            value_bytes_max: sizes.max().unwrap_or(1),
            wires: wires.map(|direction| WirePlan::new(schema, direction, role)),
        }
    }

    /// The number of values of the board.
    #[must_use]
    pub fn fields_count(&self) -> usize {
        self.fields.len()
    }

    /// The bytes of the longest report, and of the buffer for commands, of a board without memory for long ones.
    #[must_use]
    pub fn buffers_bytes(&self) -> [usize; 2] {
        let [reports, commands] = &self.wires;
        [reports.frame_bytes_max, 2 * commands.frame_bytes_max]
    }

    /// Compiler options (`-D`) for what no wire of the program needs.
    #[must_use]
    pub fn left_out(&self) -> Vec<&'static str> {
        let none = |has: fn(&WirePlan) -> bool| !self.wires.iter().any(has);
        let parts = [
            ("UP_WIRE_CHECKSUMS=0", none(|wire| wire.checksum.is_some())),
            ("UP_WIRE_STAMPS=0", none(|wire| wire.has_stamp)),
            ("UP_WIRE_BOOLS=0", none(|wire| wire.is_taken && wire.has_bools())),
            ("UP_WIRE_MEMO=0", none(|wire| wire.has_memo)),
        ];
        parts.into_iter().filter(|(_, is_out)| *is_out).map(|(name, _)| name).collect()
    }
}

impl WirePlan {
    fn new(schema: &Schema, direction: Direction, role: Role) -> Self {
        let is_to_host = direction == Direction::Sensor;
        let all = schema.items.iter().enumerate();
        let items: Vec<FieldPlan> =
            all.filter(|(_, item)| item.direction == direction).map(FieldPlan::new).collect();
        let has_stamp = schema.stamp && is_to_host;
        let stamp_bytes = if has_stamp && !items.is_empty() { STAMP_BYTES } else { 0 };
        let payload_bytes_max = schema.payload_bytes_max(direction);
        let frame_bytes_max = schema.frame_bytes_max(direction);
        let is_taken = role == Role::Both || (role == Role::Host) == is_to_host;
        let mut wire = Self {
            name: if is_to_host { "report" } else { "command" },
            title: if is_to_host { "reports, to the host" } else { "commands, to the board" },
            direction_macro: direction_macro(direction),
            values_bytes_max: stamp_bytes + items.iter().map(FieldPlan::item_bytes).sum::<usize>(),
            health_bytes: if is_to_host {
                HEALTH_BOARD_BYTES + HEALTH_DEVICE_BYTES * schema.items.len()
            } else {
                0
            },
            payload_bytes_max,
            frame_bytes_max,
            head_bytes: frame_bytes_max.saturating_sub(payload_bytes_max + 1),
            checksum: schema.checksum,
            has_stamp,
            has_memo: false,
            is_packed: !items.is_empty()
                && (role == Role::Both || is_to_host == (role == Role::Board)),
            is_taken,
            items,
        };
        let is_long =
            frame_bytes_max > PLAIN_BYTES && (wire.checksum.is_some() || wire.has_bools());
        wire.has_memo = is_taken && (is_long || wire.items.len() > PLAIN_ITEMS);
        wire
    }

    fn has_bools(&self) -> bool {
        self.items.iter().any(|item| item.scalar == ScalarType::Bool)
    }

    /// The prefix of its macros: `REPORT`.
    pub(crate) fn upper(&self) -> String {
        self.name.to_ascii_uppercase()
    }
}

impl FieldPlan {
    fn new((index, item): (usize, &Item)) -> Self {
        let (c_type, type_macro) = scalar(item.value.scalar);
        let count = item.value.count();
        Self {
            index,
            name: item.name.clone(),
            id: item.id,
            c_type,
            type_macro,
            direction_macro: direction_macro(item.direction),
            count,
            element_bytes: item.value.size_bytes().checked_div(count).unwrap_or(0),
            is_array: item.value.length.is_some(),
            scalar: item.value.scalar,
        }
    }

    /// The size of the value with its identifier.
    pub(crate) fn item_bytes(&self) -> usize {
        1 + self.element_bytes * self.count
    }

    pub(crate) fn value_bytes(&self) -> usize {
        self.element_bytes * self.count
    }

    pub(crate) fn is_bool(&self) -> bool {
        self.scalar == ScalarType::Bool
    }

    /// The byte and the bit of its place in a bitmap.
    pub(crate) fn byte(&self) -> usize {
        self.index / 8
    }

    pub(crate) fn bit(&self) -> String {
        format!("0x{:02X}U", 1_u32 << (self.index % 8))
    }

    /// Packs the value: the expression for the position after it.
    pub(crate) fn put(&self) -> String {
        let at = format!("up_put_8(at, {}U)", self.id);
        let value = format!("values->SENSE_{}", self.name);
        if self.is_array {
            return format!(
                "up_put_array({at}, {value}, {}U, {}U)",
                self.element_bytes, self.count
            );
        }
        let bits = match self.scalar {
            ScalarType::Bool => format!("{value} ? 1U : 0U"),
            ScalarType::Uint8 | ScalarType::Uint16 | ScalarType::Uint32 | ScalarType::Uint64 => {
                value
            }
            ScalarType::Int8 | ScalarType::Int16 | ScalarType::Int32 | ScalarType::Int64 => {
                format!("({}){value}", self.bits_type())
            }
            ScalarType::Float32 => format!("up_bits_of({value})"),
            ScalarType::Float64 => format!("up_bits_of_double({value})"),
        };
        format!("up_put_{}({at}, {bits})", 8 * self.element_bytes)
    }

    /// Unpacks the value, which follows its identifier at `at`.
    pub(crate) fn take(&self) -> String {
        let value = format!("values->SENSE_{}", self.name);
        if self.is_array {
            let (size, count) = (self.element_bytes, self.count);
            return format!("up_get_array(&at[1], {value}, {size}U, {count}U)");
        }
        let bits = match self.element_bytes {
            1 => "at[1]".to_owned(),
            bytes => format!("up_get_{}(&at[1])", 8 * bytes),
        };
        match self.scalar {
            ScalarType::Bool => format!("{value} = {bits} != 0U"),
            ScalarType::Uint8 | ScalarType::Uint16 | ScalarType::Uint32 | ScalarType::Uint64 => {
                format!("{value} = {bits}")
            }
            ScalarType::Int8 | ScalarType::Int16 | ScalarType::Int32 | ScalarType::Int64 => {
                format!("{value} = ({}){bits}", self.c_type)
            }
            ScalarType::Float32 => format!("{value} = up_float_of({bits})"),
            ScalarType::Float64 => format!("{value} = up_double_of({bits})"),
        }
    }

    /// The unsigned type of the same size.
    fn bits_type(&self) -> &'static str {
        match self.element_bytes {
            1 => "uint8_t",
            2 => "uint16_t",
            4 => "uint32_t",
            _ => "uint64_t",
        }
    }
}

fn direction_macro(direction: Direction) -> &'static str {
    match direction {
        Direction::Sensor => "UP_TO_HOST",
        Direction::Actuator => "UP_TO_BOARD",
    }
}

/// The C type, and the runtime's name for it.
pub(crate) fn scalar(scalar: ScalarType) -> (&'static str, &'static str) {
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
