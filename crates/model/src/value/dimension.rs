//! The dimensions of units: a unit in, its powers of seconds, volts, metres and so on, and its
//! power of ten out.

use sensedsl_syntax::Unit;

/// The powers of the base units. Being a code is one of them, so that a code cannot be added to a
/// shown value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Dimension {
    pub(super) seconds: i8,
    pub(super) volts: i8,
    pub(super) ohms: i8,
    pub(super) metres: i8,
    pub(super) amperes: i8,
    pub(super) watts: i8,
    pub(super) degrees: i8,
    pub(super) celsius: i8,
    pub(super) turns: i8,
    pub(super) percents: i8,
    pub(super) raws: i8,
}

impl Dimension {
    pub(crate) const NONE: Self = Self {
        seconds: 0,
        volts: 0,
        ohms: 0,
        metres: 0,
        amperes: 0,
        watts: 0,
        degrees: 0,
        celsius: 0,
        turns: 0,
        percents: 0,
        raws: 0,
    };
    pub(crate) const TIME: Self = Self { seconds: 1, ..Self::NONE };
    pub(crate) const FREQUENCY: Self = Self { seconds: -1, ..Self::NONE };
    pub(crate) const VOLTAGE: Self = Self { volts: 1, ..Self::NONE };
    pub(crate) const RESISTANCE: Self = Self { ohms: 1, ..Self::NONE };
    pub(crate) const RAW: Self = Self { raws: 1, ..Self::NONE };

    pub(crate) fn of(unit: Unit) -> Self {
        match unit {
            Unit::Microseconds | Unit::Milliseconds | Unit::Seconds => Self::TIME,
            Unit::Hertz | Unit::Kilohertz | Unit::Megahertz => Self::FREQUENCY,
            Unit::Millivolts | Unit::Volts => Self::VOLTAGE,
            Unit::Ohms | Unit::Kiloohms => Self::RESISTANCE,
            Unit::Percent => Self { percents: 1, ..Self::NONE },
            Unit::Millimetres | Unit::Centimetres | Unit::Metres => {
                Self { metres: 1, ..Self::NONE }
            }
            Unit::Degrees => Self { degrees: 1, ..Self::NONE },
            Unit::Celsius => Self { celsius: 1, ..Self::NONE },
            Unit::Milliamperes | Unit::Amperes => Self { amperes: 1, ..Self::NONE },
            Unit::Watts => Self { watts: 1, ..Self::NONE },
            Unit::TurnsPerMinute => Self { turns: 1, ..Self::NONE },
            Unit::DegreesPerSecond => Self { degrees: 1, seconds: -1, ..Self::NONE },
            Unit::MillimetresPerSecond | Unit::CentimetresPerSecond | Unit::MetresPerSecond => {
                Self { metres: 1, seconds: -1, ..Self::NONE }
            }
            Unit::MetresPerSecondSquared => Self { metres: 1, seconds: -2, ..Self::NONE },
        }
    }

    pub(crate) fn combine(self, other: Self, with: fn(i8, i8) -> i8) -> Self {
        Self {
            seconds: with(self.seconds, other.seconds),
            volts: with(self.volts, other.volts),
            ohms: with(self.ohms, other.ohms),
            metres: with(self.metres, other.metres),
            amperes: with(self.amperes, other.amperes),
            watts: with(self.watts, other.watts),
            degrees: with(self.degrees, other.degrees),
            celsius: with(self.celsius, other.celsius),
            turns: with(self.turns, other.turns),
            percents: with(self.percents, other.percents),
            raws: with(self.raws, other.raws),
        }
    }
}

/// The power of ten from a unit to seconds, hertz, volts, ohms, metres, amperes and the like.
pub(crate) fn power_of_ten(unit: Unit) -> i32 {
    match unit {
        Unit::Microseconds => -6,
        Unit::Milliseconds | Unit::Millivolts | Unit::Millimetres | Unit::Milliamperes => -3,
        Unit::MillimetresPerSecond => -3,
        Unit::Centimetres | Unit::CentimetresPerSecond => -2,
        Unit::Seconds
        | Unit::Hertz
        | Unit::Volts
        | Unit::Ohms
        | Unit::Percent
        | Unit::Metres
        | Unit::Degrees
        | Unit::Celsius
        | Unit::Amperes
        | Unit::Watts
        | Unit::TurnsPerMinute
        | Unit::DegreesPerSecond
        | Unit::MetresPerSecond
        | Unit::MetresPerSecondSquared => 0,
        Unit::Kilohertz | Unit::Kiloohms => 3,
        Unit::Megahertz => 6,
    }
}

/// A number times a power of ten, rounded once: negative powers of ten are not exact in binary.
pub(crate) fn shifted(number: f64, power: i32) -> f64 {
    if power < 0 { number / 10_f64.powi(-power) } else { number * 10_f64.powi(power) }
}
