//! How ChibiOS spells what a profile describes: files of its tree, versions of drivers, driver objects, options.
//!
//! In: the part of a profile for its system's generator. Out: [`Names`]. A rule is a text in which `{name}` stands for
//! the unit's name, `{n}` for the number in it and `{channel}` for the number of an output. What a unit states itself
//! takes precedence over the rule of its group.

use std::collections::BTreeMap;

use sensedsl_board::profile::{TargetProfile, Timer};
use sensedsl_board::signal::UnitName;
use serde::Deserialize;

use sensedsl_firmware_c::DmaBuffer;
use sensedsl_job::JobStream;

/// The names of one line of MCUs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Names {
    /// The file of the tree that lists what each MCU has.
    pub registry: String,
    /// The macros that the file needs besides one of the MCU's.
    #[serde(default)]
    pub macros: Vec<String>,
    /// Files of the tree.
    pub tree: Tree,
    /// Versions of the drivers.
    pub drivers: Drivers,
    /// The option that names the kernel's timer.
    pub(super) kernel_option: String,
    /// The core's clock, which drives its cycle counter.
    #[serde(default = "core_clock")]
    pub(super) core_clock: String,
    pub(super) off: Off,
    /// The rule for the field that moves a unit to other pins; `None` if every pin has its own choice.
    remap: Option<String>,
    /// The memory for DMA buffers; by default that of all other data.
    #[serde(default)]
    pub(super) memory: Memory,
    timers: Timers,
    adcs: Group,
    pub(super) i2cs: Group,
    spis: Group,
    serials: Group,
    cans: Option<Group>,
    dacs: Option<Dacs>,
    /// The USB devices.
    #[serde(default)]
    pub usbs: Vec<Usb>,
    #[serde(default)]
    units: Vec<Unit>,
    /// The facts of the line.
    #[serde(skip)]
    pub line: Line,
    #[serde(skip)]
    line_name: String,
}

/// The facts of a line.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// The macros that select these MCUs in the tree.
    pub devices: Vec<String>,
    /// The driver list, if the line has its own.
    platform_mk: Option<String>,
    /// The FPU option, if the line has its own.
    fpu: Option<String>,
}

/// Files of the tree, relative to its root.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tree {
    /// The core, as a compiler option.
    pub mcu: String,
    /// The core's FPU, as a compiler option; `None` without one.
    pub fpu: Option<String>,
    /// Start-up code.
    pub startup_mk: String,
    /// The platform's drivers.
    pub platform_mk: String,
    /// The kernel's port.
    pub port_mk: String,
    /// The layer between drivers and kernel.
    pub osal_mk: String,
    /// The folder of the make rules.
    pub rules_dir: String,
    source: String,
}

/// Versions of the drivers; each selects a variant of the generated code.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drivers {
    /// Analog-digital conversion.
    pub adc: String,
    /// CAN; empty if there is no driver.
    #[serde(default)]
    pub can: String,
    /// Digital-analog conversion; empty if there is no driver.
    #[serde(default)]
    pub dac: String,
    /// DMA.
    pub dma: String,
    /// Pin interrupts; empty if they belong to the pins.
    #[serde(default)]
    pub exti: String,
    /// Pins.
    pub gpio: String,
    /// I²C.
    pub i2c: String,
    /// Serial ports.
    pub serial: String,
    /// SPI.
    pub spi: String,
    /// Timers.
    pub timer: String,
    source: String,
}

/// Switches that demos turn on although they are not needed.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Off {
    pub(super) switches: Vec<String>,
    source: String,
}

/// Uncached memory that DMA controllers reach.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Memory {
    /// The section for buffers in the tree's linker scripts.
    pub(super) dma_section: Option<String>,
    /// The section for buffers of the basic controller, which reaches only one memory.
    pub(super) bdma_section: Option<String>,
    /// The number of the basic controller in the names of streams.
    bdma_controller: Option<String>,
    /// Options that exclude the sections from the cache, and their values.
    #[serde(default)]
    options: Vec<[String; 2]>,
    source: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Timers {
    icu: Group,
    pwm: Group,
}

/// The names of the units of a group.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Group {
    driver: String,
    switch: String,
    /// Options that name streams; `None` if the tree fixes them.
    rx: Option<String>,
    tx: Option<String>,
    dma: Option<String>,
    /// Options that select source and divider of the group's clock, and their values.
    #[serde(default)]
    options: Vec<[String; 2]>,
    /// The option for the time in milliseconds that the driver blocks the processor while a bus is busy.
    pub(super) busy_option: Option<String>,
    /// The option that selects the unit's clock source, and the value for which the profile's clock is right; `None` if
    /// the tree has a constant for the unit's own clock.
    clock_source: Option<[String; 2]>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Dacs {
    switch: String,
    /// The driver objects of a converter's outputs, starting with the first.
    drivers: BTreeMap<String, Vec<String>>,
    /// Options of the outputs, by number from 1, and their values: those that the driver requires and not every demo
    /// sets.
    #[serde(default)]
    options: BTreeMap<String, Vec<[String; 2]>>,
}

/// A USB device.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Usb {
    name: String,
    /// The driver's version.
    pub version: String,
    pub(super) driver: String,
    pub(super) switch: String,
    /// Options that must be on as well.
    #[serde(default)]
    pub(super) needs: Vec<String>,
    /// Options that select its clock, and their values.
    #[serde(default)]
    pub(super) settings: BTreeMap<String, String>,
    /// True if the MCU has no pull-up resistor by which a host detects it: one on the board is always connected, unless
    /// the board's folder says how to switch it.
    #[serde(default)]
    pub(super) is_always_connected: bool,
    /// The option with which it assumes a host and does not use the VBUS pin.
    pub(super) without_vbus: Option<String>,
}

/// A unit that is spelled differently from the rule of its group.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Unit {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    driver: Option<String>,
    switch: Option<String>,
    rx: Option<String>,
    tx: Option<String>,
    dma: Option<String>,
    /// The field that moves it to other pins.
    remap: Option<String>,
    /// The rule by which its options name a stream, with `{controller}` and `{stream}`.
    stream: Option<String>,
    clock_source: Option<[String; 2]>,
    /// Options that must be on as well.
    #[serde(default)]
    needs: Vec<String>,
    /// Options that select source and divider of its clock, and their values.
    #[serde(default)]
    options: Vec<[String; 2]>,
}

/// The usual rule by which an option names a stream.
const STREAM: &str = "STM32_DMA_STREAM_ID({controller}, {stream})";

fn core_clock() -> String {
    "STM32_HCLK".to_owned()
}

fn apply(rule: &str, name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = name.strip_prefix(stem).unwrap_or_default();
    rule.replace("{name}", name).replace("{n}", number)
}

impl Names {
    /// The names for a profile's line.
    ///
    /// # Errors
    ///
    /// If its file is damaged; a test rules that out.
    pub fn of(profile: &TargetProfile) -> Result<Self, String> {
        let own = &profile.own;
        let mut names: Self =
            own.file.clone().try_into().map_err(|error: toml::de::Error| error.to_string())?;
        names.line =
            own.line.clone().try_into().map_err(|error: toml::de::Error| error.to_string())?;
        if let Some(platform_mk) = &names.line.platform_mk {
            names.tree.platform_mk.clone_from(platform_mk);
        }
        if names.line.fpu.is_some() {
            names.tree.fpu.clone_from(&names.line.fpu);
        }
        names.line_name.clone_from(&profile.line);
        Ok(names)
    }

    /// The driver object of a unit; for a timer that of input capture.
    pub(super) fn driver(&self, unit: &str) -> Option<String> {
        let own = self.own(unit).and_then(|own| own.driver.as_ref());
        Some(apply(own.or(self.group(unit).map(|group| &group.driver))?, unit))
    }

    /// The options that select the clock of a unit's group, and their values.
    pub(super) fn group_options(&self, unit: &str) -> impl Iterator<Item = Setting> {
        let options = self.group(unit).into_iter().flat_map(|group| &group.options);
        options.map(|[name, value]| Setting::new(name, value))
    }

    /// The field that moves a unit to other pins, if pins have no choice of their own.
    pub(super) fn remap(&self, unit: &str) -> Option<String> {
        let own = self.own(unit).and_then(|own| own.remap.as_ref());
        Some(apply(own.or(self.remap.as_ref())?, unit))
    }

    /// The options that turn a unit on.
    pub(super) fn switches(&self, unit: &str) -> Vec<String> {
        let own = self.own(unit);
        let switch = own.and_then(|own| own.switch.as_ref());
        let switch = switch.or(self.group(unit).map(|group| &group.switch));
        let switch = switch.map(|switch| apply(switch, unit));
        switch.into_iter().chain(own.iter().flat_map(|own| own.needs.clone())).collect()
    }

    /// The driver object of a timer's outputs, and the options that turn it on.
    pub(super) fn pwm(&self, timer: &Timer) -> (String, Vec<String>) {
        let pwm = &self.timers.pwm;
        // Without a handler in the port, an option must say that the outputs need none.
        let suppress = (!timer.interrupt).then(|| format!("STM32_{}_SUPPRESS_ISR", timer.name));
        let switches = std::iter::once(apply(&pwm.switch, &timer.name)).chain(suppress);
        (apply(&pwm.driver, &timer.name), switches.collect())
    }

    /// The option that names the stream of a request, and the stream's name; `None` if the tree fixes the stream.
    pub(super) fn stream(&self, unit: &str, request: &str, stream: &str) -> Option<Setting> {
        let (own, group) = (self.own(unit), self.group(unit)?);
        let (own_option, rule) = match request.strip_prefix(unit) {
            Some("_RX") => (own.and_then(|own| own.rx.as_ref()), &group.rx),
            Some("_TX") => (own.and_then(|own| own.tx.as_ref()), &group.tx),
            _ => (own.and_then(|own| own.dma.as_ref()), &group.dma),
        };
        let option = own_option.or(rule.as_ref())?;
        let id = own.and_then(|own| own.stream.as_deref()).unwrap_or(STREAM);
        let (controller, number) = stream.split_once(',').unwrap_or_default();
        let value = id.replace("{controller}", controller).replace("{stream}", number);
        Some(Setting::new(&apply(option, unit), &value))
    }

    /// The driver object of a converter's output, counted from 1, and the options that turn it on.
    pub(super) fn dac(&self, unit: &str, channel: u8) -> Option<(String, Vec<Setting>)> {
        let dacs = self.dacs.as_ref()?;
        let place = usize::from(channel).checked_sub(1)?;
        let driver = dacs.drivers.get(unit)?.get(place)?.clone();
        let channel = channel.to_string();
        let switch =
            Setting::new(&apply(&dacs.switch.replace("{channel}", &channel), unit), "TRUE");
        let options = dacs.options.get(&channel).into_iter().flatten();
        let options = options.map(|[name, value]| Setting::new(&apply(name, unit), value));
        Some((driver, std::iter::once(switch).chain(options).collect()))
    }

    /// The options that select source and divider of the converters' clock.
    pub(super) fn converters<'a>(&self, units: impl Iterator<Item = &'a UnitName>) -> Vec<Setting> {
        let own = units.filter_map(|unit| self.own(unit.as_str()));
        let own = own.flat_map(|own| &own.options);
        let all = self.adcs.options.iter().chain(own);
        all.map(|[name, value]| Setting::new(name, value)).collect()
    }

    /// The kind of buffer that these streams fill or empty.
    pub(super) fn buffer(&self, streams: &[JobStream<'_>]) -> DmaBuffer {
        let is_basic = streams.iter().any(|one| self.is_basic(one.stream));
        if is_basic { DmaBuffer::Basic } else { DmaBuffer::Main }
    }

    /// Whether a stream belongs to the basic controller.
    pub(super) fn is_basic(&self, stream: &str) -> bool {
        let controller = stream.split_once(',').map(|(controller, _)| controller);
        controller.is_some() && controller == self.memory.bdma_controller.as_deref()
    }

    /// The options that exclude buffers from the cache.
    pub(super) fn memory_settings(&self) -> impl Iterator<Item = Setting> {
        self.memory.options.iter().map(|[name, value]| Setting::new(name, value))
    }

    /// The option that selects a unit's clock source, and its required value.
    pub(super) fn clock_source(&self, unit: &str) -> Option<[String; 2]> {
        let own = self.own(unit).and_then(|own| own.clock_source.as_ref());
        let source = own.or(self.group(unit).and_then(|group| group.clock_source.as_ref()))?;
        Some(source.each_ref().map(|text| apply(text, unit)))
    }

    /// The names of a USB device.
    #[must_use]
    pub fn usb(&self, name: &str) -> Option<&Usb> {
        self.usbs.iter().find(|usb| usb.name == name)
    }

    fn own(&self, unit: &str) -> Option<&Unit> {
        let fits = |own: &Unit| own.lines.is_empty() || own.lines.contains(&self.line_name);
        self.units.iter().find(|own| own.name == unit && fits(own))
    }

    fn group(&self, unit: &str) -> Option<&Group> {
        match unit.trim_end_matches(|c: char| c.is_ascii_digit()) {
            "ADC" => Some(&self.adcs),
            "I2C" => Some(&self.i2cs),
            "SPI" => Some(&self.spis),
            "USART" | "UART" | "LPUART" => Some(&self.serials),
            "CAN" | "FDCAN" => self.cans.as_ref(),
            "TIM" => Some(&self.timers.icu),
            _ => None,
        }
    }

    /// The parts of a profile that have no name or no source here; empty if there are none.
    #[must_use]
    pub fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        let line = &profile.line;
        let adcs = profile.adcs.iter().map(|unit| &unit.name);
        let buses = profile.i2cs.iter().chain(&profile.spis).chain(&profile.serials);
        let buses = buses.chain(&profile.cans).map(|unit| &unit.name);
        let timers = profile.timers.iter().map(|timer| &timer.name);
        let unnamed = adcs.chain(buses).chain(timers).filter(|unit| self.driver(unit).is_none());
        let mut problems: Vec<String> =
            unnamed.map(|unit| format!("{line}: {unit} has no driver")).collect();
        for dac in &profile.dacs {
            let drivers = self.dacs.as_ref().and_then(|dacs| dacs.drivers.get(&dac.name));
            if drivers.is_none_or(|drivers| drivers.len() < dac.outputs.len()) {
                problems.push(format!("{line}: {} lacks drivers", dac.name));
            }
        }
        let usbs = profile.usbs.iter().filter(|usb| self.usb(&usb.name).is_none());
        problems.extend(usbs.map(|usb| format!("{line}: {} has no driver", usb.name)));
        let sources = [&self.tree.source, &self.drivers.source, &self.off.source];
        if sources.iter().any(|source| source.is_empty()) {
            problems.push(format!("{line}: files, drivers or switches have no source"));
        }
        let memory = &self.memory;
        if memory.dma_section.is_some() && memory.source.is_none() {
            problems.push(format!("{line}: the memory of buffers has no source"));
        }
        if self.line.devices.is_empty() {
            problems.push(format!("{line}: no devices"));
        }
        problems
    }
}

/// `#define NAME VALUE`
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Setting {
    pub(super) name: String,
    pub(super) value: String,
}

impl Setting {
    pub(super) fn new(name: &str, value: &str) -> Self {
        Self { name: name.to_owned(), value: value.to_owned() }
    }
}
