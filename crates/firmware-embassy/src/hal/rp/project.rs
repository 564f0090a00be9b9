//! A project on `embassy-rp` as a whole: its crate's features, memory, watchdog, the cause of the last reset.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::TargetProfile;
use sensedsl_job::{BoardJob, JobConnection};

use super::gaps;
use super::settings::{Settings, Start};
use crate::context::Context;
use crate::hal::contract::outputs::{Pins, Speed};
use crate::hal::contract::{Begin, Project, Watchdog};
use crate::names::Names;

/// The memory of the chips, which the HAL does not know: the flash is a chip of its own.
const MEMORY_2040: &str = include_str!("templates/memory_rp2040.x.txt");
const MEMORY_2350: &str = include_str!("templates/memory_rp2350.x.txt");

/// The crystal from which the HAL makes the clocks, and the boot loader that of USB.
const CRYSTAL_HZ: u32 = 12_000_000;

impl Pins for Settings {
    fn pin(&self, pin: &PinName) -> String {
        match pin.as_str().strip_prefix("GP") {
            Some(number) => format!("PIN_{number}"),
            None => pin.to_string(),
        }
    }

    fn output(&self, pin: &PinName, level: &str, _speed: Speed) -> String {
        format!("Output::new(p.{}, {level})", self.pin(pin))
    }
}

impl Project for Settings {
    fn problems(&self, profile: &TargetProfile, names: &Names) -> Vec<String> {
        let lacks = |name: &&String| names.interrupt(name, "EV").is_none();
        let units = profile.i2cs.iter().map(|unit| &unit.name).filter(lacks);
        units.map(|unit| format!("{}: {unit} has no interrupt", profile.line)).collect()
    }

    fn refusal(&self, job: &BoardJob<'_>, _profile: &TargetProfile) -> Option<String> {
        let hz = job.board.facts.as_ref().and_then(|facts| facts.crystal.hse_hz)?;
        (hz != CRYSTAL_HZ).then(|| {
            format!(
                "its crystal has {hz} Hz, and Embassy's clocks are made of one of {CRYSTAL_HZ} Hz"
            )
        })
    }

    fn lacks(&self, job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<&'static str> {
        gaps::lacks(job, wire)
    }

    fn features(&self, context: &Context<'_>) -> Vec<String> {
        [context.chip.feature.as_str(), "time-driver", "unstable-pac"].map(str::to_owned).into()
    }

    fn uf2_family(&self, _context: &Context<'_>) -> Option<u32> {
        Some(self.uf2_family)
    }

    fn begin(&self, _context: &Context<'_>, _is_usb: bool) -> Begin {
        let (register, power, run) = match self.start {
            Start::Boot2 => ("VREG_AND_CHIP_RESET", "cause.had_por()", "cause.had_run()"),
            Start::Block => ("POWMAN", "cause.had_por() || cause.had_bor()", "cause.had_run_low()"),
        };
        Begin {
            config_type: "hal::config::Config",
            // The HAL sets the clocks by itself.
            config: vec!["hal::config::Config::default()".to_owned()],
            start: vec![
                format!("let cause = hal::pac::{register}.chip_reset().read();"),
                format!("STATUS.begin(rt::watchdog::cause({power}, {run}));"),
                "let wiring = wiring::wire(hal::init(config()));".to_owned(),
            ],
            watchdog: Watchdog {
                type_: "crate::rt::watchdog::Watchdog".to_owned(),
                make: "crate::rt::watchdog::Watchdog::new(p.WATCHDOG, WATCHDOG_US)".to_owned(),
            },
            scripts: match self.start {
                Start::Boot2 => ", \"-C\", \"link-arg=-Tlink-rp.x\"",
                Start::Block => "",
            },
            memory: Some(match self.start {
                Start::Boot2 => MEMORY_2040.to_owned(),
                Start::Block => MEMORY_2350.to_owned(),
            }),
        }
    }

    fn last_priority(&self, _context: &Context<'_>) -> usize {
        // The HAL uses two bits of priority on all its chips.
        3
    }
}

#[cfg(test)]
mod tests {
    use super::{PinName, Pins as _, Settings, Start};

    #[test]
    fn pins_have_the_names_of_the_hal() {
        let settings = Settings { start: Start::Boot2, uf2_family: 0 };
        let name = |pin: &str| PinName::parse(pin).map(|pin| settings.pin(&pin));
        assert_eq!(name("GP26").as_deref(), Some("PIN_26"));
        assert_eq!(name("PA1").as_deref(), Some("PA1"));
    }
}
