//! How pads must be set up, from the wiring alone, and which of them differ.
//!
//! In: a board's job, and the state of the pads of the emulated MCU. Out: the differences. Nothing here is shared with
//! the generators, which decide the same things independently.

use sensedsl_board::signal::{Function, Signal};
use sensedsl_job::{BoardJob, Pad as Wired};
use sensedsl_model::kind::digital::Pull as Wanted;
use sensedsl_model::kind::uart::Duplex;
use sensedsl_model::kind::{Interface, Kind, Role};

use sensedsl_machine::{Mode, PadState, Pull};
use sensedsl_surroundings::Pad;

/// How a pad must be set up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Planned {
    pad: Pad,
    title: String,
    mode: Mode,
    /// The signal that it is switched to.
    wire: Option<Signal>,
    /// Whether it must be open-drain; `None` if it drives nothing.
    open_drain: Option<bool>,
    /// The pull resistors, any of which will do.
    pulls: &'static [Pull],
}

/// A pad or a port that is not as planned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PadMismatch {
    /// The device, or the link.
    pub title: String,
    /// The pad or the port, as in `PB4` or `USART2`.
    pub place: String,
    /// The expected setting.
    pub expected: String,
    /// The setting found.
    pub found: String,
}

const FREE: &[Pull] = &[Pull::None];
const UP: &[Pull] = &[Pull::Up];
const DOWN: &[Pull] = &[Pull::Down];
/// The lines of a bus have external pull-ups, which those of its pads may support.
const BUS: &[Pull] = &[Pull::None, Pull::Up];
const ANY: &[Pull] = &[Pull::None, Pull::Up, Pull::Down];

/// The pads of all devices and of a serial link. `is_numbered` says whether each pad of the MCU has a number that
/// switches it to a peripheral.
pub(crate) fn planned(job: &BoardJob<'_>, is_numbered: bool) -> Vec<Planned> {
    let devices = job.connections.iter().flat_map(|one| {
        let kind = &one.connection.kind;
        one.pads.iter().filter_map(move |pad| of_kind(&one.title, kind, pad, is_numbered))
    });
    let link = job.link.iter().flat_map(|link| &link.pads).filter_map(|pad| {
        let pulls = if pad.role == Role::Rx { BUS } else { FREE };
        led("the link", pad, is_numbered, Some(false), pulls)
    });
    devices.chain(link).collect()
}

fn of_kind(title: &str, kind: &Kind, pad: &Wired<'_>, is_numbered: bool) -> Option<Planned> {
    let led = |open_drain, pulls| led(title, pad, is_numbered, open_drain, pulls);
    let named = Pad::named(&pad.pin.name.to_string())?;
    let plain = |mode, open_drain, pulls| {
        let title = title.to_owned();
        Some(Planned { pad: named, title, mode, wire: None, open_drain, pulls })
    };
    if pad.role.is_on_any_pin() {
        return plain(Mode::Output, Some(false), ANY);
    }
    let driven = (!pad.role.is_driven_by_device()).then_some(false);
    match kind.interface() {
        Interface::Analog(_) | Interface::Dac(_) => plain(Mode::Analog, None, FREE),
        Interface::Digital(_) if pad.role == Role::Out => plain(Mode::Output, Some(false), ANY),
        Interface::Digital(own) => plain(
            Mode::Input,
            None,
            match own.pull {
                Wanted::None => FREE,
                Wanted::Up => UP,
                Wanted::Down => DOWN,
            },
        ),
        Interface::I2c(_) => led(Some(true), BUS),
        // Each end of a wire with both directions pulls it low, or lets it go.
        Interface::Uart(own) if own.exchange.duplex == Duplex::Half => led(Some(true), BUS),
        Interface::OneWire(_) => plain(Mode::Output, Some(true), BUS),
        Interface::Uart(own) if pad.role == Role::Rx => {
            led(None, if own.is_inverted { DOWN } else { UP })
        }
        Interface::Spi(_) => led(driven, ANY),
        Interface::Can(_) if pad.role == Role::Rx => led(None, BUS),
        Interface::Uart(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Pwm(_)
        | Interface::Stepper(_)
        | Interface::Can(_)
        | Interface::Code(_) => led(driven, FREE),
    }
}

/// A pad that belongs to a peripheral. Where it has no number, the peripheral controls it only if it drives it, as both
/// ends do with the wires of an open-drain bus.
fn led(
    title: &str,
    pad: &Wired<'_>,
    is_numbered: bool,
    open_drain: Option<bool>,
    pulls: &'static [Pull],
) -> Option<Planned> {
    let is_driven = open_drain == Some(true) || !pad.role.is_driven_by_device();
    let mode = match (is_numbered, is_driven) {
        (true, _) => Mode::Alternate(Some(pad.alternate?)),
        (false, true) => Mode::Alternate(None),
        (false, false) => Mode::Input,
    };
    Some(Planned {
        pad: Pad::named(&pad.pin.name.to_string())?,
        title: title.to_owned(),
        mode,
        wire: pad.usage.map(|usage| usage.signal.clone()),
        open_drain,
        pulls,
    })
}

/// The pads that are not as planned.
pub(crate) fn mismatches(planned: &[Planned], states: &[PadState]) -> Vec<PadMismatch> {
    let differs = |one: &Planned| {
        let state = states.iter().find(|state| state.pad == one.pad)?;
        let drives = one.open_drain.is_none_or(|open_drain| open_drain == state.open_drain);
        let is_right = state.mode == one.mode
            && is_led(one, state)
            && drives
            && one.pulls.contains(&state.pull);
        (!is_right).then(|| PadMismatch {
            title: one.title.clone(),
            place: one.pad.to_string(),
            expected: expected(one),
            found: found(one, state),
        })
    };
    planned.iter().filter_map(differs).collect()
}

/// Whether the pad's alternate function is the one of its signal. The MCU's own facts tell, whatever number was
/// planned.
fn is_led(one: &Planned, state: &PadState) -> bool {
    let Some(wire) = &one.wire else { return true };
    let is_same = |led: &String| Signal::parse(led).0.function() == wire.function();
    *wire.function() == Function::Other || state.wires.iter().any(is_same)
}

fn mode(of: Mode) -> String {
    match of {
        Mode::Input => "an input".to_owned(),
        Mode::Output => "an output".to_owned(),
        Mode::Alternate(Some(number)) => format!("alternate function {number}"),
        Mode::Alternate(None) => "an alternate function".to_owned(),
        Mode::Analog => "analog".to_owned(),
    }
}

fn pull(of: Pull) -> &'static str {
    match of {
        Pull::None => "no pull",
        Pull::Up => "pulled up",
        Pull::Down => "pulled down",
    }
}

fn drive(is_open_drain: bool) -> &'static str {
    if is_open_drain { "open drain" } else { "push-pull" }
}

fn expected(one: &Planned) -> String {
    let wire = one.wire.as_ref().map(|wire| format!(" ({wire})")).unwrap_or_default();
    let drive = one.open_drain.map(|drains| format!(", {}", drive(drains))).unwrap_or_default();
    let pulls: Vec<&str> = one.pulls.iter().map(|one| pull(*one)).collect();
    let pulls =
        if one.pulls.len() == 3 { String::new() } else { format!(", {}", pulls.join(" or ")) };
    format!("{}{wire}{drive}{pulls}", mode(one.mode))
}

fn found(one: &Planned, state: &PadState) -> String {
    let wires = state.wires.join(", ");
    let wires = if wires.is_empty() { wires } else { format!(" ({wires})") };
    let drive = one.open_drain.map(|_| format!(", {}", drive(state.open_drain)));
    let pulls = if one.pulls.len() == 3 { "" } else { pull(state.pull) };
    let comma = if pulls.is_empty() { "" } else { ", " };
    format!("{}{wires}{}{comma}{pulls}", mode(state.mode), drive.unwrap_or_default())
}
