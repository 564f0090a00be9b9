//! The units that a number may have, and how a word maps to one of them.

use std::fmt;

use sensedsl_diagnostics::nearest;

/// Makes the type of a table of units, each as it is written.
macro_rules! units {
    ($($name:literal $unit:ident,)+) => {
        /// The unit of a time, a frequency, a voltage or a resistance, or of a value that a device shows.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Unit {
            $(#[doc = concat!("`", $name, "`")] $unit,)+
        }

        impl Unit {
            /// All units.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$unit),+];

            /// The unit as written.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$unit => $name,)+
                }
            }
        }
    };
}

units! {
    "us" Microseconds,
    "ms" Milliseconds,
    "s" Seconds,
    "Hz" Hertz,
    "kHz" Kilohertz,
    "MHz" Megahertz,
    "mV" Millivolts,
    "V" Volts,
    "Ohm" Ohms,
    "kOhm" Kiloohms,
    "%" Percent,
    "mm" Millimetres,
    "cm" Centimetres,
    "m" Metres,
    "deg" Degrees,
    "degC" Celsius,
    "mA" Milliamperes,
    "A" Amperes,
    "W" Watts,
    "rpm" TurnsPerMinute,
    "deg/s" DegreesPerSecond,
    "mm/s" MillimetresPerSecond,
    "cm/s" CentimetresPerSecond,
    "m/s" MetresPerSecond,
    "m/s^2" MetresPerSecondSquared,
}

impl Unit {
    /// The unit that is written like this, if it exists.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// The length of the unit with a slash that a text begins with: 5 for `deg/s;`. A longer word
    /// does not count.
    pub(crate) fn with_slash(text: &str) -> Option<usize> {
        let names = Self::ALL.map(Self::name).into_iter().filter(|name| name.contains('/'));
        let ends = |name: &&str| {
            let rest = text.strip_prefix(*name);
            rest.is_some_and(|rest| {
                !rest.starts_with(|next: char| next.is_alphanumeric() || next == '_')
            })
        };
        names.filter(ends).map(str::len).max()
    }

    /// The unit probably meant by a word that is not a unit.
    pub(crate) fn similar(word: &str) -> Option<&'static str> {
        // Both code points of the micro sign, then units as words.
        let lower = word.to_lowercase().replace(['\u{b5}', '\u{3bc}'], "u");
        let spelled_out = [
            ("usec", Self::Microseconds),
            ("microseconds", Self::Microseconds),
            ("msec", Self::Milliseconds),
            ("milliseconds", Self::Milliseconds),
            ("sec", Self::Seconds),
            ("seconds", Self::Seconds),
            ("hertz", Self::Hertz),
        ];
        let same = Self::ALL.into_iter().find(|unit| unit.name().to_lowercase() == lower);
        same.or_else(|| {
            let entry = spelled_out.iter().find(|(long, _)| long.starts_with(&*lower));
            entry.filter(|_| lower.len() > 2).map(|(_, unit)| *unit)
        })
        .map(Self::name)
        .or_else(|| nearest(word, Self::ALL.map(Self::name)))
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
