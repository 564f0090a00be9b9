//! Reports clocks that cannot be derived from the available ones, each with the nearest possible
//! clock.

use std::collections::BTreeMap;

use sensedsl_board::profile::{Timer, Unit};
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::codes::e0620_clock_out_of_reach::clock_out_of_reach;
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_model::design::Transport;
use sensedsl_model::kind::analog::Analog;
use sensedsl_model::kind::icu::Icu;
use sensedsl_model::kind::{Interface, Sharing};

use crate::can_bit::can_bit;
use crate::clocks::{PRESCALER_MAX, Tick, off_ppm, sampling, slowest_hz, timer_hz, unit_hz};
use crate::context::{Context, Wired};
use crate::{buses, i2c_clock, ports, steps, strips};

/// How far off a serial port may be: half a bit after ten bits, shared by both ends and the slopes
/// of the edges. The usual rate of an AVR, 115200 baud of 16 MHz, is 2.13 % off, and every USB bridge takes it.
const SERIAL_OFF_PPM_MAX: u64 = 22_000;
/// How far off a CAN bus may be (Bosch, CAN 2.0, 9.1: 1.58 % over both ends without
/// resynchronization in the arbitration).
const CAN_OFF_PPM_MAX: u64 = 5_000;
/// A pulse needs one count for its active part and one for the rest.
const PWM_STEPS_MIN: u32 = 2;

pub(crate) fn limits(context: &Context<'_>) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut shared: BTreeMap<UnitName, Vec<&Wired<'_>>> = BTreeMap::new();
    for wired in &context.elements {
        let unit = wired.wiring.unit.as_deref();
        let kind = &wired.device.kind;
        diagnostics.extend(match kind.interface() {
            Interface::Analog(analog) => of_sampling(context, wired, analog),
            Interface::Icu(icu) => of_tick(context, wired, icu),
            Interface::Pwm(pwm) => of_pulses(context, wired, pwm.frequency_hz),
            Interface::Uart(uart) => unit.and_then(|unit| {
                let span = uart.baud_span.unwrap_or(wired.device.kind_span);
                of_baud(context, unit, uart.baud, span)
            }),
            // Kinds that share their unit are checked per bus, below.
            Interface::I2c(_) | Interface::Spi(_) | Interface::Can(_) => None,
            Interface::Stepper(own) => steps::too_fast(context, wired, own),
            Interface::Encoder(_) | Interface::Digital(_) | Interface::Dac(_) => None,
            Interface::Code(_) => None,
            // The processor makes its bits.
            Interface::OneWire(_) => None,
        });
        if let (true, Some(unit)) = (kind.name().spec().sharing != Sharing::Own, unit) {
            shared.entry(UnitName::new(unit)).or_default().push(wired);
        }
    }
    for (unit, on_bus) in &shared {
        diagnostics.extend(of_bus(context, unit, on_bus));
    }
    let link = &context.board.link;
    if link.transport == Transport::Uart
        && let Some(wiring) = &context.wiring.link
    {
        let span = link.baud_span.unwrap_or(context.board.name.span);
        diagnostics.extend(of_baud(context, &wiring.unit, link.baud, span));
    }
    diagnostics
}

fn of_sampling(context: &Context<'_>, wired: &Wired<'_>, analog: &Analog) -> Option<Diagnostic> {
    let facts = &context.board.profile()?.adc;
    let asked = analog.sampling_cycles?;
    if sampling(facts, Some(asked)).is_some() {
        return None;
    }
    let most = facts.sample_cycles.iter().max().map_or(0, |most| most.whole());
    let name = &wired.device.name.value;
    let message =
        format!("{name} asks for {asked} cycles of sampling, and the ADC has at most {most}");
    let span = analog.sampling_span.unwrap_or(wired.device.kind_span);
    Some(clock_out_of_reach(span, &message, &format!("write `sampling = {most};` or less")))
}

fn timer<'c>(context: &'c Context<'_>, wired: &Wired<'_>) -> Option<&'c Timer> {
    let name = wired.wiring.unit.as_deref()?;
    context.board.profile()?.timers.iter().find(|timer| timer.name == name)
}

/// What measures an input, and its clock in hertz.
fn clock_of<'c>(context: &'c Context<'_>, wired: &'c Wired<'_>) -> Option<(&'c str, u32)> {
    if let Some(timer) = timer(context, wired) {
        return Some((&timer.name, timer_hz(context, timer)?));
    }
    let block = context.board.profile()?.pio(wired.wiring.unit.as_deref()?)?;
    Some((&block.name, context.clock_hz(&block.clock)?))
}

fn of_tick(context: &Context<'_>, wired: &Wired<'_>, icu: &Icu) -> Option<Diagnostic> {
    let (name, clock_hz) = clock_of(context, wired)?;
    let tick = Tick { clock_hz, tick_hz: icu.tick_hz };
    if tick.made().is_some() {
        return None;
    }
    let (device, tick_hz) = (&wired.device.name.value, icu.tick_hz);
    let message =
        format!("{name} of {device} runs at {clock_hz} Hz, which does not divide to {tick_hz} Hz");
    let least = clock_hz.div_ceil(PRESCALER_MAX);
    let nearest = tick.nearest()?;
    let microsecond = Tick { clock_hz, tick_hz: 1_000_000 };
    let usual = if microsecond.is_possible() { ": 1 us does" } else { "" };
    let help = format!(
        "write `resolution = {nearest} Hz;`, the nearest that it can make, or another from {least} Hz on that divides \
         {clock_hz} Hz{usual}"
    );
    let span = icu.tick_span.unwrap_or(wired.device.kind_span);
    Some(clock_out_of_reach(span, &message, &help))
}

fn of_pulses(context: &Context<'_>, wired: &Wired<'_>, frequency_hz: u32) -> Option<Diagnostic> {
    let timer = timer(context, wired)?;
    let most = timer_hz(context, timer)? / PWM_STEPS_MIN;
    let (name, device) = (&timer.name, &wired.device.name.value);
    (frequency_hz > most).then(|| {
        let message = format!("{name} of {device} makes at most {most} pulses a second");
        clock_out_of_reach(
            wired.device.kind_span,
            &message,
            &format!("write `frequency = {most} Hz;` or less"),
        )
    })
}

/// Reports a rate that the divider misses by too much.
fn of_baud(context: &Context<'_>, unit: &str, asked: u32, span: Span) -> Option<Diagnostic> {
    let exact = ports::exact_baud(context, unit, asked)?;
    if off_ppm(exact, asked) <= SERIAL_OFF_PPM_MAX {
        return None;
    }
    let message = format!("{unit} makes {exact} baud of its clock, not {asked}");
    let help = format!(
        "write a `baud` within 2.2 % of one that it can make, such as {exact}, or take another port: their clocks differ"
    );
    Some(clock_out_of_reach(span, &message, &help))
}

fn of_bus(context: &Context<'_>, unit: &UnitName, on_bus: &[&Wired<'_>]) -> Option<Diagnostic> {
    let profile = context.board.profile()?;
    let facts: &Unit = profile.unit(unit.as_str())?;
    let hz = unit_hz(context, facts)?;
    let is_strip = |wired: &&&Wired<'_>| wired.device.kind.encoding().windows().is_some();
    if let Some(strip) = on_bus.iter().find(is_strip) {
        return strips::out_of_reach(context, unit.as_str(), strip);
    }
    let asked_hz = buses::asked_hz(on_bus.iter().copied())?;
    let exact = buses::exact_hz(context, unit, asked_hz);
    let asks = |wired: &&&Wired<'_>| buses::asked_hz(std::iter::once(**wired)) == Some(asked_hz);
    let wired = on_bus.iter().find(asks)?;
    let (name, device) = (unit.as_str(), &wired.device.name.value);
    let kind_span = wired.device.kind_span;
    let kind = &wired.device.kind;
    let (span, property, slowest) = match kind.interface() {
        Interface::Can(can) => {
            let at = can.bitrate_span.unwrap_or(kind_span);
            return of_can(
                (name, device),
                at,
                asked_hz,
                can_bit(profile.can_dividers.as_ref()?, hz, asked_hz)?.rate_hz(hz)?,
            );
        }
        Interface::I2c(i2c) => (i2c.speed_span, "speed", i2c_clock::slowest_hz(&profile.i2c, hz)),
        Interface::Spi(spi) => {
            let dividers = profile.spi_dividers.as_ref()?;
            (spi.clock_span, "clock", Some(slowest_hz(dividers, hz)))
        }
        Interface::Analog(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::OneWire(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => return None,
    };
    // Without facts about its dividers, nothing is known about the clock.
    let slowest = slowest.filter(|_| exact.is_none())?;
    let message = format!(
        "{name} of {device} makes no clock of {asked_hz} Hz or less: its slowest is {slowest} Hz"
    );
    let help = format!("write `{property} = {slowest} Hz;` or more");
    Some(clock_out_of_reach(span.unwrap_or(kind_span), &message, &help))
}

/// Reports a CAN bus whose bit rate is too far off.
fn of_can(
    (unit, device): (&str, &str),
    at: Span,
    asked_hz: u32,
    exact_hz: u32,
) -> Option<Diagnostic> {
    if off_ppm(exact_hz, asked_hz) <= CAN_OFF_PPM_MAX {
        return None;
    }
    let message =
        format!("{unit} of {device} makes {exact_hz} bits a second of its clock, not {asked_hz}");
    let help = format!(
        "write a `bitrate` within 0.5 % of one that it can make: {exact_hz} Hz is the nearest"
    );
    Some(clock_out_of_reach(at, &message, &help))
}
