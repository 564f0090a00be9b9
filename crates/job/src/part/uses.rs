//! The parts of the runtime, in C and in Rust, that the values of a board need; the rest is left out of the program.

use sensedsl_model::design::Device;
use sensedsl_model::words::{Code, Words};
use sensedsl_wire::{Checksum, ScalarType};

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

fn is_code(code: Code) -> bool {
    !matches!(code, Code::Integer | Code::Pulses | Code::Leds | Code::Text)
}

fn is_real(device: &Device) -> bool {
    matches!(device.value.value.scalar, ScalarType::Float32 | ScalarType::Float64)
}
