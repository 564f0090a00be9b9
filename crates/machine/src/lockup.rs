//! A program that is stuck.

use std::fmt;

/// The reason why the core is stuck.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lockup {
    /// The address of the instruction that failed, or at which the core stands still.
    pub pc: u32,
    /// The reason in words.
    pub why: String,
}

impl fmt::Display for Lockup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the program stopped at 0x{:08x}: {}", self.pc, self.why)
    }
}
