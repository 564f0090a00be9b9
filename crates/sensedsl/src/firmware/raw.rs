//! The bytes of a program as they are in the flash, for tools that do not take ELF files.

use anyhow::{Result, bail};
use object::Endianness;
use object::elf::{FileHeader32, PT_LOAD};
use object::read::elf::{FileHeader as _, ProgramHeader as _};

/// The value of erased flash.
pub(super) const ERASED: u8 = 0xFF;
/// The size that no microcontroller's flash exceeds.
pub(super) const FLASH_BYTES_MAX: u64 = 16 << 20;

/// The parts of a 32-bit ELF file that are loaded, with their load addresses.
///
/// # Errors
///
/// If it is not such a file, or nothing of it is loaded.
pub(super) fn parts(elf: &[u8]) -> Result<Vec<(u64, &[u8])>> {
    let header = FileHeader32::<Endianness>::parse(elf)?;
    let endian = header.endian()?;
    let mut parts: Vec<(u64, &[u8])> = Vec::new();
    for segment in header.program_headers(endian, elf)? {
        let Ok(data) = segment.data(endian, elf) else { bail!("a segment is cut off") };
        if segment.p_type(endian) == PT_LOAD && !data.is_empty() {
            parts.push((segment.p_paddr(endian).into(), data));
        }
    }
    if parts.is_empty() {
        bail!("nothing of it is loaded");
    }
    Ok(parts)
}

/// The bytes from the lowest load address of a 32-bit ELF file to its highest.
///
/// # Errors
///
/// If it is not such a file, or is larger than any flash.
pub(crate) fn of_elf(elf: &[u8]) -> Result<Vec<u8>> {
    let parts = parts(elf)?;
    let begin = parts.iter().map(|(address, _)| *address).min().unwrap_or_default();
    let mut bytes = Vec::new();
    for (address, data) in parts {
        let offset = address - begin;
        if offset + data.len() as u64 > FLASH_BYTES_MAX {
            bail!("its parts are farther apart than any flash is large");
        }
        let offset = usize::try_from(offset)?;
        if bytes.len() < offset + data.len() {
            bytes.resize(offset + data.len(), ERASED);
        }
        if let Some(place) = bytes.get_mut(offset..offset + data.len()) {
            place.copy_from_slice(data);
        }
    }
    Ok(bytes)
}
