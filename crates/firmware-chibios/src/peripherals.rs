//! The drivers that have code, as one list.
//!
//! In: the drivers of an MCU. Out: the kinds and the sections that the code makes of them, or the driver that it has
//! no code for. It is a file of its own because each driver's folder builds on `section.rs`, and this on all folders.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use super::context::Context;
use super::names::Drivers;
use super::section::{Peripheral, Section, Version};
use super::{
    adc, can, control, dac, digital, encoder, gpio, i2c, icu, onewire, pulse, pwm, spi, stepper,
    uart,
};

/// All drivers, in the order in which their sections are printed and their threads are numbered.
pub(super) const PERIPHERALS: &[&Peripheral] = &[
    &gpio::PERIPHERAL,
    &adc::PERIPHERAL,
    &dac::PERIPHERAL,
    &i2c::PERIPHERAL,
    &spi::PERIPHERAL,
    &onewire::PERIPHERAL,
    &uart::PERIPHERAL,
    &can::PERIPHERAL,
    &icu::PERIPHERAL,
    &encoder::PERIPHERAL,
    &digital::PERIPHERAL,
    &pwm::PERIPHERAL,
    &stepper::PERIPHERAL,
    &pulse::PERIPHERAL,
    &control::PERIPHERAL,
];

/// The kinds of devices that have code here.
pub(super) fn kinds(drivers: &Drivers) -> Vec<KindName> {
    let served = PERIPHERALS.iter().filter(|one| one.serving(drivers).is_some());
    served.filter_map(|one| one.kind).collect()
}

/// The driver of an MCU's pins, in words, if it has no code here.
pub(super) fn unserved(drivers: &Drivers) -> Option<String> {
    let is_missing = |one: &&&Peripheral| one.kind.is_none() && one.serving(drivers).is_none();
    let missing = PERIPHERALS.iter().find(is_missing)?;
    let known: Vec<&str> = missing.versions.iter().map(|version| version.name).collect();
    Some(format!(
        "its {} driver is {}, code is made for {} only",
        missing.name,
        (missing.version)(drivers),
        known.join(" and ")
    ))
}

/// The sections of a board.
pub(super) fn sections(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Section> {
    let drivers = &context.names.drivers;
    let serving = PERIPHERALS.iter().filter_map(|one| Some((one, one.serving(drivers)?)));
    let section = |(peripheral, version): (&&Peripheral, &Version)| {
        let mut section = (version.plan)(context, diagnostics);
        if !section.tables.is_empty() {
            let files = peripheral.runtime.iter();
            let names = files.filter_map(|(path, _)| path.strip_prefix("chibios/"));
            section.headers = names.filter(|name| name.ends_with(".h")).collect();
        }
        section
    };
    serving.map(section).collect()
}
