//! A project on `embassy-nrf` as a whole: its clocks, its memory, its watchdog.

use askama::Template;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::TargetProfile;
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

/// The features of the HAL for a board, whatever is made of it.
pub(super) fn features<'a>(context: &'a Context<'_>) -> Vec<&'a str> {
    /// The pins of the antenna of NFC.
    const NFC_PINS: [&str; 2] = ["P0.09", "P0.10"];
    let mut features = vec![context.chip.feature.as_str(), "gpiote", "unstable-pac"];
    // The chip notes for good that it has no antenna there, so only a design with such a pin asks for it.
    let pads = context.job.connections.iter().flat_map(|one| &one.pads);
    if pads.map(|pad| pad.pin.name.as_str()).any(|pin| NFC_PINS.contains(&pin)) {
        features.push("nfc-pins-as-gpio");
    }
    features
}

/// What a board says of its boot loader in `[system.embassy]`.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct BootLoader {
    /// Where the program begins: behind the boot loader, if that is in the way.
    #[serde(default)]
    flash_from: u32,
    /// Whether it takes UF2 files.
    #[serde(default)]
    uf2: bool,
}

impl BootLoader {
    /// What the board says; the error says what is wrong with it.
    fn of(job: &BoardJob<'_>) -> Result<Self, String> {
        let facts = job.board.facts.as_ref().and_then(|facts| facts.system.get("embassy"));
        let Some(facts) = facts else { return Ok(Self::default()) };
        let own = toml::Value::Table(facts.own.clone());
        own.try_into().map_err(|error: toml::de::Error| error.to_string())
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
    /// A program in the wrong place would overwrite the boot loader.
    fn refusal(&self, job: &BoardJob<'_>, _profile: &TargetProfile) -> Option<String> {
        let error = BootLoader::of(job).err()?;
        Some(format!("what its table says of its boot loader is wrong: {error}"))
    }

    fn lacks(&self, job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<&'static str> {
        gaps::lacks(self, job, wire)
    }

    fn features(&self, context: &Context<'_>) -> Vec<String> {
        features(context).into_iter().chain(["time-driver-rtc1"]).map(str::to_owned).collect()
    }

    fn uf2_family(&self, context: &Context<'_>) -> Option<u32> {
        self.uf2_family.filter(|_| BootLoader::of(context.job).is_ok_and(|loader| loader.uf2))
    }

    fn begin(&self, context: &Context<'_>, _is_usb: bool) -> Begin {
        // A board that says it wrongly was refused.
        let BootLoader { flash_from, .. } = BootLoader::of(context.job).unwrap_or_default();
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
    use super::{BootLoader, PinName, Pins as _, Settings};

    #[test]
    fn a_boot_loader_is_said_without_mistakes() {
        let read = |text: &str| toml::from_str::<BootLoader>(text).map(|own| own.flash_from);
        assert_eq!(read("flash_from = 0x2_7000\nuf2 = true").ok(), Some(0x2_7000));
        assert!(read("flash_form = 0x2_7000").is_err());
    }

    #[test]
    fn pins_have_the_names_of_the_hal() {
        let settings =
            Settings { flash_bytes: 0, ram_bytes: 0, has_two_stop_bits: true, uf2_family: None };
        let name = |pin: &str| PinName::parse(pin).map(|pin| settings.pin(&pin));
        assert_eq!(name("P0.04").as_deref(), Some("P0_04"));
        assert_eq!(name("P1.15").as_deref(), Some("P1_15"));
    }
}
