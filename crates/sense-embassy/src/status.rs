//! The cause of the last reset, the task that hung before it, and the stack that was never used.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicU8, AtomicU32, Ordering};

use sense_rt::{BoardHealth, Cause};

/// Marks a record that was kept across a reset.
const MAGIC: u32 = 0x5345_4E53;
/// The record of a panic, in place of a device.
const HALTED: u32 = 0x100;
/// The word that fills the stack, and the most bytes filled, because a start must be short.
const FILL: u32 = 0x5555_5555;
const FILLED_BYTES: u32 = 16_384;
/// Bytes left alone below the stack frame of the function that fills.
const SPARED_BYTES: u32 = 256;

unsafe extern "C" {
    /// The end of all statics, up to which the stack may grow.
    #[cfg_attr(feature = "esp", link_name = "_stack_end")]
    static __sheap: u32;
}

/// Words that the start-up code leaves as they are.
struct Kept(UnsafeCell<[u32; 2]>);

// SAFETY: the words are written at the start, and then only before a reset.
unsafe impl Sync for Kept {}

#[cfg_attr(feature = "esp", unsafe(link_section = ".rtc_fast.persistent.sense_record"))]
#[cfg_attr(not(feature = "esp"), unsafe(link_section = ".uninit.sense_record"))]
static KEPT: Kept = Kept(UnsafeCell::new([0; 2]));

fn keep(words: [u32; 2]) {
    // SAFETY: the words belong to this module alone, and are aligned.
    unsafe { KEPT.0.get().write_volatile(words) }
}

/// Records that the task of a device hangs, for the next start.
pub fn note_hang(device: u8) {
    keep([MAGIC, device.into()]);
}

/// Records a panic, for the next start.
pub fn note_panic() {
    keep([MAGIC, HALTED]);
}

/// The status of the board itself; it is a `static`.
pub struct BoardStatus {
    /// By the number of the cause on the wire.
    flags: AtomicU32,
    has_halted: AtomicU8,
    device: AtomicU8,
    /// Where the filled part of the stack begins.
    filled_from: AtomicU32,
    filled_to: AtomicU32,
}

impl BoardStatus {
    /// Nothing is known yet.
    #[expect(clippy::new_without_default, reason = "it is the value of a static")]
    #[must_use]
    pub const fn new() -> Self {
        Self {
            flags: AtomicU32::new(0),
            has_halted: AtomicU8::new(0),
            device: AtomicU8::new(0),
            filled_from: AtomicU32::new(0),
            filled_to: AtomicU32::new(0),
        }
    }

    /// Takes the record of the last reset; call it before anything is set up. `flags`: the causes of
    /// the reset from bit 26 on, in this order: pin, power, software, watchdog, window watchdog, low
    /// power; 0 if no register tells.
    pub fn begin(&self, flags: u32) {
        // SAFETY: as in `keep`.
        let [magic, kept] = unsafe { KEPT.0.get().read_volatile() };
        keep([0; 2]);
        self.flags.store(flags, Ordering::Relaxed);
        if magic == MAGIC {
            self.has_halted.store(u8::from(kept == HALTED), Ordering::Relaxed);
            self.device.store(if kept < HALTED { kept as u8 } else { 0 }, Ordering::Relaxed);
        }
        self.fill();
    }

    /// Fills the memory below the current stack.
    #[inline(never)]
    fn fill(&self) {
        let here = 0_u32;
        let end = (&raw const here as u32).saturating_sub(SPARED_BYTES) & !3;
        let least = &raw const __sheap as u32;
        let from = least.max(end.saturating_sub(FILLED_BYTES));
        let mut place = from;
        while place < end {
            // SAFETY: between the statics and the stack there is nothing.
            unsafe { (place as *mut u32).write_volatile(FILL) };
            place += 4;
        }
        self.filled_from.store(from, Ordering::Relaxed);
        self.filled_to.store(end, Ordering::Relaxed);
    }

    /// Bytes between the statics and the deepest point of the stack so far.
    fn stack_left(&self) -> u32 {
        let (from, to) =
            (self.filled_from.load(Ordering::Relaxed), self.filled_to.load(Ordering::Relaxed));
        let mut place = from;
        // SAFETY: `fill` has filled the word, or it belongs to the stack.
        while place < to && unsafe { (place as *const u32).read_volatile() } == FILL {
            place += 4;
        }
        place.saturating_sub(&raw const __sheap as u32)
    }

    /// Why the board started.
    pub fn cause(&self) -> Cause {
        let flags = self.flags.load(Ordering::Relaxed);
        let has = |bit: u32| flags >> bit & 1 != 0;
        if has(29) {
            Cause::Watchdog
        } else if has(30) {
            Cause::WindowWatchdog
        } else if has(31) {
            Cause::LowPower
        } else if has(27) {
            Cause::Power
        } else if has(28) && self.has_halted.load(Ordering::Relaxed) != 0 {
            Cause::Halt
        } else if has(28) {
            Cause::Software
        } else if has(26) {
            Cause::Pin
        } else {
            Cause::Unknown
        }
    }

    /// Adds the cause of the reset and the stack to the board's health.
    pub fn describe(&self, board: &mut BoardHealth) {
        board.reset_cause = self.cause();
        if board.reset_cause == Cause::Watchdog {
            board.reset_device = self.device.load(Ordering::Relaxed);
        }
        board.stack_left_bytes =
            u16::try_from(self.stack_left()).unwrap_or(u16::MAX - 1).min(u16::MAX - 1);
    }
}
