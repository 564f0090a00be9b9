//! The kinds that there is code for, as one list.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_firmware_c::runtime as core;
use sensedsl_firmware_c::runtime::File;
use sensedsl_model::kind::KindName;

use crate::context::Context;
use crate::section::{Peripheral, Section, nothing};
use crate::{analog, bus, digital, encoder, icu, pwm, runtime, uart};

/// All kinds, in the order in which their sections are printed.
pub(crate) const PERIPHERALS: &[Peripheral] = &[
    Peripheral {
        kind: Some(KindName::Analog),
        lacks: nothing,
        plan: analog::plan,
        core: &[],
        runtime: &[runtime::ANALOG],
    },
    Peripheral {
        kind: Some(KindName::I2c),
        lacks: bus::lacks,
        plan: bus::i2c,
        core: &[],
        runtime: &[runtime::I2C, runtime::CHIPS],
    },
    Peripheral {
        kind: Some(KindName::Spi),
        lacks: bus::lacks,
        plan: bus::spi,
        core: &[],
        runtime: &[runtime::SPI, runtime::CHIPS],
    },
    Peripheral {
        kind: Some(KindName::Uart),
        lacks: uart::lacks,
        plan: uart::plan,
        core: &[],
        runtime: &[runtime::UART],
    },
    Peripheral {
        kind: Some(KindName::Icu),
        lacks: icu::lacks,
        plan: icu::plan,
        core: &[core::CAPTURE, core::COUNT, core::ELEMENTS],
        runtime: &[runtime::ICU],
    },
    Peripheral {
        kind: Some(KindName::Encoder),
        lacks: nothing,
        plan: encoder::plan,
        core: &[core::COUNT],
        runtime: &[runtime::ENCODER],
    },
    Peripheral {
        kind: Some(KindName::Digital),
        lacks: digital::lacks,
        plan: digital::plan,
        core: &[core::COUNT, core::DEBOUNCE],
        runtime: &[runtime::DIGITAL],
    },
    Peripheral {
        kind: Some(KindName::Pwm),
        lacks: nothing,
        plan: pwm::plan,
        core: &[core::PULSE_WIDTH],
        runtime: &[runtime::PWM],
    },
];

/// The kinds of devices that have code here.
pub(crate) fn kinds() -> Vec<KindName> {
    let own = PERIPHERALS.iter().filter_map(|one| one.kind);
    own.chain(std::iter::once(KindName::Code)).collect()
}

/// The sections of a board, each with the files that it needs; those of kinds that no device has are left out.
pub(crate) fn sections(
    context: &Context<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<Section>, Vec<File>) {
    let mut files: Vec<File> = Vec::new();
    let mut sections = Vec::new();
    for peripheral in PERIPHERALS {
        let section = (peripheral.plan)(context, diagnostics);
        if !section.tables.is_empty() {
            let own = peripheral.core.iter().chain(peripheral.runtime).copied().flatten();
            files.extend(own.copied());
        }
        sections.push(section);
    }
    files.sort_unstable();
    files.dedup();
    (sections, files)
}
