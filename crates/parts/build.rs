//! Copies the table that is part of the program.

/// More than the table ever is.
const TABLE_BYTES_MAX: usize = 64 << 20;

fn main() -> std::io::Result<()> {
    sensedsl_packed::copy_deflated("data/parts.bin", TABLE_BYTES_MAX)
}
