//! Wires of RP2040 and RP2350 in the HAL's types.

use askama::Template;
use sensedsl_board::signal::{Function, I2cLine, SpiLine, TimerLine, UartLine};
use sensedsl_files::print;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::types::{Request, Types};

/// The crate of a check.
#[derive(Template)]
#[template(path = "hal/rp/templates/wiring_check.rs.txt", escape = "none")]
struct Check<'a> {
    calls: &'a [(&'static str, String)],
    lines: &'a [String],
}

/// What cargo needs for ARMv8-M: the HAL names registers that the core's crate only has for these cores, even when it
/// is checked for another one.
const CONFIG: &str = include_str!("templates/check_config.toml.txt");

/// The functions that the lines call.
const CALLS: &[(&str, &str)] = &[
    ("analog", "<P: hal::adc::AdcPin>(_: Peri<'static, P>)"),
    ("scl", "<T: hal::i2c::Instance, P: hal::i2c::SclPin<T>>(_: Peri<'static, P>)"),
    ("sda", "<T: hal::i2c::Instance, P: hal::i2c::SdaPin<T>>(_: Peri<'static, P>)"),
    ("sck", "<T: hal::spi::Instance, P: hal::spi::ClkPin<T>>(_: Peri<'static, P>)"),
    ("miso", "<T: hal::spi::Instance, P: hal::spi::MisoPin<T>>(_: Peri<'static, P>)"),
    ("mosi", "<T: hal::spi::Instance, P: hal::spi::MosiPin<T>>(_: Peri<'static, P>)"),
    ("uart_tx", "<T: hal::uart::Instance, P: hal::uart::TxPin<T>>(_: Peri<'static, P>)"),
    ("uart_rx", "<T: hal::uart::Instance, P: hal::uart::RxPin<T>>(_: Peri<'static, P>)"),
    ("pio", "<T: hal::pio::Instance, P: hal::pio::PioPin>(_: Peri<'static, P>)"),
    ("channel_a", "<T: hal::pwm::Slice, P: hal::pwm::ChannelAPin<T>>(_: Peri<'static, P>)"),
    ("channel_b", "<T: hal::pwm::Slice, P: hal::pwm::ChannelBPin<T>>(_: Peri<'static, P>)"),
];

impl Types for Settings {
    fn features(&self, context: &Context<'_>) -> Vec<String> {
        [context.chip.feature.as_str(), "unstable-pac"].map(str::to_owned).into()
    }

    fn cargo_config(&self, context: &Context<'_>) -> Option<&'static str> {
        context.names.target.starts_with("thumbv8m").then_some(CONFIG)
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
        let unit = context.peripheral(unit);
        let call = match function {
            // There is one converter.
            Function::Adc { .. } => return Some(format!("analog::<_>(p.{pin});")),
            Function::I2c { line, .. } => match line {
                I2cLine::Scl => "scl",
                I2cLine::Sda => "sda",
            },
            Function::Timer { channel, line, .. } => match (line, channel) {
                (TimerLine::Inverted, _) => return None,
                (TimerLine::Both | TimerLine::Output | TimerLine::Input, 1) => "channel_a",
                (TimerLine::Both | TimerLine::Output | TimerLine::Input, _) => "channel_b",
            },
            Function::Uart { line, .. } => match line {
                UartLine::Tx => "uart_tx",
                UartLine::Rx => "uart_rx",
            },
            Function::Spi { line, .. } => match line {
                SpiLine::Sck => "sck",
                SpiLine::Miso => "miso",
                SpiLine::Mosi => "mosi",
                SpiLine::Nss => return None,
            },
            Function::Pio { .. } => "pio",
            Function::Can { .. } | Function::Dac { .. } | Function::Other => return None,
        };
        Some(format!("{call}::<{unit}, _>(p.{pin});"))
    }

    /// Any channel serves any unit.
    fn channel(&self, _request: &Request<'_>, channel: &str) -> Option<String> {
        Some(format!("dma(p.{channel});"))
    }
}
