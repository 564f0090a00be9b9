//! The greatest age of a value when it arrives.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::Transport;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::i2c::I2c;
use sensedsl_model::kind::icu::{Icu, Mode};
use sensedsl_model::kind::spi::Spi;
use sensedsl_wire::Direction;

use super::findings::{MS, SECOND};
use crate::truth::Subject;
use crate::world::Signal;

/// The time that the longest frame takes on a serial link.
pub(super) fn link_ns(job: &BoardJob<'_>) -> u64 {
    if job.board.link.transport != Transport::Uart {
        return 0;
    }
    let bytes = u64::try_from(job.schema.frame_bytes_max(Direction::Sensor)).unwrap_or(0);
    // A report waits for the one that is on the line.
    2 * bytes * 10 * SECOND / u64::from(job.board.link.baud.max(1))
}

/// The greatest age of a value when it is read.
pub(super) fn measured_ns(one: &JobDevice<'_>, subject: &Subject, period_ns: u64) -> u64 {
    let device = one.device;
    let delay_ns = MS * u64::from(device.delay_ms);
    match device.kind.interface() {
        Interface::I2c(I2c { trigger, wait_us, .. })
        | Interface::Spi(Spi { trigger, wait_us, .. })
            if !trigger.is_empty() =>
        {
            delay_ns + 1_000 * u64::from(*wait_us)
        }
        Interface::OneWire(own) => {
            // A bit-banged reading lasts some milliseconds, and is repeated where something disturbed it.
            let read_ns = delay_ns.min(50 * MS) + 40 * MS;
            read_ns
                + (delay_ns + 1_000 * u64::from(own.wait_us)) * u64::from(!own.trigger.is_empty())
        }
        Interface::Analog(_) | Interface::I2c(_) | Interface::Spi(_) => delay_ns.min(50 * MS),
        // A spike restarts a contact's debounce, and without interrupts each sample is a cycle late.
        Interface::Digital(own) if own.debounce_us > 0 => {
            delay_ns.min(50 * MS) + 3_000 * u64::from(own.debounce_us) + 20 * MS
        }
        Interface::Digital(_) => delay_ns.min(50 * MS),
        // An answer has what the part measures then.
        Interface::Uart(own) if !own.exchange.request.is_empty() => period_ns + 10 * MS,
        Interface::Uart(_) | Interface::Can(_) => period_ns + delay_ns.min(SECOND),
        Interface::Encoder(_) | Interface::Stepper(_) => 20 * MS,
        Interface::Icu(icu) => {
            pulses_ns(icu, subject) + delay_ns * u64::from(icu.pulse_us.is_some())
        }
        Interface::Pwm(_) | Interface::Dac(_) | Interface::Code(_) => 0,
    }
}

/// The greatest age of the last pulse.
fn pulses_ns(icu: &Icu, subject: &Subject) -> u64 {
    let bounds = subject.signals.iter().filter_map(Signal::bounds);
    let ends =
        bounds.flat_map(|(least, greatest)| [least, greatest]).map(|end| subject.scale.raw(end));
    let (least, greatest) = ends.fold((f64::MAX, 0.0_f64), |(l, g), one| (l.min(one), g.max(one)));
    let ticks_ns =
        |ticks: f64| crate::arith::nanoseconds(ticks * 1e9 / f64::from(icu.tick_hz.max(1)));
    match icu.mode {
        Mode::Count => 20 * MS,
        Mode::Width => 45 * MS + 2 * ticks_ns(greatest) + 1_000 * u64::from(icu.wait_us),
        Mode::Period => 2 * ticks_ns(greatest),
        Mode::Frequency if least > 2.0 => crate::arith::nanoseconds(2e9 / least),
        Mode::Frequency => 1_200 * MS,
        Mode::Duty => 30 * MS,
        Mode::Ppm => 2 * 40 * MS + 8 * ticks_ns(greatest),
    }
}
