//! A project on `embassy-stm32` as a whole: its crate's features, clocks, watchdog, the cause of the last reset.

use std::collections::BTreeSet;

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::TargetProfile;
use sensedsl_job::BoardJob;

use super::clock;
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Pins, Speed};
use crate::hal::contract::{Begin, Project, Watchdog};
use crate::names::{Chip, Names};

impl Pins for Settings {
    fn pin(&self, pin: &PinName) -> String {
        pin.to_string()
    }

    fn output(&self, pin: &PinName, level: &str, speed: Speed) -> String {
        let speed = match speed {
            Speed::Low => "Low",
            Speed::Medium => "Medium",
        };
        format!("Output::new(p.{pin}, {level}, Speed::{speed})")
    }
}

/// The pads of JTAG on F1 that are not those of SWD: JTDI, JTDO and NJTRST (reference manual RM0008, 9.3.5).
const JTAG: [&str; 3] = ["PA15", "PB3", "PB4"];

impl Project for Settings {
    fn problems(&self, profile: &TargetProfile, names: &Names) -> Vec<String> {
        let line = &profile.line;
        let mut problems = Vec::new();
        if self.lacks_buses() && !profile.i2cs.is_empty() {
            problems.push(format!("{line}: I2C units without a version"));
        }
        if self.lacks_can() && !profile.cans.is_empty() {
            problems.push(format!("{line}: CAN controllers without a driver"));
        }
        for timer in &profile.timers {
            if timer.icu.is_some() && names.interrupt(&timer.name, "CC").is_none() {
                problems.push(format!("{line}: {} has no interrupt", timer.name));
            }
        }
        for unit in &profile.i2cs {
            if names.interrupt(&unit.name, "EV").is_none() {
                problems.push(format!("{line}: {} has no interrupt", unit.name));
            }
        }
        problems
    }

    /// The HAL's clock runs on a timer that no device may have.
    fn refusal(&self, job: &BoardJob<'_>, profile: &TargetProfile) -> Option<String> {
        if clock::timer(job, profile).is_some() {
            return None;
        }
        let timers = profile.kernel.timers.join(", ");
        Some(format!(
            "its devices leave no timer for Embassy's clock, which runs on one of {timers}; another pin or kind for \
             one of them frees one"
        ))
    }

    fn features(&self, context: &Context<'_>) -> Vec<String> {
        let always = ["exti", "memory-x", "unstable-pac"].map(str::to_owned);
        std::iter::once(context.chip.feature.clone())
            .chain(banks(&context.chip))
            .chain(split(context.job))
            .chain(time_driver(context))
            .chain(always)
            .collect()
    }

    fn lock_tags(&self, chip: &Chip) -> Vec<&'static str> {
        fine_timers(chip).into_iter().collect()
    }

    fn begin(&self, context: &Context<'_>, is_usb: bool) -> Begin {
        let unit = if context.profile.family == "STM32H7" { "IWDG1" } else { "IWDG" };
        Begin {
            config_type: "hal::Config",
            config: self.config(context, is_usb),
            start: self.start(context),
            watchdog: Watchdog {
                type_: format!("hal::wdg::IndependentWatchdog<'static, {unit}>"),
                make: format!("hal::wdg::IndependentWatchdog::new(p.{unit}, WATCHDOG_US)"),
            },
            scripts: "",
            memory: None,
        }
    }

    fn last_priority(&self, context: &Context<'_>) -> usize {
        // Cores of ARMv6-M have two bits of priority, and the HAL uses three of the others.
        if context.names.target.starts_with("thumbv6m") { 3 } else { 7 }
    }
}

impl Settings {
    /// The body of the function that makes the HAL's configuration.
    fn config(&self, context: &Context<'_>, is_usb: bool) -> Vec<String> {
        let clock = self.line.clock.as_ref();
        let clocks = clock.and_then(|clock| clock.lines(&context.crystal(), is_usb));
        let clocks = clocks.unwrap_or_default();
        let mut sets: Vec<String> =
            clocks.iter().map(|clock| format!("config.rcc.{clock};")).collect();
        if self.file.afio && takes_jtag(context.job) {
            // The pads that JTAG has after a reset; the two of SWD remain.
            sets.push("config.swj = hal::gpio::SwjCfg::SwdOnly;".to_owned());
        }
        if sets.is_empty() {
            return vec!["hal::Config::default()".to_owned()];
        }
        let uses = (!clocks.is_empty()).then(|| "use hal::rcc::*;".to_owned());
        let begin = "let mut config = hal::Config::default();".to_owned();
        let end = "config".to_owned();
        uses.into_iter().chain([begin]).chain(sets).chain([end]).collect()
    }

    /// The first statements of `main`, up to the wiring.
    fn start(&self, context: &Context<'_>) -> Vec<String> {
        let mut lines = match &self.file.reset {
            Some(reset) => vec![
                format!("STATUS.begin(hal::pac::RCC.{reset}().read().0);"),
                format!("hal::pac::RCC.{reset}().modify(|flags| flags.set_rmvf(true));"),
            ],
            None => vec!["STATUS.begin(0);".to_owned()],
        };
        // The MCU may have a second core, which gets no program.
        if context.chip.feature.contains("-cm") {
            lines.extend(
                [
                    "// What a program of the other core would wait for.",
                    "static SHARED: core::mem::MaybeUninit<hal::SharedData> = core::mem::MaybeUninit::uninit();",
                    "let wiring = wiring::wire(hal::init_primary(config(), &SHARED));",
                ]
                .map(str::to_owned),
            );
        } else {
            lines.push("let wiring = wiring::wire(hal::init(config()));".to_owned());
        }
        lines
    }
}

/// Whether a wire is on a pad that the debug port has after a reset, though SWD does not need it.
fn takes_jtag(job: &BoardJob<'_>) -> bool {
    let linked = job.link.iter().flat_map(|link| &link.pads);
    let mut pads = job.connections.iter().flat_map(|one| &one.pads).chain(linked);
    pads.any(|pad| JTAG.contains(&pad.pin.name.as_str()))
}

/// The feature that says how many banks the flash has.
pub(super) fn banks(chip: &Chip) -> Option<String> {
    chip.banks.then(|| "dual-bank".to_owned())
}

/// The feature for the timer that the clock runs on; `None` if the devices leave none.
pub(super) fn time_driver(context: &Context<'_>) -> Option<String> {
    let timer = clock::timer(context.job, context.profile)?;
    Some(format!("time-driver-{}", timer.to_lowercase()))
}

/// The features that separate pins whose analog side is a pin of its own, `PA1_C`, from their digital sides.
pub(super) fn split(job: &BoardJob<'_>) -> BTreeSet<String> {
    let pads = job.connections.iter().flat_map(|one| &one.pads);
    let pins = pads.filter_map(|pad| pad.pin.name.as_str().strip_suffix("_C"));
    pins.map(|pin| format!("split-{}", pin.to_lowercase())).collect()
}

/// The high-resolution timers of a chip, for which the HAL takes further crates.
pub(super) fn fine_timers(chip: &Chip) -> Option<&'static str> {
    let starts = |starts: &[&str]| starts.iter().any(|start| chip.feature.starts_with(start));
    if starts(&["stm32g474", "stm32g484"]) {
        Some("g4")
    } else if starts(&["stm32f334"]) {
        Some("f3")
    } else {
        None
    }
}
