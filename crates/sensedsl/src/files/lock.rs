//! One writer at a time: a lock that ends with the process that holds it, however that ends.
//!
//! The lock is held on a file in a folder of its own, and both are removed when it is given back.
//! Whoever waited for a file that is gone by then begins anew, so no two hold one lock.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// The file in the folder.
pub(super) const NAME: &str = "lock";

/// How often a lock that another holds is tried.
const PAUSE: Duration = Duration::from_millis(10);

/// How long a run waits for another before it says so.
const SILENT: Duration = Duration::from_millis(300);

/// How long a run waits: far longer than any other writes.
pub(crate) const WAIT: Duration = Duration::from_secs(30);

/// A lock that is held; dropping it gives it back.
#[derive(Debug)]
pub(crate) struct Lock {
    folder: PathBuf,
    /// None where the file system has no locks.
    _file: Option<File>,
}

/// Why there is no lock.
#[derive(Debug)]
pub(crate) enum NoLock {
    /// Another process holds it.
    Busy,
    /// The folder cannot be made.
    Failed(io::Error),
    /// What stands there was not made by a run.
    Strange(PathBuf),
}

impl From<io::Error> for NoLock {
    fn from(error: io::Error) -> Self {
        Self::Failed(error)
    }
}

impl Lock {
    /// Takes the lock of a folder, which is made for it. `waiting` is called once when that takes
    /// longer than a moment.
    pub(crate) fn take(
        folder: &Path,
        wait: Duration,
        waiting: &mut dyn FnMut(),
    ) -> Result<Self, NoLock> {
        let began = Instant::now();
        let mut said = false;
        loop {
            if let Some(lock) = Self::try_take(folder)? {
                return Ok(lock);
            }
            let waited = began.elapsed();
            if waited >= wait {
                return Err(NoLock::Busy);
            }
            if waited >= SILENT && !said {
                waiting();
                said = true;
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
            // Who held it has removed it just now.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error.into()),
            // A link leads to somebody else's folder.
            Ok(found) if !found.is_dir() => return Err(NoLock::Strange(folder.to_path_buf())),
            Ok(_) => {}
        }
        let path = folder.join(NAME);
        let file = match open(&path) {
            // Who held it has removed the folder just now.
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
            // A file system without locks: better one that writes than none.
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
        // Where a file that is open cannot be told from another, it stays, and so does the folder.
        if cfg!(unix) {
            // Leftovers are found and used by the next run.
            let _ = fs::remove_file(self.folder.join(NAME));
        }
        // Not empty where something is left for the next run to complete.
        let _ = fs::remove_dir(&self.folder);
    }
}

/// Opens the file of a lock: never what a link leads to, and without waiting for a pipe's reader.
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

/// Whether something stands there that is not a file.
fn is_strange(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| !found.is_file())
}

/// Whether the file is still the one of that name.
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
