//! The machine's memory of the folders that it has written: a key, and a record of each folder's
//! list.
//!
//! An output folder may be a stranger's: cloned, unpacked, pulled. Nothing in it can prove that a
//! run on this machine left it, except a code that only this machine can compute. The key is in the
//! user's state folder, where nobody else can read it, and so is a record of each folder's list.
//! Both codes depend on the folder's inode, so that a folder may be moved, whereas a copy belongs
//! to nobody.
//!
//! Without a place for the key, each run has a key of its own: it writes just as safely, but the
//! next run refuses what a killed one has left.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use sha2::{Digest as _, Sha256};

/// The length of the key.
const KEY_BYTES: usize = 32;

/// The block size of SHA-256.
const BLOCK_BYTES: usize = 64;

/// The most folders that are remembered; beyond that, those written longest ago are forgotten.
const FOLDERS_MAX: usize = 4_096;

/// The subfolder of the state folder with a record of each output folder.
const FOLDERS: &str = "folders";

/// The machine's memory.
#[derive(Debug)]
pub(crate) struct State {
    /// `None` if there is no place that only the user can access.
    place: Option<PathBuf>,
    key: [u8; KEY_BYTES],
}

impl State {
    /// The memory of this user on this machine.
    pub(crate) fn of_user() -> &'static Self {
        static STATE: OnceLock<State> = OnceLock::new();
        STATE.get_or_init(|| {
            // Tests of this crate leave no traces, and every test runs as the same machine.
            if cfg!(test) {
                return Self { place: None, key: [7; KEY_BYTES] };
            }
            Self::at(places())
        })
    }

    fn at(places: Vec<PathBuf>) -> Self {
        let found = places.into_iter().find_map(|place| Some((key(&place).ok()?, place)));
        match found {
            Some((key, place)) => Self { place: Some(place), key },
            None => Self { place: None, key: random() },
        }
    }

    /// The code that a run leaves in a folder of its own, so that the next run trusts its contents.
    pub(crate) fn seal(&self, folder: &Path) -> io::Result<String> {
        Ok(self.code(&[b"work", identity(folder)?.as_bytes()]))
    }

    /// Whether this machine wrote that list into that folder.
    pub(crate) fn knows(&self, folder: &Path, list: &[u8]) -> bool {
        let Some((record, text)) = self.record(folder, list) else { return false };
        fs::read(record).is_ok_and(|found| found == text.as_bytes())
    }

    /// Remembers that this machine wrote that list into that folder. If it cannot, the contents of
    /// the files must prove whose they are.
    pub(crate) fn remember(&self, folder: &Path, list: &[u8]) {
        let Some((record, text)) = self.record(folder, list) else { return };
        let Some(above) = record.parent() else { return };
        if private_folder(above).is_ok() && !self.knows(folder, list) {
            forget_some(above);
            let _ = super::write_whole(&record, text.as_bytes());
        }
    }

    /// The path of a folder's record, and the text in it.
    fn record(&self, folder: &Path, list: &[u8]) -> Option<(PathBuf, String)> {
        let (place, id) = (self.place.as_ref()?, identity(folder).ok()?);
        let name = self.code(&[b"folder", id.as_bytes()]);
        let text = self.code(&[b"list", id.as_bytes(), list]);
        Some((place.join(FOLDERS).join(name), text))
    }

    /// The code of some texts, each preceded by its length.
    fn code(&self, texts: &[&[u8]]) -> String {
        let mut all = Vec::new();
        for text in texts {
            all.extend((text.len() as u64).to_be_bytes());
            all.extend(*text);
        }
        hmac(&self.key, &all)
    }
}

/// HMAC-SHA-256 (RFC 2104).
fn hmac(key: &[u8; KEY_BYTES], text: &[u8]) -> String {
    let pad = |with: u8| {
        let mut block = [with; BLOCK_BYTES];
        block.iter_mut().zip(key).for_each(|(byte, key)| *byte ^= key);
        block
    };
    let inner = Sha256::new().chain_update(pad(0x36)).chain_update(text).finalize();
    hex(&Sha256::new().chain_update(pad(0x5c)).chain_update(inner).finalize())
}

/// The SHA-256 of a file's contents, as `sha256sum` prints it.
pub(crate) fn digest(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A text that stays the same when a folder is moved, but not when it is copied.
#[cfg(unix)]
fn identity(folder: &Path) -> io::Result<String> {
    use std::os::unix::fs::MetadataExt as _;
    let found = fs::metadata(folder)?;
    // The inode number of a removed folder is used again.
    let born =
        found.created().ok().and_then(|time| time.duration_since(std::time::UNIX_EPOCH).ok());
    Ok(format!("{} {}", found.ino(), born.unwrap_or_default().as_nanos()))
}

#[cfg(not(unix))]
fn identity(folder: &Path) -> io::Result<String> {
    Ok(fs::canonicalize(folder)?.display().to_string())
}

/// The possible places for state, the best one first.
fn places() -> Vec<PathBuf> {
    // A relative path would be in somebody's project.
    let variable =
        |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let mut places: Vec<PathBuf> = variable("XDG_STATE_HOME").into_iter().collect();
    places.extend(variable("HOME").map(|home| home.join(".local/state")));
    if cfg!(windows) {
        places.extend(variable("LOCALAPPDATA"));
    }
    // Containers often have no home.
    #[cfg(unix)]
    let shared = Some(format!("/var/tmp/sensedsl-{}", rustix::process::geteuid().as_raw()).into());
    #[cfg(not(unix))]
    let shared: Option<PathBuf> = None;
    places.iter().map(|place| place.join("sensedsl")).chain(shared).collect()
}

/// The key in a folder, created if there is none.
fn key(place: &Path) -> io::Result<[u8; KEY_BYTES]> {
    private_folder(place)?;
    let path = place.join("key");
    match read_key(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        found => return found,
    }
    // If two runs create it at once, the first one wins, and both use its key.
    let part = place.join(format!("key-{}", std::process::id()));
    let _ = fs::remove_file(&part);
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(&part)?;
    let made = file.write_all(&random()).and_then(|()| file.sync_all());
    let linked = made.and_then(|()| fs::hard_link(&part, &path));
    let _ = fs::remove_file(&part);
    match linked {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => read_key(&path),
    }
}

/// Reads a key that others could neither read nor have put there.
fn read_key(path: &Path) -> io::Result<[u8; KEY_BYTES]> {
    let found = fs::symlink_metadata(path)?;
    if !found.is_file() || found.len() != KEY_BYTES as u64 || !is_private(&found, 0o077) {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let mut key = [0; KEY_BYTES];
    File::open(path)?.read_exact(&mut key)?;
    Ok(key)
}

/// Makes or finds a folder that only the user can access.
fn private_folder(path: &Path) -> io::Result<()> {
    if let Some(above) = path.parent() {
        fs::create_dir_all(above)?;
    }
    match private_builder().create(path) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
        Ok(()) | Err(_) => {}
    }
    let found = fs::symlink_metadata(path)?;
    let is_own = found.is_dir() && is_private(&found, 0o022);
    if is_own { Ok(()) } else { Err(io::ErrorKind::PermissionDenied.into()) }
}

/// What makes folders for the user alone, where the system lets a program say so.
fn private_builder() -> fs::DirBuilder {
    #[cfg(unix)]
    {
        let mut builder = fs::DirBuilder::new();
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder
    }
    #[cfg(not(unix))]
    fs::DirBuilder::new()
}

/// Whether something belongs to the user, and gives others none of these permissions.
#[cfg(unix)]
fn is_private(found: &fs::Metadata, others: u32) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    found.uid() == rustix::process::geteuid().as_raw() && found.mode() & others == 0
}

#[cfg(not(unix))]
fn is_private(_: &fs::Metadata, _: u32) -> bool {
    true
}

/// Removes the oldest records if there are very many.
fn forget_some(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut records: Vec<_> = entries
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    if records.len() >= FOLDERS_MAX {
        records.sort();
        for (_, record) in records.iter().take(FOLDERS_MAX / 4) {
            let _ = fs::remove_file(record);
        }
    }
}

/// Bytes that nobody can guess: from the system's random source, or from the seeds of hash tables.
fn random() -> [u8; KEY_BYTES] {
    use std::hash::{BuildHasher as _, Hasher as _, RandomState};
    let mut key = [0; KEY_BYTES];
    let read = File::open("/dev/urandom").and_then(|mut source| source.read_exact(&mut key));
    if read.is_err() {
        let mut seeds = Sha256::new();
        for _ in 0..KEY_BYTES {
            seeds.update(RandomState::new().build_hasher().finish().to_be_bytes());
        }
        key = seeds.finalize().into();
    }
    key
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_those_of_rfc_4231() {
        // The second case. Its key is shorter than ours, and HMAC pads keys with zeros.
        let mut key = [0; KEY_BYTES];
        key[..4].copy_from_slice(b"Jefe");
        let code = "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843";
        assert_eq!(hmac(&key, b"what do ya want for nothing?"), code);
    }

    #[cfg(unix)]
    #[test]
    fn a_key_that_others_could_have_put_there_is_not_taken() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = std::env::temp_dir().join(format!("sensedsl-state-{}", std::process::id()));
        let place = folder.join("sensedsl");
        let state = State::at(vec![place.clone()]);
        assert_eq!(state.place.as_deref(), Some(place.as_path()));
        assert_eq!(State::at(vec![place.clone()]).key, state.key);
        state.remember(&folder, b"list");
        assert!(state.knows(&folder, b"list") && !state.knows(&folder, b"other"));
        assert!(!state.knows(&place, b"list"), "it is of one folder");
        fs::set_permissions(place.join("key"), fs::Permissions::from_mode(0o644)).unwrap();
        let other = State::at(vec![place.clone()]);
        assert!(other.place.is_none() && other.key != state.key);
        assert!(!other.knows(&folder, b"list"));
        fs::remove_dir_all(folder).unwrap();
    }
}
