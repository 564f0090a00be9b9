//! What an input capture has seen, and the values that a sensor makes of it.
//!
//! The capturing side only counts and copies; the reader does the arithmetic. Captures are counted
//! in timer ticks.

use crate::convert::{store_ratio, store_unsigned};
use crate::count::store_count;
use crate::scalar::Scalar;

/// How often an unchanged count is reported again.
const COUNT_REPEAT_MS: u32 = 1000;

/// What a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaptureMode {
    /// Edges since the start; wraps.
    Count,
    /// The width of the last pulse, in ticks.
    Width,
    /// The last period, in ticks.
    Period,
    /// The frequency of the last period, in Hz.
    Frequency,
    /// The active part of the last period, in units of 0.01 %.
    Duty,
}

/// The configuration of a capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureConfig {
    /// What the sensor measures.
    pub mode: CaptureMode,
    /// The clock of the timer.
    pub tick_hz: u32,
    /// The time without an edge after which frequency and duty are 0.
    pub silent_ms: u32,
}

/// The captures so far: written by the capturing side, copied by the reader.
#[derive(Clone, Copy, Debug, Default)]
pub struct Captured {
    edges: u32,
    widths: u32,
    periods: u32,
    width_ticks: u32,
    period_ticks: u32,
}

impl Captured {
    /// The state at the start.
    pub const NEW: Self = Self { edges: 0, widths: 0, periods: 0, width_ticks: 0, period_ticks: 0 };

    /// A pulse has ended. `both_edges`: its end counts as an edge, too. Must not be called if the
    /// timer wrapped during the pulse.
    pub fn on_width(&mut self, width_ticks: u32, both_edges: bool) {
        self.width_ticks = width_ticks;
        self.widths = self.widths.wrapping_add(1);
        if both_edges {
            self.edges = self.edges.wrapping_add(1);
        }
    }

    /// A period has ended.
    pub fn on_period(&mut self, period_ticks: u32) {
        self.edges = self.edges.wrapping_add(1);
        self.period_ticks = period_ticks;
        self.periods = self.periods.wrapping_add(1);
    }

    /// An edge was seen that is only counted.
    pub fn on_edge(&mut self) {
        self.edges = self.edges.wrapping_add(1);
    }
}

/// What the reader remembers from one read to the next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Capture {
    captures: u32,
    reported_ms: u32,
    has_reported: bool,
    is_silent: bool,
}

impl Capture {
    /// The state at the start.
    pub const NEW: Self =
        Self { captures: 0, reported_ms: 0, has_reported: false, is_silent: false };

    /// True if there is something new; then one element was stored. `first_edge_seen` makes up for
    /// an edge that a driver does not report: the one that starts the first period.
    pub fn read(
        &mut self,
        config: &CaptureConfig,
        raw: &Captured,
        first_edge_seen: bool,
        now_ms: u32,
        scalar: Scalar,
        element: &mut [u8],
    ) -> bool {
        let captures = match config.mode {
            CaptureMode::Count => {
                let edges = raw.edges.wrapping_add(u32::from(first_edge_seen));
                return self.read_count(edges, now_ms, scalar, element);
            }
            CaptureMode::Width => raw.widths,
            CaptureMode::Period | CaptureMode::Frequency | CaptureMode::Duty => raw.periods,
        };
        if captures == self.captures {
            return self.read_silence(config, now_ms, scalar, element);
        }
        self.captures = captures;
        self.reported_ms = now_ms;
        self.is_silent = false;
        let (width, period) = (u64::from(raw.width_ticks), u64::from(raw.period_ticks));
        match config.mode {
            CaptureMode::Width => store_unsigned(scalar, width, element),
            CaptureMode::Frequency => store_ratio(scalar, config.tick_hz.into(), period, element),
            CaptureMode::Duty => store_ratio(scalar, width * 10_000, period, element),
            CaptureMode::Count | CaptureMode::Period => store_unsigned(scalar, period, element),
        }
        true
    }

    /// An unchanged count is news as well: it is reported once at the start and repeated from time
    /// to time.
    fn read_count(&mut self, edges: u32, now_ms: u32, scalar: Scalar, element: &mut [u8]) -> bool {
        let is_recent = now_ms.wrapping_sub(self.reported_ms) < COUNT_REPEAT_MS;
        if self.has_reported && edges == self.captures && is_recent {
            return false;
        }
        self.has_reported = true;
        self.captures = edges;
        self.reported_ms = now_ms;
        store_count(scalar, edges.into(), element);
        true
    }

    /// A signal that has stopped has no frequency; its last width and period remain.
    fn read_silence(
        &mut self,
        config: &CaptureConfig,
        now_ms: u32,
        scalar: Scalar,
        element: &mut [u8],
    ) -> bool {
        let reports_silence = matches!(config.mode, CaptureMode::Frequency | CaptureMode::Duty);
        let is_short = now_ms.wrapping_sub(self.reported_ms) < config.silent_ms;
        if !reports_silence || self.is_silent || is_short {
            return false;
        }
        self.is_silent = true;
        store_unsigned(scalar, 0, element);
        true
    }
}
