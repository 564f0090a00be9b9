//! One writer at a time: a lock that ends with the process that holds it, however that process
//! ends.
//!
//! The lock is held on a file in a folder of its own, and both are removed when it is released. A
//! process that waited for a file which is gone by then starts again, so no two processes hold the
//! same lock.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// The name of the file in the folder.
pub(super) const NAME: &str = "lock";

/// The interval at which a lock held by another process is tried.
const PAUSE: Duration = Duration::from_millis(10);

/// How long a run waits for another before it says so.
const SILENT: Duration = Duration::from_millis(300);

/// How long a run waits: far longer than any other takes to write.
pub(crate) const WAIT: Duration = Duration::from_secs(30);

/// A lock that is held; dropping it releases it.
#[derive(Debug)]
pub(crate) struct Lock {
    folder: PathBuf,
    /// `None` if the file system has no locks.
    _file: Option<File>,
}

/// The reason why there is no lock.
#[derive(Debug)]
pub(crate) enum NoLock {
    /// Another process holds it.
    Busy,
    /// The folder cannot be made.
    Failed(io::Error),
    /// The entry at that path was not made by a run.
    Strange(PathBuf),
}

impl From<io::Error> for NoLock {
    fn from(error: io::Error) -> Self {
        Self::Failed(error)
    }
}

impl Lock {
    /// Takes the lock of a folder, which is created for it. `waiting` is called once if this takes
    /// longer than a moment.
    pub(crate) fn take(
        folder: &Path,
        wait: Duration,
        waiting: &mut dyn FnMut(),
    ) -> Result<Self, NoLock> {
        let began = Instant::now();
        let mut reported = false;
        loop {
            if let Some(lock) = Self::try_take(folder)? {
                return Ok(lock);
            }
            let waited = began.elapsed();
            if waited >= wait {
                return Err(NoLock::Busy);
            }
            if waited >= SILENT && !reported {
                waiting();
                reported = true;
            }
            thread::sleep(PAUSE);
        }
    }

    fn try_take(folder: &Path) -> Result<Option<Self>, NoLock> {
        match fs::create_dir(folder) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error.into()),
            Ok(()) | Err(_) => {}
        }
        match fs::symlink_metadata(folder) {
            // The process that held it has just removed it.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error.into()),
            // A link leads to somebody else's folder.
            Ok(found) if !found.is_dir() => return Err(NoLock::Strange(folder.to_path_buf())),
            Ok(_) => {}
        }
        let path = folder.join(NAME);
        let file = match open(&path) {
            // The process that held it has just removed the folder.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(_) if is_strange(&path) => return Err(NoLock::Strange(path)),
            file => file?,
        };
        if !file.metadata()?.is_file() {
            return Err(NoLock::Strange(path));
        }
        let file = match file.try_lock() {
            Ok(()) => Some(file),
            Err(TryLockError::WouldBlock) => return Ok(None),
            // On a file system without locks, writing unlocked is better than not writing.
            Err(TryLockError::Error(_)) => None,
        };
        if file.as_ref().is_some_and(|file| !is_at(file, &path)) {
            return Ok(None);
        }
        Ok(Some(Self { folder: folder.to_path_buf(), _file: file }))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Where an open file cannot be told from another, it stays, and so does the folder.
        if cfg!(unix) {
            // Leftovers are found and used by the next run.
            let _ = fs::remove_file(self.folder.join(NAME));
        }
        // The folder is not empty if something is left for the next run to complete.
        let _ = fs::remove_dir(&self.folder);
    }
}

/// Opens the file of a lock, without following a link, and without waiting for a pipe's reader.
fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.create(true).truncate(false).write(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        let flags = rustix::fs::OFlags::NOFOLLOW | rustix::fs::OFlags::NONBLOCK;
        options.custom_flags(flags.bits().cast_signed());
    }
    options.open(path)
}

/// Whether the entry at a path is not a file.
fn is_strange(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| !found.is_file())
}

/// Whether the file is still the one with that name.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let id = |found: fs::Metadata| (found.dev(), found.ino());
    let (Ok(own), Ok(there)) = (file.metadata(), fs::symlink_metadata(path)) else { return false };
    id(own) == id(there)
}

#[cfg(not(unix))]
pub(super) fn is_at(_: &File, _: &Path) -> bool {
    true
}
