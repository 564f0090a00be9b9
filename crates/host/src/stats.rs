//! How regularly the values of a device come, and how late: what a table and a summary say of them.
//!
//! In: each value's arrival, its latency, and the board's stamp where there is one. Out: rate, jitter, latency, values
//! that are missing. It takes as much memory after a day as after a second.

use std::time::Duration;

/// Buckets of each power of two: what is read from them is within 6 %.
const STEPS: u64 = 8;
/// Buckets of a histogram; the last one takes all above two days.
const BUCKETS: usize = 40 * STEPS as usize;
/// The seconds over which the current rate is counted.
const RATE_OVER: usize = 5;

/// Durations, counted by size.
#[derive(Clone, Debug)]
pub struct Histogram {
    counts: Vec<u64>,
    count: u64,
    sum_us: f64,
    squares: f64,
    least: Duration,
    most: Duration,
}

impl Default for Histogram {
    fn default() -> Self {
        let (least, most) = (Duration::MAX, Duration::ZERO);
        Self { counts: vec![0; BUCKETS], count: 0, sum_us: 0.0, squares: 0.0, least, most }
    }
}

impl Histogram {
    /// Counts one.
    pub fn add(&mut self, one: Duration) {
        if let Some(count) = self.counts.get_mut(bucket(one)) {
            *count += 1;
        }
        let us = one.as_secs_f64() * 1e6;
        self.count += 1;
        self.sum_us += us;
        self.squares += us * us;
        self.least = self.least.min(one);
        self.most = self.most.max(one);
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The duration that a share of all does not exceed, within 6 %; none if there are none.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Option<Duration> {
        let wanted = (share * self.count as f64).ceil().max(1.0) as u64;
        let mut seen = 0;
        let at = self.counts.iter().position(|count| {
            seen += count;
            seen >= wanted
        })?;
        Some(middle(at).clamp(self.least, self.most))
    }

    /// The mean; none if there are none.
    #[must_use]
    pub fn mean(&self) -> Option<Duration> {
        let mean_us = self.sum_us / self.count as f64;
        (self.count > 0).then(|| Duration::from_secs_f64(mean_us / 1e6))
    }

    /// The standard deviation; none if there are fewer than two.
    #[must_use]
    pub fn deviation(&self) -> Option<Duration> {
        let count = self.count as f64;
        let variance = (self.squares - self.sum_us * self.sum_us / count) / (count - 1.0);
        (self.count > 1).then(|| Duration::from_secs_f64(variance.max(0.0).sqrt() / 1e6))
    }

    /// The longest; none if there are none.
    #[must_use]
    pub fn most(&self) -> Option<Duration> {
        (self.count > 0).then_some(self.most)
    }
}

/// Whole microseconds up to `STEPS`, then `STEPS` buckets a power of two.
fn bucket(one: Duration) -> usize {
    let us = u64::try_from(one.as_micros()).unwrap_or(u64::MAX);
    if us < STEPS {
        return us as usize;
    }
    let power = u64::from(us.ilog2());
    let shift = power - u64::from(STEPS.ilog2());
    let place = (shift + 1) * STEPS + ((us >> shift) - STEPS);
    usize::try_from(place).map_or(BUCKETS - 1, |place| place.min(BUCKETS - 1))
}

/// The middle of a bucket.
fn middle(at: usize) -> Duration {
    let at = at as u64;
    if at < STEPS {
        return Duration::from_micros(at);
    }
    let shift = at / STEPS - 1;
    let from = (at % STEPS + STEPS) << shift;
    Duration::from_nanos(from * 1_000 + ((1_000 << shift) >> 1))
}

/// What is known of a device's values.
#[derive(Clone, Debug, Default)]
pub struct DeviceStats {
    count: u64,
    missing: u64,
    first: Option<Duration>,
    last: Option<Duration>,
    last_stamp_us: Option<u32>,
    intervals: Histogram,
    latencies: Histogram,
    seconds: [(u64, u32); RATE_OVER],
}

impl DeviceStats {
    /// Takes a value: when it arrived, how old it was then, and the stamp of its report in microseconds of the board,
    /// where these are known. A device with a cycle tells by the interval how many values are missing before it.
    pub fn add(
        &mut self,
        at: Duration,
        latency: Option<Duration>,
        stamp_us: Option<u32>,
        cycle: Option<Duration>,
    ) {
        let by_stamp = self.last_stamp_us.zip(stamp_us).map(|(last, now)| now.wrapping_sub(last));
        // A stamp that goes back is of a board that was restarted.
        let by_stamp = by_stamp.filter(|step_us| *step_us <= u32::MAX / 2);
        let by_stamp = by_stamp.map(|step_us| Duration::from_micros(step_us.into()));
        let interval = match stamp_us {
            Some(_) => by_stamp,
            None => self.last.map(|last| at.saturating_sub(last)),
        };
        if let Some(interval) = interval {
            self.intervals.add(interval);
            if let Some(cycle) = cycle.filter(|cycle| !cycle.is_zero()) {
                let cycles = (interval.as_secs_f64() / cycle.as_secs_f64()).round();
                self.missing += (cycles as u64).saturating_sub(1);
            }
        }
        if let Some(latency) = latency {
            self.latencies.add(latency);
        }
        let second = at.as_secs();
        let place = usize::try_from(second % RATE_OVER as u64).unwrap_or_default();
        if let Some(place) = self.seconds.get_mut(place) {
            if place.0 != second {
                *place = (second, 0);
            }
            place.1 += 1;
        }
        self.count += 1;
        self.first.get_or_insert(at);
        (self.last, self.last_stamp_us) = (Some(at), stamp_us);
    }

    /// The link was away: the time between is no interval.
    pub fn interrupt(&mut self) {
        (self.last, self.last_stamp_us) = (None, None);
    }

    /// How many values came.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// How many did not come, by the device's cycle.
    #[must_use]
    pub fn missing(&self) -> u64 {
        self.missing
    }

    /// When the first and the last one came.
    #[must_use]
    pub fn span(&self) -> Option<(Duration, Duration)> {
        self.first.zip(self.last)
    }

    /// From one value to the next: by the board's clock where reports are stamped, otherwise by arrival.
    #[must_use]
    pub fn intervals(&self) -> &Histogram {
        &self.intervals
    }

    /// From the report's being put together to its arrival.
    #[must_use]
    pub fn latencies(&self) -> &Histogram {
        &self.latencies
    }

    /// Values a second over the last whole seconds; none before the first one is over.
    #[must_use]
    pub fn rate_hz(&self, now: Duration) -> Option<f64> {
        let (current, first) = (now.as_secs(), self.first?.as_secs());
        let from = current.saturating_sub(RATE_OVER as u64 - 1).max(first + 1);
        let whole = current.checked_sub(from).filter(|whole| *whole > 0)?;
        let all = self.seconds.iter().filter(|(second, _)| (from..current).contains(second));
        let count: u32 = all.map(|(_, count)| count).sum();
        Some(f64::from(count) / whole as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_near_the_exact_ones() {
        let mut histogram = Histogram::default();
        let mut all: Vec<u64> = (0..5_000_u64).map(|n| n * n % 99_991 + n % 7).collect();
        for us in &all {
            histogram.add(Duration::from_micros(*us));
        }
        all.sort_unstable();
        for share in [0.01, 0.5, 0.95, 0.999, 1.0] {
            let exact = all[((share * 5_000.0) as usize).min(4_999).saturating_sub(1)] as f64;
            let found = histogram.quantile(share).unwrap().as_secs_f64() * 1e6;
            assert!((found - exact).abs() <= exact * 0.07 + 1.0, "{share}: {found} {exact}");
        }
        assert_eq!(histogram.most(), Some(Duration::from_micros(*all.last().unwrap())));
        assert_eq!(bucket(Duration::MAX), BUCKETS - 1);
        assert_eq!(Histogram::default().quantile(0.5), None);
    }

    #[test]
    fn values_that_are_missing_are_counted() {
        let mut stats = DeviceStats::default();
        let cycle = Some(Duration::from_millis(10));
        for report in (0..300_u64).filter(|report| report % 50 != 7) {
            let at = Duration::from_millis(report * 10);
            stats.add(at, Some(Duration::from_millis(1)), Some(at.as_micros() as u32), cycle);
        }
        assert_eq!((stats.count(), stats.missing()), (294, 6));
        assert_eq!(stats.rate_hz(Duration::from_millis(2_990)), Some(98.0));
        // A second that the link was away is no gap of the device.
        stats.interrupt();
        stats.add(Duration::from_secs(5), None, Some(40), cycle);
        assert_eq!((stats.missing(), stats.latencies().count()), (6, 294));
    }
}
