//! What no value of a board needs of `runtime/core`, so that it is left out of the program.

use sensedsl_model::design::Device;
use sensedsl_model::words::{Code, Words};
use sensedsl_wire::ScalarType;

use crate::job::BoardJob;
use crate::part::BusPlan;

/// As the compiler is told (`-D`); `runtime/core/up_uses.h` says what each is.
pub(crate) fn left_out(job: &BoardJob<'_>) -> Vec<&'static str> {
    let device = |uses: fn(&Device) -> bool| job.devices.iter().any(|one| uses(one.device));
    let word = |uses: fn(&Words) -> bool| {
        job.devices.iter().filter_map(|one| Words::of(one.device)).any(|words| uses(&words))
    };
    let bus = |uses: fn(&BusPlan) -> bool| {
        job.parts.iter().filter_map(|one| one.plan.bus.as_ref()).any(uses)
    };
    let uses = [
        ("UP_USES_REALS=0", device(is_real)),
        ("UP_USES_CODES=0", word(|words| words.code != Code::Integer)),
        ("UP_USES_WORD_CRC=0", word(|words| words.crc.is_some())),
        ("UP_USES_MEDIAN=0", device(|device| device.filter.median > 1)),
        ("UP_USES_SMOOTH=0", device(|device| device.filter.smooth_ms > 0)),
        ("UP_USES_CHANGE=0", device(|device| device.filter.change.is_some())),
        ("UP_USES_CHIP_INIT=0", bus(|bus| !bus.init.is_empty())),
        ("UP_USES_CHIP_IDENTITY=0", bus(|bus| bus.identity.is_some())),
        ("UP_USES_CHIP_FORMULAS=0", bus(BusPlan::is_computed)),
        ("UP_USES_CHIP_COMMANDS=0", bus(|bus| !bus.commands.is_empty())),
        ("UP_USES_CHIP_EXCHANGES=0", bus(|bus| bus.transfers.iter().any(|one| one.is_exchange))),
    ];
    uses.into_iter().filter(|(_, is_used)| !is_used).map(|(name, _)| name).collect()
}

fn is_real(device: &Device) -> bool {
    matches!(device.value.value.scalar, ScalarType::Float32 | ScalarType::Float64)
}
