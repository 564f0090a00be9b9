//! The shipped table: the packed bytes in the binary in, the unpacked table out.
//!
//! It is unpacked once, when something first asks for it, and everything else here reads it.

use std::sync::OnceLock;

use crate::format::{self, Data};

/// The table as it is shipped.
const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/parts.bin"));

/// The unpacked table; empty should the shipped one be damaged, which tests rule out.
pub(crate) fn data() -> &'static Data {
    static DATA: OnceLock<Data> = OnceLock::new();
    DATA.get_or_init(|| format::unpack(PACKED).unwrap_or_default())
}

/// Bytes of the table in the binary.
#[must_use]
pub const fn packed_bytes() -> usize {
    PACKED.len()
}
