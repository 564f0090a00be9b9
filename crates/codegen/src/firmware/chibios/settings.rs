//! What changes in the demo's `chconf.h`, `halconf.h` and `mcuconf.h`.

use std::collections::BTreeSet;

use sensedsl_board::profile::{DmaRequest, Fallback};
use sensedsl_board::signal::UnitName;
use sensedsl_model::kind::Kind;

use super::context::Context;
use super::i2c::I2cPlan;
use super::link::LinkPlan;

/// All settings.
#[derive(Clone, Debug)]
pub(super) struct SettingsPlan {
    /// The kernel has the core's tick instead of a timer.
    pub(super) is_systick: bool,
    /// What has the kernel's time, for people.
    pub(super) kernel_clock: String,
    /// For `halconf.h`: name and value.
    pub(super) hal: Vec<Setting>,
    /// For `mcuconf.h`.
    pub(super) mcu: Vec<Setting>,
    /// The macros of DMA streams in use.
    pub(super) dma: Vec<String>,
}

/// `#define NAME VALUE`
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Setting {
    pub(super) name: String,
    pub(super) value: String,
}

pub(super) fn plan(context: &Context<'_>, i2c: &I2cPlan, link: &LinkPlan) -> SettingsPlan {
    let units = units(context);
    let kernel_timer = kernel_timer(context, &units);
    let mut mcu = Vec::new();
    let used = switches(context, &units, link);
    let off = context.profile.off.switches.iter().filter(|switch| !used.contains(switch));
    mcu.extend(off.map(|switch| setting(switch, "FALSE")));
    if let Some(timer) = &kernel_timer {
        let number = timer.trim_start_matches("TIM");
        mcu.push(setting(&context.profile.kernel.option, number));
    }
    mcu.extend(used.iter().map(|switch| setting(switch, "TRUE")));
    mcu.extend(converter_clock(context));
    mcu.extend(busy(context, i2c, kernel_timer.is_none()));
    let streams = streams(context, &units);
    mcu.extend(streams.iter().cloned());
    SettingsPlan {
        is_systick: kernel_timer.is_none(),
        kernel_clock: kernel_timer.unwrap_or_else(|| "SysTick".to_owned()),
        hal: hal(context, link),
        mcu,
        dma: streams.into_iter().map(|setting| setting.name).collect(),
    }
}

fn setting(name: &str, value: &str) -> Setting {
    Setting { name: name.to_owned(), value: value.to_owned() }
}

/// The peripheral instances of all devices, in natural order.
fn units(context: &Context<'_>) -> Vec<UnitName> {
    let units = context.devices.iter().filter_map(|wired| wired.wiring.unit.as_deref());
    let units: BTreeSet<UnitName> = units.map(UnitName::new).collect();
    units.into_iter().collect()
}

/// The first timer that no device has; none for the core's tick.
fn kernel_timer(context: &Context<'_>, units: &[UnitName]) -> Option<String> {
    let kernel = &context.profile.kernel;
    let is_free = |timer: &&String| units.iter().all(|unit| unit.as_str() != timer.as_str());
    let free = kernel.timers.iter().find(is_free);
    match kernel.fallback {
        Some(Fallback::Systick) => free.cloned(),
        // Without a fallback the wiring has kept one free.
        None => free.or(kernel.timers.first()).cloned(),
    }
}

fn switches(context: &Context<'_>, units: &[UnitName], link: &LinkPlan) -> Vec<String> {
    let mut switches = match link {
        LinkPlan::Usb { switches, .. } => switches.clone(),
        LinkPlan::Uart { switch, .. } => vec![switch.clone()],
    };
    let profile = context.profile;
    for unit in units {
        let name = unit.as_str();
        let adc = profile.adcs.iter().find(|adc| adc.name == name).map(|adc| &adc.switch);
        let timer = profile.timers.iter().find(|timer| timer.name == name);
        let icu = timer.and_then(|timer| timer.icu.as_ref()).map(|icu| &icu.switch);
        let bus = profile.unit(name).map(|unit| &unit.switch);
        switches.extend(adc.or(bus).or(icu).cloned());
    }
    switches
}

/// The streams of all requests, by the macro that names each.
fn streams(context: &Context<'_>, units: &[UnitName]) -> Vec<Setting> {
    let mut settings = Vec::new();
    for unit in units {
        for DmaRequest { name, option, id, .. } in context.profile.dma(unit.as_str()) {
            let Some(option) = option else { continue };
            let stream = context.stream(unit.as_str(), name);
            settings.extend(stream.map(|stream| setting(option, &id.of(stream))));
        }
    }
    settings
}

/// While a bus is busy the driver holds the processor, and nobody of its priority or a lower one runs.
/// Between two transfers that is the time of a stop condition; all else is a bus that hangs, and will be
/// clocked free. A tick of a millisecond is one more, for the first of them is cut short.
fn busy(context: &Context<'_>, i2c: &I2cPlan, is_systick: bool) -> Option<Setting> {
    let option = context.profile.i2c.busy_option.as_deref()?;
    let stop_ms = i2c.ports.iter().map(|port| port.stop_ms).max()?;
    Some(setting(option, &(stop_ms + u32::from(is_systick)).to_string()))
}

/// The converters' clock is told, so that it is what their times were computed with.
fn converter_clock(context: &Context<'_>) -> Option<Setting> {
    let has_analog =
        context.devices.iter().any(|wired| matches!(wired.device.kind, Kind::Analog(_)));
    let [option, value] = context.profile.adc.clock_option.as_ref().filter(|_| has_analog)?;
    Some(setting(option, value))
}

fn hal(context: &Context<'_>, link: &LinkPlan) -> Vec<Setting> {
    let has = |is_kind: fn(&Kind) -> bool| {
        context.devices.iter().any(|wired| is_kind(&wired.device.kind))
    };
    let truth = |value: bool| if value { "TRUE" } else { "FALSE" };
    let mut settings = vec![
        setting("HAL_USE_PAL", "TRUE"),
        setting("HAL_USE_ADC", truth(has(|kind| matches!(kind, Kind::Analog(_))))),
        setting("HAL_USE_I2C", truth(has(|kind| matches!(kind, Kind::I2c(_))))),
        setting("HAL_USE_ICU", truth(has(|kind| matches!(kind, Kind::Icu(_))))),
        setting("HAL_USE_SERIAL", truth(!link.is_usb())),
        setting("HAL_USE_SERIAL_USB", truth(link.is_usb())),
        setting("HAL_USE_USB", truth(link.is_usb())),
        setting("ADC_USE_WAIT", "TRUE"),
        setting("ADC_USE_MUTUAL_EXCLUSION", "TRUE"),
        setting("I2C_USE_MUTUAL_EXCLUSION", "TRUE"),
        setting("ICU_USE_OVERFLOW_SCALING", "FALSE"),
    ];
    if !link.is_usb() {
        settings.push(setting("SERIAL_BUFFERS_SIZE", "256"));
    }
    settings
}
