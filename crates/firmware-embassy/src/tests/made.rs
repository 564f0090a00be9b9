//! A made-up HAL, spelled about as `embassy-nrf` spells things. It has drivers for GPIO, analog inputs and USB.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Cycles;
use serde::Deserialize;

use crate::context::Context;
use crate::hal::contract::inputs::{Analog, AnalogInput, each_round};
use crate::hal::contract::link::{Link, LinkPads, PortLink};
use crate::hal::contract::outputs::{Pins, Speed};
use crate::hal::contract::{Begin, CORTEX_M, Drivers, Hal, Package, Project, Watchdog, drivers};
use crate::missing::Printed;
use crate::names::Names;
use crate::section::{Constructor, Section};

pub(super) struct MadeUp;

static PACKAGE: Package = Package {
    name: "made-up",
    crate_name: "embassy-made-up",
    core: &CORTEX_M,
    version: "0.9.0",
    tick_hz: "32_768",
    main_uses: "use embassy_made_up::{self as hal, Peri, gpio::*, interrupt, peripherals::*};\n",
    wiring_uses: "use embassy_made_up::{self as hal, Peri, Peripherals, bind_interrupts, peripherals::*};\n",
    runtime_asks: &["unstable-pac"],
    runtime_features: &[],
    runtime_needs: &[],
    check_needs: &[],
    loader: None,
};

/// The keys of `[system]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    saadc_bits: u8,
}

impl Hal for MadeUp {
    fn package(&self) -> &'static Package {
        &PACKAGE
    }

    fn drivers(&self, names: &Names) -> Result<Box<dyn Drivers>, String> {
        Ok(Box::new(names.settings::<Settings>()?))
    }
}

drivers! {
    Settings;
    analog: Analog,
}

impl Project for Settings {
    fn features(&self, context: &Context<'_>) -> Vec<String> {
        vec![context.chip.feature.clone(), "gpiote".to_owned()]
    }

    fn begin(&self, _context: &Context<'_>, _is_usb: bool) -> Begin {
        Begin {
            config_type: "hal::config::Config",
            config: vec!["hal::config::Config::default()".to_owned()],
            start: vec![
                "STATUS.begin(hal::pac::POWER.resetreas().read().0);".to_owned(),
                "let wiring = wiring::wire(hal::init(config()));".to_owned(),
            ],
            watchdog: Watchdog {
                type_: "crate::rt::watchdog::Watchdog".to_owned(),
                make: "crate::rt::watchdog::Watchdog::new(p.WDT, WATCHDOG_US)".to_owned(),
            },
            scripts: "",
            memory: None,
        }
    }

    fn last_priority(&self, _context: &Context<'_>) -> usize {
        7
    }
}

impl Pins for Settings {
    /// `P0_04` of `GP4`
    fn pin(&self, pin: &PinName) -> String {
        let number: u8 = pin.as_str().trim_start_matches("GP").parse().unwrap();
        format!("P{}_{:02}", number / 32, number % 32)
    }

    fn output(&self, pin: &PinName, level: &str, _speed: Speed) -> String {
        format!("Output::new(p.{}, {level}, OutputDrive::Standard)", self.pin(pin))
    }
}

impl Analog for Settings {
    fn converter(
        &self,
        context: &Context<'_>,
        unit: &str,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let (hal, interrupt) = (context.peripheral(unit), context.interrupt(unit, "GLOBAL")?);
        section.bind(interrupt, "hal::saadc::InterruptHandler".to_owned());
        let bits = self.saadc_bits;
        Ok(Constructor {
            type_: "hal::saadc::Saadc<'static, 1>".to_owned(),
            make: format!(
                "hal::saadc::Saadc::new(p.{hal}, Irqs, hal::saadc::Resolution::_{bits}BIT)"
            ),
        })
    }

    fn input(&self, _context: &Context<'_>, _unit: &str, pin: &PinName) -> Constructor {
        Constructor {
            type_: "hal::saadc::AnyInput<'static>".to_owned(),
            make: format!("hal::saadc::Input::degrade_saadc(p.{})", self.pin(pin)),
        }
    }

    fn sample(&self, inputs: &[AnalogInput<'_>], _sampling: Cycles, samples: &str) -> Vec<String> {
        vec![each_round(inputs, samples, |name, AnalogInput { wire, converter, .. }| {
            format!("{converter}.sample(&mut {}, {name}).await;", wire.ident)
        })]
    }
}

impl Link for Settings {
    fn port(
        &self,
        _context: &Context<'_>,
        _port: &LinkPads<'_>,
        _section: &mut Section,
    ) -> Option<PortLink> {
        None
    }
}
