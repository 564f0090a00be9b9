//! Analog sensors: the driver of the converters.

mod v2;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, plain_only};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "ADC",
    kind: Some(KindName::Analog),
    version: |drivers| &drivers.adc,
    versions: &[Version { name: "ADCv2", plan: v2::plan }],
    lacks: plain_only,
    runtime: &[("chibios/up_adc.c", include_str!("../../../../../../runtime/chibios/up_adc.c"))],
};
