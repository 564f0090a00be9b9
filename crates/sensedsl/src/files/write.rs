//! Single files: written completely or not at all, with respect for what is already there.
//!
//! A regular file is written beside its place under a temporary name and is on disk before it takes
//! its place. It keeps the permissions and the owner of the file that it replaces; symbolic links
//! are followed and stay. A device or a pipe is written to and stays what it is. Leftovers of a
//! killed process are removed by the next one that writes the same file.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use anyhow::{Context as _, Result, bail};

use super::ops;
use crate::files::shown;

/// The most links that are followed one after another.
const LINKS_MAX: usize = 40;

/// The part in the middle of a file's name before it takes its place.
const UNTIL_THEN: &str = ".sensedsl-part-";

/// Writes a file, with the folders above it.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    write_together(&[(path, bytes)])
}

/// Writes several files: all of them are complete and on disk before the first one takes its place,
/// so that a failure leaves none.
pub(crate) fn write_together(files: &[(&Path, &[u8])]) -> Result<()> {
    let mut staged = Vec::new();
    for (path, bytes) in files {
        let writing = || format!("cannot write {}", shown(path));
        if is_stream(path) {
            write_in_place(path, bytes).with_context(writing)?;
        } else {
            staged.push(Staged::new(path, bytes).with_context(writing)?);
        }
    }
    for one in &mut staged {
        one.publish().with_context(|| format!("cannot write {}", shown(&one.place)))?;
    }
    Ok(())
}

/// Writes a file whose contents are not all there at once. It takes its place when all is written.
pub(crate) fn write_streamed<T>(
    path: &Path,
    fill: impl FnOnce(Box<dyn io::Write + Send>) -> Result<T>,
) -> Result<T> {
    let writing = || format!("cannot write {}", shown(path));
    if is_stream(path) {
        let file = OpenOptions::new().append(true).open(path).with_context(writing)?;
        return fill(Box::new(io::BufWriter::new(file)));
    }
    let mut staged = Staged::new(path, &[]).with_context(writing)?;
    let file = staged.file.try_clone().with_context(writing)?;
    let filled = fill(Box::new(io::BufWriter::with_capacity(1 << 16, file)))?;
    staged.file.sync_all().with_context(writing)?;
    staged.publish().with_context(writing)?;
    Ok(filled)
}

/// Whether the entry at a path is written to rather than replaced: a device, a pipe, an open file.
pub(crate) fn is_stream(path: &Path) -> bool {
    let open = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"];
    open.iter().any(|one| path.starts_with(one))
        || fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Whether there is a file that would be lost: neither empty nor the same as the new one.
pub(crate) fn is_in_the_way(path: &Path, bytes: &[u8]) -> Result<bool> {
    let reading = || format!("cannot read {}", shown(path));
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error).with_context(reading),
        Ok(found) if found.is_dir() => bail!("{} is a folder", shown(path)),
        Ok(found) if found.len() == 0 || is_stream(path) => Ok(false),
        Ok(found) if found.len() != bytes.len() as u64 => Ok(true),
        Ok(_) => Ok(fs::read(path).with_context(reading)? != bytes),
    }
}

/// Whether a file starts with these bytes.
pub(crate) fn begins_with(path: &Path, bytes: &[u8]) -> Result<bool> {
    use io::Read as _;
    let reading = || format!("cannot read {}", shown(path));
    let mut head = Vec::new();
    let file = File::open(path).with_context(reading)?;
    file.take(bytes.len() as u64).read_to_end(&mut head).with_context(reading)?;
    Ok(head == bytes)
}

/// Removes a file; it may already be gone.
pub(crate) fn remove_file(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        done => done,
    }
}

fn write_in_place(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // The contents of an open file were printed by this very command.
    let mut file = OpenOptions::new().append(true).open(path)?;
    file.write_all(bytes)?;
    file.flush()
}

/// A complete file, beside its place.
struct Staged {
    /// Open, and locked as long as its process lives.
    file: File,
    part: PathBuf,
    place: PathBuf,
    is_published: bool,
}

impl Staged {
    fn new(path: &Path, bytes: &[u8]) -> Result<Self> {
        let place = behind_links(path)?;
        let name = place.file_name().context("a file needs a name")?;
        let above = place.parent().filter(|above| *above != Path::new(""));
        let above = above.unwrap_or(Path::new("."));
        fs::create_dir_all(above).with_context(|| format!("cannot make {}", shown(above)))?;
        let old = match fs::metadata(&place) {
            Ok(old) if old.is_dir() => bail!("it is a folder"),
            // A file that may not be written is not replaced either.
            Ok(old) => OpenOptions::new().write(true).open(&place).map(|_| Some(old))?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error.into()),
        };
        remove_leftovers(above, name);
        let mut staged = Self::open(place)?;
        staged.file.write_all(bytes)?;
        if let Some(old) = old {
            ops::resemble(&staged.file, &old)?;
        }
        staged.file.sync_all()?;
        Ok(staged)
    }

    fn open(place: PathBuf) -> io::Result<Self> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        loop {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let mut name = OsString::from(".");
            name.push(place.file_name().unwrap_or_default());
            name.push(format!("{UNTIL_THEN}{}-{number}", std::process::id()));
            let part = place.with_file_name(name);
            match OpenOptions::new().write(true).create_new(true).open(&part) {
                // It is from a process with the same number, on another machine or before a
                // restart.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    // Without locks, leftovers stay, because they cannot be told from files in use.
                    let _ = file.try_lock();
                    return Ok(Self { file, part, place, is_published: false });
                }
            }
        }
    }

    fn publish(&mut self) -> io::Result<()> {
        fs::rename(&self.part, &self.place)?;
        self.is_published = true;
        let above = self.place.parent().filter(|above| *above != Path::new(""));
        ops::sync(&[above.unwrap_or(Path::new(".")).to_path_buf()])
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if !self.is_published {
            // If that also fails, the first error gives the reason, and the next run tries again.
            let _ = fs::remove_file(&self.part);
        }
    }
}

/// Whether a file is a part of that one, from a run that was stopped or one that is still going on.
pub(crate) fn is_part_of(part: &Path, whole: &Path) -> bool {
    let names = part.file_name().zip(whole.file_name());
    part.parent() == whole.parent()
        && names.is_some_and(|(part, whole)| {
            part.to_string_lossy().starts_with(&beginning_of_parts(whole))
        })
}

fn beginning_of_parts(name: &std::ffi::OsStr) -> String {
    format!(".{}{UNTIL_THEN}", name.to_string_lossy())
}

/// Removes the files that killed processes left beside a file.
fn remove_leftovers(folder: &Path, name: &std::ffi::OsStr) {
    let beginning = beginning_of_parts(name);
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        // Opening a link or a pipe of that name would reach something that belongs to somebody
        // else.
        if !is_file || !entry.file_name().to_string_lossy().starts_with(&beginning) {
            continue;
        }
        // The lock of a process ends with the process.
        let is_dead = OpenOptions::new().write(true).open(entry.path());
        if is_dead.is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The path at the end of a chain of links, even if nothing is there yet.
fn behind_links(path: &Path) -> Result<PathBuf> {
    let mut place = path.to_path_buf();
    for _ in 0..LINKS_MAX {
        let Ok(target) = fs::read_link(&place) else { return Ok(place) };
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    bail!("too many links lead from one to the next")
}
