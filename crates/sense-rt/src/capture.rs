//! What an input capture saw, and what a sensor makes of it.
//!
//! The side that captures only counts and copies; the arithmetic is the reader's. Captures are
//! counted in ticks of the timer.

use crate::convert::{store_ratio, store_unsigned};
use crate::count::store_count;
use crate::scalar::Scalar;

/// How often an unchanged count is told again.
const COUNT_REPEAT_MS: u32 = 1000;

/// What a sensor wants to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaptureMode {
    /// Edges since the start; wraps.
    Count,
    /// The last pulse, in ticks.
    Width,
    /// The last period, in ticks.
    Period,
    /// Of the last period, in Hz.
    Frequency,
    /// The active part of the last period, in ten-thousandths.
    Duty,
}

/// What is wanted of a capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureConfig {
    /// What a sensor wants to know.
    pub mode: CaptureMode,
    /// Of the timer.
    pub tick_hz: u32,
    /// After this time without an edge, frequency and duty are 0.
    pub silent_ms: u32,
}

/// What was captured so far: written by the side that captures, copied by the reader.
#[derive(Clone, Copy, Debug, Default)]
pub struct Captured {
    edges: u32,
    widths: u32,
    periods: u32,
    width_ticks: u32,
    period_ticks: u32,
}

impl Captured {
    /// At the start.
    pub const NEW: Self = Self { edges: 0, widths: 0, periods: 0, width_ticks: 0, period_ticks: 0 };

    /// A pulse has ended. `both_edges`: its end is counted as well. Not to be called where the timer
    /// wrapped meanwhile.
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

    /// An edge that is only counted.
    pub fn on_edge(&mut self) {
        self.edges = self.edges.wrapping_add(1);
    }
}

/// What the reader remembers between two looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Capture {
    captures: u32,
    told_ms: u32,
    has_told: bool,
    is_silent: bool,
}

impl Capture {
    /// At the start.
    pub const NEW: Self = Self { captures: 0, told_ms: 0, has_told: false, is_silent: false };

    /// True when there is something new, and then one element was stored. `first_edge_seen` repairs
    /// what a driver keeps to itself: the edge that starts the first period.
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
        self.told_ms = now_ms;
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

    /// Standing still is a fact as well: it is told once at the start and then now and again.
    fn read_count(&mut self, edges: u32, now_ms: u32, scalar: Scalar, element: &mut [u8]) -> bool {
        let is_recent = now_ms.wrapping_sub(self.told_ms) < COUNT_REPEAT_MS;
        if self.has_told && edges == self.captures && is_recent {
            return false;
        }
        self.has_told = true;
        self.captures = edges;
        self.told_ms = now_ms;
        store_count(scalar, edges.into(), element);
        true
    }

    /// A signal that has stopped has no frequency; its last width and period stay what they were.
    fn read_silence(
        &mut self,
        config: &CaptureConfig,
        now_ms: u32,
        scalar: Scalar,
        element: &mut [u8],
    ) -> bool {
        let tells_silence = matches!(config.mode, CaptureMode::Frequency | CaptureMode::Duty);
        let is_short = now_ms.wrapping_sub(self.told_ms) < config.silent_ms;
        if !tells_silence || self.is_silent || is_short {
            return false;
        }
        self.is_silent = true;
        store_unsigned(scalar, 0, element);
        true
    }
}
