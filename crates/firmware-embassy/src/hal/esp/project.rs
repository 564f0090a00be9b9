//! A project on `esp-hal` as a whole: its clocks, its watchdog, and what the boot loader wants to know of it.

use sensedsl_board::pin::PinName;
use sensedsl_job::{BoardJob, JobConnection};

use super::gaps;
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Pins, Speed};
use crate::hal::contract::{Begin, Project, Watchdog};
use crate::names::Chip;

impl Pins for Settings {
    fn pin(&self, pin: &PinName) -> String {
        pin.to_string()
    }

    fn output(&self, pin: &PinName, level: &str, _speed: Speed) -> String {
        format!("Output::new(p.{pin}, {level})")
    }
}

impl Project for Settings {
    fn lacks(&self, job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<&'static str> {
        gaps::lacks(job, wire)
    }

    fn features(&self, context: &Context<'_>) -> Vec<String> {
        vec![context.chip.feature.clone(), "unstable".to_owned()]
    }

    fn needs(&self, context: &Context<'_>) -> Vec<String> {
        let chip = &context.chip.feature;
        vec![
            format!("esp-bootloader-esp-idf = {{ version = \"=0.6.0\", features = [\"{chip}\"] }}"),
            format!("esp-rtos = {{ version = \"=0.4.0\", features = [\"embassy\", \"{chip}\"] }}"),
        ]
    }

    /// Each chip has a description of its registers.
    fn lock_tags(&self, chip: &Chip) -> Vec<&'static str> {
        ["esp32c3", "esp32c6"].into_iter().filter(|tag| *tag == chip.feature).collect()
    }

    fn begin(&self, _context: &Context<'_>, _is_usb: bool) -> Begin {
        Begin {
            config_type: "hal::Config",
            config: vec![
                "hal::Config::default().with_cpu_clock(hal::clock::CpuClock::max())".to_owned(),
            ],
            start: vec![
                "STATUS.begin(rt::watchdog::cause());".to_owned(),
                "let wiring = wiring::wire(rt::begin(config()));".to_owned(),
            ],
            watchdog: Watchdog {
                type_: "crate::rt::watchdog::Watchdog".to_owned(),
                make: "crate::rt::watchdog::Watchdog::new(p.RTC_TIMER, WATCHDOG_US)".to_owned(),
            },
            scripts: "",
            // The HAL has them all.
            memory: None,
        }
    }

    /// The runtime knows the levels by their order alone.
    fn last_priority(&self, context: &Context<'_>) -> usize {
        context.names.line.spare.len()
    }
}
