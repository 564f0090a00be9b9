//! What changes in the demo's `chconf.h`, `halconf.h` and `mcuconf.h`.

use std::collections::BTreeSet;

use sensedsl_board::signal::UnitName;

use super::context::Context;
use super::link::LinkPlan;
use super::names::Setting;
use super::section::{GuardPlan, Section};

/// All settings.
#[derive(Clone, Debug)]
pub(super) struct SettingsPlan {
    /// The kernel has the core's tick instead of a timer.
    pub(super) is_systick: bool,
    /// What has the kernel's time, for people.
    pub(super) kernel_clock: String,
    /// For `halconf.h`.
    pub(super) hal: Vec<Setting>,
    /// For `mcuconf.h`.
    pub(super) mcu: Vec<Setting>,
    /// The macros of DMA streams in use.
    dma: Vec<String>,
}

pub(super) fn plan(context: &Context<'_>, sections: &[Section], link: &LinkPlan) -> SettingsPlan {
    let units: BTreeSet<&UnitName> = sections.iter().flat_map(|section| &section.units).collect();
    let used = units.iter().flat_map(|unit| context.names.switches(unit.as_str()));
    let own = sections.iter().flat_map(|section| section.switches.iter().cloned());
    let used: Vec<String> = link.switches().iter().cloned().chain(used).chain(own).collect();
    let off = context.names.off.switches.iter().filter(|switch| !used.contains(switch));
    let mut mcu: Vec<Setting> = off.map(|switch| Setting::new(switch, "FALSE")).collect();
    if let Some(timer) = &context.kernel_timer {
        let number = timer.trim_start_matches("TIM");
        mcu.push(Setting::new(&context.names.kernel_option, number));
    }
    mcu.extend(used.iter().map(|switch| Setting::new(switch, "TRUE")));
    // The watchdog and its oscillator.
    mcu.extend(["STM32_WDG_USE_IWDG", "STM32_LSI_ENABLED"].map(|one| Setting::new(one, "TRUE")));
    mcu.extend(sections.iter().flat_map(|section| section.mcu.iter().cloned()));
    let streams = streams(context, &units);
    mcu.extend(streams.iter().cloned());
    SettingsPlan {
        is_systick: context.kernel_timer.is_none(),
        kernel_clock: context.kernel_timer.clone().unwrap_or_else(|| "SysTick".to_owned()),
        hal: hal(sections, link),
        mcu,
        dma: streams.into_iter().map(|setting| setting.name).collect(),
    }
}

/// The streams of all requests, by the macro that names each.
fn streams(context: &Context<'_>, units: &BTreeSet<&UnitName>) -> Vec<Setting> {
    let mut settings = Vec::new();
    for unit in units {
        let devices = &context.job.devices;
        let Some(device) = devices.iter().find(|one| one.unit == Some(unit.as_str())) else {
            continue;
        };
        for request in context.profile.dma(unit.as_str()) {
            let served = device.streams.iter().find(|one| one.request == request.name);
            settings.extend(served.and_then(|served| {
                context.names.stream(unit.as_str(), served.request, served.stream)
            }));
        }
    }
    settings
}

fn hal(sections: &[Section], link: &LinkPlan) -> Vec<Setting> {
    let truth = |value: bool| if value { "TRUE" } else { "FALSE" };
    let mut settings = vec![Setting::new("HAL_USE_PAL", "TRUE")];
    settings.extend(sections.iter().filter_map(|section| section.switch.clone()));
    settings.extend([
        Setting::new("HAL_USE_SERIAL", truth(!link.is_usb())),
        Setting::new("HAL_USE_SERIAL_USB", truth(link.is_usb())),
        Setting::new("HAL_USE_USB", truth(link.is_usb())),
        Setting::new("HAL_USE_WDG", "TRUE"),
    ]);
    settings.extend(sections.iter().flat_map(|section| section.hal.iter().cloned()));
    if !link.is_usb() {
        settings.push(Setting::new("SERIAL_BUFFERS_SIZE", "256"));
    }
    settings
}

/// What the C compiler is asked to check against the user's tree, because nothing else would.
pub(super) fn guards(
    context: &Context<'_>,
    sections: &[Section],
    settings: &SettingsPlan,
) -> Vec<GuardPlan> {
    let mut guards = Vec::new();
    streams_differ(settings, &mut guards);
    guards.extend(sections.iter().flat_map(|section| section.guards.iter().cloned()));
    let clocks = clocks(context, sections);
    let needed =
        context.chibios.clocks_hz.iter().filter(|(name, _)| clocks.contains(name.as_str()));
    guards.extend(needed.map(|(name, hz)| GuardPlan {
        condition: format!("{name} == {hz}U"),
        message: format!("{name} is not what this wiring was made for"),
    }));
    guards
}

/// The macros of clocks that the computed times are true for.
fn clocks<'a>(context: &'a Context<'_>, sections: &'a [Section]) -> BTreeSet<&'a str> {
    let core = context.profile.costs.as_ref().map(|costs| costs.clock.as_str());
    let link = context.job.link.as_ref().and_then(|link| context.profile.unit(link.unit));
    let own = core.into_iter().chain(link.and_then(|unit| unit.clock.as_deref()));
    let sections = sections.iter().flat_map(|section| &section.clocks);
    own.chain(sections.map(String::as_str)).collect()
}

/// Two drivers on one stream compile, and fail at run time.
fn streams_differ(settings: &SettingsPlan, guards: &mut Vec<GuardPlan>) {
    for (at, first) in settings.dma.iter().enumerate() {
        for second in settings.dma.iter().skip(at + 1) {
            guards.push(GuardPlan {
                condition: format!("{first} !=\n               {second}"),
                message: "two drivers have one DMA stream".to_owned(),
            });
        }
    }
}
