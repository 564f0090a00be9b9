//! Timers as inputs: they keep the count at which an edge was, or count the steps of an encoder.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Capture, CaptureInput, Counter, Encoder, Waiting};
use crate::hal::timed;
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

impl Capture for Settings {
    fn waiting(
        &self,
        context: &Context<'_>,
        input: &CaptureInput<'_>,
        section: &mut Section,
    ) -> Printed<Waiting> {
        let CaptureInput { wire, icu, statics, is_train } = input;
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::In)?);
        let (channel, hal) = (missing::channel(pad)?, context.peripheral(unit));
        let interrupt = context.interrupt(unit, "CC")?;
        section.bind(interrupt, format!("hal::timer::CaptureCompareInterruptHandler<{hal}>"));
        let (pin, moved) = (pad.pin.name.as_str(), self.generics(context, unit, &[]));
        let made = if icu.mode == Mode::Count {
            counter(&moved, &hal, pin, channel, icu)
        } else {
            pulses(&moved, &hal, pin, channel, icu)
        };
        if icu.mode != Mode::Count && icu.edge == Edge::Falling {
            section.begins.push(swap(&hal, channel));
        }
        let runs = if *is_train {
            format!(
                "rt::timer::train(timer, hal::timer::Channel::Ch{channel}, &{statics}_TRAIN, &{statics}_SEEN)"
            )
        } else {
            run(icu, channel, statics)
        };
        Ok(Waiting { type_: made.type_.clone(), made, parameter: "timer", runs })
    }
}

/// A timer that keeps the counts of the edges on one channel.
fn counter(moved: &str, hal: &str, pin: &str, channel: u8, icu: &Icu) -> Constructor {
    let slots = (1..=4).map(|slot| {
        if slot == channel {
            format!("Some(hal::timer::input_capture::CapturePin::new(p.{pin}, Pull::None))")
        } else {
            "None".to_owned()
        }
    });
    let slots: Vec<String> = slots.collect();
    Constructor {
        type_: format!("hal::timer::input_capture::InputCapture<'static, {hal}>"),
        make: format!(
            "hal::timer::input_capture::InputCapture::new{moved}(p.{hal}, {}, Irqs, hz({}), CountingMode::EdgeAlignedUp)",
            slots.join(", "),
            icu.tick_hz
        ),
    }
}

/// A timer that measures width and period of pulses with two channels.
fn pulses(moved: &str, hal: &str, pin: &str, channel: u8, icu: &Icu) -> Constructor {
    Constructor {
        type_: format!("hal::timer::pwm_input::PwmInput<'static, {hal}>"),
        make: format!(
            "hal::timer::pwm_input::PwmInput::new_ch{channel}{moved}(p.{hal}, p.{pin}, Irqs, Pull::None, hz({}))",
            icu.tick_hz
        ),
    }
}

/// Exchanges the edges of a timer's two channels: the HAL measures from rising edges.
fn swap(hal: &str, channel: u8) -> String {
    let (own, other) = if channel == 1 { (0, 1) } else { (1, 0) };
    format!(
        "hal::pac::{hal}.ccer().modify(|edges| {{ edges.set_ccp({own}, true); edges.set_ccp({other}, false); }});"
    )
}

/// What the task awaits.
fn run(icu: &Icu, channel: u8, statics: &str) -> String {
    let edges = timed::edges(icu.edge);
    if icu.mode == Mode::Count {
        format!("rt::timer::count(timer, Channel::Ch{channel}, {edges}, &{statics}_SEEN)")
    } else {
        let is_width = icu.mode == Mode::Width;
        format!("rt::timer::measure(timer, {is_width}, {}, &{statics}_SEEN)", icu.tick_hz)
    }
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
        let hal = context.peripheral(unit);
        // The HAL takes the channels in either order.
        let type_of = |channel| format!("hal::timer::Ch{channel}");
        let (first, second) = (type_of(missing::channel(a)?), type_of(missing::channel(b)?));
        let type_ = format!("hal::timer::qei::Qei<'static, {hal}>");
        let make = format!(
            "hal::timer::qei::Qei::new{}(p.{hal}, p.{}, p.{}, Default::default())",
            self.generics(context, unit, &[&first, &second]),
            a.pin.name,
            b.pin.name
        );
        Ok(Counter { made: Constructor { type_: type_.clone(), make }, suffix: "qei", type_ })
    }
}
