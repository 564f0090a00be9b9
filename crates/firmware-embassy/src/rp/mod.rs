//! What a project on `embassy-rp` has of its own: RP2040 and RP2350.

pub(super) mod analog;
pub(super) mod buses;
pub(super) mod edges;
pub(super) mod gaps;
pub(super) mod icu;
pub(super) mod link;
pub(super) mod pwm;
pub(super) mod typed;

use serde::Deserialize;

use super::context::Context;
use super::hal::Hal;
use super::plan::{Begin, Watchdog};
use sensedsl_job::BoardJob;

/// The memory of the chips, which no HAL has: the flash is a chip of its own.
const MEMORY_2040: &str = include_str!("../templates/rp/memory_rp2040.x.txt");
const MEMORY_2350: &str = include_str!("../templates/rp/memory_rp2350.x.txt");

/// The chips by how they start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Start {
    /// With a second stage in the first 256 bytes of the flash: RP2040.
    #[default]
    Boot2,
    /// With a block that describes the image: RP2350.
    Block,
}

/// The crystal that the HAL's clocks and the boot loader's USB are made of.
const CRYSTAL_HZ: u32 = 12_000_000;

/// Why no project is made for a board, whatever its devices.
pub(super) fn refusal(hal: Hal, job: &BoardJob<'_>) -> Option<String> {
    let hz = job.board.facts.as_ref().and_then(|facts| facts.crystal.hse_hz)?;
    match hal {
        Hal::Rp if hz != CRYSTAL_HZ => Some(format!(
            "its crystal has {hz} Hz, and Embassy's clocks are made of one of {CRYSTAL_HZ} Hz"
        )),
        Hal::Rp | Hal::Stm32 => None,
    }
}

/// How a project begins.
pub(super) fn begin(context: &Context<'_>) -> Begin {
    let start = context.names.start;
    let (register, power, run) = match start {
        Start::Boot2 => ("VREG_AND_CHIP_RESET", "cause.had_por()", "cause.had_run()"),
        Start::Block => ("POWMAN", "cause.had_por() || cause.had_bor()", "cause.had_run_low()"),
    };
    Begin {
        // The HAL makes the clocks of the crystal of 12 MHz.
        clocks: Vec::new(),
        config: "hal::config::Config",
        start: vec![
            format!("let cause = hal::pac::{register}.chip_reset().read();"),
            format!("STATUS.begin(rt::watchdog::cause({power}, {run}));"),
            "let wiring = wiring::wire(hal::init(config()));".to_owned(),
        ],
        watchdog: Watchdog {
            type_: "crate::rt::watchdog::Watchdog".to_owned(),
            make: "crate::rt::watchdog::Watchdog::new(p.WATCHDOG, WATCHDOG_US)".to_owned(),
        },
        scripts: match start {
            Start::Boot2 => ", \"-C\", \"link-arg=-Tlink-rp.x\"",
            Start::Block => "",
        },
        memory: Some(match start {
            Start::Boot2 => MEMORY_2040,
            Start::Block => MEMORY_2350,
        }),
    }
}
