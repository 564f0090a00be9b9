//! How much of a certificate is read and looked at, so that a hostile one is refused soon.
//!
//! Every step of a record goes through all choices that are left in its case, so the text alone does
//! not bound the time.

use crate::{Refuted, Unusable, ensure};

/// Bytes of a certificate; one of a hundred devices on eight boards has two MiB.
pub const BYTES_MAX: usize = 8 << 20;
/// Lists and objects in a certificate that are not empty; they take memory before all else.
pub const LISTS_MAX: usize = 120_000;
/// Choices that are looked at, which takes a second or two.
pub const WORK_MAX: usize = 150_000_000;

/// What is said of a record beyond [`WORK_MAX`].
pub const TOO_LONG: &str = "the proof is longer than the verifier looks at";

/// Checks that a text is not too large to be read.
///
/// # Errors
/// What it has too much of.
pub fn fits(text: &str) -> Result<(), Unusable> {
    if text.len() > BYTES_MAX {
        return Err(Unusable(format!("it has more than {} MiB", BYTES_MAX >> 20)));
    }
    let pairs = text.as_bytes().windows(2);
    let lists = pairs.filter(|pair| match pair {
        [b'[', next] => *next != b']',
        [b'{', next] => *next != b'}',
        _ => false,
    });
    if lists.count() > LISTS_MAX {
        return Err(Unusable(format!("it has more than {LISTS_MAX} lists and objects")));
    }
    Ok(())
}

/// What is left for the proof of a certificate.
pub(crate) struct Budget {
    work: usize,
}

impl Budget {
    pub(crate) const fn new() -> Self {
        Self { work: WORK_MAX }
    }

    /// So many choices are looked at.
    pub(crate) fn work(&mut self, choices: usize) -> Result<(), Refuted> {
        ensure(self.work >= choices, || TOO_LONG.into())?;
        self.work -= choices;
        Ok(())
    }
}
