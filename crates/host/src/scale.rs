//! Raw numbers to shown ones, and back: `curve(scale * raw + offset)`.

/// The conversion of a device's raw numbers to those that are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    factor: f64,
    offset: f64,
    curve: Vec<(f64, f64)>,
}

impl Default for Scale {
    fn default() -> Self {
        Self::new(None, None, Vec::new())
    }
}

impl Scale {
    /// A conversion; what is left out is 1, 0, and no curve. The points of the curve may have any order.
    #[must_use]
    pub fn new(factor: Option<f64>, offset: Option<f64>, mut curve: Vec<(f64, f64)>) -> Self {
        let factor = factor.filter(|factor| *factor != 0.0).unwrap_or(1.0);
        curve.sort_by(|one, other| one.0.total_cmp(&other.0));
        Self { factor, offset: offset.unwrap_or(0.0), curve }
    }

    /// Whether what is shown is the raw number itself.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// The number that is shown for a raw number.
    #[must_use]
    pub fn shown(&self, raw: f64) -> f64 {
        let linear = self.factor * raw + self.offset;
        interpolated(&self.curve, linear).unwrap_or(linear)
    }

    /// The raw number for a shown one, before rounding. Beyond the ends of a curve, it is the one for the nearer end.
    #[must_use]
    pub fn raw(&self, shown: f64) -> f64 {
        let linear = self.before_curve(shown);
        (linear - self.offset) / self.factor
    }

    /// Finds the place on the curve by bisection of the piece that has the value.
    fn before_curve(&self, shown: f64) -> f64 {
        let (Some(first), Some(last)) = (self.curve.first(), self.curve.last()) else {
            return shown;
        };
        let pieces = self.curve.windows(2).filter_map(|pair| match pair {
            [one, next] => Some((*one, *next)),
            _ => None,
        });
        for (one, next) in pieces {
            let (least, greatest) = (one.1.min(next.1), one.1.max(next.1));
            if shown >= least && shown <= greatest {
                return halved(one.0, next.0, |at| {
                    let value = interpolated(&[one, next], at).unwrap_or(at);
                    if next.1 >= one.1 { value < shown } else { value > shown }
                });
            }
        }
        if (shown - first.1).abs() <= (shown - last.1).abs() { first.0 } else { last.0 }
    }

    /// By how much the shown number changes if the raw one changes by one.
    #[must_use]
    pub fn shown_step(&self, raw: f64) -> f64 {
        let (above, below) = (self.shown(raw + 1.0), self.shown(raw - 1.0));
        (above - below).abs() / 2.0
    }
}

/// The least place between two ends from which on the condition no longer holds, to the precision of a double.
pub fn halved(mut from: f64, mut to: f64, is_before: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..64 {
        let middle = from + (to - from) / 2.0;
        if is_before(middle) {
            from = middle;
        } else {
            to = middle;
        }
    }
    to
}

fn interpolated(curve: &[(f64, f64)], at: f64) -> Option<f64> {
    let (first, last) = (curve.first()?, curve.last()?);
    if at <= first.0 {
        return Some(first.1);
    }
    let next = curve.partition_point(|point| point.0 <= at);
    let (Some(before), Some(after)) = (curve.get(next.checked_sub(1)?), curve.get(next)) else {
        return Some(last.1);
    };
    let width = after.0 - before.0;
    let share = if width == 0.0 { 0.0 } else { (at - before.0) / width };
    Some(before.1 + (after.1 - before.1) * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_there_and_back() {
        let plain = Scale::default();
        assert!(plain.is_plain() && plain.shown(7.0) == 7.0 && plain.raw(7.0) == 7.0);
        let linear = Scale::new(Some(0.5), Some(-10.0), Vec::new());
        assert_eq!(
            (linear.shown(100.0), linear.raw(40.0), linear.shown_step(3.0)),
            (40.0, 100.0, 0.5)
        );
        // Falling, as an infrared ranger's curve is; the first and the last value hold beyond.
        let curve = Scale::new(None, None, vec![(2.0, 10.0), (0.0, 30.0), (1.0, 20.0)]);
        assert_eq!((curve.shown(0.5), curve.shown(-1.0), curve.shown(9.0)), (25.0, 30.0, 10.0));
        assert!((curve.raw(25.0) - 0.5).abs() < 1e-9 && (curve.raw(5.0) - 2.0).abs() < 1e-9);
    }
}
