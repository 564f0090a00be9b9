//! A program that does nothing more.

use std::fmt;

/// Why the core does nothing more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lockup {
    /// The instruction that failed, or where the core stands.
    pub pc: u32,
    /// In words.
    pub why: String,
}

impl fmt::Display for Lockup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the program stopped at 0x{:08x}: {}", self.pc, self.why)
    }
}
