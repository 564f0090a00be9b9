//! The check of the emulated MCU's watchdog.

use sensedsl_twin::bench::Bench;
use sensedsl_twin::emulated::EmulatedBoard;

use crate::run::{read, with_job};

/// A vector table with stack and entry, and a program that loops and does nothing: it never starts a watchdog.
const LOOP: [u8; 12] = [0, 0x10, 0, 0x20, 9, 0, 0, 8, 0x00, 0xBF, 0xFD, 0xE7];
const DESIGN: &str = "board STM32F407G_DISC1 { sensor Light returns uint16 { type = analog; } }";

/// A link over USB is plugged in for more than a second before the program is ready, so the watchdog is checked later.
#[test]
fn a_program_without_a_watchdog_is_told_when_it_must_be_there() {
    with_job(DESIGN, |job| {
        let (world, _) = read(job, "", 7);
        let mut board = EmulatedBoard::new(job, Bench::new(job, &world, 7), &LOOP).unwrap();
        board.run_until(2_000_000_000);
        assert_eq!(board.unwatched(), None);
        board.run_until(2_600_000_000);
        assert_eq!(board.unwatched().as_deref(), Some("does not run"));
        assert_eq!(board.unwatched(), None);
    });
}
