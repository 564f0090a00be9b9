//! Pulses of the slices of the PWM unit: two outputs a slice, which change together.

use super::icu::timer_hz;
use crate::context::Context;
use crate::lack::{Missing, Printed};
use crate::outputs::{Output, element, level};
use crate::section::{Field, Section};
use sensedsl_job::snake;

/// A slice counts so many steps in a period at most.
const COUNTS: u32 = 65_535;
/// What the clock of a slice is divided by at most.
const DIVIDER: u32 = 255;

/// The divider of a slice, and its last count.
fn period(clock_hz: u32, frequency_hz: u32) -> Option<(u32, u32)> {
    let frequency_hz = frequency_hz.max(1);
    let clocks = clock_hz / frequency_hz;
    let divider = clocks.div_ceil(COUNTS).max(1);
    let step_hz = clock_hz / divider;
    let counts = (step_hz + frequency_hz / 2) / frequency_hz;
    (divider <= DIVIDER && counts > 1).then(|| (divider, counts.min(COUNTS) - 1))
}

/// The outputs of a slice, with what sets them.
pub(crate) fn slice(
    context: &Context<'_>,
    unit: &str,
    outputs: &[Output<'_>],
    section: &mut Section,
) -> Printed<()> {
    let Some(first) = outputs.first() else { return Ok(()) };
    let (name, hal) = (snake(unit), context.peripheral(unit));
    let (clock_hz, frequency_hz) = (timer_hz(context, unit)?, first.pwm.frequency_hz);
    let (divider, top) = period(clock_hz, frequency_hz)
        .ok_or_else(|| Missing::unit(format!("{frequency_hz} pulses a second")))?;
    let pin = |slot: u8| {
        let own = outputs.iter().find(|one| one.pulse.slot == slot);
        own.map(|one| format!(", p.{}", context.pin(one.pin)))
    };
    let (which, pins) = match (pin(1), pin(2)) {
        (Some(a), Some(b)) => ("ab", a + &b),
        (Some(a), None) => ("a", a),
        (None, Some(b)) => ("b", b),
        (None, None) => return Err(Missing::wire(format!("an output of {unit}"))),
    };
    let config = format!("crate::rt::pwm::config({divider}, {top})");
    let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
    section.outputs.push(Field {
        name: name.clone(),
        comment: format!("{unit}: {}", places.join("; ")),
        type_: "crate::rt::pwm::Slice".to_owned(),
        make: format!(
            "crate::rt::pwm::Slice::new(hal::pwm::Pwm::new_output_{which}(p.{hal}{pins}, {config}), {config})"
        ),
    });
    let apply = format!("outputs.{name}.apply();");
    for Output { wired, at, pwm, pulse, .. } in outputs {
        let (scalar, bytes) = element(wired, *at);
        let sets = section.sets.entry(wired.index).or_default();
        // Elements on one slice change in the same period.
        sets.retain(|line| *line != apply);
        sets.push(pulse.set(&format!("pulse_level({scalar}, {bytes})")));
        sets.push(apply.clone());
        if let Some(failsafe) = pwm.failsafe {
            let safe = format!("{} {apply}", pulse.set(&level(failsafe).to_string()));
            // Until the host speaks it is as silent as later: that is the start as well.
            section.begins.push(format!("outputs(|outputs| {{ {safe} }});"));
            section.fails.push(safe);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::period;

    #[test]
    fn periods_are_as_fine_as_a_slice_makes_them() {
        assert_eq!(period(125_000_000, 50), Some((39, 64_102)));
        assert_eq!(period(125_000_000, 20_000), Some((1, 6_249)));
        assert_eq!(period(150_000_000, 8), None);
        assert_eq!(period(125_000_000, 8), Some((239, 65_376)));
        assert_eq!(period(125_000_000, 62_500_000), Some((1, 1)));
    }
}
