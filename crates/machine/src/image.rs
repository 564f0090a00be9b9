//! Programs: ELF files, and the raw bytes of the flash.

use std::fmt;

use object::{Endianness, Object, ObjectKind};

use super::mcu::Mcu;
use super::transfer::{CCM_BASE, FLASH_BASE, SRAM_BASE};

/// The reason why bytes are not a program for this MCU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageError {
    /// Neither an ELF file nor a vector table.
    NotAProgram,
    /// An ELF file that cannot be read.
    Damaged(String),
    /// It is for another processor, with this architecture.
    OtherProcessor(String),
    /// It is not an executable program but an object file, a library or a core dump.
    NotExecutable,
    /// The board's MCU cannot be emulated.
    NoModel(String),
    /// A part of it belongs at an address that is not in the flash.
    OtherAddress {
        /// The MCU.
        mcu: &'static Mcu,
        /// The address.
        address: u64,
        /// The length in bytes.
        length: u64,
    },
    /// It has more bytes than the flash.
    TooLong {
        /// The MCU.
        mcu: &'static Mcu,
        /// The length in bytes.
        length: usize,
    },
    /// The first words of the vector table are not a stack and a program in this MCU's memory.
    Vectors {
        /// The MCU.
        mcu: &'static Mcu,
        /// The initial stack pointer.
        stack: u32,
        /// The address of the first instruction.
        entry: u32,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAProgram => {
                f.write_str("it is neither an ELF file nor the contents of a flash")
            }
            Self::Damaged(why) => write!(f, "the ELF file cannot be read: {why}"),
            Self::OtherProcessor(which) => {
                write!(f, "it is a program for another processor ({which}), not for a 32-bit Arm")
            }
            Self::NotExecutable => f.write_str("it is not a linked program"),
            Self::NoModel(mcu) => {
                let known: Vec<&str> = Mcu::parts().collect();
                write!(f, "a {mcu} cannot be emulated; these can: {}", known.join(", "))
            }
            Self::OtherAddress { mcu, address, length } => write!(
                f,
                "{length} bytes of it belong at 0x{address:08x}, but the {}'s flash is from 0x08000000 to \
                 0x{:08x}: it was linked for another MCU",
                mcu.name(),
                FLASH_BASE + mcu.flash_bytes - 1
            ),
            Self::TooLong { mcu, length } => {
                write!(
                    f,
                    "it has {length} bytes, but the {}'s flash has {}",
                    mcu.name(),
                    mcu.flash_bytes
                )
            }
            Self::Vectors { mcu, stack, entry } => write!(
                f,
                "its vector table has the stack at 0x{stack:08x} and begins at 0x{entry:08x}: one of them is not in \
                 the {}'s memory",
                mcu.name()
            ),
        }
    }
}

impl std::error::Error for ImageError {}

/// The contents of the flash, from its first byte on.
pub(super) fn flash_of(image: &[u8], mcu: &'static Mcu) -> Result<Vec<u8>, ImageError> {
    let is_elf = image.starts_with(b"\x7FELF");
    let flash = if is_elf { of_elf(image, mcu)? } else { of_bytes(image, mcu)? };
    let word = |at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(flash.get(at..at + 4)?.try_into().ok()?))
    };
    let (Some(stack), Some(entry)) = (word(0), word(4)) else {
        return Err(ImageError::NotAProgram);
    };
    // The stack may start in SRAM or in the core's own memory, up to the end of either.
    let memories = [(SRAM_BASE, mcu.sram_bytes), (CCM_BASE, mcu.ccm_bytes)];
    let has_stack = memories.iter().any(|(low, bytes)| stack > *low && stack <= low + bytes);
    let begins = entry & 1 == 1 && (FLASH_BASE..FLASH_BASE + mcu.flash_bytes).contains(&entry);
    if !has_stack || !begins {
        return Err(ImageError::Vectors { mcu, stack, entry });
    }
    Ok(flash)
}

fn of_bytes(image: &[u8], mcu: &'static Mcu) -> Result<Vec<u8>, ImageError> {
    if image.len() < 8 {
        return Err(ImageError::NotAProgram);
    }
    if image.len() > mcu.flash_bytes as usize {
        return Err(ImageError::TooLong { mcu, length: image.len() });
    }
    Ok(image.to_vec())
}

fn of_elf(image: &[u8], mcu: &'static Mcu) -> Result<Vec<u8>, ImageError> {
    use object::elf::{FileHeader32, PT_LOAD};
    use object::read::elf::{ElfFile, FileHeader, ProgramHeader};

    // The header names the machine, whatever the class of the file.
    let machine = image.get(18..20).map_or(0, |bytes| u16::from_le_bytes([bytes[0], bytes[1]]));
    let is_little = image.get(5) == Some(&1);
    if image.get(4) != Some(&1) || !is_little || machine != object::elf::EM_ARM {
        return Err(ImageError::OtherProcessor(processor(machine)));
    }
    let file = ElfFile::<FileHeader32<Endianness>>::parse(image)
        .map_err(|error| ImageError::Damaged(error.to_string()))?;
    if file.kind() != ObjectKind::Executable {
        return Err(ImageError::NotExecutable);
    }
    let endian = file.endian();
    let headers = FileHeader32::<Endianness>::parse(image)
        .and_then(|header| header.program_headers(endian, image))
        .map_err(|error| ImageError::Damaged(error.to_string()))?;
    let mut flash = Vec::new();
    for header in headers.iter().filter(|header| header.p_type(endian) == PT_LOAD) {
        // The program copies initialised data to RAM itself: in the flash, they are at their load address.
        let address = u64::from(header.p_paddr(endian));
        let data = header
            .data(endian, image)
            .map_err(|()| ImageError::Damaged("a segment is cut off".to_owned()))?;
        if data.is_empty() {
            continue;
        }
        let other = ImageError::OtherAddress { mcu, address, length: data.len() as u64 };
        let begin = address.checked_sub(u64::from(FLASH_BASE)).ok_or(other.clone())?;
        let begin = usize::try_from(begin).map_err(|_| other.clone())?;
        let end = begin
            .checked_add(data.len())
            .filter(|end| *end <= mcu.flash_bytes as usize)
            .ok_or(other)?;
        if flash.len() < end {
            flash.resize(end, 0xFF);
        }
        if let Some(place) = flash.get_mut(begin..end) {
            place.copy_from_slice(data);
        }
    }
    Ok(flash)
}

fn processor(machine: u16) -> String {
    let known = [
        (3, "x86"),
        (8, "MIPS"),
        (40, "Arm of another byte order"),
        (62, "x86-64"),
        (83, "AVR"),
        (94, "Xtensa"),
        (183, "64-bit Arm"),
        (243, "RISC-V"),
    ];
    let name = known.iter().find(|(number, _)| *number == machine);
    name.map_or_else(|| format!("machine {machine}"), |(_, name)| (*name).to_owned())
}
