//! The subject of a certificate: whether given files are those from which its problem was made.
//!
//! This distinguishes a certificate from one of another file, or of an earlier state. It is not a
//! signature: whoever can change the certificate can change the hashes in it.

use crate::format::Subject;
use crate::verdict::{Refuted, ensure};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeSet;
use std::fmt;

/// The SHA-256 of some bytes in lower-case hexadecimal.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    format!("{:x}", Sha256::digest(bytes))
}

/// The parts of a subject that were compared.
#[derive(Debug)]
pub struct Compared<'a> {
    subject: &'a Subject,
    files: BTreeSet<&'a str>,
    built_in: BTreeSet<&'a str>,
}

/// Compares files, each a path with the hash of its content, with the subject of a certificate.
///
/// A path that ends with the name of a file of the subject stands for that file. Any other stands
/// for whatever has the same content: the standard input, or a built-in text that was printed.
///
/// # Errors
/// The first file that has changed, is not part of the subject, or is missing.
pub fn compare<'a>(
    subject: &'a Subject,
    given: &[(String, String)],
) -> Result<Compared<'a>, Refuted> {
    let mut compared = subject.unseen();
    for (path, hash) in given {
        let called = subject.files.iter().filter(|(name, _)| is_called(path, name));
        if let Some((name, stated)) = called.max_by_key(|(name, _)| parts(name).len()) {
            ensure(stated == hash, || format!("{path:?} is not the {name:?} that was solved"))?;
            compared.files.insert(name);
            continue;
        }
        let same = |(_, stated): &(&'a String, &'a String)| *stated == hash;
        let files: Vec<&str> = subject.files.iter().filter(same).map(|(name, _)| &**name).collect();
        let texts = subject.built_in.iter().filter(same).map(|(name, _)| &**name);
        let texts: Vec<&str> = texts.collect();
        let known = !files.is_empty() || !texts.is_empty();
        ensure(known, || format!("the certificate is not of {path:?}"))?;
        compared.files.extend(files);
        compared.built_in.extend(texts);
    }
    let missing = subject.files.keys().find(|name| !compared.files.contains(name.as_str()));
    missing.map_or(Ok(compared), |name| {
        Err(Refuted(format!("the certificate is also of {name:?}, which is not given")))
    })
}

impl Subject {
    /// The comparison before any file was compared.
    #[must_use]
    pub const fn unseen(&self) -> Compared<'_> {
        Compared { subject: self, files: BTreeSet::new(), built_in: BTreeSet::new() }
    }
}

/// A line for each part of the subject.
impl fmt::Display for Compared<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Subject { tool, options, files, built_in } = self.subject;
        let state = |seen| if seen { "the same" } else { "not compared" };
        write!(f, "made by {} of", tool.escape_debug())?;
        for name in files.keys() {
            let state = state(self.files.contains(name.as_str()));
            write!(f, "\n  {}: {state}", name.escape_debug())?;
        }
        for name in built_in.keys() {
            let state = state(self.built_in.contains(name.as_str()));
            write!(f, "\n  `sensedsl {}`: {state}", name.escape_debug())?;
        }
        options.iter().try_for_each(|(name, value)| {
            write!(f, "\n  with {} {}", name.escape_debug(), value.escape_debug())
        })
    }
}

/// The parts of a path without those that do not name a file or folder.
fn parts(path: &str) -> Vec<&str> {
    path.split(['/', '\\']).filter(|part| !matches!(*part, "" | "." | "..")).collect()
}

/// Whether a path ends with a name.
fn is_called(path: &str, name: &str) -> bool {
    let name = parts(name);
    !name.is_empty() && parts(path).ends_with(&name)
}
