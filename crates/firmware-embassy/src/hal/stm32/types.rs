//! Wires of STM32 in the HAL's types. Its traits are made from ST's data by other people, so what they refuse is a
//! mistake of theirs or of ours.

use askama::Template;
use sensedsl_board::signal::{CanLine, Function, I2cLine, SpiLine, TimerLine, UartLine};
use sensedsl_files::print;
use sensedsl_model::kind::KindName;

use super::project::{banks, fine_timers, split, time_driver};
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::types::{Request, Types, UsbWire};

/// The crate of a check.
#[derive(Template)]
#[template(path = "hal/stm32/templates/wiring_check.rs.txt", escape = "none")]
struct Check<'a> {
    calls: &'a [(&'static str, String)],
    lines: &'a [String],
}

/// The functions that the lines call. `{A}` is the parameter for the block of pins, which one family has.
const CALLS: &[(&str, &str)] = &[
    (
        "analog",
        "<T: hal::adc::Instance, P: PeripheralType>(_: Peri<'static, P>) where Peri<'static, P>: hal::adc::AdcChannel<T>",
    ),
    ("adc_dma", "<T: hal::adc::Instance, D: hal::adc::RxDma<T>>(_: Peri<'static, D>)"),
    (
        "dac_out",
        "<T: hal::dac::Instance, C: hal::dac::Channel, P: hal::dac::DacPin<T, C>>(_: Peri<'static, P>)",
    ),
    ("scl", "<T: hal::i2c::Instance{A}, P: hal::i2c::SclPin<T{A}>>(_: Peri<'static, P>)"),
    ("sda", "<T: hal::i2c::Instance{A}, P: hal::i2c::SdaPin<T{A}>>(_: Peri<'static, P>)"),
    ("i2c_rx", "<T: hal::i2c::Instance, D: hal::i2c::RxDma<T>>(_: Peri<'static, D>)"),
    ("i2c_tx", "<T: hal::i2c::Instance, D: hal::i2c::TxDma<T>>(_: Peri<'static, D>)"),
    ("sck", "<T: hal::spi::Instance{A}, P: hal::spi::SckPin<T{A}>>(_: Peri<'static, P>)"),
    ("miso", "<T: hal::spi::Instance{A}, P: hal::spi::MisoPin<T{A}>>(_: Peri<'static, P>)"),
    ("mosi", "<T: hal::spi::Instance{A}, P: hal::spi::MosiPin<T{A}>>(_: Peri<'static, P>)"),
    ("spi_rx", "<T: hal::spi::Instance, D: hal::spi::RxDma<T>>(_: Peri<'static, D>)"),
    ("spi_tx", "<T: hal::spi::Instance, D: hal::spi::TxDma<T>>(_: Peri<'static, D>)"),
    ("uart_tx", "<T: hal::usart::Instance{A}, P: hal::usart::TxPin<T{A}>>(_: Peri<'static, P>)"),
    ("uart_rx", "<T: hal::usart::Instance{A}, P: hal::usart::RxPin<T{A}>>(_: Peri<'static, P>)"),
    ("can_tx", "<T: hal::can::Instance{A}, P: hal::can::TxPin<T{A}>>(_: Peri<'static, P>)"),
    ("can_rx", "<T: hal::can::Instance{A}, P: hal::can::RxPin<T{A}>>(_: Peri<'static, P>)"),
    (
        "channel",
        "<T: hal::timer::GeneralInstance4Channel, C: hal::timer::TimerChannel{A}, P: hal::timer::TimerPin<T, C{A}>>(_: Peri<'static, P>)",
    ),
    (
        "inverted",
        "<T: hal::timer::AdvancedInstance4Channel, C: hal::timer::TimerChannel{A}, P: hal::timer::TimerComplementaryPin<T, C{A}>>(_: Peri<'static, P>)",
    ),
    ("usb_dm", "<T: hal::usb::Instance, P: hal::usb::DmPin<T>>(_: Peri<'static, P>)"),
    ("usb_dp", "<T: hal::usb::Instance, P: hal::usb::DpPin<T>>(_: Peri<'static, P>)"),
];

impl Types for Settings {
    fn features(&self, context: &Context<'_>) -> Vec<String> {
        let chip = &context.chip;
        let always = [chip.feature.as_str(), "exti", "time", "unstable-pac"].map(str::to_owned);
        let split = split(context.job);
        always.into_iter().chain(banks(chip)).chain(split).chain(time_driver(context)).collect()
    }

    fn lock_tags(&self, context: &Context<'_>) -> Vec<&'static str> {
        let clock = time_driver(context).map(|_| "clock");
        fine_timers(&context.chip).into_iter().chain(clock).collect()
    }

    fn calls(&self) -> Vec<(&'static str, String)> {
        let parameter = if self.file.afio { ", A" } else { "" };
        let call =
            |(name, signature): &(&'static str, &str)| (*name, signature.replace("{A}", parameter));
        CALLS.iter().map(call).collect()
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
        let moved = self.block_type(context, unit).map_or(String::new(), |one| format!(", {one}"));
        let unit = context.peripheral(unit);
        let channel = |channel| format!(", hal::timer::Ch{channel}");
        let (call, extra) = match function {
            Function::Adc { .. } => return Some(format!("analog::<{unit}, _>(p.{pin});")),
            Function::Dac { channel, .. } => {
                return Some(format!("dac_out::<{unit}, hal::dac::Ch{channel}, _>(p.{pin});"));
            }
            Function::I2c { line: I2cLine::Scl, .. } => ("scl", String::new()),
            Function::I2c { line: I2cLine::Sda, .. } => ("sda", String::new()),
            Function::Timer { channel: number, line, .. } => match line {
                TimerLine::Inverted => ("inverted", channel(number)),
                TimerLine::Both | TimerLine::Output | TimerLine::Input => {
                    ("channel", channel(number))
                }
            },
            Function::Uart { line: UartLine::Tx, .. } => ("uart_tx", String::new()),
            Function::Uart { line: UartLine::Rx, .. } => ("uart_rx", String::new()),
            Function::Spi { line, .. } => match line {
                SpiLine::Sck => ("sck", String::new()),
                SpiLine::Miso => ("miso", String::new()),
                SpiLine::Mosi => ("mosi", String::new()),
                SpiLine::Nss => return None,
            },
            Function::Can { line: CanLine::Tx, .. } => ("can_tx", String::new()),
            Function::Can { line: CanLine::Rx, .. } => ("can_rx", String::new()),
            Function::Pio { .. } | Function::Other => return None,
        };
        Some(format!("{call}::<{unit}{extra}{moved}, _>(p.{pin});"))
    }

    fn edge(&self, pin: &str, line: u8) -> String {
        format!("edge!(p.{pin}, p.EXTI{line});")
    }

    fn channel(&self, request: &Request<'_>, channel: &str) -> Option<String> {
        let call = match (request.kind, request.signal) {
            (KindName::Analog, _) => "adc_dma",
            (KindName::I2c, Some("RX")) => "i2c_rx",
            (KindName::I2c, Some("TX")) => "i2c_tx",
            (KindName::Spi, Some("RX")) => "spi_rx",
            (KindName::Spi, Some("TX")) => "spi_tx",
            _ => return None,
        };
        Some(format!("{call}::<{}, _>(p.{channel});", request.unit))
    }

    fn usb(&self, unit: &str, wire: UsbWire, pin: &str) -> Option<String> {
        let call = match wire {
            UsbWire::Minus => "usb_dm",
            UsbWire::Plus => "usb_dp",
        };
        Some(format!("{call}::<{unit}, _>(p.{pin});"))
    }
}
