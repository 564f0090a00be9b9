//! What a property takes: its shape as data, and in words.

use std::fmt;

use sensedsl_syntax::Unit;

/// What a property takes. Ranges hold both of their ends.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A whole number.
    Whole(i64, i64),
    /// A whole number that people write in hexadecimal.
    Hex(i64, i64),
    /// Any number, without a unit.
    Number,
    /// A bound of the shown value, with its unit or without.
    Bound,
    /// A value as it is shown, with its unit or without, or a code.
    Shown,
    /// A time, in microseconds.
    Time(u64, u64),
    /// A time up to the period of a pwm output.
    Pulse,
    /// A frequency, in hertz.
    Frequency(u32, u32),
    /// A frequency, or the time of one tick; in hertz.
    Rate(u32, u32),
    /// A voltage, in millivolts.
    Voltage(u32, u32),
    /// Two resistances.
    Resistances,
    /// `true` or `false`.
    Truth,
    /// One of a few words.
    Words(fn() -> Vec<&'static str>),
    /// So many bytes.
    Bytes(usize, usize),
    /// A text.
    Text,
    /// A text, or a list of texts.
    Texts,
    /// The unit of a shown value.
    Quantity,
    /// A kind of device.
    Kind,
    /// A driver of the library or of the file.
    Driver,
    /// A reading or a command of the chip's driver.
    Reading,
    /// Connections of the driver.
    Connections,
    /// An output of the driver's formula.
    Output,
    /// A pin, or a list with one for each element of an array.
    Pin,
    /// A peripheral instance.
    Peripheral,
    /// A side of the board.
    Side,
    /// A connector of the board.
    Header,
    /// A group of devices.
    Group,
    /// The system of a firmware.
    Target,
    /// Devices of the board.
    Devices,
    /// Something else: what it is, and the units that its numbers may have.
    Form(&'static str, &'static [Unit]),
}

/// Units of a time.
pub(super) const TIME: &[Unit] = &[Unit::Microseconds, Unit::Milliseconds, Unit::Seconds];
/// Units of a frequency.
const FREQUENCY: &[Unit] = &[Unit::Hertz, Unit::Kilohertz, Unit::Megahertz];
/// Units of a tick.
const RATE: &[Unit] = &[
    Unit::Hertz,
    Unit::Kilohertz,
    Unit::Megahertz,
    Unit::Microseconds,
    Unit::Milliseconds,
    Unit::Seconds,
];
/// Units of a voltage.
pub(super) const VOLTAGE: &[Unit] = &[Unit::Volts, Unit::Millivolts];
/// Units of a resistance.
pub(super) const RESISTANCE: &[Unit] = &[Unit::Ohms, Unit::Kiloohms];

impl Takes {
    /// The words of a closed set; empty for anything else.
    #[must_use]
    pub fn words(&self) -> Vec<&'static str> {
        if let Self::Words(words) = self {
            words()
        } else if matches!(self, Self::Truth) {
            vec!["true", "false"]
        } else {
            Vec::new()
        }
    }

    /// The units that its numbers may have, whatever the device shows.
    #[must_use]
    pub const fn units(&self) -> &'static [Unit] {
        if let Self::Form(_, units) = self {
            units
        } else if matches!(self, Self::Time(..) | Self::Pulse) {
            TIME
        } else if matches!(self, Self::Frequency(..)) {
            FREQUENCY
        } else if matches!(self, Self::Rate(..)) {
            RATE
        } else if matches!(self, Self::Voltage(..)) {
            VOLTAGE
        } else if matches!(self, Self::Resistances) {
            RESISTANCE
        } else {
            &[]
        }
    }
}

/// In words, as a sentence goes on after "takes".
impl fmt::Display for Takes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(least, most) => write!(f, "a whole number from {least} to {most}"),
            Self::Hex(least, most) => write!(f, "a whole number from {least:#04X} to {most:#X}"),
            Self::Number => f.write_str("a number"),
            Self::Bound => f.write_str("a number as it is shown, with its unit or without"),
            Self::Shown => f.write_str(
                "a value as it is shown, with its unit or without, or a code such as `raw 307`",
            ),
            Self::Time(0, most) => write!(f, "a time up to {}", time(*most)),
            Self::Time(least, most) => write!(f, "a time from {} to {}", time(*least), time(*most)),
            Self::Pulse => f.write_str("a time up to the period"),
            Self::Frequency(least, most) => {
                write!(f, "a frequency from {} to {}", frequency(*least), frequency(*most))
            }
            Self::Rate(least, most) => {
                let (least, most) = (frequency(*least), frequency(*most));
                write!(f, "a frequency from {least} to {most}, or the time of one tick")
            }
            Self::Voltage(..) => f.write_str("a voltage"),
            Self::Resistances => f.write_str("two resistances such as `[33 kOhm, 10 kOhm]`"),
            Self::Truth => f.write_str("`true` or `false`"),
            Self::Words(words) => {
                let words: Vec<String> = words().iter().map(|one| format!("`{one}`")).collect();
                match words.as_slice() {
                    [only] => f.write_str(only),
                    words => write!(f, "one of {}", words.join(", ")),
                }
            }
            Self::Bytes(1, 1) => f.write_str("one byte or letter"),
            Self::Bytes(least, most) => {
                write!(f, "{least} to {most} bytes, as a list of numbers or as a text")
            }
            Self::Text => f.write_str("a text"),
            Self::Texts => f.write_str("a text, or a list of texts"),
            Self::Quantity => f.write_str("the name of a unit"),
            Self::Kind => f.write_str("a kind of device"),
            Self::Driver => f.write_str("the name of a driver"),
            Self::Reading => f.write_str("a reading or a command of the driver"),
            Self::Connections => f.write_str("a connection of the driver, or a list of them"),
            Self::Output => f.write_str("an output of the formula"),
            Self::Pin => f.write_str("a pin; of an array a list with one for each element"),
            Self::Peripheral => f.write_str("a peripheral such as `ADC1`"),
            Self::Side => f.write_str("a side of the board"),
            Self::Header => f.write_str("a connector of the board"),
            Self::Group => f.write_str("the name of a group, or `none`"),
            Self::Target => f.write_str("a system, or one with its version"),
            Self::Devices => f.write_str("a device, or a list of them"),
            Self::Form(form, _) => f.write_str(form),
        }
    }
}

/// A time in the largest unit in which it is a whole number.
fn time(us: u64) -> String {
    let units = [(3_600_000_000, "h"), (1_000_000, "s"), (1_000, "ms")];
    let found = units.iter().find(|(size, _)| us >= *size && us.is_multiple_of(*size));
    let (size, unit) = found.copied().unwrap_or((1, "us"));
    format!("{} {unit}", us / size)
}

fn frequency(hz: u32) -> String {
    crate::value::written::shown_hz(hz)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_told_in_the_unit_that_people_use() {
        assert_eq!(Takes::Time(1_000, 3_600_000_000).to_string(), "a time from 1 ms to 1 h");
        assert_eq!(Takes::Time(0, 60_000_000).to_string(), "a time up to 60 s");
        assert_eq!(Takes::Time(1, 10_000).to_string(), "a time from 1 us to 10 ms");
        let speed = Takes::Frequency(1_000, 1_000_000).to_string();
        assert_eq!(speed, "a frequency from 1 kHz to 1 MHz");
        let frame = Takes::Hex(0, 0x1FFF_FFFF).to_string();
        assert_eq!(frame, "a whole number from 0x00 to 0x1FFFFFFF");
    }
}
