//! The parts of the runtime, in C and in Rust, that the values of a board need; the rest is left out of the program.

use sensedsl_model::design::Device;
use sensedsl_model::kind::icu::Mode;
use sensedsl_model::protocol::Format;
use sensedsl_model::words::{Code, Words};
use sensedsl_wire::{Checksum, Direction, ScalarType};

use super::bus::BusPlan;
use crate::BoardJob;

/// The optional parts of the runtime, named after the features of `sense-rt`, and whether any value needs them;
/// `crates/firmware-c/runtime/up_uses.h` describes each.
#[must_use]
pub fn uses(job: &BoardJob<'_>) -> [(&'static str, bool); 14] {
    let device = |uses: fn(&Device) -> bool| job.devices.iter().any(|one| uses(one.device));
    let word = |uses: fn(&Words) -> bool| {
        job.devices.iter().filter_map(|one| Words::of(one.device)).any(|words| uses(&words))
    };
    let bus =
        |uses: fn(&BusPlan) -> bool| job.parts.iter().flat_map(|one| &one.plan.buses).any(uses);
    [
        ("crc32", job.schema.checksum == Checksum::Crc32),
        ("reals", device(is_real)),
        ("codes", word(|words| is_code(words.code))),
        ("lamps", word(|words| matches!(words.code, Code::Pulses | Code::Leds))),
        ("letters", word(|words| words.code == Code::Text)),
        ("word-crc", word(|words| words.crc.is_some())),
        ("median", device(|device| device.filter.median > 1)),
        ("smooth", device(|device| device.filter.smooth_ms > 0)),
        ("change", device(|device| device.filter.change.is_some())),
        ("chip-init", bus(|bus| !bus.init.is_empty())),
        ("chip-identity", bus(|bus| bus.identity.is_some())),
        ("chip-formulas", bus(BusPlan::is_computed)),
        ("chip-commands", bus(|bus| !bus.commands.is_empty())),
        ("chip-exchanges", bus(|bus| bus.transfers.iter().any(|one| one.is_exchange))),
    ]
}

/// The optional parts of the runtime in C: those of [`uses`], and what only a program in C can leave out.
#[must_use]
pub fn uses_in_c(job: &BoardJob<'_>) -> Vec<(&'static str, bool)> {
    let device = |uses: fn(&Device) -> bool| job.devices.iter().any(|one| uses(one.device));
    let bus =
        |uses: fn(&BusPlan) -> bool| job.parts.iter().flat_map(|one| &one.plan.buses).any(uses);
    let own = [
        ("wide", device(is_wide)),
        ("word-bits", device(|device| Words::of(device).is_some_and(|words| is_partial(&words)))),
        ("invalid", device(|device| !device.filter.invalid.is_empty())),
        ("capture-times", device(is_timed)),
        ("chip-triggers", bus(|bus| bus.transfers.iter().any(|one| !one.trigger.is_empty()))),
        ("chip-reads", bus(|bus| bus.transfers.iter().any(|one| one.trigger.is_empty()))),
        ("chip-turns", bus(|bus| bus.transfers.len() != 1)),
    ];
    uses(job).into_iter().chain(own).collect()
}

/// Whether the value, or what it is made of, has more than 32 bits. Text has digits without a limit, and packed words
/// are read together with what stands in their first byte.
fn is_wide(device: &Device) -> bool {
    let is_wide = |words: &Words| {
        let is_number = !matches!(words.code, Code::Pulses | Code::Leds | Code::Text);
        is_number && (words.word_bytes > 4 || (words.code == Code::Packed && words.bits > 25))
    };
    let is_long = |scalar: ScalarType| matches!(scalar, ScalarType::Int64 | ScalarType::Uint64);
    let text = device.coding.text.as_ref().filter(|_| device.direction == Direction::Sensor);
    is_real(device)
        || is_long(device.value.value.scalar)
        || Words::of(device).is_some_and(|words| is_wide(&words))
        || text.is_some_and(|text| text.format != Format::Hex)
        || device.filter.change.is_some_and(|change| change > f64::from(u32::MAX))
}

/// Whether edges are not only counted.
fn is_timed(device: &Device) -> bool {
    device.kind.icu().is_some_and(|icu| icu.mode != Mode::Count)
}

/// Whether only some bits of a word are the value.
fn is_partial(words: &Words) -> bool {
    words.code == Code::Packed
        || words.low > 0
        || u16::from(words.bits) != 8 * u16::from(words.word_bytes)
}

fn is_code(code: Code) -> bool {
    !matches!(code, Code::Integer | Code::Pulses | Code::Leds | Code::Text)
}

fn is_real(device: &Device) -> bool {
    matches!(device.value.value.scalar, ScalarType::Float32 | ScalarType::Float64)
}
