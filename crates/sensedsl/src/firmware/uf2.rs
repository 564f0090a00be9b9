//! A program as a UF2 file, which the drive of a boot loader takes. In: the bytes of an ELF file, and the family of its
//! chip. Out: the bytes of the file.
//!
//! The form is that of <https://github.com/microsoft/uf2>: blocks of 512 bytes, each with the address of its 256 bytes
//! of payload. Two faults of boot ROMs are worked around as Raspberry Pi's own converter does it. That of RP2040 tells
//! by the number of a block which sector it has erased, so a sector that is touched is filled. That of the first RP2350
//! (erratum E10) does not put a program into a partition unless a block of the family "absolute" is before it; later
//! ones skip that block by its extension.

use std::collections::BTreeMap;

use anyhow::{Result, bail};

use super::raw::{self, ERASED, FLASH_BYTES_MAX};

/// Chips of which UF2 files know the family.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Family {
    /// What blocks call it.
    id: u32,
    /// What the names of boards begin with in `INFO_UF2.TXT` on the boot loader's drive.
    board_id: &'static str,
    /// What people call it.
    pub(crate) chip: &'static str,
    /// Where its flash begins.
    flash: u64,
    /// Whether its flash may have partitions.
    has_partitions: bool,
}

impl Family {
    /// Whether a board that its boot loader calls so has this chip.
    pub(crate) fn is_of(&self, board_id: &str) -> bool {
        board_id.starts_with(self.board_id)
    }
}

/// All families.
const FAMILIES: [Family; 3] = [
    Family {
        id: 0xE48B_FF56,
        board_id: "RPI-RP2",
        chip: "RP2040",
        flash: 0x1000_0000,
        has_partitions: false,
    },
    Family {
        id: 0xE48B_FF59,
        board_id: "RP2350",
        chip: "RP2350",
        flash: 0x1000_0000,
        has_partitions: true,
    },
    // The boot loader that Adafruit wrote, on boards of several makers: `nRF52840-Feather-revD`.
    Family {
        id: 0xADA5_2840,
        board_id: "nRF52840-",
        chip: "nRF52840",
        flash: 0,
        has_partitions: false,
    },
];

/// The family of blocks that ignore partitions.
const ABSOLUTE: u32 = 0xE48B_FF57;
/// The last page of the largest flash, where such a block does no harm.
const LAST_PAGE: u32 = 0x10FF_FF00;
/// The extension that has a boot ROM skip a block.
const SKIPPED: u32 = 0x9957_E304;

const PAGE_BYTES: usize = 256;
const SECTOR_BYTES: u32 = 4096;
const BLOCK_BYTES: usize = 512;
/// The size of what is before the payload of a block.
const HEAD_BYTES: usize = 32;

const HAS_FAMILY: u32 = 0x2000;
const HAS_EXTENSIONS: u32 = 0x8000;

type Page = [u8; PAGE_BYTES];

/// The family that a project names.
pub(crate) fn family(id: u32) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.id == id)
}

/// The chip of a boot loader's drive; `None` if it is of another make.
pub(crate) fn chip(board_id: &str) -> Option<&'static str> {
    FAMILIES.iter().find(|family| family.is_of(board_id)).map(|family| family.chip)
}

/// The UF2 file of a program.
///
/// # Errors
///
/// If the ELF file cannot be read, or has something outside of the flash.
pub(crate) fn of_elf(elf: &[u8], family: &Family) -> Result<Vec<u8>> {
    let mut pages = pages(elf, family.flash)?;
    fill_sectors(&mut pages);
    let mut bytes = Vec::new();
    if family.has_partitions {
        let filler = [0xEF; PAGE_BYTES];
        let flags = HAS_FAMILY | HAS_EXTENSIONS;
        // It counts as the first of two, as in the files of Raspberry Pi's converter.
        let head = Head { flags, address: LAST_PAGE, number: 0, count: 2, family: ABSOLUTE };
        push(&mut bytes, &head, &filler, &SKIPPED.to_le_bytes());
    }
    let count = u32::try_from(pages.len())?;
    for (number, (address, page)) in (0..).zip(&pages) {
        let head = Head { flags: HAS_FAMILY, address: *address, number, count, family: family.id };
        push(&mut bytes, &head, page, &[]);
    }
    Ok(bytes)
}

/// The pages of the flash that a program has something in, by address.
fn pages(elf: &[u8], flash: u64) -> Result<BTreeMap<u32, Page>> {
    let mut pages = BTreeMap::new();
    for (begin, data) in raw::parts(elf)? {
        let end = begin + data.len() as u64;
        if begin < flash || end > flash + FLASH_BYTES_MAX {
            bail!("{begin:#010x} to {end:#010x} is not in the flash");
        }
        for (address, byte) in (u32::try_from(begin)?..).zip(data) {
            let at = address as usize % PAGE_BYTES;
            let page: &mut Page = pages.entry(address - at as u32).or_insert([ERASED; PAGE_BYTES]);
            if let Some(place) = page.get_mut(at) {
                *place = *byte;
            }
        }
    }
    Ok(pages)
}

/// Adds the pages that are missing in sectors, up to the last one that is there.
fn fill_sectors(pages: &mut BTreeMap<u32, Page>) {
    let Some(last) = pages.last_key_value().map(|(address, _)| *address) else { return };
    let sectors: Vec<u32> = pages.keys().map(|address| address - address % SECTOR_BYTES).collect();
    for sector in sectors {
        for address in (sector..last.min(sector + SECTOR_BYTES)).step_by(PAGE_BYTES) {
            pages.entry(address).or_insert([ERASED; PAGE_BYTES]);
        }
    }
}

/// What a block says of itself.
struct Head {
    flags: u32,
    address: u32,
    number: u32,
    count: u32,
    family: u32,
}

/// Adds a block.
fn push(bytes: &mut Vec<u8>, head: &Head, page: &Page, extension: &[u8]) {
    let Head { flags, address, number, count, family } = *head;
    let begin = bytes.len();
    let words =
        [0x0A32_4655, 0x9E5D_5157, flags, address, PAGE_BYTES as u32, number, count, family];
    for word in words {
        bytes.extend(u32::to_le_bytes(word));
    }
    debug_assert_eq!(bytes.len(), begin + HEAD_BYTES);
    bytes.extend(page);
    bytes.extend(extension);
    bytes.resize(begin + BLOCK_BYTES - 4, 0);
    bytes.extend(0x0AB1_6F30_u32.to_le_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An ELF file that loads these parts.
    fn elf(parts: &[(u32, &[u8])]) -> Vec<u8> {
        let mut file = vec![0x7F, b'E', b'L', b'F', 1, 1, 1];
        file.resize(0x34 + 0x20 * parts.len(), 0);
        let mut words = vec![(0x10, 0x0028_0002), (0x1C, 0x34), (0x28, 0x0020_0034)];
        words.push((0x2C, u32::try_from(parts.len()).unwrap()));
        for (index, (address, data)) in parts.iter().enumerate() {
            let (at, size) = (file.len() as u32, data.len() as u32);
            let head = [1, at, 0, *address, size, size];
            words.extend(
                (0..).zip(head).map(|(word, value)| (0x34 + 0x20 * index + 4 * word, value)),
            );
            file.extend(*data);
        }
        for (at, value) in words {
            file[at..at + 4].copy_from_slice(&value.to_le_bytes());
        }
        file
    }

    /// The eight words at the head of a block.
    fn words(block: &[u8]) -> Vec<u32> {
        let word = |bytes: &[u8]| u32::from_le_bytes(bytes.try_into().unwrap());
        block[..32].chunks(4).map(word).collect()
    }

    #[test]
    fn a_program_is_cut_into_pages() {
        let program: Vec<u8> = (0..=255).chain(0..44).collect();
        let file = of_elf(&elf(&[(0x1000_0000, &program)]), &FAMILIES[0]).unwrap();
        assert_eq!(file.len(), 2 * 512);
        let (first, second) = file.split_at(512);
        let head = |address, number| {
            vec![0x0A32_4655, 0x9E5D_5157, 0x2000, address, 256, number, 2, 0xE48B_FF56]
        };
        assert_eq!(words(first), head(0x1000_0000, 0));
        assert_eq!(words(second), head(0x1000_0100, 1));
        assert_eq!(first[32..288], program[..256]);
        assert_eq!(second[32..76], program[256..]);
        assert!(second[76..288].iter().all(|byte| *byte == 0xFF));
        assert!(second[288..508].iter().all(|byte| *byte == 0));
        assert_eq!(second[508..], [0x30, 0x6F, 0xB1, 0x0A]);
    }

    #[test]
    fn a_program_behind_a_boot_loader_stays_there() {
        let family = family(0xADA5_2840).unwrap();
        let file = of_elf(&elf(&[(0x0002_6000, &[7; 300])]), family).unwrap();
        let addresses: Vec<u32> = file.chunks(512).map(|block| words(block)[3]).collect();
        assert_eq!(addresses, [0x0002_6000, 0x0002_6100]);
        assert_eq!(words(&file)[7], 0xADA5_2840);
        assert_eq!(chip("nRF52840-Feather-revD"), Some("nRF52840"));
        assert!(of_elf(&elf(&[(0x1000_0000, &[7])]), family).is_err());
    }

    #[test]
    fn a_sector_that_is_touched_is_whole_unless_it_is_the_last() {
        let parts = [(0x1000_0110, &[1_u8; 16][..]), (0x1000_4200, &[2; 16])];
        let file = of_elf(&elf(&parts), &FAMILIES[0]).unwrap();
        let addresses: Vec<u32> = file.chunks(512).map(|block| words(block)[3]).collect();
        let first = (0..16).map(|page| 0x1000_0000 + 256 * page);
        let last = (0..3).map(|page| 0x1000_4000 + 256 * page);
        assert_eq!(addresses, first.chain(last).collect::<Vec<u32>>());
        assert_eq!(file[512 + 32 + 16..][..16], [1; 16]);
        assert_eq!(file[512 + 32..][..16], [0xFF; 16]);
    }

    #[test]
    fn a_program_for_rp2350_has_a_block_before_it() {
        let file = of_elf(&elf(&[(0x1000_0000, &[7; 256])]), &FAMILIES[1]).unwrap();
        assert_eq!(file.len(), 2 * 512);
        let absolute = [0x0A32_4655, 0x9E5D_5157, 0xA000, 0x10FF_FF00, 256, 0, 2, 0xE48B_FF57];
        assert_eq!(words(&file), absolute);
        assert_eq!(file[288..292], [0x04, 0xE3, 0x57, 0x99]);
        assert_eq!(words(&file[512..])[5..], [0, 1, 0xE48B_FF59]);
    }

    #[test]
    fn what_is_not_in_the_flash_is_refused() {
        let refused = |address| of_elf(&elf(&[(address, &[0; 4])]), &FAMILIES[0]).unwrap_err();
        assert!(refused(0x2000_0000).to_string().contains("0x20000000 to 0x20000004"));
        assert!(refused(0x0800_0000).to_string().contains("not in the flash"));
        assert!(refused(0x10FF_FFFE).to_string().contains("not in the flash"));
        assert!(of_elf(b"no ELF file", &FAMILIES[0]).is_err());
        assert!(of_elf(&elf(&[]), &FAMILIES[0]).is_err());
    }
}
