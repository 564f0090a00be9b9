//! Programs that a task starts: what they have used of the machine, and that they end with the task.

use std::process::Child;

/// Linux counts the time of processes so many times a second.
const TICKS_A_SECOND: f64 = 100.0;
const PAGE_BYTES: u64 = 4_096;

/// What a program has used.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Used {
    /// The processor's time, of all its threads.
    pub(crate) processor_s: f64,
    /// Its memory now.
    pub(crate) memory_bytes: u64,
}

/// A program that ends when it is no longer needed.
pub(crate) struct Ended(pub(crate) Child);

impl Ended {
    /// What it has used so far; none when it is over.
    pub(crate) fn used(&self) -> Option<Used> {
        let of = |file| std::fs::read_to_string(format!("/proc/{}/{file}", self.0.id())).ok();
        let (stat, memory) = (of("stat")?, of("statm")?);
        // After the name in brackets; user and system time are the 14th and 15th words of all.
        let words: Vec<&str> = stat.rsplit(')').next().unwrap_or("").split_whitespace().collect();
        let ticks = words.iter().skip(11).take(2).filter_map(|word| word.parse::<f64>().ok());
        let pages = memory.split_whitespace().nth(1)?.parse::<u64>().ok()?;
        let processor_s = ticks.sum::<f64>() / TICKS_A_SECOND;
        // A program that is over, and was not waited for, has none.
        (pages > 0).then_some(Used { processor_s, memory_bytes: pages * PAGE_BYTES })
    }
}

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
