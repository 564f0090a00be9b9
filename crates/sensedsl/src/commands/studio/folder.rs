//! The folder's files: all at once, and one by one, read and written.
//!
//! A file is written only if it is still what the page has read: the tag of an answer comes back with the change. Nothing
//! outside of the folder is read or written, also not through a link.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context as _, Result, bail};
use sensedsl_limits::TOTAL_BYTES_MAX;
use sensedsl_model::{FileUse, stays_inside};
use serde_json::json;
use tiny_http::Request;

use super::answer::{Answer, Method, header};
use crate::files::state::digest;
use crate::files::{Disk, files_below, remove_file, shown, write_whole};

/// The ends of names of files that a page shows; of pictures, those that a world names as its map.
const ENDS: [&str; 4] = ["sense", "csv", "toml", "svg"];
/// Folders that other tools fill.
const OTHERS: [&str; 3] = ["build", "node_modules", "target"];
/// The most folders that are looked into.
const FOLDERS_MAX: usize = 2_000;
/// The most files that a page gets.
const FILES_MAX: usize = 500;

/// A folder with designs.
pub(super) struct Folder {
    /// Without symbolic links.
    root: PathBuf,
    /// The file that is wanted first.
    open: Option<String>,
    /// One change at a time.
    writing: Mutex<()>,
}

impl Folder {
    /// A folder, or that of a file.
    ///
    /// # Errors
    /// It is not there, or is neither.
    pub(super) fn open(path: &Path) -> Result<Self> {
        let real =
            fs::canonicalize(path).with_context(|| format!("cannot open {}", shown(path)))?;
        let (root, open) = if real.is_dir() {
            (real, None)
        } else {
            let name = real.file_name().map(|name| name.to_string_lossy().into_owned());
            let folder = real.parent().context("a file is in a folder")?;
            (folder.to_path_buf(), name.filter(|name| is_shown(name)))
        };
        if !root.is_dir() {
            bail!("{} is not a folder", shown(path));
        }
        Ok(Self { root, open, writing: Mutex::new(()) })
    }

    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// The name of the folder, all its texts, and the one to begin with.
    pub(super) fn project(&self) -> Answer {
        let files = match self.texts() {
            Ok(files) => files,
            Err(why) => return Answer::refused(500, &format!("{why:#}")),
        };
        let folder = self.root.file_name().map(|name| name.to_string_lossy().into_owned());
        let tags: BTreeMap<&String, String> =
            files.iter().map(|(path, text)| (path, tag(text.as_bytes()))).collect();
        Answer::json(
            200,
            &json!({ "folder": folder, "files": files, "etags": tags, "open": self.open }),
        )
    }

    fn texts(&self) -> Result<BTreeMap<String, String>> {
        let folders = Cell::new(0);
        let skip = |name: &str| {
            folders.set(folders.get() + 1);
            name.starts_with('.') || OTHERS.contains(&name) || folders.get() > FOLDERS_MAX
        };
        let found = files_below(&self.root, &skip)?;
        if folders.get() > FOLDERS_MAX {
            bail!("there are more than {FOLDERS_MAX} folders inside: open a smaller folder");
        }
        let names = found.iter().map(|path| path.to_string_lossy().replace('\\', "/"));
        let (pictures, others): (Vec<String>, Vec<String>) =
            names.filter(|name| is_shown(name)).partition(|name| has_end(name, "svg"));
        let mut texts = BTreeMap::new();
        self.take(others, &mut texts)?;
        let is_named = |picture: &String| {
            let name = picture.rsplit('/').next().unwrap_or(picture);
            texts.iter().any(|(path, text)| has_end(path, "toml") && text.contains(name))
        };
        let maps = pictures.into_iter().filter(is_named).collect();
        self.take(maps, &mut texts)?;
        Ok(texts)
    }

    /// Reads files.
    fn take(&self, names: Vec<String>, texts: &mut BTreeMap<String, String>) -> Result<()> {
        let mut bytes: usize = texts.values().map(String::len).sum();
        for name in names {
            if texts.len() >= FILES_MAX {
                break;
            }
            let Some(text) = self.read(&name) else { continue };
            bytes += text.len();
            if bytes > TOTAL_BYTES_MAX {
                bail!("the folder has more text than the page can take: open a smaller one");
            }
            texts.insert(name, text);
        }
        Ok(())
    }

    /// A text of the folder; none if it is not there, or is no text.
    fn read(&self, name: &str) -> Option<String> {
        let disk = Disk::below(&self.root, &[]);
        let bytes = disk.bytes(&self.root.join(name), FileUse::Sense).ok()?;
        String::from_utf8(bytes).ok()
    }

    /// Reads, writes or removes a file.
    pub(super) fn answer(&self, method: Method, path: &str, request: &mut Request) -> Answer {
        let Some(name) = decoded(path).filter(|name| is_inside(name) && is_shown(name)) else {
            return Answer::refused(
                404,
                "only .sense, .csv, .toml and .svg files of the folder can be read and written",
            );
        };
        match method {
            Method::Get => match self.read(&name) {
                Some(text) => {
                    let tag = tag(text.as_bytes());
                    Answer::text(200, text, tag)
                }
                None => Answer::refused(404, "there is no such file"),
            },
            Method::Put => match text_of(request) {
                Ok(text) => self.write(&name, Some(text), request),
                Err(refused) => refused,
            },
            Method::Delete => self.write(&name, None, request),
            Method::Post | Method::Other => {
                Answer::refused(405, "a file can be read, written and removed")
            }
        }
    }

    /// Changes a file that is still what the page has read.
    fn write(&self, name: &str, text: Option<String>, request: &Request) -> Answer {
        let _alone = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let path = self.root.join(name);
        if !self.is_own(&path) {
            return Answer::refused(403, "this is a link that leads out of the folder");
        }
        let now = self.read(name);
        if now.is_none() && path.exists() {
            return Answer::refused(409, "something else has that name, and it is not text");
        }
        let tag_now = now.as_deref().map(|text| tag(text.as_bytes()));
        let is_new = header(request, "If-None-Match") == Some("*");
        let expected = header(request, "If-Match");
        let is_as_read = match (&tag_now, expected) {
            (Some(now), Some(expected)) => now == expected,
            (None, None) => is_new,
            (Some(_), None) | (None, Some(_)) => false,
        };
        if !is_as_read {
            let why = if expected.is_none() && !is_new {
                return Answer::refused(
                    428,
                    "send If-Match with the ETag, or If-None-Match: * for a new file",
                );
            } else {
                now.unwrap_or_default()
            };
            return Answer::text(409, why, tag_now.unwrap_or_default());
        }
        let done = match &text {
            Some(text) => write_whole(&path, text.as_bytes()),
            None => remove_file(&path).with_context(|| format!("cannot remove {name}")),
        };
        match done {
            Ok(()) => {
                let tag = tag(text.unwrap_or_default().as_bytes());
                Answer::text(200, String::new(), tag)
            }
            Err(why) => Answer::refused(500, &format!("{why:#}")),
        }
    }

    /// Whether a path, links followed, is in the folder; also one that is still to be made.
    fn is_own(&self, path: &Path) -> bool {
        let there = path.ancestors().find(|one| one.symlink_metadata().is_ok());
        there.is_some_and(|there| {
            fs::canonicalize(there).is_ok_and(|real| real.starts_with(&self.root))
        })
    }
}

/// The text that a page sends.
fn text_of(request: &mut Request) -> Result<String, Answer> {
    let most = FileUse::Sense.bytes_max();
    let mut bytes = Vec::new();
    let read = request.as_reader().take(most as u64 + 1).read_to_end(&mut bytes);
    if read.is_err() {
        return Err(Answer::refused(400, "the upload was cut off"));
    }
    if bytes.len() > most {
        return Err(Answer::refused(413, "the text is larger than a file may be"));
    }
    String::from_utf8(bytes).map_err(|_| Answer::refused(400, "the text is not UTF-8"))
}

/// What a text is known by.
fn tag(bytes: &[u8]) -> String {
    format!("\"{}\"", digest(bytes))
}

/// A path of a URL as it was before its signs were escaped.
fn decoded(path: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = [rest.next()?, rest.next()?];
        let digits = std::str::from_utf8(&digits).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
    }
    String::from_utf8(bytes).ok()
}

/// Whether a name is that of a file in the folder, and not hidden.
pub(super) fn is_inside(name: &str) -> bool {
    let is_plain = |part: &str| {
        !part.is_empty() && !part.starts_with('.') && !part.contains(['\\', ':', '\0'])
    };
    stays_inside(name) && name.split('/').all(is_plain)
}

/// Whether a page shows a file.
fn is_shown(name: &str) -> bool {
    ENDS.iter().any(|end| has_end(name, end))
}

/// Whether a name has something before a dot, and that end after it.
fn has_end(name: &str, end: &str) -> bool {
    let parts = name.rsplit_once('.');
    parts.is_some_and(|(stem, own)| !stem.is_empty() && own.eq_ignore_ascii_case(end))
}
