//! How a host shows a value: the raw value in, the shown one out, and back.

use sensedsl_diagnostics::Span;

/// How a host shows a value: `scale * raw + offset`, in `quantity`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Presentation {
    /// A text for people.
    pub label: Option<String>,
    /// The name of the unit (`cm`, `V`).
    pub quantity: Option<String>,
    /// The factor; none for 1.
    pub scale: Option<f64>,
    /// The offset added after scaling; none for 0.
    pub offset: Option<f64>,
    /// The least value to expect, scaled.
    pub min: Option<f64>,
    /// The greatest value to expect, scaled.
    pub max: Option<f64>,
    /// Where `min` and `max` are stated.
    pub bounds: [Option<Span>; 2],
    /// Points between which `scale * raw + offset` is interpolated; empty for no curve.
    pub curve: Vec<(f64, f64)>,
    /// A bare number given as a shown value, if its code is a different number.
    pub bare: Option<Bare>,
}

/// A number without a unit, given for a device whose shown value is not the code.
#[derive(Clone, Debug, PartialEq)]
pub struct Bare {
    /// Its place.
    pub span: Span,
    /// The number.
    pub number: f64,
    /// The code that it stands for now.
    pub code: f64,
    /// The number with its unit, if the language has that unit.
    pub with_unit: Option<String>,
}

impl Presentation {
    /// Whether the shown value is the code.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let is_one = self.scale.is_none_or(|scale| scale.to_bits() == 1.0_f64.to_bits());
        let is_zero = self.offset.is_none_or(|offset| offset == 0.0);
        is_one && is_zero && self.curve.is_empty()
    }

    /// The raw value, with a fraction, that is shown like this; none if there is none.
    #[must_use]
    pub fn raw_of(&self, shown: f64) -> Option<f64> {
        let pairs = self.curve.iter().zip(self.curve.iter().skip(1));
        let on_curve = |(from, to): (&(f64, f64), &(f64, f64))| {
            let (low, high) = (from.1.min(to.1), from.1.max(to.1));
            let rise = to.1 - from.1;
            let is_here = shown >= low && shown <= high;
            let part = if rise == 0.0 { 0.0 } else { (shown - from.1) / rise };
            is_here.then_some(from.0 + (to.0 - from.0) * part)
        };
        let x =
            if self.curve.is_empty() { Some(shown) } else { pairs.into_iter().find_map(on_curve) };
        let scale = self.scale.unwrap_or(1.0);
        let raw = (x? - self.offset.unwrap_or(0.0)) / scale;
        raw.is_finite().then_some(raw)
    }

    /// The value that a host shows for a raw value.
    #[must_use]
    pub fn of_raw(&self, raw: f64) -> f64 {
        let x = self.scale.unwrap_or(1.0) * raw + self.offset.unwrap_or(0.0);
        let (Some(first), Some(last)) = (self.curve.first(), self.curve.last()) else { return x };
        let pairs = self.curve.iter().zip(self.curve.iter().skip(1));
        for (from, to) in pairs {
            if x >= from.0 && x <= to.0 {
                return from.1 + (to.1 - from.1) * (x - from.0) / (to.0 - from.0);
            }
        }
        if x < first.0 { first.1 } else { last.1 }
    }
}
