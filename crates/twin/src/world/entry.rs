//! A world's description of one quantity: a number, or a table that tells how it moves.

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown, e0542_world_value,
    e0543_world_time as time,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_model::design::Device;
use sensedsl_model::given::{self, EnteredValue, EntryError};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::file::forwards;
use super::samples;
use super::signal::{Shape, Signal};
use crate::arith::{nanoseconds, signed_number};

/// The keys that tell how a quantity moves; each signal has exactly one.
const SHAPES: [&str; 7] = ["value", "ramp", "sine", "square", "rate", "steps", "csv"];
/// The other keys of a signal.
const BESIDE: [&str; 7] = ["over", "offset", "period", "start", "column", "noise", "hold"];

type Value<'i> = Spanned<DeValue<'i>>;
type Failed = Box<Diagnostic>;

/// A reader of one quantity.
pub(super) struct Entry<'a> {
    pub(super) file: FileId,
    pub(super) samples: &'a dyn Fn(&str) -> Result<String, String>,
    pub(super) device: &'a Device,
}

impl Entry<'_> {
    /// The signal of the quantity.
    pub(super) fn signal(&self, value: &Value<'_>) -> Result<Signal, Failed> {
        if let Some(shown) = self.shown(value)? {
            return Ok(Signal::of(Shape::Constant(shown)));
        }
        let span = self.span(value);
        let Some(table) = value.get_ref().as_table() else {
            let what = format!("what `{}` does", self.name());
            let example = "IRFront = { sine = 15, offset = 40, period = \"5 s\" }";
            return Err(unreadable::wrong_sort(
                span,
                &what,
                "a number, a text with a unit, or a table",
                example,
            )
            .into());
        };
        for key in table.keys() {
            let word = key.get_ref().as_ref();
            if !SHAPES.contains(&word) && !BESIDE.contains(&word) {
                let near = nearest(word, SHAPES.into_iter().chain(BESIDE));
                let (at, all) = (self.span(key), SHAPES.join(", "));
                return Err(unknown::unknown_word(at, word, "a quantity", near, &all).into());
            }
        }
        let found: Vec<&str> = SHAPES.into_iter().filter(|one| table.contains_key(*one)).collect();
        let [shape] = found.as_slice() else {
            let why = if found.is_empty() {
                format!("nothing says what it does; there are {}", SHAPES.join(", "))
            } else {
                format!("`{}` exclude each other", found.join("` and `"))
            };
            let example = format!("{} = {{ ramp = [0, 100], over = \"10 s\" }}", self.name());
            return Err(
                unreadable::unclear(span, &format!("`{}`", self.name()), &why, &example).into()
            );
        };
        let noise = self.optional(table, "noise", given::difference)?.unwrap_or(0.0);
        Ok(Signal { noise: noise.abs(), ..Signal::of(self.shape(shape, table, span)?) })
    }

    fn shape(&self, shape: &str, table: &DeTable<'_>, span: Span) -> Result<Shape, Failed> {
        let offset = self.optional(table, "offset", shown_of)?;
        let start = self.optional(table, "start", shown_of)?;
        Ok(match shape {
            "ramp" => {
                let [from, to] = self.pair(table, "ramp", "ramp = [0, 100]")?;
                Shape::Ramp {
                    from,
                    to,
                    over_ns: self.time(table, span, "over", "over = \"10 s\"")?,
                }
            }
            "sine" => Shape::Sine {
                amplitude: self.number(table, span, "sine", given::difference)?,
                offset: offset.unwrap_or(0.0),
                period_ns: self.period(table, span)?,
            },
            "square" => {
                let [first, second] = self.pair(table, "square", "square = [0, 1]")?;
                Shape::Square { first, second, period_ns: self.period(table, span)? }
            }
            "rate" => Shape::Rate {
                from: start.unwrap_or(0.0),
                a_second: self.number(table, span, "rate", given::a_second)?,
            },
            "steps" => self.steps(table, span)?,
            "csv" => self.samples(table, span)?,
            _ => Shape::Constant(self.number(table, span, "value", shown_of)?),
        })
    }

    fn steps(&self, table: &DeTable<'_>, span: Span) -> Result<Shape, Failed> {
        let example = "steps = [[\"0 s\", 5], [\"2 s\", 10]]";
        let list = table.get("steps");
        let at = list.map_or(span, |list| self.span(list));
        let wrong = || unreadable::wrong_sort(at, "`steps`", "a list of times and values", example);
        let list = list.and_then(|list| list.get_ref().as_array()).ok_or_else(wrong)?;
        let mut points = Vec::new();
        for one in list {
            let mut pair = one.get_ref().as_array().ok_or_else(wrong)?.iter();
            let (Some(when), Some(what), None) = (pair.next(), pair.next(), pair.next()) else {
                return Err(wrong().into());
            };
            let value = self.shown(what)?.ok_or_else(wrong)?;
            points.push((duration(self.file, when)?, value));
            forwards(self.span(one), points.iter().rev().take(2).rev().map(|point| point.0))?;
        }
        if points.is_empty() {
            return Err(wrong().into());
        }
        Ok(Shape::Points { points, is_straight: false })
    }

    fn samples(&self, table: &DeTable<'_>, span: Span) -> Result<Shape, Failed> {
        let word = |key: &str| table.get(key).and_then(|one| one.get_ref().as_str());
        let file = word("csv").ok_or_else(|| {
            unreadable::wrong_sort(span, "`csv`", "the name of a file", "csv = \"drive.csv\"")
        })?;
        let is_held = table.get("hold").and_then(|one| one.get_ref().as_bool()).unwrap_or(false);
        let at = table.get("csv").map_or(span, |one| self.span(one));
        let column = word("column").unwrap_or(self.name());
        let points = samples::read(self.samples, file, column, at)?;
        forwards(at, points.iter().map(|point| point.0))?;
        Ok(Shape::Points { points, is_straight: !is_held })
    }

    fn period(&self, table: &DeTable<'_>, span: Span) -> Result<u64, Failed> {
        self.time(table, span, "period", "period = \"5 s\"")
    }

    /// A time above 0.
    fn time(
        &self,
        table: &DeTable<'_>,
        span: Span,
        key: &str,
        example: &str,
    ) -> Result<u64, Failed> {
        let what = format!("`{}`", self.name());
        let Some(value) = table.get(key) else {
            return Err(unreadable::missing(span, &what, key, example).into());
        };
        match duration(self.file, value)? {
            0 => Err(time::not_a_time(self.span(value), "0").into()),
            time => Ok(time),
        }
    }

    fn optional(&self, table: &DeTable<'_>, key: &str, read: Read) -> Result<Option<f64>, Failed> {
        let Some(value) = table.get(key) else { return Ok(None) };
        self.read(value, read)?.map(Some).ok_or_else(|| {
            let example = format!("{key} = 2.5");
            unreadable::wrong_sort(self.span(value), &format!("`{key}`"), NUMBER, &example).into()
        })
    }

    fn number(
        &self,
        table: &DeTable<'_>,
        span: Span,
        key: &str,
        read: Read,
    ) -> Result<f64, Failed> {
        let example = format!("{key} = 20");
        let missing =
            || unreadable::missing(span, &format!("`{}`", self.name()), key, &example).into();
        self.optional(table, key, read)?.ok_or_else(missing)
    }

    fn pair(&self, table: &DeTable<'_>, key: &str, example: &str) -> Result<[f64; 2], Failed> {
        let value = table.get(key);
        let list = value.and_then(|value| value.get_ref().as_array()).map(|list| &**list);
        if let Some([from, to]) = list
            && let (Some(from), Some(to)) = (self.shown(from)?, self.shown(to)?)
        {
            return Ok([from, to]);
        }
        let span = value.map_or(Span::new(self.file, 0..0), |value| self.span(value));
        let wanted = "two numbers, from and to";
        Err(unreadable::wrong_sort(span, &format!("`{key}`"), wanted, example).into())
    }

    /// A value as the device shows it; `None` if it is not of that sort.
    fn shown(&self, value: &Value<'_>) -> Result<Option<f64>, Failed> {
        self.read(value, shown_of)
    }

    fn read(&self, value: &Value<'_>, read: Read) -> Result<Option<f64>, Failed> {
        let Some(text) = value.get_ref().as_str() else { return Ok(number(value.get_ref())) };
        match read(text, self.device) {
            Ok(number) => Ok(Some(number)),
            Err(EntryError::NoNumber) => Ok(None),
            Err(EntryError::ValueMismatch(why, help)) => {
                let span = self.span(value);
                Err(e0542_world_value::does_not_fit(span, self.name(), &why, &help).into())
            }
        }
    }

    fn name(&self) -> &str {
        &self.device.name.value
    }

    fn span<T>(&self, of: &Spanned<T>) -> Span {
        Span::new(self.file, of.span())
    }
}

/// The function that reads a text.
type Read = fn(&str, &Device) -> Result<f64, EntryError>;

/// The kind of value expected for a quantity.
const NUMBER: &str = "a number, or a text with a unit";

/// A value as the device shows it.
fn shown_of(text: &str, device: &Device) -> Result<f64, EntryError> {
    Ok(match given::value(text, device)? {
        EnteredValue::Shown(shown) => shown,
        EnteredValue::Code(code) => device.shown.of_raw(code),
    })
}

/// A number, or a truth value as 0 or 1.
pub(super) fn number(value: &DeValue<'_>) -> Option<f64> {
    if let Some(flag) = value.as_bool() {
        return Some(f64::from(u8::from(flag)));
    }
    if let Some(integer) = value.as_integer() {
        return i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(signed_number);
    }
    value.as_float()?.as_str().parse().ok().filter(|number: &f64| number.is_finite())
}

/// A time: `"20 ms"`, or a number of seconds.
pub(super) fn duration(file: FileId, value: &Value<'_>) -> Result<u64, Failed> {
    let span = Span::new(file, value.span());
    if let Some(text) = value.get_ref().as_str() {
        return parsed(text).ok_or_else(|| time::not_a_time(span, text).into());
    }
    let seconds = number(value.get_ref()).filter(|seconds| *seconds >= 0.0);
    seconds
        .map(|seconds| nanoseconds(seconds * 1e9))
        .ok_or_else(|| time::not_a_time(span, "this").into())
}

/// Parses a time such as `1.5 s`.
fn parsed(text: &str) -> Option<u64> {
    let text = text.trim();
    let unit = text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.' || c == '_');
    let digits = text.strip_suffix(unit)?.replace('_', "");
    let number: f64 = digits.parse().ok()?;
    let each = match unit.trim() {
        "ns" => 1.0,
        "us" | "µs" => 1e3,
        "ms" => 1e6,
        "s" => 1e9,
        "min" => 60e9,
        "h" => 3_600e9,
        _ => return None,
    };
    Some(nanoseconds(number * each))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        assert_eq!(parsed("1.5 s"), Some(1_500_000_000));
        assert_eq!(parsed("20ms"), Some(20_000_000));
        assert_eq!(parsed("300 us"), Some(300_000));
        for wrong in ["", "s", "1", "-1 s", "1 m", "1,5 s", "1e3 s", "1.2.3 s"] {
            assert_eq!(parsed(wrong), None, "{wrong}");
        }
    }
}
