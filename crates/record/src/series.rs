//! The course of a number over a run, in a fixed amount of memory: the least and the greatest of each span of time.
//!
//! When a run has become too long for the spans, two become one. So a plot shows every peak, however short.

use std::time::Duration;

/// The most spans.
const SPANS_MAX: usize = 1_200;
/// The first spans are that long.
const SPAN_MIN: Duration = Duration::from_millis(1);

/// A number over time.
#[derive(Clone, Debug)]
pub struct Series {
    span: Duration,
    /// The least and the greatest of each span; none where nothing came.
    spans: Vec<Option<(f64, f64)>>,
    count: u64,
    mean: f64,
}

impl Default for Series {
    fn default() -> Self {
        Self { span: SPAN_MIN, spans: Vec::new(), count: 0, mean: 0.0 }
    }
}

impl Series {
    /// Adds a number; what is none is left out.
    pub fn add(&mut self, at: Duration, number: f64) {
        if !number.is_finite() {
            return;
        }
        let mut place = self.place(at);
        while place >= SPANS_MAX {
            self.widen();
            place = self.place(at);
        }
        if self.spans.len() <= place {
            self.spans.resize(place + 1, None);
        }
        if let Some(span) = self.spans.get_mut(place) {
            *span = joined(*span, Some((number, number)));
        }
        self.count += 1;
        self.mean += (number - self.mean) / self.count as f64;
    }

    fn place(&self, at: Duration) -> usize {
        usize::try_from(at.as_nanos() / self.span.as_nanos()).unwrap_or(usize::MAX)
    }

    fn widen(&mut self) {
        let pairs =
            self.spans.chunks(2).map(|pair| pair.iter().fold(None, |all, one| joined(all, *one)));
        self.spans = pairs.collect();
        self.span *= 2;
    }

    /// How long a span is.
    #[must_use]
    pub fn span(&self) -> Duration {
        self.span
    }

    /// The least and the greatest of each span, from the begin of the run on.
    #[must_use]
    pub fn spans(&self) -> &[Option<(f64, f64)>] {
        &self.spans
    }

    /// Least, mean and greatest of all; none if there are none.
    #[must_use]
    pub fn numbers(&self) -> [Option<f64>; 3] {
        let all = self.spans.iter().fold(None, |all, one| joined(all, *one));
        let mean = (self.count > 0).then_some(self.mean);
        [all.map(|all| all.0), mean, all.map(|all| all.1)]
    }
}

fn joined(one: Option<(f64, f64)>, other: Option<(f64, f64)>) -> Option<(f64, f64)> {
    match (one, other) {
        (Some(one), Some(other)) => Some((one.0.min(other.0), one.1.max(other.1))),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_peak_stays() {
        let mut series = Series::default();
        for step in 0..100_000_u64 {
            let number = if step == 77_777 { 9.0 } else { (step % 10) as f64 / 10.0 };
            series.add(Duration::from_millis(step), number);
        }
        let [least, mean, most] = series.numbers().map(Option::unwrap);
        assert!((least, most) == (0.0, 9.0) && (mean - 0.450_083).abs() < 1e-5, "{mean}");
        assert!(series.spans().len() <= SPANS_MAX && series.spans().iter().all(Option::is_some));
        let place = (77_777 / series.span().as_millis()) as usize;
        assert_eq!(series.spans()[place].unwrap().1, 9.0);
        series.add(Duration::from_secs(1_000), f64::NAN);
        assert_eq!(series.numbers()[2], Some(9.0));
    }
}
