//! Raw values, shown values, and how one becomes the other.

use core::fmt::{self, Write as _};

/// The significant digits of a printed number that is not whole.
const DIGITS: usize = 9;

/// How a raw number becomes the shown one: `scale * raw + offset`, and through the points of `curve` where there are
/// some, linear between two of them, the first and the last one held beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaling {
    /// The factor.
    pub scale: f64,
    /// What is added.
    pub offset: f64,
    /// The points, by their first numbers.
    pub curve: &'static [(f64, f64)],
}

impl Scaling {
    /// The raw number itself.
    pub const PLAIN: Self = Self { scale: 1.0, offset: 0.0, curve: &[] };

    /// The shown number of a raw one.
    #[must_use]
    pub fn shown(&self, raw: f64) -> f64 {
        let x = self.scale * raw + self.offset;
        let (Some(first), Some(last)) = (self.curve.first(), self.curve.last()) else { return x };
        if x <= first.0 {
            return first.1;
        }
        for (one, next) in self.curve.iter().zip(self.curve.iter().skip(1)) {
            if x < next.0 {
                return one.1 + (x - one.0) * (next.1 - one.1) / (next.0 - one.0);
            }
        }
        if x.is_nan() { x } else { last.1 }
    }

    /// The raw number that is shown so, before rounding; none if no raw number is.
    #[must_use]
    pub fn raw(&self, shown: f64) -> Option<f64> {
        let x = if self.curve.is_empty() {
            shown
        } else {
            let mut pieces = self.curve.iter().zip(self.curve.iter().skip(1));
            pieces.find_map(|(one, next)| {
                let is_within = one.1.min(next.1) <= shown && shown <= one.1.max(next.1);
                let share = if one.1 == next.1 { 0.0 } else { (shown - one.1) / (next.1 - one.1) };
                is_within.then_some(one.0 + share * (next.0 - one.0))
            })?
        };
        let raw = (x - self.offset) / self.scale;
        raw.is_finite().then_some(raw)
    }
}

/// What the design says of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The identifier on the wire.
    pub id: u8,
    /// The name in the design.
    pub name: &'static str,
    /// Whether its value travels from the board to the host.
    pub is_sensor: bool,
    /// From raw numbers to shown ones; none where the raw number is shown as it is.
    pub scaling: Option<Scaling>,
    /// The unit of what is shown.
    pub unit: Option<&'static str>,
    /// The least shown number.
    pub min: Option<f64>,
    /// The greatest shown number.
    pub max: Option<f64>,
    /// From one value to the next; none for values that come when something happens.
    pub cycle_ms: Option<u32>,
}

/// The limit of the design that a value is beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Overstep {
    /// Less than the least.
    Below(f64),
    /// More than the greatest.
    Above(f64),
}

impl Facts {
    fn overstep(&self, shown: f64) -> Option<Overstep> {
        let below = self.min.filter(|least| shown < *least).map(Overstep::Below);
        below.or_else(|| self.max.filter(|most| shown > *most).map(Overstep::Above))
    }

    fn shown(&self, raw: f64) -> f64 {
        self.scaling.map_or(raw, |scaling| scaling.shown(raw))
    }
}

/// Why a value does not become a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refused {
    /// The device.
    pub device: &'static str,
    /// The shown value, of the first element that does not fit.
    pub value: f64,
    /// The limit that it is beyond; none if no code of the type is shown so.
    pub overstep: Option<Overstep>,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is ", self.device, Number(self.value))?;
        match self.overstep {
            Some(Overstep::Below(least)) => write!(f, "below the minimum of {}", Number(least)),
            Some(Overstep::Above(most)) => write!(f, "above the maximum of {}", Number(most)),
            None => f.write_str("out of reach of its type"),
        }
    }
}

impl core::error::Error for Refused {}

/// A type that travels: a scalar, or an array of scalars.
pub trait Raw: Copy + fmt::Debug + PartialEq + Send + 'static {
    /// Its bytes on the wire.
    const BYTES: usize;
    /// The type of what is shown, where that is not the raw value itself.
    type Shown: Copy;
    /// Reads it from that many bytes.
    fn read(bytes: &[u8]) -> Option<Self>;
    /// Writes it to that many bytes.
    fn write(self, bytes: &mut [u8]);
    /// What is shown.
    fn shown(self, facts: &Facts) -> Self::Shown;
    /// The code of what is shown.
    ///
    /// # Errors
    /// Fails if a shown value is beyond a limit of the design or of the type.
    fn of_shown(shown: Self::Shown, facts: &Facts) -> Result<Self, Refused>;
    /// The first element that is beyond a limit.
    fn beyond(self, facts: &Facts) -> Option<(f64, Overstep)>;
    /// Prints the elements, as they are or as they are shown.
    ///
    /// # Errors
    /// Fails if the formatter does.
    fn print(self, f: &mut fmt::Formatter<'_>, shown: Option<&Facts>) -> fmt::Result;
}

macro_rules! scalars {
    ($($type:ident: $code:expr;)+) => {$(
        impl Raw for $type {
            const BYTES: usize = size_of::<Self>();
            type Shown = f64;

            #[inline]
            fn read(bytes: &[u8]) -> Option<Self> {
                Some(Self::from_be_bytes(bytes.try_into().ok()?))
            }

            #[inline]
            fn write(self, bytes: &mut [u8]) {
                if let Some(place) = bytes.first_chunk_mut() {
                    *place = self.to_be_bytes();
                }
            }

            fn shown(self, facts: &Facts) -> f64 {
                facts.shown(self as f64)
            }

            fn of_shown(shown: f64, facts: &Facts) -> Result<Self, Refused> {
                let overstep = facts.overstep(shown);
                let raw = facts.scaling.unwrap_or(Scaling::PLAIN).raw(shown);
                let code: fn(f64) -> Option<Self> = $code;
                let refused = Refused { device: facts.name, value: shown, overstep };
                if overstep.is_some() { None } else { raw.and_then(code) }.ok_or(refused)
            }

            fn beyond(self, facts: &Facts) -> Option<(f64, Overstep)> {
                let shown = facts.shown(self as f64);
                facts.overstep(shown).map(|overstep| (shown, overstep))
            }

            fn print(self, f: &mut fmt::Formatter<'_>, shown: Option<&Facts>) -> fmt::Result {
                match shown {
                    Some(facts) => write!(f, "{}", Number(facts.shown(self as f64))),
                    None => write!(f, "{self}"),
                }
            }
        }
    )+};
}

macro_rules! whole {
    ($type:ident) => {
        |raw| {
            // A cast drops the fraction; what is half way goes away from zero.
            let whole = raw as i128;
            let rest = raw - whole as f64;
            let up = i128::from(rest >= 0.5) - i128::from(rest <= -0.5);
            $type::try_from(whole.checked_add(up)?).ok()
        }
    };
}

scalars! {
    u8: whole!(u8);
    i8: whole!(i8);
    u16: whole!(u16);
    i16: whole!(i16);
    u32: whole!(u32);
    i32: whole!(i32);
    u64: whole!(u64);
    i64: whole!(i64);
    f32: |raw| (raw.abs() <= f64::from(f32::MAX)).then_some(raw as f32);
    f64: Some;
}

impl Raw for bool {
    const BYTES: usize = 1;
    type Shown = bool;

    #[inline]
    fn read(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0] => Some(false),
            [1] => Some(true),
            _ => None,
        }
    }

    fn write(self, bytes: &mut [u8]) {
        if let Some(place) = bytes.first_mut() {
            *place = self.into();
        }
    }

    fn shown(self, _: &Facts) -> bool {
        self
    }

    fn of_shown(shown: bool, _: &Facts) -> Result<Self, Refused> {
        Ok(shown)
    }

    fn beyond(self, _: &Facts) -> Option<(f64, Overstep)> {
        None
    }

    fn print(self, f: &mut fmt::Formatter<'_>, _: Option<&Facts>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl<T: Raw, const COUNT: usize> Raw for [T; COUNT] {
    const BYTES: usize = T::BYTES * COUNT;
    type Shown = [T::Shown; COUNT];

    #[inline]
    fn read(bytes: &[u8]) -> Option<Self> {
        let mut all = [T::read(bytes.get(..T::BYTES)?)?; COUNT];
        for (element, bytes) in all.iter_mut().zip(bytes.chunks_exact(T::BYTES)) {
            *element = T::read(bytes)?;
        }
        (bytes.len() == Self::BYTES).then_some(all)
    }

    fn write(self, bytes: &mut [u8]) {
        for (element, bytes) in self.into_iter().zip(bytes.chunks_exact_mut(T::BYTES)) {
            element.write(bytes);
        }
    }

    fn shown(self, facts: &Facts) -> Self::Shown {
        self.map(|element| element.shown(facts))
    }

    fn of_shown(shown: Self::Shown, facts: &Facts) -> Result<Self, Refused> {
        let mut wrong = None;
        let codes = shown.map(|element| match T::of_shown(element, facts) {
            Ok(code) => Some(code),
            Err(refused) => {
                wrong = wrong.or(Some(refused));
                None
            }
        });
        let refused = wrong.unwrap_or(Refused { device: facts.name, value: 0.0, overstep: None });
        let first = codes.iter().flatten().next().copied().ok_or(refused)?;
        if wrong.is_some() { Err(refused) } else { Ok(codes.map(|code| code.unwrap_or(first))) }
    }

    fn beyond(self, facts: &Facts) -> Option<(f64, Overstep)> {
        self.into_iter().find_map(|element| element.beyond(facts))
    }

    fn print(self, f: &mut fmt::Formatter<'_>, shown: Option<&Facts>) -> fmt::Result {
        for (index, element) in self.into_iter().enumerate() {
            f.write_str(if index == 0 { "[" } else { ", " })?;
            element.print(f, shown)?;
        }
        f.write_char(']')
    }
}

/// A number for people: whole ones in full, others with up to nine digits.
pub(super) struct Number(pub(super) f64);

/// Text of at most so many bytes.
struct Short {
    bytes: [u8; 32],
    length: usize,
}

impl fmt::Write for Short {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let end = self.length + text.len();
        self.bytes.get_mut(self.length..end).ok_or(fmt::Error)?.copy_from_slice(text.as_bytes());
        self.length = end;
        Ok(())
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = *self;
        if number.abs() < 1e15 && (number as i64) as f64 == number {
            return write!(f, "{}", number as i64);
        }
        let mut short = Short { bytes: [0; 32], length: 0 };
        write!(short, "{number:.*e}", DIGITS - 1)?;
        let text = short.bytes.get(..short.length).and_then(|bytes| core::str::from_utf8(bytes).ok());
        match text.and_then(|text| text.parse::<f64>().ok()) {
            Some(rounded) => write!(f, "{rounded}"),
            None => write!(f, "{number}"),
        }
    }
}
