//! A device's values as people read and write them.

use std::fmt;

use sensedsl_wire::{Direction, EncodeError, Scalar, ScalarType, encode_report};

use crate::schema::{Board, Device};

/// Significant digits of a shown number that is not whole.
const DIGITS: usize = 9;
/// The same where there is little room, for numbers that have no step.
const BRIEF_DIGITS: usize = 6;

/// The side on which a value is outside of its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Overstep {
    /// Less than the least.
    Below(f64),
    /// More than the greatest.
    Above(f64),
}

/// Why a command is not sent.
#[derive(Clone, Debug, PartialEq)]
pub enum CommandError {
    /// No actuator has the name; the one that was probably meant.
    Name(String, Option<String>),
    /// A sensor has the name.
    Sensor(String),
    /// The code of a controller on the board sets it: the device, and the controller.
    Owned(String, String),
    /// There are not as many values as the device has elements.
    Count {
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A word is no value of the device.
    Value(String),
    /// A unit is not one of the device's quantity.
    Unit {
        /// The unit.
        unit: String,
        /// The unit that the device is shown in.
        quantity: Option<String>,
    },
    /// A value is outside of the design's limits.
    Limit(String, Overstep),
    /// No code of the device's type is shown as the value.
    OutOfReach(String),
}

impl fmt::Display for CommandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name, None) => write!(f, "the board has no actuator `{name}`"),
            Self::Name(name, Some(meant)) => {
                write!(f, "the board has no actuator `{name}`, did you mean `{meant}`?")
            }
            Self::Sensor(name) => write!(f, "`{name}` is a sensor: it is not set"),
            Self::Owned(name, controller) => write!(
                f,
                "`{name}` obeys the code of `{controller}` on the board; `host = override;` there lets the host set it, too"
            ),
            Self::Count { expected, found } => {
                write!(f, "{found} values for {expected}: write one for each element")
            }
            Self::Value(word) => write!(f, "`{word}` is not a valid value"),
            Self::Unit { unit, quantity: Some(quantity) } => {
                write!(f, "`{unit}` does not fit: it is shown in {quantity}")
            }
            Self::Unit { unit, quantity: None } => {
                write!(f, "`{unit}` does not fit: it is shown as a bare number")
            }
            Self::Limit(value, Overstep::Below(least)) => {
                write!(f, "{value} is below the minimum of {}", number(*least))
            }
            Self::Limit(value, Overstep::Above(greatest)) => {
                write!(f, "{value} is above the maximum of {}", number(*greatest))
            }
            Self::OutOfReach(value) => write!(f, "{value} is out of reach of its type"),
        }
    }
}

impl std::error::Error for CommandError {}

/// A number for people: whole ones in full, others with up to nine significant digits.
fn number(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return format!("{value}");
    }
    significant(value, DIGITS)
}

fn significant(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    text.parse::<f64>().map_or(text, |rounded| rounded.to_string())
}

impl Device {
    /// The shown number of an element; a `bool` is 0 or 1.
    #[must_use]
    pub fn shown(&self, raw: Scalar) -> f64 {
        self.scale.shown(real(raw))
    }

    /// The side on which a value is outside of the design's limits.
    #[must_use]
    pub fn overstep(&self, value: &[Scalar]) -> Option<Overstep> {
        value.iter().find_map(|raw| self.limits(self.shown(*raw)))
    }

    fn limits(&self, shown: f64) -> Option<Overstep> {
        let below = self.min.filter(|least| shown < *least).map(Overstep::Below);
        below.or_else(|| self.max.filter(|most| shown > *most).map(Overstep::Above))
    }

    /// Raw and shown, as hosts print it: `1000 (37.9758523 cm)`, `[1, 2] ([0.1, 0.2] g)`.
    #[must_use]
    pub fn text(&self, value: &[Scalar]) -> String {
        let raw = self.list(value.iter().map(ToString::to_string));
        let is_bool = self.value.scalar == ScalarType::Bool;
        if is_bool || (self.scale.is_plain() && self.quantity.is_none()) {
            return raw;
        }
        format!("{raw} ({}{})", self.list(self.numbers(value)), self.unit())
    }

    /// What is shown, with its unit: `37.9758523 cm`.
    #[must_use]
    pub fn shown_text(&self, value: &[Scalar]) -> String {
        if self.value.scalar == ScalarType::Bool {
            return self.list(value.iter().map(ToString::to_string));
        }
        format!("{}{}", self.list(self.numbers(value)), self.unit())
    }

    /// What is shown, with as many digits as a code more or less would change, and its unit: `37.98 cm`.
    #[must_use]
    pub fn brief(&self, value: &[Scalar]) -> String {
        if self.value.scalar == ScalarType::Bool {
            return self.list(value.iter().map(ToString::to_string));
        }
        let is_real = matches!(self.value.scalar, ScalarType::Float32 | ScalarType::Float64);
        let all = value.iter().map(|raw| {
            let (shown, step) = (self.shown(*raw), self.scale.shown_step(real(*raw)));
            if is_real || !step.is_finite() {
                return significant(shown, BRIEF_DIGITS);
            }
            let mut scaled = step;
            let decimals = (0..DIGITS).find(|_| {
                let is_enough = scaled >= 0.999;
                scaled *= 10.0;
                is_enough
            });
            format!("{shown:.*}", decimals.unwrap_or(DIGITS))
        });
        format!("{}{}", self.list(all), self.unit())
    }

    fn numbers(&self, value: &[Scalar]) -> impl Iterator<Item = String> {
        value.iter().map(|raw| number(self.shown(*raw)))
    }

    /// The unit behind a number, with the space before it.
    fn unit(&self) -> String {
        self.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"))
    }

    fn list(&self, all: impl Iterator<Item = String>) -> String {
        let all: Vec<String> = all.collect();
        if self.value.length.is_none() { all.concat() } else { format!("[{}]", all.join(", ")) }
    }

    /// The codes of what somebody typed: values that are shown, with or without their unit, codes behind `raw`, or a text
    /// between quotes for a line of letters.
    ///
    /// # Errors
    /// Fails if a word is no value, if there are too few or too many, or if a value is outside of the limits.
    pub fn parse(&self, text: &str) -> Result<Vec<Scalar>, CommandError> {
        let quoted = text.trim().strip_prefix('"').and_then(|text| text.strip_suffix('"'));
        if let Some(text) = quoted.filter(|_| self.is_line()) {
            return self.letters(text);
        }
        let mut words: Vec<&str> = text.split([' ', '\t', ',', '[', ']']).collect();
        words.retain(|word| !word.is_empty());
        let is_raw = words.first().is_some_and(|word| word.eq_ignore_ascii_case("raw"));
        let mut factor = 1.0;
        if is_raw {
            words.remove(0);
        } else if let Some(unit) = words.last().filter(|_| words.len() > self.value.count()) {
            factor = self.factor(unit)?;
            words.pop();
        }
        if words.len() != self.value.count() {
            let (expected, found) = (self.value.count(), words.len());
            return Err(CommandError::Count { expected, found });
        }
        words.into_iter().map(|word| self.element(word, is_raw, factor)).collect()
    }

    /// Whether its elements may be the letters of a line.
    fn is_line(&self) -> bool {
        self.value.scalar == ScalarType::Uint8 && self.value.length.is_some()
    }

    /// The codes of letters, with zeros behind a short text.
    fn letters(&self, text: &str) -> Result<Vec<Scalar>, CommandError> {
        let (expected, found) = (self.value.count(), text.chars().count());
        if found > expected {
            return Err(CommandError::Count { expected, found });
        }
        let code = |letter: char| {
            let code = u8::try_from(letter).ok().filter(u8::is_ascii);
            code.map(|code| Scalar::Unsigned(code.into()))
                .ok_or_else(|| CommandError::Value(letter.to_string()))
        };
        let blanks = std::iter::repeat_n(Ok(Scalar::Unsigned(0)), expected - found);
        text.chars().map(code).chain(blanks).collect()
    }

    fn element(&self, word: &str, is_raw: bool, factor: f64) -> Result<Scalar, CommandError> {
        let wrong = || CommandError::Value(word.to_owned());
        let far = || CommandError::OutOfReach(word.to_owned());
        let code = if self.value.scalar == ScalarType::Bool {
            match word {
                "true" | "on" | "1" => 1.0,
                "false" | "off" | "0" => 0.0,
                _ => return Err(wrong()),
            }
        } else if is_raw {
            return self.code(word).ok_or_else(wrong).and_then(|code| self.checked(code, word));
        } else {
            let shown: f64 = word.parse().map_err(|_| wrong())?;
            if !shown.is_finite() {
                return Err(wrong());
            }
            let shown = shown * factor;
            if let Some(side) = self.limits(shown) {
                return Err(CommandError::Limit(format!("{}{}", number(shown), self.unit()), side));
            }
            self.scale.raw(shown)
        };
        nearest(self.value.scalar, code).ok_or_else(far)
    }

    /// A code that is written: decimal, or hexadecimal behind `0x`.
    fn code(&self, word: &str) -> Option<Scalar> {
        let scalar = self.value.scalar;
        if scalar == ScalarType::Float32 {
            return word.parse().ok().filter(|n: &f32| n.is_finite()).map(Scalar::Float32);
        }
        if scalar == ScalarType::Float64 {
            return word.parse().ok().filter(|n: &f64| n.is_finite()).map(Scalar::Float64);
        }
        let digits = word.strip_prefix("0x").or_else(|| word.strip_prefix("0X"));
        let whole = match digits {
            Some(digits) => i128::from_str_radix(digits, 16).ok()?,
            None => word.parse().ok()?,
        };
        of_integer(scalar, whole)
    }

    fn checked(&self, code: Scalar, word: &str) -> Result<Scalar, CommandError> {
        match self.limits(self.shown(code)) {
            Some(side) => Err(CommandError::Limit(format!("raw {word}"), side)),
            None => Ok(code),
        }
    }

    /// How many of the device's units one of another is: `ms` of `us` is 1000.
    ///
    /// # Errors
    /// Fails if the other unit is not one of the device's with another prefix.
    pub fn factor(&self, unit: &str) -> Result<f64, CommandError> {
        let quantity = self.quantity.clone();
        let found = quantity.as_deref().and_then(|own| {
            if own == unit {
                return Some(1.0);
            }
            let ways = |word: &str| -> Vec<(f64, String)> {
                let all = PREFIXES.iter().filter_map(|(prefix, size)| {
                    let base = word.strip_prefix(prefix)?;
                    (!base.is_empty()).then(|| (*size, base.to_owned()))
                });
                all.collect()
            };
            let others = ways(unit);
            ways(own).into_iter().find_map(|(own, base)| {
                let other = others.iter().find(|(_, other)| *other == base)?;
                Some(other.0 / own)
            })
        });
        found.ok_or_else(|| CommandError::Unit { unit: unit.to_owned(), quantity })
    }
}

/// The prefixes of units.
const PREFIXES: [(&str, f64); 6] =
    [("", 1.0), ("u", 1e-6), ("m", 1e-3), ("c", 1e-2), ("k", 1e3), ("M", 1e6)];

impl Board {
    /// The actuator whose name is so close that it was probably meant.
    fn meant(&self, name: &str) -> Option<String> {
        let distance = |one: &Device| {
            strsim::damerau_levenshtein(&one.name.to_lowercase(), &name.to_lowercase())
        };
        let actuators = self.devices.iter().filter(|one| one.direction == Direction::Actuator);
        let near = actuators.map(|one| (distance(one), &one.name)).min()?;
        (3 * near.0 <= name.chars().count()).then(|| near.1.clone())
    }

    /// The frame that sets an actuator to what somebody typed, and what has become of it.
    ///
    /// # Errors
    /// Fails if no actuator has that name, or if the text is no value of it.
    pub fn command(
        &self,
        name: &str,
        text: &str,
    ) -> Result<(Vec<u8>, usize, Vec<Scalar>), CommandError> {
        let found = self.devices.iter().position(|one| one.name == name);
        let of_any_case =
            || self.devices.iter().position(|one| one.name.eq_ignore_ascii_case(name));
        let Some(index) = found.or_else(of_any_case) else {
            return Err(CommandError::Name(name.to_owned(), self.meant(name)));
        };
        let Some(device) =
            self.devices.get(index).filter(|one| one.direction == Direction::Actuator)
        else {
            return Err(CommandError::Sensor(name.to_owned()));
        };
        if let Some(controller) = &device.obeys {
            return Err(CommandError::Owned(device.name.clone(), controller.clone()));
        }
        let value = device.parse(text)?;
        let values = [(device.id, value)];
        let frame = encode_report(&self.schema, Direction::Actuator, &values);
        let [(_, value)] = values;
        // The values were made for this very schema.
        let frame =
            frame.map_err(|error: EncodeError| CommandError::OutOfReach(error.to_string()))?;
        Ok((frame, index, value))
    }
}

fn real(raw: Scalar) -> f64 {
    match raw {
        Scalar::Bool(flag) => f64::from(u8::from(flag)),
        #[expect(clippy::cast_precision_loss, reason = "shown to fewer digits than a double has")]
        Scalar::Unsigned(number) => number as f64,
        #[expect(clippy::cast_precision_loss, reason = "shown to fewer digits than a double has")]
        Scalar::Signed(number) => number as f64,
        Scalar::Float32(number) => number.into(),
        Scalar::Float64(number) => number,
    }
}

fn of_integer(scalar: ScalarType, whole: i128) -> Option<Scalar> {
    let (least, greatest) = scalar.integer_range()?;
    if whole < least || whole > greatest {
        return None;
    }
    Some(if scalar == ScalarType::Bool {
        Scalar::Bool(whole == 1)
    } else if least < 0 {
        Scalar::Signed(i64::try_from(whole).ok()?)
    } else {
        Scalar::Unsigned(u64::try_from(whole).ok()?)
    })
}

/// The code of a type that is nearest to a number; none if it is beyond the type.
fn nearest(scalar: ScalarType, code: f64) -> Option<Scalar> {
    if !code.is_finite() {
        return None;
    }
    if scalar == ScalarType::Float64 {
        return Some(Scalar::Float64(code));
    }
    if scalar == ScalarType::Float32 {
        #[expect(clippy::cast_possible_truncation, reason = "within its range, and rounded")]
        return (code.abs() <= f32::MAX.into()).then_some(Scalar::Float32(code as f32));
    }
    #[expect(clippy::cast_possible_truncation, reason = "checked against the type's range next")]
    of_integer(scalar, code.round() as i128)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::Scale;
    use sensedsl_wire::ValueType;

    fn device(scalar: ScalarType, length: Option<u16>) -> Device {
        Device {
            name: "Winch".into(),
            id: 9,
            direction: Direction::Actuator,
            value: ValueType { scalar, length },
            kind: String::new(),
            quantity: Some("us".into()),
            scale: Scale::new(Some(0.5), Some(10.0), Vec::new()),
            min: Some(0.0),
            max: Some(3_000.0),
            cycle_ms: None,
            obeys: None,
        }
    }

    /// Numbers with a sign are no letters.
    fn pair_of_letters() -> Device {
        device(ScalarType::Int8, Some(2))
    }

    #[test]
    fn values_are_shown_and_typed() {
        let winch = device(ScalarType::Uint16, None);
        assert_eq!(winch.text(&[Scalar::Unsigned(1001)]), "1001 (510.5 us)");
        assert_eq!(winch.shown_text(&[Scalar::Unsigned(1001)]), "510.5 us");
        assert_eq!(winch.brief(&[Scalar::Unsigned(1001)]), "510.5 us");
        assert_eq!(number(1.0 / 3.0), "0.333333333");
        for (typed, code) in
            [("1500", 2980), ("1.5 ms", 2980), ("1500 us", 2980), ("raw 7", 7), ("raw 0x1F", 31)]
        {
            assert_eq!(winch.parse(typed), Ok(vec![Scalar::Unsigned(code)]), "{typed}");
        }
        let why = |typed: &str| winch.parse(typed).unwrap_err().to_string();
        assert_eq!(why("3001"), "3001 us is above the maximum of 3000");
        assert_eq!(why("-1"), "-1 us is below the minimum of 0");
        assert_eq!(why("raw 6000"), "raw 6000 is above the maximum of 3000");
        assert_eq!(why("raw 70000"), "`70000` is not a valid value");
        assert_eq!(why("1 V"), "`V` does not fit: it is shown in us");
        assert_eq!(why("fast"), "`fast` is not a valid value");
        assert_eq!(why("nan"), "`nan` is not a valid value");
        assert_eq!(why(""), "0 values for 1: write one for each element");
        assert_eq!(why("1 2 3"), "`3` does not fit: it is shown in us");
        assert_eq!(why("5"), "5 is out of reach of its type");
        let lamps = device(ScalarType::Bool, Some(3));
        let on = [true, false, true].map(Scalar::Bool);
        assert_eq!(lamps.parse("on 0 true"), Ok(on.to_vec()));
        assert_eq!(lamps.text(&on), "[true, false, true]");
        let line = device(ScalarType::Uint8, Some(4));
        let hey = [b'H', b'e', b'y', 0].map(|code| Scalar::Unsigned(code.into()));
        assert_eq!(line.parse(" \"Hey\""), Ok(hey.to_vec()));
        let why = |typed: &str| line.parse(typed).unwrap_err().to_string();
        assert_eq!(why("\"Hello\""), "5 values for 4: write one for each element");
        assert_eq!(why("\"\u{e9}\""), "`\u{e9}` is not a valid value");
        assert!(pair_of_letters().parse("\"ab\"").is_err());
        let pair = device(ScalarType::Int8, Some(2));
        assert_eq!(pair.parse("[30, 10] us"), Ok(vec![Scalar::Signed(40), Scalar::Signed(0)]));
    }
}
