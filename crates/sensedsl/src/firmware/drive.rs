//! Drives that take a program as a file: that of the boot loader of RP2040 and RP2350, and that of an ST-LINK.
//!
//! In: the folders at which volumes are mounted. Out: the drives among them, and whether one is a board's.

use std::path::{Path, PathBuf};

use super::Program;
use super::uf2;
use crate::files::read_if_there;

/// Folders that are looked at in place of the mounted volumes.
const VARIABLE: &str = "SENSEDSL_DRIVES";
/// The size that no text on such a drive exceeds.
const TEXT_BYTES_MAX: u64 = 64 << 10;
/// How the names of an ST-LINK's drives begin; the MCU follows.
const ST_LINKS: [&str; 3] = ["NODE_", "NOD_", "DIS_"];
/// The letters and digits of a part number that say the line, the pins and the flash: `F401RE`.
const PART_LETTERS: usize = "F401RE".len();

/// A drive that takes programs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Drive {
    /// The folder at which it is mounted.
    pub(crate) path: PathBuf,
    make: Make,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Make {
    /// A boot loader that takes UF2 files, with what it calls its board.
    Uf2(String),
    /// An ST-LINK, which takes raw bytes, with the part that the drive is named after.
    StLink(Option<String>),
}

impl Drive {
    /// The drive that is mounted at a folder; `None` if it takes no programs.
    pub(crate) fn at(path: &Path) -> Option<Self> {
        let text = |name: &str| {
            let file = path.join(name);
            std::fs::metadata(&file).ok().filter(|found| found.len() <= TEXT_BYTES_MAX)?;
            let bytes = read_if_there(&file).ok().flatten()?;
            Some(String::from_utf8_lossy(&bytes).into_owned())
        };
        let make = if let Some(info) = text("INFO_UF2.TXT") {
            Make::Uf2(board_id(&info)?)
        } else {
            // Probes of other makes have these files as well.
            let details = text("MBED.HTM").and_then(|_| text("DETAILS.TXT"))?;
            if details.contains("DAPLink") {
                return None;
            }
            Make::StLink(part(path))
        };
        Some(Self { path: path.to_path_buf(), make })
    }

    /// Whether it is that of a board with this program's MCU, as far as it tells.
    pub(crate) fn suits(&self, program: &Program) -> bool {
        match (&self.make, program.build.family()) {
            (Make::Uf2(board_id), Some(family)) => family.is_of(board_id),
            (Make::StLink(part), None) => {
                let line = program.mcu.as_deref().and_then(|mcu| mcu.strip_prefix("STM32"));
                let (Some(part), Some(line)) = (part, line) else { return true };
                line.starts_with(part.get(..PART_LETTERS).unwrap_or(part))
            }
            (Make::Uf2(_), None) | (Make::StLink(_), Some(_)) => false,
        }
    }

    /// What it belongs to, in words: `an RP2040`.
    pub(crate) fn owner(&self) -> String {
        match &self.make {
            Make::Uf2(board_id) => match uf2::chip(board_id) {
                Some(chip) => format!("an {chip}"),
                None => format!("a board that calls itself `{board_id}`"),
            },
            Make::StLink(Some(part)) => format!("an ST-LINK with an STM32{part}"),
            Make::StLink(None) => "an ST-LINK".to_owned(),
        }
    }
}

/// What the boot loader calls its board: `RPI-RP2`.
fn board_id(info: &str) -> Option<String> {
    let id = info.lines().find_map(|line| line.strip_prefix("Board-ID:"))?;
    Some(id.trim().to_owned())
}

/// The part that an ST-LINK's drive is named after: `F401RE`. Windows does not tell the name.
fn part(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let part = ST_LINKS.iter().find_map(|begin| name.strip_prefix(begin))?;
    Some(part.to_owned())
}

/// All drives that take programs.
pub(crate) fn mounted() -> Vec<Drive> {
    let folders = match std::env::var_os(VARIABLE) {
        Some(named) => std::env::split_paths(&named).collect(),
        None => volumes(),
    };
    folders.iter().filter_map(|folder| Drive::at(folder)).collect()
}

/// The folders at which volumes are mounted, as far as they can be such drives.
fn volumes() -> Vec<PathBuf> {
    if cfg!(windows) {
        // A and B wait for a disk, C is the system's.
        return ('D'..='Z').map(|letter| PathBuf::from(format!("{letter}:\\"))).collect();
    }
    if cfg!(target_os = "macos") {
        return entries(Path::new("/Volumes"));
    }
    let mounts = read_if_there(Path::new("/proc/mounts")).ok().flatten().unwrap_or_default();
    of_mounts(&String::from_utf8_lossy(&mounts))
}

/// The entries of a folder, in the order of their names.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let found = std::fs::read_dir(folder).into_iter().flatten();
    let mut found: Vec<PathBuf> = found.filter_map(|entry| Some(entry.ok()?.path())).collect();
    found.sort();
    found
}

/// The folders with a FAT file system, of the table that Linux keeps: one from a network could hang.
fn of_mounts(table: &str) -> Vec<PathBuf> {
    let folder = |line: &str| {
        let mut cells = line.split(' ').skip(1);
        let (folder, kind) = (cells.next()?, cells.next()?);
        matches!(kind, "vfat" | "msdos").then(|| PathBuf::from(unescaped(folder)))
    };
    table.lines().filter_map(folder).collect()
}

/// A cell of that table: spaces and the like are octal numbers in it.
fn unescaped(cell: &str) -> String {
    let codes = [("\\040", " "), ("\\011", "\t"), ("\\012", "\n"), ("\\134", "\\")];
    codes.iter().fold(cell.to_owned(), |cell, (code, is)| cell.replace(code, is))
}

/// The name of such a drive that Linux sees and has not mounted.
pub(crate) fn not_mounted() -> Option<String> {
    if std::env::var_os(VARIABLE).is_some() {
        return None;
    }
    let labels = entries(Path::new("/dev/disk/by-label")).into_iter();
    let mut names = labels.filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()));
    names.find(|name| {
        uf2::chip(name).is_some() || ST_LINKS.iter().any(|begin| name.starts_with(begin))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::firmware::Build;

    #[test]
    fn boot_loaders_say_what_they_are() {
        let info = "UF2 Bootloader v3.0\r\nModel: Raspberry Pi RP2\r\nBoard-ID: RPI-RP2\r\n";
        assert_eq!(board_id(info).as_deref(), Some("RPI-RP2"));
        assert_eq!(board_id("UF2 Bootloader\n"), None);
    }

    #[test]
    fn only_drives_of_the_machine_are_looked_at() {
        let table = "/dev/sda1 / ext4 rw 0 0\n\
                     /dev/sdb1 /media/me/RPI-RP2 vfat rw,nosuid 0 0\n\
                     nas:/all /media/me/far nfs rw 0 0\n\
                     /dev/sdc /run/media/me/My\\040Board vfat rw 0 0\n";
        let found: Vec<PathBuf> =
            ["/media/me/RPI-RP2", "/run/media/me/My Board"].map(PathBuf::from).into();
        assert_eq!(of_mounts(table), found);
    }

    #[test]
    fn an_st_link_is_named_after_its_mcu() {
        let suits = |drive: &str, mcu: Option<&str>| {
            let path = PathBuf::from(drive);
            let make = Make::StLink(part(&path));
            let program = Program {
                board: "B".to_owned(),
                folder: PathBuf::new(),
                mcu: mcu.map(str::to_owned),
                ready: None,
                build: Build::Make(super::super::Wants::default()),
            };
            Drive { path, make }.suits(&program)
        };
        assert!(suits("/media/me/NODE_F401RE", Some("STM32F401RET6")));
        assert!(suits("/media/me/NOD_H743ZI2", Some("STM32H743ZIT6")));
        assert!(suits("/media/me/NODE_L552ZE", Some("STM32L552ZET6Q")));
        assert!(suits("/media/me/NODE_F401RE", None));
        assert!(suits("/mnt", Some("STM32F401RET6")));
        assert!(!suits("/media/me/NODE_F401RE", Some("STM32F411RET6")));
        assert!(!suits("/media/me/NODE_L432KC", Some("STM32L432RCT6")));
    }
}
