//! The connections of an MCU's pads and buses.
//!
//! The machine asks, the world answers. All times are virtual nanoseconds since the board got power, and they never go
//! backwards from one call to the next, with one documented exception: [`Surroundings::next_edge`] asks about the
//! future.
//!
//! # Example
//!
//! ```
//! use sensedsl_surroundings::{Pad, Surroundings};
//!
//! /// A battery at PA1 that loses a millivolt each second.
//! struct Battery(Pad);
//!
//! impl Surroundings for Battery {
//!     fn millivolts(&mut self, pad: Pad, now_ns: u64) -> f64 {
//!         if pad == self.0 { 3_000.0 - now_ns as f64 / 1e9 } else { 0.0 }
//!     }
//! }
//!
//! let pa1 = Pad::named("PA1").unwrap();
//! assert_eq!(Battery(pa1).millivolts(pa1, 5_000_000_000), 2_995.0);
//! // Whatever else is not connected has the default.
//! assert_eq!(Battery(pa1).level(Pad { port: 1, pin: 0 }, 0), None);
//! ```

use std::fmt;

/// A pad of the MCU: port `0` is A, and pins count from 0 to 15.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pad {
    /// The port: 0 for port A, 1 for port B, and so on.
    pub port: u8,
    /// The pin, from 0 to 15.
    pub pin: u8,
}

impl Pad {
    /// The pad with that name, as in `PA5`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let mut letters = name.strip_prefix('P')?.chars();
        let port = letters.next().filter(char::is_ascii_uppercase)?;
        let digits = letters.as_str();
        let pin: u8 = digits.parse().ok().filter(|pin| *pin < 16 && !digits.starts_with('+'))?;
        let port = u8::try_from(u32::from(port) - u32::from('A')).ok()?;
        Some(Self { port, pin })
    }
}

impl fmt::Display for Pad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "P{}{}", char::from(b'A'.saturating_add(self.port)), self.pin)
    }
}

/// An action of the MCU on an I2C bus, as its master.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum I2cEvent {
    /// A start or a repeated start, and the 7-bit address.
    Start {
        /// The address without the direction bit.
        address: u8,
        /// Whether the master reads.
        read: bool,
    },
    /// The master sends a byte.
    Write(u8),
    /// The master takes a byte.
    Read {
        /// Whether it acknowledges the byte, and so wants another one.
        ack: bool,
    },
    /// The bus is released.
    Stop,
}

/// The bus's answer to an [`I2cEvent`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum I2cReply {
    /// SDA was pulled low: the address or the byte was taken. After [`I2cEvent::Stop`]: the bus is free.
    Ack,
    /// SDA was not pulled low.
    Nack,
    /// The byte that the master read.
    Byte(u8),
    /// Something holds SDA low. The bus stays busy until the master has clocked it free by hand.
    Stuck,
    /// Something holds SCL low: nothing more happens on the bus until [`Surroundings::level`] reports SCL as high.
    Silent,
}

/// An output of a timer: a channel's, or its complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TimerOutput {
    /// The timer's number.
    pub timer: u8,
    /// The channel, counted from 1.
    pub channel: u8,
    /// Whether it is the complement: `CH1N` instead of `CH1`.
    pub is_complement: bool,
}

/// A CAN frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanFrame {
    /// The identifier, with 11 bits, or with 29 if `extended` is set.
    pub id: u32,
    /// Whether the identifier has 29 bits.
    pub extended: bool,
    /// Whether it is a request for a frame, which has no data.
    pub remote: bool,
    /// The number of bytes of `data` that count, at most 8.
    pub length: u8,
    /// The data.
    pub data: [u8; 8],
}

/// The connections of the MCU's pads and buses. Times are virtual nanoseconds since the board got power.
///
/// Units are numbered as in the MCU's manual: `1` is I2C1, USART1, SPI1, TIM1, CAN1; channels of a timer and of the DAC
/// start at 1. The default methods stand for pads and buses with nothing connected, so that a test's world implements
/// only what it is about.
pub trait Surroundings: Send {
    /// The voltage that a converter samples at a pad.
    fn millivolts(&mut self, pad: Pad, now_ns: u64) -> f64 {
        let _ = (pad, now_ns);
        0.0
    }

    /// The level that is driven from outside; `None` if nothing drives it, so that the pull resistor decides. A voltage
    /// source also drives its pad, and a pull-up resistor of a bus drives its wires high: firmware looks for loose
    /// wires.
    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        let _ = (pad, now_ns);
        None
    }

    /// The first change of [`Surroundings::level`] after a time, and the level from then on. Captures, encoders and
    /// external interrupts depend on it. A world that changes an edge it has announced (because the MCU drove a pad,
    /// say) does so before the time of that edge, and the machine asks again after each [`Surroundings::driven`].
    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        let _ = (pad, after_ns);
        None
    }

    /// An output of the MCU changed: triggers, chip selects, LEDs. `None` if the MCU no longer drives the pad.
    fn driven(&mut self, pad: Pad, level: Option<bool>, now_ns: u64) {
        let _ = (pad, level, now_ns);
    }

    /// The MCU acts as the master of an I2C bus.
    fn i2c(&mut self, unit: u8, event: I2cEvent, now_ns: u64) -> I2cReply {
        let _ = (unit, now_ns);
        match event {
            I2cEvent::Start { .. } | I2cEvent::Write(_) => I2cReply::Nack,
            I2cEvent::Read { .. } => I2cReply::Byte(0xFF),
            I2cEvent::Stop => I2cReply::Ack,
        }
    }

    /// The MCU shifts a byte out of an SPI port, and another one in. The chip selects determine the chip.
    fn spi(&mut self, unit: u8, out: u8, now_ns: u64) -> u8 {
        let _ = (unit, out, now_ns);
        0xFF
    }

    /// The levels at MOSI while an SPI port shifts a byte out, whether its clock is at a pad or not: the highest bit first,
    /// from that time on, each of which lasts so many picoseconds.
    fn levels(&mut self, unit: u8, byte: u8, from_ps: u64, bit_ps: u64) {
        let _ = (unit, byte, from_ps, bit_ps);
    }

    /// A byte that has arrived at a serial port, if there is one. The machine asks as often as the port can take a
    /// byte, which is about once in the time of one.
    fn uart_in(&mut self, unit: u8, now_ns: u64) -> Option<u8> {
        let _ = (unit, now_ns);
        None
    }

    /// The MCU has sent a byte on a serial port.
    fn uart_out(&mut self, unit: u8, byte: u8, now_ns: u64) {
        let _ = (unit, byte, now_ns);
    }

    /// A frame that has arrived on a CAN bus, if there is one.
    fn can_in(&mut self, unit: u8, now_ns: u64) -> Option<CanFrame> {
        let _ = (unit, now_ns);
        None
    }

    /// The MCU has sent a frame on a CAN bus.
    fn can_out(&mut self, unit: u8, frame: CanFrame, now_ns: u64) {
        let _ = (unit, frame, now_ns);
    }

    /// An output of a timer has a new waveform. A width of 0 means off.
    fn pwm(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64, now_ns: u64) {
        let _ = (output, period_ns, width_ns, now_ns);
    }

    /// A timer that stops after each period has made a pulse, which is over now.
    fn pulse(&mut self, output: TimerOutput, from_ns: u64, width_ns: u64) {
        let _ = (output, from_ns, width_ns);
    }

    /// An output of a DAC has a new voltage. Channels count on from unit to unit, each of which has two.
    fn dac(&mut self, channel: u8, millivolts: f64, now_ns: u64) {
        let _ = (channel, millivolts, now_ns);
    }
}

#[cfg(test)]
mod tests {
    use super::Pad;

    #[test]
    fn pads_have_names() {
        let pad = Pad { port: 4, pin: 15 };
        assert_eq!(pad.to_string(), "PE15");
        assert_eq!(Pad::named("PE15"), Some(pad));
        assert_eq!(Pad::named("PA0"), Some(Pad { port: 0, pin: 0 }));
        for wrong in ["", "P", "PA", "PA16", "pa1", "A1", "P1", "PAA1", "PA+1"] {
            assert_eq!(Pad::named(wrong), None, "{wrong}");
        }
    }
}
