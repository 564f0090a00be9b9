//! How pads and ports of an AVR must be set up, from the wiring alone, and which of them are not.
//!
//! In: a board's job, and the registers of the emulated MCU. Out: the differences. Nothing here is shared with the
//! generator, which decides the same things on its own.

use std::collections::BTreeSet;

use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::Transport;
use sensedsl_model::kind::digital::Pull;
use sensedsl_model::kind::uart::Parity;
use sensedsl_model::kind::{Interface, Kind, Role};
use sensedsl_surroundings::Pad;
use sensedsl_twin::bench::number_of;

use super::board::AvrBoard;
use super::child::{Serial, Setting};

/// How far the rate of a serial port may be off, in thousandths: 115,200 is off by 21 on a crystal of 16 MHz.
const OFF_MAX: u64 = 25;

/// A pad or a port that is not as it must be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mismatch {
    /// `PC1 of Bump`
    pub what: String,
    pub expected: String,
    pub found: String,
}

/// How a pad must be: an output, or an input whose pull-up is on or off as one of these says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    Output,
    Input(&'static [bool]),
}

const FREE: &[bool] = &[false];
const UP: &[bool] = &[true];
const ANY: &[bool] = &[false, true];

impl Wanted {
    fn of(kind: &Kind, role: Role) -> Option<Self> {
        if role.is_on_any_pin() {
            return Some(Self::Output);
        }
        match kind.interface() {
            Interface::Digital(_) if role == Role::Out => Some(Self::Output),
            Interface::Digital(own) => Some(Self::Input(match own.pull {
                Pull::Up => UP,
                Pull::None | Pull::Down => FREE,
            })),
            Interface::Analog(_) | Interface::Icu(_) => Some(Self::Input(FREE)),
            // Nothing but a part pulls these low; resistors on the board may do what the MCU does.
            Interface::I2c(_) | Interface::Encoder(_) => Some(Self::Input(ANY)),
            // A wire to a part that is not there must not look like data.
            Interface::Uart(_) if role == Role::Rx => Some(Self::Input(UP)),
            Interface::Spi(_) if role.is_driven_by_device() => Some(Self::Input(ANY)),
            Interface::Spi(_) | Interface::Pwm(_) => Some(Self::Output),
            // The transmitter has its pad for itself; the rest is not there on an AVR.
            Interface::Uart(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        }
    }

    fn fits(self, is_output: bool, latch: bool) -> bool {
        match self {
            Self::Output => is_output,
            Self::Input(pulls) => !is_output && pulls.contains(&latch),
        }
    }

    fn shown(self) -> String {
        match self {
            Self::Output => "an output".to_owned(),
            Self::Input([is_pulled]) => shown(false, *is_pulled),
            Self::Input(_) => "an input".to_owned(),
        }
    }
}

fn shown(is_output: bool, latch: bool) -> String {
    match (is_output, latch) {
        (true, true) => "an output, high".to_owned(),
        (true, false) => "an output, low".to_owned(),
        (false, true) => "an input, pulled up".to_owned(),
        (false, false) => "an input, not pulled".to_owned(),
    }
}

/// The pads and ports that are not as the wiring says.
pub(super) fn mismatches(job: &BoardJob<'_>, board: &mut AvrBoard) -> Vec<Mismatch> {
    let registers = board.registers();
    let mut all = of_pads(job, &registers);
    all.extend(of_nobody(job, &registers));
    let wrong = job.connections.iter().filter_map(|one| of_port(job, one, board));
    all.extend(wrong.collect::<Vec<_>>());
    all
}

fn bit(registers: &[(u8, u8)], pad: Pad) -> (bool, bool) {
    let (direction, latch) = registers.get(usize::from(pad.port)).copied().unwrap_or_default();
    (direction >> pad.pin & 1 == 1, latch >> pad.pin & 1 == 1)
}

fn of_pads(job: &BoardJob<'_>, registers: &[(u8, u8)]) -> Vec<Mismatch> {
    let pads = job.connections.iter().flat_map(|one| one.pads.iter().map(move |pad| (one, pad)));
    let differs = |(one, wired): (&JobConnection<'_>, &sensedsl_job::Pad<'_>)| {
        let pad = Pad::named(&wired.pin.name.to_string())?;
        let wanted = Wanted::of(&one.connection.kind, wired.role)?;
        let (is_output, latch) = bit(registers, pad);
        (!wanted.fits(is_output, latch)).then(|| Mismatch {
            what: format!("{pad} of {}", one.title),
            expected: wanted.shown(),
            found: shown(is_output, latch),
        })
    };
    pads.filter_map(differs).collect()
}

/// Outputs that nobody has asked for: something else may drive the same pad.
fn of_nobody(job: &BoardJob<'_>, registers: &[(u8, u8)]) -> Vec<Mismatch> {
    let of_devices = job.connections.iter().flat_map(|one| &one.pads);
    let all = of_devices.chain(job.link.iter().flat_map(|link| &link.pads));
    let mut known: BTreeSet<Pad> =
        all.filter_map(|pad| Pad::named(&pad.pin.name.to_string())).collect();
    // The framework's lamps of a USB link are at these pads of an ATmega32U4.
    let lamps = ["PB0", "PD5"].into_iter().filter_map(Pad::named);
    known.extend(lamps.filter(|_| job.board.link.transport == Transport::Usb));
    let has_spi = job.connections.iter().any(|one| one.connection.kind.spi().is_some());
    let is_mega = job.board.mcu.as_deref().is_some_and(|mcu| mcu.starts_with("ATmega2560"));
    // The framework drives the pin that would make the unit a slave.
    let select = Pad::named(if is_mega { "PB0" } else { "PB2" });
    known.extend(select.filter(|_| has_spi));
    let pads = (0..).zip(registers).flat_map(|(port, (direction, _))| {
        (0..8).filter(move |pin| direction >> pin & 1 == 1).map(move |pin| Pad { port, pin })
    });
    let free = pads.filter(|pad| !known.contains(pad));
    free.map(|pad| Mismatch {
        what: format!("{pad} of nobody"),
        expected: "an input".to_owned(),
        found: "an output".to_owned(),
    })
    .collect()
}

/// The port of a connection, if it runs in another way than all parts on it understand.
fn of_port(job: &BoardJob<'_>, one: &JobConnection<'_>, board: &AvrBoard) -> Option<Mismatch> {
    let number = number_of(one.unit?);
    let found = |letter: char, number: u8| board.ports().get(&(letter, number)).copied();
    let (found, is_right) = match one.connection.kind.interface() {
        Interface::I2c(own) => {
            let most_hz = job.board.profile().map_or(u32::MAX, |all| all.i2c.speed_max_hz);
            let found = found('i', 1)?;
            let hz = if let Setting::I2c { clock_hz } = found { clock_hz } else { 0 };
            (found, (1..=own.speed_hz.min(most_hz)).contains(&hz))
        }
        Interface::Spi(own) => {
            let found = found('s', 1)?;
            // Parts take turns, each with its own setting: the last one counts here.
            let chips = job.connections.iter().filter_map(|other| other.connection.kind.spi());
            let is_right = chips.chain(std::iter::once(own)).any(|chip| {
                matches!(found, Setting::Spi { clock_hz, mode }
                    if mode == chip.mode && (1..=chip.clock_hz).contains(&clock_hz))
            });
            (found, is_right)
        }
        Interface::Uart(own) => {
            let found = found('u', number?)?;
            let odd_parity = match own.parity {
                Parity::None => None,
                Parity::Even => Some(false),
                Parity::Odd => Some(true),
            };
            let (baud, data_bits, stop_bits) = (own.baud, own.data_bits, own.stop_bits);
            let wanted = Serial { baud, data_bits, odd_parity, stop_bits };
            (found, is_alike(found, wanted))
        }
        _ => return None,
    };
    (!is_right).then(|| Mismatch {
        what: format!("{} of {}", one.unit.unwrap_or_default(), one.title),
        expected: "as its part says".to_owned(),
        found: format!("{found:?}"),
    })
}

fn is_alike(found: Setting, wanted: Serial) -> bool {
    let Setting::Serial(found) = found else { return false };
    let [is, must] = [found.baud, wanted.baud].map(u64::from);
    1_000 * is.abs_diff(must) <= OFF_MAX * must && Serial { baud: wanted.baud, ..found } == wanted
}

/// The wires that make parts measure, and have no pulses or shorter ones than these need.
pub(super) fn short_triggers(job: &BoardJob<'_>, board: &AvrBoard) -> Vec<Mismatch> {
    let differs = |one: &JobConnection<'_>| {
        let least_ns = 1_000 * u64::from(one.connection.kind.icu()?.pulse_us?);
        let pad = Pad::named(&one.pad(Role::Trigger)?.pin.name.to_string())?;
        let found = board.shortest_trigger_ns(pad);
        found.is_none_or(|ns| ns < least_ns).then(|| Mismatch {
            what: one.title.clone(),
            expected: format!("{least_ns} ns"),
            found: format!("{found:?} ns"),
        })
    };
    job.connections.iter().filter_map(differs).collect()
}
