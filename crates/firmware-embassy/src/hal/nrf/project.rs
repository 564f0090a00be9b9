//! A project on `embassy-nrf` as a whole: its clocks, its memory, its watchdog.

use askama::Template;
use sensedsl_board::pin::PinName;
use sensedsl_files::print;
use sensedsl_job::{BoardJob, JobConnection};
use serde::Deserialize;

use super::gaps;
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Pins, Speed};
use crate::hal::contract::{Begin, Project, Watchdog};

/// `memory.x`
#[derive(Template)]
#[template(path = "hal/nrf/templates/memory.x.txt", escape = "none")]
struct Memory<'a> {
    chip: &'a str,
    /// Where the program begins, and how much of the flash is left from there.
    flash_from: u32,
    flash_bytes: u32,
    ram_bytes: u32,
}

/// The pins of the antenna of NFC.
pub(super) const NFC_PINS: [&str; 2] = ["P0.09", "P0.10"];

/// What a board says of its boot loader in `[system.embassy]`.
#[derive(Clone, Copy, Default, Deserialize)]
struct BootLoader {
    /// Where the program begins: behind the boot loader, if that is in the way.
    #[serde(default)]
    flash_from: u32,
    /// Whether it takes UF2 files.
    #[serde(default)]
    uf2: bool,
}

impl BootLoader {
    fn of(context: &Context<'_>) -> Self {
        let facts = context.job.board.facts.as_ref().and_then(|facts| facts.system.get("embassy"));
        let own = facts.map(|facts| toml::Value::Table(facts.own.clone()));
        own.and_then(|own| own.try_into().ok()).unwrap_or_default()
    }
}

impl Pins for Settings {
    /// `P0_04` of `P0.04`
    fn pin(&self, pin: &PinName) -> String {
        pin.as_str().replace('.', "_")
    }

    fn output(&self, pin: &PinName, level: &str, _speed: Speed) -> String {
        format!("Output::new(p.{}, {level}, OutputDrive::Standard)", self.pin(pin))
    }
}

impl Project for Settings {
    fn lacks(&self, job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<&'static str> {
        gaps::lacks(self, job, wire)
    }

    fn features(&self, context: &Context<'_>) -> Vec<String> {
        let chip = context.chip.feature.as_str();
        let mut features = vec![chip, "gpiote", "time-driver-rtc1", "unstable-pac"];
        // The chip notes for good that it has no antenna there, so only a design with such a pin asks for it.
        let pads = context.job.connections.iter().flat_map(|one| &one.pads);
        if pads.map(|pad| pad.pin.name.as_str()).any(|pin| NFC_PINS.contains(&pin)) {
            features.push("nfc-pins-as-gpio");
        }
        features.into_iter().map(str::to_owned).collect()
    }

    fn uf2_family(&self, context: &Context<'_>) -> Option<u32> {
        self.uf2_family.filter(|_| BootLoader::of(context).uf2)
    }

    fn begin(&self, context: &Context<'_>, _is_usb: bool) -> Begin {
        let BootLoader { flash_from, .. } = BootLoader::of(context);
        let memory = Memory {
            chip: &context.chip.probe,
            flash_from,
            flash_bytes: self.flash_bytes.saturating_sub(flash_from),
            ram_bytes: self.ram_bytes,
        };
        Begin {
            config_type: "hal::config::Config",
            // All these boards have the crystal of the radio, from which the slow clock is made as well.
            config: vec![
                "let mut config = hal::config::Config::default();".to_owned(),
                "config.hfclk_source = hal::config::HfclkSource::ExternalXtal;".to_owned(),
                "config.lfclk_source = hal::config::LfclkSource::Synthesized;".to_owned(),
                "config".to_owned(),
            ],
            start: vec![
                "rt::vectors::take();".to_owned(),
                "STATUS.begin(rt::watchdog::cause());".to_owned(),
                "let wiring = wiring::wire(hal::init(config()));".to_owned(),
            ],
            watchdog: Watchdog {
                type_: "crate::rt::watchdog::Watchdog".to_owned(),
                make: "crate::rt::watchdog::Watchdog::new(p.WDT, WATCHDOG_US)".to_owned(),
            },
            scripts: "",
            memory: Some(print(&memory)),
        }
    }

    fn last_priority(&self, _context: &Context<'_>) -> usize {
        // Three bits of priority.
        7
    }
}

#[cfg(test)]
mod tests {
    use super::{PinName, Pins as _, Settings};

    #[test]
    fn pins_have_the_names_of_the_hal() {
        let settings =
            Settings { flash_bytes: 0, ram_bytes: 0, has_two_stop_bits: true, uf2_family: None };
        let name = |pin: &str| PinName::parse(pin).map(|pin| settings.pin(&pin));
        assert_eq!(name("P0.04").as_deref(), Some("P0_04"));
        assert_eq!(name("P1.15").as_deref(), Some("P1_15"));
    }
}
