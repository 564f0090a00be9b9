//! What the hardware will do differently from what the reader expects.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{
    w0601_unused_property, w0602_slower_than_asked, w0603_narrow_type,
};
use sensedsl_wire::ScalarType;

use crate::design::{Design, Device};
use crate::kind::Kind;

/// Bits of one conversion of the ADCs there are profiles for; wider ones are scaled by the driver.
const ADC_BITS: u32 = 12;

/// Adds the warnings for all devices.
pub(crate) fn run(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    for device in &design.devices {
        diagnostics.extend(unused_pace(device));
        diagnostics.extend(too_slow(device));
        diagnostics.extend(narrow(device));
    }
}

/// Cycle time and priority of what the hardware measures by itself.
fn unused_pace(device: &Device) -> Vec<Diagnostic> {
    let pulsed = matches!(&device.kind, Kind::Icu(icu) if icu.pulse_us.is_some());
    if !device.kind.name().triggers_itself() || pulsed {
        return Vec::new();
    }
    let written = [("delay", device.delay_span), ("prio", device.prio_span)];
    let why = "the timer sees every edge by itself";
    let kind = device.kind.name().name();
    let unused = |(name, at): (&str, Option<_>)| {
        Some(w0601_unused_property::unused_property(at?, name, kind, why))
    };
    written.into_iter().filter_map(unused).collect()
}

fn too_slow(device: &Device) -> Option<Diagnostic> {
    let Kind::I2c(i2c) = &device.kind else { return None };
    if u64::from(i2c.wait_us) <= u64::from(device.delay_ms) * 1_000 {
        return None;
    }
    let at = device.delay_span.or(i2c.wait_span)?;
    let needs_ms = i2c.wait_us.div_ceil(1_000).to_string();
    let name = &device.name.value;
    let delay_ms = device.delay_ms.to_string();
    let source = i2c.wait_span.filter(|wait| Some(*wait) != Some(at));
    Some(w0602_slower_than_asked::slower_than_asked(at, name, &needs_ms, &delay_ms, source))
}

fn narrow(device: &Device) -> Option<Diagnostic> {
    let value = device.value.value;
    let (_, most) = value.scalar.integer_range()?;
    let (largest, wider) = match &device.kind {
        Kind::Analog(_) => ((1_i128 << ADC_BITS) - 1, ScalarType::Uint16),
        Kind::I2c(i2c) if value.length.is_none() => match i2c.length_bytes {
            0 | 1 => return None,
            2 => (i128::from(u16::MAX), ScalarType::Uint16),
            3 | 4 => (i128::from(u32::MAX), ScalarType::Uint32),
            _ => (i128::from(u64::MAX), ScalarType::Uint64),
        },
        Kind::I2c(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_) => return None,
    };
    if most >= largest || value.scalar.size_bytes() >= wider.size_bytes() {
        return None;
    }
    let range = format!("0 to {largest}");
    let found = value.to_string();
    Some(w0603_narrow_type::narrow_type(device.value.span, &found, &range, wider.name()))
}
