//! Analog inputs of the converters of STM32, which differ from family to family in how they are made and read.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Cycles;

use super::settings::{AdcNew, AdcRead, Settings};
use crate::context::Context;
use crate::hal::contract::inputs::{Analog, AnalogInput, SampleRoom, each_round};
use crate::item::{Handler, Item};
use crate::missing::Printed;
use crate::section::{Constructor, Section};

impl Analog for Settings {
    fn converter(
        &self,
        context: &Context<'_>,
        unit: &str,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit);
        if self.file.adc.read == AdcRead::Async {
            // The HAL turns the interrupt on whether or not it asks for the handler.
            let interrupt = context.interrupt(unit, "GLOBAL")?;
            section.bind(interrupt, format!("hal::adc::InterruptHandler<{hal}>"));
        }
        let arguments = match self.file.adc.new {
            AdcNew::Unit => "",
            AdcNew::Interrupt => ", Irqs",
            AdcNew::Resolution => ", hal::adc::Resolution::BITS12",
            AdcNew::Default => ", hal::adc::AdcConfig::default()",
        };
        if self.file.adc.read == AdcRead::Sampler {
            sampler(context, unit, section)?;
        }
        Ok(Constructor {
            type_: format!("hal::adc::Adc<'static, {hal}>"),
            make: format!("hal::adc::Adc::new(p.{hal}{arguments})"),
        })
    }

    fn input(&self, context: &Context<'_>, unit: &str, pin: &PinName) -> Constructor {
        let plain = |make| Constructor { type_: format!("Peri<'static, {pin}>"), make };
        match self.file.adc.read {
            AdcRead::Blocking => plain(format!("p.{pin}")),
            // The HAL leaves the pin as it was after the reset; a `Flex` leaves it analog.
            AdcRead::Async => plain(format!(
                "{{ let mut pin = p.{pin}; drop(hal::gpio::Flex::new(pin.reborrow())); pin }}"
            )),
            AdcRead::Sampler => Constructor {
                type_: format!("hal::adc::AnyAdcChannel<'static, {}>", context.peripheral(unit)),
                make: format!("hal::adc::AdcChannel::degrade_adc(p.{pin})"),
            },
        }
    }

    fn room(&self) -> SampleRoom {
        match self.file.adc.read {
            AdcRead::Blocking | AdcRead::Async => SampleRoom::Task,
            AdcRead::Sampler => SampleRoom::Interrupt,
        }
    }

    fn sample(&self, inputs: &[AnalogInput<'_>], sampling: Cycles, samples: &str) -> Vec<String> {
        let time = sample_time(sampling);
        match self.file.adc.read {
            AdcRead::Blocking => vec![rows(inputs, samples, "blocking_read", &time, "")],
            AdcRead::Async => vec![rows(inputs, samples, "read", &time, ".await")],
            AdcRead::Sampler => columns(inputs, samples, &time),
        }
    }
}

/// All inputs one right after the other, as often as there are samples.
fn rows(inputs: &[AnalogInput<'_>], samples: &str, call: &str, time: &str, wait: &str) -> String {
    each_round(inputs, samples, |name, AnalogInput { wire, converter, .. }| {
        let ident = &wire.ident;
        format!("*{name} = {converter}.{call}(&mut {ident}, hal::adc::SampleTime::{time}){wait};")
    })
}

/// All samples of an input, then those of the next: the interrupt of the converter takes them.
fn columns(inputs: &[AnalogInput<'_>], samples: &str, time: &str) -> Vec<String> {
    let count = inputs.len();
    let fill = |(at, AnalogInput { wire, unit, .. }): (usize, &AnalogInput<'_>)| {
        let ident = &wire.ident;
        format!(
            "{samples} = {unit}_SAMPLER.fill({ident}.get_hw_channel(), hal::adc::SampleTime::{time}, {samples}, {at}, {count}).await;"
        )
    };
    inputs.iter().enumerate().map(fill).collect()
}

/// The static that samples with a converter, and the handler of its interrupt, which converters may share.
fn sampler(context: &Context<'_>, unit: &str, section: &mut Section) -> Printed<()> {
    section.features.insert("adc-v2");
    let interrupt = context.interrupt(unit, "GLOBAL")?;
    let (name, sampler) = (format!("{unit}_SAMPLES"), format!("{unit}_SAMPLER"));
    section.items.push(Item::Static {
        doc: format!("The samples of {unit}"),
        line: format!(
            "static {sampler}: rt::converter::Sampler = rt::converter::Sampler::new(hal::pac::{});",
            context.peripheral(unit)
        ),
    });
    section.bind(interrupt, format!("crate::{name}"));
    section.items.push(Item::Handler(Handler {
        doc: format!("The end of a conversion of {unit}"),
        name,
        named_as: "the converter",
        interrupt: interrupt.to_owned(),
        calls: vec![format!("{sampler}.on_interrupt();")],
    }));
    section.begins.push("// Its handler is there.".to_owned());
    section.begins.push(format!("unsafe {{ interrupt::{interrupt}.enable() }};"));
    Ok(())
}

/// `CYCLES84`, `CYCLES1_5`
fn sample_time(cycles: Cycles) -> String {
    let half = if cycles.halves() % 2 == 1 { "_5" } else { "" };
    format!("CYCLES{}{half}", cycles.whole())
}
