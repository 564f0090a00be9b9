//! All changes to the names in a folder, with a method for each, and a way to make changes durable.
//!
//! A tree is written only through [`Ops`], so that a test can stop after any single change, as a
//! kill does, or let any single one fail, as a full disk does.

use crate::files::shown;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::thread;

/// The number of threads that wait for the disk: syncing many small files together takes no longer
/// than one of them.
const SYNCING_MAX: usize = 8;

/// The changes to a folder.
#[derive(Debug, Default)]
pub(crate) struct Ops {
    #[cfg(test)]
    pub(crate) fault: super::fault::Fault,
}

impl Ops {
    #[cfg_attr(not(test), expect(clippy::unused_self, reason = "only tests let a change fail"))]
    fn may(&self) -> io::Result<()> {
        #[cfg(test)]
        self.fault.strike()?;
        Ok(())
    }

    /// Writes a new file, with the permissions and the owner of the file `like`.
    pub(crate) fn create(&self, path: &Path, bytes: &[u8], like: Option<&Path>) -> io::Result<()> {
        self.may()?;
        let write = || {
            let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
            // A kill can come while a file is being written.
            self.may()?;
            file.write_all(bytes)?;
            like.and_then(|like| fs::metadata(like).ok())
                .map_or(Ok(()), |old| resemble(&file, &old))
        };
        write().map_err(at(path))
    }

    /// Makes a folder, and those above it; none of them may be a file.
    pub(crate) fn make_folders(&self, path: &Path) -> io::Result<()> {
        if path.is_dir() {
            return Ok(());
        }
        if let Some(above) = path.parent() {
            self.make_folders(above)?;
        }
        self.may()?;
        fs::create_dir(path).map_err(at(path))
    }

    /// Gives a file a second name.
    #[cfg_attr(
        not(target_os = "linux"),
        allow(dead_code, reason = "only Linux exchanges two names at once")
    )]
    pub(crate) fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.may()?;
        fs::hard_link(from, to).map_err(at(to))
    }

    /// Makes a symbolic link that leads to `target`.
    #[cfg(target_os = "linux")]
    pub(crate) fn symlink(&self, target: &Path, path: &Path) -> io::Result<()> {
        self.may()?;
        std::os::unix::fs::symlink(target, path).map_err(at(path))
    }

    /// Renames a file or folder; an existing file is replaced.
    pub(crate) fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.may()?;
        fs::rename(from, to).map_err(at(to))
    }

    /// Exchanges two names: the one moment at which a tree is replaced by another.
    #[cfg(target_os = "linux")]
    pub(crate) fn exchange(&self, one: &Path, other: &Path) -> io::Result<()> {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        self.may()?;
        renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)
            .map_err(|error| at(one)(error.into()))
    }

    /// Removes a file or a symbolic link; it may already be gone.
    pub(crate) fn remove_file(&self, path: &Path) -> io::Result<()> {
        self.may()?;
        unless_gone(fs::remove_file(path)).map_err(at(path))
    }

    /// Removes an empty folder; it may already be gone.
    pub(crate) fn remove_folder(&self, path: &Path) -> io::Result<()> {
        self.may()?;
        unless_gone(fs::remove_dir(path)).map_err(at(path))
    }

    /// Removes one of the program's own folders with everything in it; it may already be gone.
    pub(crate) fn remove_all(&self, path: &Path) -> io::Result<()> {
        self.may()?;
        unless_gone(fs::remove_dir_all(path)).map_err(at(path))
    }
}

/// Adds the path to an error, and keeps the kind of failure.
fn at(path: &Path) -> impl FnOnce(io::Error) -> io::Error {
    move |error| {
        let kind =
            if is_unsupported_call(&error) { io::ErrorKind::Unsupported } else { error.kind() };
        io::Error::new(kind, format!("{}: {error}", shown(path)))
    }
}

fn unless_gone(removed: io::Result<()>) -> io::Result<()> {
    match removed {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        done => done,
    }
}

/// Gives a new file the permissions of the file that it replaces, and its owner if that is allowed.
pub(crate) fn resemble(file: &File, old: &fs::Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt as _, fchown};
        let new = file.metadata()?;
        if (new.uid(), new.gid()) != (old.uid(), old.gid()) {
            // Only root may give files away: any other user who rewrites a file owns the new one.
            let _ = fchown(file, Some(old.uid()), Some(old.gid()));
        }
    }
    if old.is_file() { file.set_permissions(old.permissions()) } else { Ok(()) }
}

/// Waits until files and folders are on disk.
pub(crate) fn sync(paths: &[PathBuf]) -> io::Result<()> {
    // A test of the order of changes makes thousands of them, and does not cover power failures.
    if cfg!(test) {
        return Ok(());
    }
    let share = paths.len().div_ceil(SYNCING_MAX).max(1);
    thread::scope(|scope| {
        let threads: Vec<_> = paths
            .chunks(share)
            .map(|share| scope.spawn(|| share.iter().try_for_each(|path| sync_one(path))))
            .collect();
        let mut result = Ok(());
        for thread in threads {
            let done = thread.join().unwrap_or_else(|_| Err(io::Error::other("a thread died")));
            result = result.and(done);
        }
        result
    })
}

fn sync_one(path: &Path) -> io::Result<()> {
    // Windows does not open folders, and keeps their changes by itself.
    if !cfg!(unix) && path.is_dir() {
        return Ok(());
    }
    match File::open(path)?.sync_all() {
        // Some file systems have nothing to wait for, and report that for folders.
        Err(error) if is_unsupported(&error) => Ok(()),
        done => done,
    }
}

/// Whether the file system, or the place in it, does not support this call at all, rather than just
/// now.
pub(crate) fn is_unsupported(error: &io::Error) -> bool {
    is_unsupported_call(error)
        || matches!(
            error.kind(),
            io::ErrorKind::InvalidInput
                | io::ErrorKind::CrossesDevices
                | io::ErrorKind::PermissionDenied
                | io::ErrorKind::ResourceBusy
                | io::ErrorKind::TooManyLinks
                | io::ErrorKind::InvalidFilename
        )
}

fn is_unsupported_call(error: &io::Error) -> bool {
    #[cfg(target_os = "linux")]
    if error.raw_os_error() == Some(rustix::io::Errno::OPNOTSUPP.raw_os_error()) {
        return true;
    }
    error.kind() == io::ErrorKind::Unsupported
}
