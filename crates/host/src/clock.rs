//! The clock of a board as its host knows it: when a report was put together, by the host's clock.
//!
//! In: stamps with the time of their arrival, questions and answers. Out: how old each report was when it came, and how
//! well that is known. The difference of arrival and stamp is the offset of the clocks, which drifts, plus the time on
//! the way, which is never negative. So the line that lies below all differences and touches two of them (their lower
//! convex hull, as synchronisation by one-way traces does it) is offset and drift, but for the shortest time on the
//! way. That is between none and the shortest round trip: half of it is added, and is the error.

use std::collections::VecDeque;
use std::time::Duration;

/// The span of which one difference is kept, the least.
const WINDOW: Duration = Duration::from_millis(500);
/// How many are kept: a minute.
const WINDOWS_MAX: usize = 120;
/// After that time the drift is told from chance.
const SETTLED_AFTER: Duration = Duration::from_secs(2);
/// A clock that is further off than this is none: the board was restarted meanwhile.
const DRIFT_MAX: f64 = 0.05;

/// A board's clock.
#[derive(Clone, Debug, Default)]
pub struct BoardClock {
    last: Option<u32>,
    /// Seconds of the board since the first stamp.
    board_s: f64,
    /// The least difference of each window: when by the board's clock, and arrival less stamp, in seconds.
    least: VecDeque<(f64, f64)>,
    window_began_s: f64,
    offset_s: f64,
    slope: f64,
    asked: Option<Duration>,
    trip: Option<Duration>,
}

/// How well the clock is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockError {
    /// No latency is further off than this.
    pub within: Duration,
    /// By how much the board's clock is fast, in parts per million, once that is known.
    pub drift_ppm: Option<f64>,
}

impl BoardClock {
    /// A question was sent that the board answers at once.
    pub fn asked(&mut self, at: Duration) {
        self.asked = Some(at);
    }

    /// The answer came.
    pub fn answered(&mut self, at: Duration) {
        let Some(asked) = self.asked.take() else { return };
        let trip = at.saturating_sub(asked);
        self.trip = Some(self.trip.map_or(trip, |least| least.min(trip)));
    }

    /// The board begins anew: its clock is another one.
    pub fn restart(&mut self) {
        let trip = self.trip;
        *self = Self { trip, ..Self::default() };
    }

    /// Takes the stamp of a report, in microseconds of the board, and the time of its arrival. Gives how long the
    /// report had been under way.
    pub fn stamped(&mut self, time_us: u32, arrival: Duration) -> Duration {
        let step_us = self.last.map_or(0, |last| time_us.wrapping_sub(last));
        // A stamp that goes back is of a board that was restarted: nothing waits for half an hour.
        if step_us > u32::MAX / 2 {
            self.restart();
        } else {
            self.board_s += f64::from(step_us) / 1e6;
        }
        self.last = Some(time_us);
        let difference_s = arrival.as_secs_f64() - self.board_s;
        if self.is_another(difference_s) {
            self.restart();
            self.last = Some(time_us);
        }
        self.keep(arrival.as_secs_f64() - self.board_s);
        let line_s = self.offset_s + self.slope * self.board_s;
        let past_s = (arrival.as_secs_f64() - self.board_s - line_s).max(0.0);
        Duration::from_secs_f64(past_s) + self.trip.unwrap_or_default() / 2
    }

    /// How well the latencies are known; none before a question was answered.
    #[must_use]
    pub fn error(&self) -> Option<ClockError> {
        let within = self.trip? / 2;
        let drift_ppm = self.is_settled().then_some(-self.slope / (1.0 + self.slope) * 1e6);
        Some(ClockError { within, drift_ppm })
    }

    fn is_settled(&self) -> bool {
        let (Some(first), Some(last)) = (self.least.front(), self.least.back()) else {
            return false;
        };
        last.0 - first.0 >= SETTLED_AFTER.as_secs_f64()
    }

    /// Whether a difference cannot be of the clock that is known: it is too far below it.
    fn is_another(&self, difference_s: f64) -> bool {
        let Some((at, least)) = self.least.back() else { return false };
        difference_s < least - 1.0 - (self.board_s - at) * DRIFT_MAX
    }

    fn keep(&mut self, difference_s: f64) {
        let point = (self.board_s, difference_s);
        let slope = self.slope;
        let above = |point: (f64, f64)| point.1 - slope * point.0;
        let is_same = self.board_s - self.window_began_s < WINDOW.as_secs_f64();
        match self.least.back_mut() {
            Some(least) if is_same => {
                if above(point) >= above(*least) {
                    return;
                }
                *least = point;
            }
            Some(_) | None => {
                self.window_began_s = self.board_s;
                self.least.push_back(point);
                if self.least.len() > WINDOWS_MAX {
                    self.least.pop_front();
                }
            }
        }
        self.fit();
    }

    /// The edge of the lower hull below the middle of all points.
    fn fit(&mut self) {
        let mut hull: Vec<(f64, f64)> = Vec::new();
        for point in &self.least {
            while let [.., before, last] = hull.as_slice() {
                let is_below = (last.1 - before.1) * (point.0 - last.0)
                    < (point.1 - last.1) * (last.0 - before.0);
                if is_below {
                    break;
                }
                hull.pop();
            }
            hull.push(*point);
        }
        let (Some(first), Some(last)) = (self.least.front(), self.least.back()) else { return };
        let middle = f64::midpoint(first.0, last.0);
        let edge = hull.windows(2).find_map(|pair| match pair {
            [one, next] if next.0 >= middle => Some((*one, *next)),
            _ => None,
        });
        match edge.filter(|_| self.is_settled()) {
            Some((one, next)) => {
                self.slope = ((next.1 - one.1) / (next.0 - one.0)).clamp(-DRIFT_MAX, DRIFT_MAX);
                self.offset_s = one.1 - self.slope * one.0;
            }
            None => {
                self.slope = 0.0;
                self.offset_s =
                    self.least.iter().map(|(_, least)| *least).fold(f64::INFINITY, f64::min);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arrivals of reports each 10 ms over a minute, with a clock that is fast by `ppm` and delays by a fixed rule.
    fn run(ppm: f64, wrap_at: u32) -> (BoardClock, Vec<(f64, f64)>) {
        let mut clock = BoardClock::default();
        clock.asked(Duration::from_secs(1));
        clock.answered(Duration::from_micros(1_001_000));
        let mut seed = 7_u64;
        let mut all = Vec::new();
        for report in 0..6_000_u32 {
            let true_s = 5.0 + f64::from(report) * 0.01;
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let delay_s = 0.000_4 + (seed >> 40) as f64 / (1 << 24) as f64 * 0.003;
            let board_us = (true_s * (1.0 + ppm / 1e6) * 1e6) as u64;
            let stamp = wrap_at.wrapping_add(board_us as u32);
            let found = clock.stamped(stamp, Duration::from_secs_f64(true_s + delay_s));
            all.push((delay_s, found.as_secs_f64()));
        }
        (clock, all)
    }

    #[test]
    fn latencies_are_within_the_error() {
        for (ppm, wrap_at) in [(0.0, 0), (80.0, u32::MAX - 20_000_000), (-10_000.0, 3)] {
            let (clock, all) = run(ppm, wrap_at);
            let error = clock.error().unwrap();
            assert!(error.within <= Duration::from_micros(501));
            let drift = error.drift_ppm.unwrap();
            assert!((drift - ppm).abs() < 20.0, "{ppm}: {drift}");
            // The first seconds know no drift.
            for (delay, found) in all.iter().skip(1_000) {
                assert!((delay - found).abs() < 0.000_7, "{ppm}: {delay} {found}");
            }
        }
    }

    #[test]
    fn a_restarted_board_has_another_clock() {
        let mut clock = BoardClock::default();
        for second in 0..30_u32 {
            let _ = clock.stamped(second * 1_000_000, Duration::from_secs(u64::from(second) + 100));
        }
        let after = clock.stamped(10_000, Duration::from_secs(140));
        assert_eq!(after, Duration::ZERO);
        let late = clock.stamped(1_010_000, Duration::from_millis(141_250));
        assert_eq!(late, Duration::from_millis(250));
    }
}
