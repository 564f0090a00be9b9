//! How a plan is spelled in C and in Rust.

use sensedsl_wire::ScalarType;

use crate::FieldPlan;

/// The type of one element: `uint16_t`.
pub(crate) const fn c_type(scalar: &ScalarType) -> &'static str {
    match scalar {
        ScalarType::Bool => "bool",
        ScalarType::Uint8 => "uint8_t",
        ScalarType::Int8 => "int8_t",
        ScalarType::Uint16 => "uint16_t",
        ScalarType::Int16 => "int16_t",
        ScalarType::Uint32 => "uint32_t",
        ScalarType::Int32 => "int32_t",
        ScalarType::Uint64 => "uint64_t",
        ScalarType::Int64 => "int64_t",
        ScalarType::Float32 => "float",
        ScalarType::Float64 => "double",
    }
}

/// The type of one element in Rust.
pub(crate) const fn rust_scalar(scalar: &ScalarType) -> &'static str {
    match scalar {
        ScalarType::Bool => "bool",
        ScalarType::Uint8 => "u8",
        ScalarType::Int8 => "i8",
        ScalarType::Uint16 => "u16",
        ScalarType::Int16 => "i16",
        ScalarType::Uint32 => "u32",
        ScalarType::Int32 => "i32",
        ScalarType::Uint64 => "u64",
        ScalarType::Int64 => "i64",
        ScalarType::Float32 => "f32",
        ScalarType::Float64 => "f64",
    }
}

/// The type of a value in Rust: `[u16; 8]`.
pub(crate) fn rust_type(field: &FieldPlan) -> String {
    let scalar = rust_scalar(&field.scalar);
    field.length.map_or_else(|| scalar.to_owned(), |length| format!("[{scalar}; {length}]"))
}

/// Whether a value is shown as a number of its own.
pub(crate) fn has_converted(fields: &[FieldPlan]) -> bool {
    fields.iter().any(is_converted)
}

/// Whether a value can be set to the number that is shown.
pub(crate) fn has_settable(fields: &[FieldPlan]) -> bool {
    fields.iter().any(is_settable)
}

/// The length of an array after a field's name: `[8]`; nothing for a single value.
pub(crate) fn dimension(field: &FieldPlan) -> String {
    field.length.map_or_else(String::new, |length| format!("[{length}]"))
}

/// The unit that a value is shown in, for a comment.
pub(crate) fn unit(field: &FieldPlan) -> &str {
    field.shown.quantity.as_deref().unwrap_or("the number itself")
}

/// Whether the shown value is a number of its own.
pub(crate) fn is_converted(field: &FieldPlan) -> bool {
    !field.shown.is_plain() && field.scalar != ScalarType::Bool
}

/// A number in C, exact for a `double`: `0.01`.
pub(crate) fn number(number: &f64) -> String {
    let text = format!("{number:?}");
    if text.contains(['.', 'e', 'n', 'i']) { text } else { format!("{text}.0") }
}

/// What code gets or gives, in one line that a later run compares with its own: `Line (uint16[8]), Cruise (int16)`.
pub(crate) fn interface(fields: &[FieldPlan]) -> String {
    let each = fields
        .iter()
        .map(|field| format!("{} ({}{})", field.name, field.scalar.name(), dimension(field)));
    let all = each.collect::<Vec<_>>().join(", ");
    if all.is_empty() { "nothing".to_owned() } else { all }
}

/// What a set value is kept within, in codes.
pub(crate) struct Limits {
    pub(crate) least: String,
    pub(crate) most: String,
    /// What stands for something that is not a number: nothing, or what is nearest to it.
    pub(crate) none: String,
}

/// What a set value is kept within; none where the type and the device take any.
pub(crate) fn limits(field: &FieldPlan) -> Option<Limits> {
    let (least, most) = field.range?;
    // The greatest number of 64 bits has no `double` of its own: the next one would be too great.
    let is_wide = matches!(field.scalar, ScalarType::Int64 | ScalarType::Uint64);
    let most = if is_wide { most.next_down() } else { most };
    let none = 0_f64.clamp(least, most);
    Some(Limits { least: number(&least), most: number(&most), none: number(&none) })
}

/// Whether a code is a whole number, which is rounded to.
pub(crate) fn is_whole(field: &FieldPlan) -> bool {
    field.scalar.integer_range().is_some()
}

/// The factor from a code to the shown value.
pub(crate) fn scale(field: &FieldPlan) -> &f64 {
    field.shown.scale.as_ref().unwrap_or(&1.0)
}

/// What is added after scaling.
pub(crate) fn offset(field: &FieldPlan) -> &f64 {
    field.shown.offset.as_ref().unwrap_or(&0.0)
}

/// Whether a helper can make a code of a shown value: there is no curve to go back on.
pub(crate) fn is_settable(field: &FieldPlan) -> bool {
    is_converted(field) && field.shown.curve.is_empty()
}

/// A piece of a curve: for which `x`, and what it becomes.
pub(crate) struct Piece {
    pub(crate) until: String,
    pub(crate) value: String,
}

/// The pieces of a curve, in order; the last one is beyond its end.
pub(crate) fn curve(field: &FieldPlan) -> Vec<Piece> {
    let points = &field.shown.curve;
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let below = Piece { until: format!("x < {}", number(&first.0)), value: number(&first.1) };
    let between = points.iter().zip(points.iter().skip(1)).map(|(from, to)| Piece {
        until: format!("x <= {}", number(&to.0)),
        value: format!(
            "{} + {} * (x - {})",
            number(&from.1),
            number(&((to.1 - from.1) / (to.0 - from.0))),
            number(&from.0)
        ),
    });
    let above = Piece { until: format!("x > {}", number(&last.0)), value: number(&last.1) };
    std::iter::once(below).chain(between).chain([above]).collect()
}
