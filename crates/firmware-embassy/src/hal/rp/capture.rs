//! Slices of the PWM unit as inputs: the hardware counts edges, or ticks while the pin is active. What needs the times
//! of edges is a state machine's.

use sensedsl_model::kind::Role;
use sensedsl_model::kind::icu::{Edge, Mode};

use super::pulses::timer_hz;
use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Capture, CaptureInput, Counter, Waiting};
use crate::hal::contract::outputs::Pins as _;
use crate::missing::{self, Missing, Printed};
use crate::section::{Constructor, Section};

/// The range of a slice's divider in sixteenths: it has eight bits, and four after the point.
const SIXTEENTHS: std::ops::RangeInclusive<u32> = 16..=0xFFF;

impl Capture for Settings {
    /// A slice that counts edges of one direction.
    fn counter(&self, context: &Context<'_>, input: &CaptureInput<'_>) -> Printed<Option<Counter>> {
        let CaptureInput { wire, icu, .. } = input;
        if icu.mode != Mode::Count {
            return Ok(None);
        }
        let edge = match icu.edge {
            Edge::Rising | Edge::Both => "RisingEdge",
            Edge::Falling => "FallingEdge",
        };
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::In)?);
        let type_ = "rt::gate::Edges";
        let make = format!(
            "crate::{type_}::new(p.{}, p.{}, hal::pwm::InputMode::{edge})",
            context.peripheral(unit),
            self.pin(&pad.pin.name)
        );
        Ok(Some(Counter {
            made: Constructor { type_: format!("crate::{type_}"), make },
            suffix: "slice",
            type_: type_.to_owned(),
        }))
    }

    /// A slice that measures widths, where the task waits for the ends of pulses; or a state machine.
    fn waiting(
        &self,
        context: &Context<'_>,
        input: &CaptureInput<'_>,
        section: &mut Section,
    ) -> Printed<Waiting> {
        let CaptureInput { wire, icu, statics, .. } = input;
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::In)?);
        if context.profile.pio(unit).is_some() {
            return self.stopwatch(context, input, section);
        }
        let sixteenths = sixteenths(context, unit, icu.tick_hz)?;
        let type_ = "rt::gate::Gate";
        let make = format!(
            "crate::{type_}::new(p.{}, p.{}, {sixteenths}, {})",
            context.peripheral(unit),
            self.pin(&pad.pin.name),
            icu.edge != Edge::Falling
        );
        Ok(Waiting {
            made: Constructor { type_: format!("crate::{type_}"), make },
            parameter: "gate",
            type_: type_.to_owned(),
            runs: format!("rt::gate::measure(gate, &{statics}_SEEN)"),
        })
    }
}

/// The divider of a slice for a tick, in sixteenths; it must be a whole number of them.
fn sixteenths(context: &Context<'_>, unit: &str, tick_hz: u32) -> Printed<u32> {
    let clock_hz = timer_hz(context, unit)?;
    let whole = (clock_hz.checked_mul(16))
        .filter(|clocks| tick_hz > 0 && clocks.is_multiple_of(tick_hz))
        .map(|clocks| clocks / tick_hz)
        .or_else(|| {
            (tick_hz > 0 && clock_hz.is_multiple_of(tick_hz)).then(|| clock_hz / tick_hz * 16)
        });
    whole.filter(|whole| SIXTEENTHS.contains(whole)).ok_or_else(|| {
        Missing::unit(format!("a resolution of {tick_hz} Hz, made of {clock_hz} Hz by at most 255"))
    })
}
