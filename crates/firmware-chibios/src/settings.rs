//! The changes to the demo's `chconf.h`, `halconf.h` and `mcuconf.h`.

use std::collections::BTreeSet;

use sensedsl_board::signal::UnitName;

use super::context::{Context, KERNEL_HZ, TICK_HZ};
use super::link::LinkPlan;
use super::names::Setting;
use super::section::{GuardPlan, Section};

/// All settings.
#[derive(Clone, Debug)]
pub(super) struct SettingsPlan {
    /// The source of the kernel's time.
    pub(super) kernel: KernelPlan,
    /// The settings for `halconf.h`.
    pub(super) hal: Vec<Setting>,
    /// The settings for `mcuconf.h`.
    pub(super) mcu: Vec<Setting>,
    /// The linker sections for buffers, and the macros by which the runtime refers to them.
    pub(super) memory: Vec<Setting>,
    /// The DMA streams in use.
    dma: Vec<StreamPlan>,
}

/// A stream, by the macro that names it.
#[derive(Clone, Debug)]
struct StreamPlan {
    setting: Setting,
    /// True if it is a stream of the basic controller, which are numbered separately.
    is_basic: bool,
}

/// The source of the kernel's time.
#[derive(Clone, Debug)]
pub(super) struct KernelPlan {
    /// `TIM2`
    pub(super) name: String,
    /// The reason, for people.
    pub(super) why: String,
    /// True if a timer wakes the kernel when something is due, instead of a tick.
    pub(super) is_tickless: bool,
    /// The width of the counter.
    pub(super) bits: u8,
    pub(super) hz: u32,
}

impl KernelPlan {
    fn new(context: &Context<'_>) -> Self {
        let Some(kernel) = &context.kernel_timer else {
            let why = "the core's own tick, for there is no timer that could have it".to_owned();
            return Self {
                name: "SysTick".to_owned(),
                why,
                is_tickless: false,
                bits: 32,
                hz: TICK_HZ,
            };
        };
        let bits = context.profile.timer(kernel).map_or(32, |timer| timer.bits);
        let why = format!(
            "{kernel}, which counts {bits} bits and wakes the kernel when something is due"
        );
        Self { name: kernel.clone(), why, is_tickless: true, bits, hz: KERNEL_HZ }
    }
}

pub(super) fn plan(context: &Context<'_>, sections: &[Section], link: &LinkPlan) -> SettingsPlan {
    let units: BTreeSet<&UnitName> = sections.iter().flat_map(|section| &section.units).collect();
    let used = units.iter().flat_map(|unit| context.names.switches(unit.as_str()));
    let own = sections.iter().flat_map(|section| section.switches.iter().cloned());
    let used: Vec<String> = link.switches().iter().cloned().chain(used).chain(own).collect();
    let off = context.names.off.switches.iter().filter(|switch| !used.contains(switch));
    let changes = context.chibios.changes.iter();
    let mut mcu: Vec<Setting> = changes.map(|(name, value)| Setting::new(name, value)).collect();
    mcu.extend(off.map(|switch| Setting::new(switch, "FALSE")));
    if let Some(timer) = &context.kernel_timer {
        let number = timer.trim_start_matches("TIM");
        mcu.push(Setting::new(&context.names.kernel_option, number));
    }
    mcu.extend(link.settings().iter().cloned());
    mcu.extend(used.iter().map(|switch| Setting::new(switch, "TRUE")));
    // The watchdog and its oscillator.
    mcu.extend(["STM32_WDG_USE_IWDG", "STM32_LSI_ENABLED"].map(|one| Setting::new(one, "TRUE")));
    mcu.extend(context.names.memory_settings());
    mcu.extend(sections.iter().flat_map(|section| section.mcu.iter().cloned()));
    let streams = streams(context, &units);
    mcu.extend(streams.iter().map(|stream| stream.setting.clone()));
    SettingsPlan {
        kernel: KernelPlan::new(context),
        hal: hal(sections, link),
        mcu,
        memory: memory(context),
        dma: streams,
    }
}

/// The linker sections for DMA buffers.
fn memory(context: &Context<'_>) -> Vec<Setting> {
    let memory = &context.names.memory;
    let sections = [
        ("UP_DMA_SECTION", memory.dma_section.as_ref()),
        ("UP_BDMA_SECTION", memory.bdma_section.as_ref()),
    ];
    let set = |(name, section): (&str, Option<&String>)| {
        Some(Setting::new(name, &format!("\"{}\"", section?)))
    };
    sections.into_iter().filter_map(set).collect()
}

/// The streams of all requests, by the macro that names each.
fn streams(context: &Context<'_>, units: &BTreeSet<&UnitName>) -> Vec<StreamPlan> {
    let mut settings = Vec::new();
    for unit in units {
        let mut wired = context.job.connections.iter();
        let Some(wired) = wired.find(|one| one.unit == Some(unit.as_str())) else { continue };
        for request in context.profile.dma(unit.as_str()) {
            let served = wired.streams.iter().find(|one| one.request == request.name);
            settings.extend(served.and_then(|served| {
                let setting = context.names.stream(unit.as_str(), served.request, served.stream)?;
                Some(StreamPlan { setting, is_basic: context.names.is_basic(served.stream) })
            }));
        }
    }
    settings
}

/// Drivers that a demo may turn on and that are unused here unless a section needs them.
const DRIVERS: [&str; 20] = [
    "ADC", "CAN", "CRY", "DAC", "EFL", "GPT", "I2C", "I2S", "ICU", "MAC", "MMC_SPI", "PWM", "RTC",
    "SDC", "SIO", "SPI", "TRNG", "UART", "WDG", "WSPI",
];

/// Each driver once, turned on if anything needs it.
fn hal(sections: &[Section], link: &LinkPlan) -> Vec<Setting> {
    let truth = |value: bool| if value { "TRUE" } else { "FALSE" };
    let mut settings = vec![Setting::new("HAL_USE_PAL", "TRUE")];
    let link_switches = [
        Setting::new("HAL_USE_SERIAL", truth(!link.is_usb())),
        Setting::new("HAL_USE_SERIAL_USB", truth(link.is_usb())),
        Setting::new("HAL_USE_USB", truth(link.is_usb())),
        Setting::new("HAL_USE_WDG", "TRUE"),
    ];
    let switches = sections.iter().filter_map(|section| section.switch.clone());
    let off = DRIVERS.iter().map(|name| Setting::new(&format!("HAL_USE_{name}"), "FALSE"));
    for switch in switches.chain(link_switches).chain(off) {
        match settings.iter_mut().find(|one| one.name == switch.name) {
            Some(one) if switch.value == "TRUE" => one.value = switch.value,
            Some(_) => {}
            None => settings.push(switch),
        }
    }
    for option in sections.iter().flat_map(|section| section.hal.iter().cloned()) {
        // One section may turn on what another one does not need.
        match settings.iter_mut().find(|one| one.name == option.name) {
            Some(one) if option.value == "TRUE" => one.value = option.value,
            Some(_) => {}
            None => settings.push(option),
        }
    }
    if !link.is_usb() {
        let own = settings.iter_mut().find(|one| one.name == SERIAL_SIZE);
        match own {
            Some(own) if own.value.parse().is_ok_and(|bytes: u32| bytes >= LINK_BYTES) => {}
            Some(own) => own.value = LINK_BYTES.to_string(),
            None => settings.push(Setting::new(SERIAL_SIZE, &LINK_BYTES.to_string())),
        }
    }
    settings
}

/// The size of the queues of all serial ports, each way, and the bytes that the link needs.
const SERIAL_SIZE: &str = "SERIAL_BUFFERS_SIZE";
const LINK_BYTES: u32 = 256;

/// The conditions for the C compiler to check against the user's tree, because nothing else would.
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

/// The macros of the clocks that the computed times depend on.
fn clocks<'a>(context: &'a Context<'_>, sections: &'a [Section]) -> BTreeSet<&'a str> {
    let core = context.profile.costs.as_ref().map(|costs| costs.clock.as_str());
    let link = context.job.link.as_ref().and_then(|link| context.profile.unit(link.unit));
    let own = core.into_iter().chain(link.and_then(|unit| unit.clock.as_deref()));
    let sections = sections.iter().flat_map(|section| &section.clocks);
    own.chain(sections.map(String::as_str)).collect()
}

/// Two drivers that share a stream would compile, but fail at run time.
fn streams_differ(settings: &SettingsPlan, guards: &mut Vec<GuardPlan>) {
    for (at, first) in settings.dma.iter().enumerate() {
        let others = settings.dma.iter().skip(at + 1);
        for second in others.filter(|second| second.is_basic == first.is_basic) {
            let [first, second] = [first, second].map(|stream| &stream.setting.name);
            guards.push(GuardPlan {
                condition: format!("{first} !=\n               {second}"),
                message: "two drivers have one DMA stream".to_owned(),
            });
        }
    }
}
