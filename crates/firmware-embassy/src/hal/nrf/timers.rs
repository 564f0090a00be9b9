//! Timers as inputs, and the decoder of encoders. An edge reaches timer `n` over the channels `n` of GPIOTE and PPI.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::icu::Mode;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Capture, CaptureInput, Counter, Encoder, Waiting};
use crate::hal::contract::outputs::Pins as _;
use crate::hal::timed;
use crate::missing::{self, Missing, Printed};
use crate::section::{Constructor, Section};

/// The clock of timers and PWM units.
pub(super) const CLOCK_HZ: u32 = 16_000_000;
/// The greatest power of two by which a timer divides it.
const POWER: u32 = 9;

impl Capture for Settings {
    /// Edges are counted by a timer, which loses none.
    fn counter(&self, context: &Context<'_>, input: &CaptureInput<'_>) -> Printed<Option<Counter>> {
        let CaptureInput { wire, icu, .. } = input;
        if icu.mode != Mode::Count {
            return Ok(None);
        }
        let type_ = "rt::timer::Count";
        let route = self.route(context, wire)?;
        let make = format!("crate::{type_}::new({route}, crate::{})", timed::edges(icu.edge));
        Ok(Some(Counter {
            made: Constructor { type_: format!("crate::{type_}"), make },
            suffix: "timer",
            type_: type_.to_owned(),
        }))
    }

    fn waiting(
        &self,
        context: &Context<'_>,
        input: &CaptureInput<'_>,
        _section: &mut Section,
    ) -> Printed<Waiting> {
        let CaptureInput { wire, icu, statics, is_train } = input;
        let power = power(icu.tick_hz)?;
        let type_ = "rt::timer::Stopwatch";
        let edges = timed::edges(timed::seen(icu, *is_train));
        let route = self.route(context, wire)?;
        let make = format!("crate::{type_}::new({route}, crate::{edges}, {power})");
        Ok(Waiting {
            made: Constructor { type_: format!("crate::{type_}"), make },
            parameter: "timer",
            type_: type_.to_owned(),
            runs: timed::runs(icu, statics, *is_train),
        })
    }
}

impl Settings {
    /// The timer of a wire, what leads edges to it, and the pin.
    fn route(&self, context: &Context<'_>, wire: &JobConnection<'_>) -> Printed<String> {
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::In)?);
        let number = unit.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        Ok(format!(
            "p.{}, p.GPIOTE_CH{number}, p.PPI_CH{number}, p.{}.into()",
            context.peripheral(unit),
            self.pin(&pad.pin.name)
        ))
    }
}

/// The power of two by which a timer's clock is divided for a tick.
fn power(tick_hz: u32) -> Printed<u32> {
    let found = (0..=POWER).find(|power| CLOCK_HZ >> power == tick_hz);
    found.ok_or_else(|| {
        Missing::unit(format!(
            "a resolution of {tick_hz} Hz, made of {CLOCK_HZ} Hz by halves, at most {POWER} times"
        ))
    })
}

impl Encoder for Settings {
    fn counter(
        &self,
        context: &Context<'_>,
        wire: &JobConnection<'_>,
        _section: &mut Section,
    ) -> Printed<Counter> {
        let unit = missing::unit(wire)?;
        let (a, b) = (missing::pad(wire, Role::A)?, missing::pad(wire, Role::B)?);
        let type_ = "rt::qdec::Qdec";
        let make = format!(
            "crate::{type_}::new(p.{}, p.{}.into(), p.{}.into())",
            context.peripheral(unit),
            self.pin(&a.pin.name),
            self.pin(&b.pin.name)
        );
        Ok(Counter {
            made: Constructor { type_: format!("crate::{type_}"), make },
            suffix: "qdec",
            type_: type_.to_owned(),
        })
    }
}
