//! The encoding of OD4's messages: fields in, bytes out, and back.
//!
//! It is that of Protocol Buffers, as libcluon uses it: signed integers in zigzag form, `bool` as a number, and every
//! field written, also one that is zero.

/// A value of a field.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Field {
    /// A number without a sign, or a `bool`.
    Unsigned(u64),
    /// A number with a sign.
    Signed(i64),
    /// Four bytes.
    Float(f32),
    /// Eight bytes.
    Double(f64),
    /// A text, bytes or another message.
    Bytes(Vec<u8>),
}

/// A value as it was received: what it means only the message knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Raw<'a> {
    Varint(u64),
    Fixed32([u8; 4]),
    Fixed64([u8; 8]),
    Bytes(&'a [u8]),
}

/// Writes a message.
pub(super) fn write(fields: &[(u32, Field)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (number, field) in fields {
        let key = |sort: u64| (u64::from(*number) << 3) | sort;
        match field {
            Field::Unsigned(value) => {
                varint(&mut bytes, key(0));
                varint(&mut bytes, *value);
            }
            Field::Signed(value) => {
                varint(&mut bytes, key(0));
                varint(&mut bytes, zigzag(*value));
            }
            Field::Float(value) => {
                varint(&mut bytes, key(5));
                bytes.extend(value.to_le_bytes());
            }
            Field::Double(value) => {
                varint(&mut bytes, key(1));
                bytes.extend(value.to_le_bytes());
            }
            Field::Bytes(value) => {
                varint(&mut bytes, key(2));
                varint(&mut bytes, value.len() as u64);
                bytes.extend(value);
            }
        }
    }
    bytes
}

/// Reads a message; none if it is not one.
pub(super) fn read(mut bytes: &[u8]) -> Option<Vec<(u32, Raw<'_>)>> {
    let mut fields = Vec::new();
    while !bytes.is_empty() {
        let key = take_varint(&mut bytes)?;
        let number = u32::try_from(key >> 3).ok()?;
        let raw = match key & 7 {
            0 => Raw::Varint(take_varint(&mut bytes)?),
            1 => Raw::Fixed64(take(&mut bytes, 8)?.try_into().ok()?),
            2 => {
                let length = usize::try_from(take_varint(&mut bytes)?).ok()?;
                Raw::Bytes(take(&mut bytes, length)?)
            }
            5 => Raw::Fixed32(take(&mut bytes, 4)?.try_into().ok()?),
            _ => return None,
        };
        fields.push((number, raw));
    }
    Some(fields)
}

/// The number that a zigzag form is of.
pub(super) fn signed(zigzag: u64) -> i64 {
    (zigzag >> 1).cast_signed() ^ -(zigzag & 1).cast_signed()
}

fn zigzag(value: i64) -> u64 {
    ((value << 1) ^ (value >> 63)).cast_unsigned()
}

fn varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (front, rest) = bytes.split_at_checked(count)?;
    *bytes = rest;
    Some(front)
}

fn take_varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0_u64;
    for at in 0..10 {
        let &[byte] = take(bytes, 1)? else { return None };
        value |= u64::from(byte & 0x7f) << (7 * at);
        if byte & 0x80 == 0 {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_back() {
        for number in [0, 1, -1, 2_147_483_647, i64::MIN, i64::MAX] {
            assert_eq!(signed(zigzag(number)), number);
        }
        let fields = [
            (1, Field::Signed(-3)),
            (2, Field::Unsigned(u64::MAX)),
            (3, Field::Double(0.1)),
            (4, Field::Float(-0.5)),
            (500, Field::Bytes(vec![7; 300])),
        ];
        let bytes = write(&fields);
        let found = read(&bytes).unwrap();
        assert_eq!(found[0], (1, Raw::Varint(5)));
        assert_eq!(found[1], (2, Raw::Varint(u64::MAX)));
        assert_eq!(found[2], (3, Raw::Fixed64(0.1_f64.to_le_bytes())));
        assert_eq!(found[3], (4, Raw::Fixed32((-0.5_f32).to_le_bytes())));
        assert_eq!(found[4], (500, Raw::Bytes(&[7; 300])));
        // A message that is cut is none, or one with fewer fields, and never a panic.
        for end in 0..bytes.len() {
            let found = read(&bytes[..end]);
            assert!(found.is_none_or(|found| found.len() < fields.len()));
        }
        assert_eq!(read(&[0xff; 20]), None);
    }
}
