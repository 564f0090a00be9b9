//! From values to frames.

use alloc::format;
use alloc::vec::Vec;
use core::fmt;

use crate::frame::Stamp;
use crate::health::{HEALTH_REQUEST, Health};
use crate::scalar::Scalar;
use crate::schema::{Direction, ID_HELLO, Schema};

/// Why values do not make a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EncodeError {
    /// No item with that identifier travels in that direction.
    UnknownId(u8),
    /// The number of scalars differs from the item's.
    WrongCount(u8),
    /// A scalar does not have the item's type, or is out of its range.
    WrongValue(u8),
    /// An identifier was given twice.
    Twice(u8),
    /// There is no value to report.
    Empty,
    /// There is a stamp on a link without stamps, or no stamp where each report needs one.
    Stamp,
    /// Health does not have exactly the schema's devices, in the schema's order.
    Devices,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownId(id) => write!(f, "no item {id} travels in this direction"),
            Self::WrongCount(id) => write!(f, "item {id} has another number of elements"),
            Self::WrongValue(id) => write!(f, "item {id} cannot hold this value"),
            Self::Twice(id) => write!(f, "item {id} stands twice"),
            Self::Empty => write!(f, "a report needs at least one value"),
            Self::Stamp => write!(f, "the stamp is not as the link wants it"),
            Self::Devices => write!(f, "the devices are not those of the schema"),
        }
    }
}

impl core::error::Error for EncodeError {}

/// A frame with the given values, in schema order whatever the order of `values`; without a stamp.
///
/// # Errors
/// Fails if a value does not fit the schema, if there are no values, or if the link's reports have
/// a stamp.
pub fn encode_report(
    schema: &Schema,
    direction: Direction,
    values: &[(u8, Vec<Scalar>)],
) -> Result<Vec<u8>, EncodeError> {
    encode(schema, direction, None, values)
}

/// A frame with the given values, from a board whose reports have a stamp; otherwise like
/// [`encode_report`].
///
/// # Errors
/// Fails if a value does not fit the schema, if there are no values, or if the link's reports have
/// no stamp.
pub fn encode_stamped_report(
    schema: &Schema,
    stamp: Stamp,
    values: &[(u8, Vec<Scalar>)],
) -> Result<Vec<u8>, EncodeError> {
    encode(schema, Direction::Sensor, Some(stamp), values)
}

fn encode(
    schema: &Schema,
    direction: Direction,
    stamp: Option<Stamp>,
    values: &[(u8, Vec<Scalar>)],
) -> Result<Vec<u8>, EncodeError> {
    if stamp.is_some() != (schema.stamp && direction == Direction::Sensor) {
        return Err(EncodeError::Stamp);
    }
    if values.is_empty() {
        return Err(EncodeError::Empty);
    }
    for (index, (id, _)) in values.iter().enumerate() {
        if schema.item(direction, *id).is_none() {
            return Err(EncodeError::UnknownId(*id));
        }
        if values.iter().take(index).any(|(earlier, _)| earlier == id) {
            return Err(EncodeError::Twice(*id));
        }
    }
    let mut payload = Vec::new();
    if let Some(Stamp { time_us, counter }) = stamp {
        payload.push(ID_HELLO);
        payload.extend_from_slice(&time_us.to_be_bytes());
        payload.push(counter);
    }
    for item in &schema.items {
        let Some((_, scalars)) = values.iter().find(|(id, _)| *id == item.id) else { continue };
        if scalars.len() != item.value.count() {
            return Err(EncodeError::WrongCount(item.id));
        }
        payload.push(item.id);
        for &scalar in scalars {
            if !item.value.scalar.write(scalar, &mut payload) {
                return Err(EncodeError::WrongValue(item.id));
            }
        }
    }
    Ok(frame(schema, payload))
}

/// The board's hello, which is its schema hash.
#[must_use]
pub fn encode_hello(schema: &Schema) -> Vec<u8> {
    let mut payload = Vec::from([ID_HELLO]);
    payload.extend_from_slice(&schema.hash().to_be_bytes());
    frame(schema, payload)
}

/// The state of the board and its devices.
///
/// # Errors
/// Fails if the devices are not those of the schema, in its order.
pub fn encode_health(schema: &Schema, health: &Health) -> Result<Vec<u8>, EncodeError> {
    let ids = schema.items.iter().map(|item| item.id);
    if !ids.eq(health.devices.iter().map(|device| device.id)) {
        return Err(EncodeError::Devices);
    }
    Ok(frame(schema, health.payload()))
}

/// The host's request for health.
#[must_use]
pub fn encode_health_request(schema: &Schema) -> Vec<u8> {
    frame(schema, Vec::from([ID_HELLO, HEALTH_REQUEST]))
}

/// The host's request for a hello.
#[must_use]
pub fn encode_hello_request(schema: &Schema) -> Vec<u8> {
    frame(schema, Vec::from([ID_HELLO]))
}

fn frame(schema: &Schema, mut payload: Vec<u8>) -> Vec<u8> {
    schema.checksum.append(&mut payload);
    let mut bytes = format!("{}:", payload.len()).into_bytes();
    bytes.append(&mut payload);
    bytes.push(b',');
    bytes
}
