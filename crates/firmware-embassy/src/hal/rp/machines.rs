//! State machines of the PIO as inputs: encoders, and the times of edges.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{CaptureInput, Counter, Encoder, Waiting};
use crate::hal::contract::outputs::Pins as _;
use crate::hal::timed;
use crate::missing::{self, Missing, Printed};
use crate::section::{Constructor, Section};

/// The fractions in which a machine's clock is divided, and the greatest divider.
const FRACTIONS: u64 = 256;
const DIVIDER: u64 = 65_536;
/// Instructions of the program in a tick.
const STEPS: u64 = 2;

impl Encoder for Settings {
    fn counter(
        &self,
        context: &Context<'_>,
        wire: &JobConnection<'_>,
        section: &mut Section,
    ) -> Printed<Counter> {
        let (a, b) = (missing::pad(wire, Role::A)?, missing::pad(wire, Role::B)?);
        let machine = Machine::of(context, wire)?;
        section.features.extend(machine.feature());
        let type_ = "rt::pio::Decoder";
        let make = format!(
            "crate::{type_}::new::<{}>({}, p.{}.into(), p.{}.into())",
            machine.interrupt(),
            machine.number,
            self.pin(&a.pin.name),
            self.pin(&b.pin.name)
        );
        Ok(Counter {
            made: Constructor { type_: format!("crate::{type_}"), make },
            suffix: "decoder",
            type_: type_.to_owned(),
        })
    }
}

impl Settings {
    /// A machine that keeps the times of an input's edges.
    pub(super) fn stopwatch(
        &self,
        context: &Context<'_>,
        input: &CaptureInput<'_>,
        section: &mut Section,
    ) -> Printed<Waiting> {
        let CaptureInput { wire, icu, statics, is_train } = input;
        let machine = Machine::of(context, wire)?;
        let divider = machine.divider(context, icu.tick_hz)?;
        let edges = timed::edges(timed::seen(icu, *is_train));
        let interrupt = machine.interrupt();
        section.bind(machine.vector, format!("crate::rt::pio::Wake<{interrupt}>"));
        section.features.extend(machine.feature());
        let pin = self.pin(&missing::pad(wire, Role::In)?.pin.name);
        let number = machine.number;
        let make = format!(
            "crate::rt::pio::Stopwatch::new(Irqs, {number}, p.{pin}.into(), {divider}, crate::{edges})"
        );
        Ok(Waiting {
            made: Constructor { type_: format!("crate::rt::pio::Stopwatch<{interrupt}>"), make },
            parameter: "timer",
            type_: format!("rt::pio::Stopwatch<{interrupt}>"),
            runs: timed::runs(icu, statics, *is_train),
        })
    }
}

/// The machine of a wire.
struct Machine<'c> {
    block: &'c str,
    /// The block's interrupt.
    vector: &'c str,
    /// Its place among those of the block, which are given in the order of the design.
    number: usize,
}

impl<'c> Machine<'c> {
    fn of(context: &'c Context<'_>, wire: &JobConnection<'c>) -> Printed<Self> {
        let block = missing::unit(wire)?;
        let mut own = context.job.connections.iter().filter(|one| one.unit == Some(block));
        let number = own.position(|one| one.ident == wire.ident);
        let number = number.ok_or_else(|| Missing::unit(format!("a state machine of {block}")))?;
        Ok(Self { block, vector: context.interrupt(block, "GLOBAL")?, number })
    }

    fn interrupt(&self) -> String {
        format!("hal::interrupt::typelevel::{}", self.vector)
    }

    /// The feature of the runtime without which it does not know the block.
    fn feature(&self) -> Option<&'static str> {
        (self.block == "PIO2").then_some("pio2")
    }

    /// The divider of the machine's clock for a tick.
    fn divider(&self, context: &Context<'_>, tick_hz: u32) -> Printed<u32> {
        let clock = context.profile.pio(self.block).map(|block| block.clock.as_str());
        let hz = clock.and_then(|clock| context.profile.clocks_hz.get(clock)).copied();
        let hz = hz.ok_or_else(|| Missing::name(format!("the clock of {}", self.block)))?;
        divider(hz, tick_hz).ok_or_else(|| {
            Missing::unit(format!("a resolution of {tick_hz} Hz, made of {hz} Hz by 2 to 131072"))
        })
    }
}

/// The divider in fractions, which must be whole.
fn divider(clock_hz: u32, tick_hz: u32) -> Option<u32> {
    let (clocks, steps) = (u64::from(clock_hz) * FRACTIONS, u64::from(tick_hz) * STEPS);
    let whole = (tick_hz > 0 && clocks.is_multiple_of(steps)).then(|| clocks / steps)?;
    let fits = (FRACTIONS..=DIVIDER * FRACTIONS).contains(&whole);
    fits.then(|| u32::try_from(whole).ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::divider;

    #[test]
    fn a_tick_is_two_steps() {
        assert_eq!(divider(125_000_000, 1_000_000), Some(62 * 256 + 128));
        assert_eq!(divider(150_000_000, 1_000_000), Some(75 * 256));
        assert_eq!(divider(125_000_000, 10_000), Some(6_250 * 256));
        assert_eq!(divider(125_000_000, 62_500_000), Some(256));
        assert_eq!(divider(125_000_000, 125_000_000), None);
        assert_eq!(divider(125_000_000, 3), None);
        assert_eq!(divider(125_000_000, 500), None);
    }
}
