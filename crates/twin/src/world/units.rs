//! Quantities that plants are described with: a text with a unit in, a number in the plants' own units out, and the way
//! from these to what a device shows.

use std::f64::consts::{PI, TAU};

/// What sort of quantity a number is of. Plants count angles in radians, temperatures in degrees Celsius, charges in
/// ampere-seconds, everything else in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sort {
    Angle,
    Turning,
    Length,
    Speed,
    Acceleration,
    Temperature,
    /// A difference of temperatures.
    Warmth,
    Voltage,
    Current,
    /// A share of a whole.
    Share,
    Time,
    Power,
    Resistance,
    Charge,
    /// How much warmer something becomes for each watt.
    Insulation,
    /// On or off.
    Contact,
}

impl Sort {
    /// What it is, with an example.
    pub(super) const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Angle => ("an angle", "90 deg"),
            Self::Turning => ("a speed of turning", "200 rpm"),
            Self::Length => ("a length", "65 mm"),
            Self::Speed => ("a speed", "0.5 m/s"),
            Self::Acceleration => ("an acceleration", "9.81 m/s^2"),
            Self::Temperature => ("a temperature", "20 degC"),
            Self::Warmth => ("a difference of temperatures", "60 K"),
            Self::Voltage => ("a voltage", "7.4 V"),
            Self::Current => ("a current", "1.5 A"),
            Self::Share => ("a share", "5 %"),
            Self::Time => ("a time", "100 ms"),
            Self::Power => ("a power", "40 W"),
            Self::Resistance => ("a resistance", "80 mOhm"),
            Self::Charge => ("a charge", "2200 mAh"),
            Self::Insulation => ("a temperature for each watt", "2 K/W"),
            Self::Contact => ("a contact", "true"),
        }
    }
}

/// All units: name, sort, and factor and offset to the plants' own.
const UNITS: [(&str, Sort, f64, f64); 53] = [
    ("rad", Sort::Angle, 1.0, 0.0),
    ("deg", Sort::Angle, PI / 180.0, 0.0),
    ("°", Sort::Angle, PI / 180.0, 0.0),
    ("turns", Sort::Angle, TAU, 0.0),
    ("rad/s", Sort::Turning, 1.0, 0.0),
    ("deg/s", Sort::Turning, PI / 180.0, 0.0),
    ("rpm", Sort::Turning, TAU / 60.0, 0.0),
    ("turns/s", Sort::Turning, TAU, 0.0),
    ("m", Sort::Length, 1.0, 0.0),
    ("cm", Sort::Length, 1e-2, 0.0),
    ("mm", Sort::Length, 1e-3, 0.0),
    ("m/s", Sort::Speed, 1.0, 0.0),
    ("cm/s", Sort::Speed, 1e-2, 0.0),
    ("mm/s", Sort::Speed, 1e-3, 0.0),
    ("km/h", Sort::Speed, 1.0 / 3.6, 0.0),
    ("m/s^2", Sort::Acceleration, 1.0, 0.0),
    ("g", Sort::Acceleration, 9.806_65, 0.0),
    ("degC", Sort::Temperature, 1.0, 0.0),
    ("°C", Sort::Temperature, 1.0, 0.0),
    ("K", Sort::Temperature, 1.0, -273.15),
    ("degF", Sort::Temperature, 5.0 / 9.0, -160.0 / 9.0),
    ("K", Sort::Warmth, 1.0, 0.0),
    ("degC", Sort::Warmth, 1.0, 0.0),
    ("V", Sort::Voltage, 1.0, 0.0),
    ("mV", Sort::Voltage, 1e-3, 0.0),
    ("A", Sort::Current, 1.0, 0.0),
    ("mA", Sort::Current, 1e-3, 0.0),
    ("%", Sort::Share, 1e-2, 0.0),
    ("percent", Sort::Share, 1e-2, 0.0),
    ("", Sort::Share, 1.0, 0.0),
    ("s", Sort::Time, 1.0, 0.0),
    ("ms", Sort::Time, 1e-3, 0.0),
    ("us", Sort::Time, 1e-6, 0.0),
    ("µs", Sort::Time, 1e-6, 0.0),
    ("min", Sort::Time, 60.0, 0.0),
    ("h", Sort::Time, 3_600.0, 0.0),
    ("W", Sort::Power, 1.0, 0.0),
    ("mW", Sort::Power, 1e-3, 0.0),
    ("kW", Sort::Power, 1e3, 0.0),
    ("Ohm", Sort::Resistance, 1.0, 0.0),
    ("mOhm", Sort::Resistance, 1e-3, 0.0),
    ("kOhm", Sort::Resistance, 1e3, 0.0),
    ("Ah", Sort::Charge, 3_600.0, 0.0),
    ("mAh", Sort::Charge, 3.6, 0.0),
    ("K/W", Sort::Insulation, 1.0, 0.0),
    ("degC/W", Sort::Insulation, 1.0, 0.0),
    ("", Sort::Contact, 1.0, 0.0),
    ("%", Sort::Contact, 1e-2, 0.0),
    ("rad/min", Sort::Turning, 1.0 / 60.0, 0.0),
    ("turns/min", Sort::Turning, TAU / 60.0, 0.0),
    ("in", Sort::Length, 25.4e-3, 0.0),
    ("mg", Sort::Acceleration, 9.806_65e-3, 0.0),
    ("um", Sort::Length, 1e-6, 0.0),
];

/// Factor and offset from a unit to the plants' own; `None` if it is not of that sort.
pub(super) fn unit(name: &str, sort: Sort) -> Option<(f64, f64)> {
    let found = UNITS.iter().find(|one| one.0 == name && one.1 == sort);
    found.map(|(_, _, factor, offset)| (*factor, *offset))
}

/// The units of a sort, for people.
pub(super) fn of_sort(sort: Sort) -> String {
    let names = UNITS.iter().filter(|one| one.1 == sort && !one.0.is_empty()).map(|one| one.0);
    names.collect::<Vec<_>>().join(", ")
}

/// A text such as `65 mm` in the plants' own units; `None` if it is not a number with a unit of that sort.
pub(super) fn read(text: &str, sort: Sort) -> Option<f64> {
    let text = text.trim();
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '_' | '+' | '-');
    let length = text.find(|c| !is_of_number(c)).unwrap_or(text.len());
    let (number, name) = text.split_at_checked(length)?;
    let number: f64 = number.replace('_', "").parse().ok()?;
    let (factor, offset) = unit(name.trim(), sort)?;
    Some(number * factor + offset).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_units_of_their_sort() {
        let near = |text, sort, wanted: f64| {
            let found = read(text, sort).unwrap();
            assert!((found - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{text}: {found}");
        };
        near("65 mm", Sort::Length, 0.065);
        near("-90deg", Sort::Angle, -PI / 2.0);
        near("300 rpm", Sort::Turning, 10.0 * PI);
        near("5 %", Sort::Share, 0.05);
        near("0.05", Sort::Share, 0.05);
        near("293.15 K", Sort::Temperature, 20.0);
        near("68 degF", Sort::Temperature, 20.0);
        near("60 K", Sort::Warmth, 60.0);
        near("2_200 mAh", Sort::Charge, 7_920.0);
        for (wrong, sort) in [
            ("65", Sort::Length),
            ("65 kg", Sort::Length),
            ("mm", Sort::Length),
            ("", Sort::Share),
            ("1e999", Sort::Share),
            ("--5 %", Sort::Share),
            ("5 mm", Sort::Speed),
        ] {
            assert_eq!(read(wrong, sort), None, "{wrong}");
        }
    }
}
