//! Wires of nRF52 in the HAL's types: which units there are, which pins are analog, and that none is taken twice. A unit
//! takes any pin, so the rest says little.

use askama::Template;
use sensedsl_board::signal::Function;
use sensedsl_files::print;

use super::project::features;
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::types::{Request, Types};

/// The crate of a check.
#[derive(Template)]
#[template(path = "hal/nrf/templates/wiring_check.rs.txt", escape = "none")]
struct Check<'a> {
    calls: &'a [(&'static str, String)],
    lines: &'a [String],
}

/// The functions that the lines call.
const CALLS: &[(&str, &str)] = &[
    ("analog", "<P: hal::saadc::Input>(_: P)"),
    ("captures", "<T: hal::timer::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
    ("decodes", "<T: hal::qdec::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
    ("i2c", "<T: hal::twim::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
    ("pulses", "<T: hal::pwm::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
    ("serial", "<T: hal::uarte::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
    ("spi", "<T: hal::spim::Instance, P: hal::gpio::Pin>(_: Peri<'static, P>)"),
];

impl Types for Settings {
    fn features(&self, context: &Context<'_>) -> Vec<String> {
        features(context).into_iter().map(str::to_owned).collect()
    }

    fn calls(&self) -> Vec<(&'static str, String)> {
        CALLS.iter().map(|(name, signature)| (*name, (*signature).to_owned())).collect()
    }

    fn print(&self, calls: &[(&'static str, String)], lines: &[String]) -> String {
        print(&Check { calls, lines })
    }

    fn wire(
        &self,
        context: &Context<'_>,
        unit: &str,
        function: &Function,
        pin: &str,
    ) -> Option<String> {
        let hal = context.peripheral(unit);
        let call = match function {
            Function::Adc { .. } => return Some(format!("analog::<_>(p.{pin});")),
            Function::I2c { .. } => "i2c",
            Function::Spi { .. } => "spi",
            Function::Uart { .. } => "serial",
            Function::Timer { .. } if unit.starts_with("PWM") => "pulses",
            Function::Timer { .. } if unit.starts_with("QDEC") => "decodes",
            Function::Timer { .. } => "captures",
            Function::Can { .. }
            | Function::Dac { .. }
            | Function::Pio { .. }
            | Function::Other => return None,
        };
        Some(format!("{call}::<{hal}, _>(p.{pin});"))
    }

    /// Units have DMA of their own.
    fn channel(&self, _request: &Request<'_>, _channel: &str) -> Option<String> {
        None
    }
}
