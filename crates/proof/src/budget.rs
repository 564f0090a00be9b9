//! Limits on how much of a certificate is read and examined, so that a hostile one is refused
//! early.
//!
//! Every step of a record goes through all choices that are left in its case, so the length of the
//! text alone does not bound the time.

use crate::verdict::{Refuted, Unusable, ensure};

/// The most bytes in a certificate; one for a hundred devices on eight boards has two MiB.
pub const BYTES_MAX: usize = 8 << 20;
/// The most non-empty lists and objects in a certificate; they above all take memory.
pub const LISTS_MAX: usize = 120_000;
/// The most choices that are examined, which takes a second or two.
pub const WORK_MAX: usize = 150_000_000;

/// The message about a record beyond [`WORK_MAX`].
pub const TOO_LONG: &str = "the proof is longer than the verifier looks at";

/// Checks that a text is not too large to be read.
///
/// # Errors
/// The part of which it has too much.
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

/// The budget that is left for verifying a certificate.
pub(crate) struct Budget {
    work: usize,
}

impl Budget {
    pub(crate) const fn new() -> Self {
        Self { work: WORK_MAX }
    }

    /// Spends the work of examining this many choices.
    pub(crate) fn work(&mut self, choices: usize) -> Result<(), Refuted> {
        ensure(self.work >= choices, || TOO_LONG.into())?;
        self.work -= choices;
        Ok(())
    }
}
