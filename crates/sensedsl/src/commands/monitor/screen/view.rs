//! What of the histories is in the plots: how much time, until when, and where the cursor is.
//!
//! In: keys, as what they mean. Out: the first and the last moment that is seen.

use std::time::Duration;

use super::history::SPAN_US;

/// What can be seen at once, in seconds.
const SPANS_S: [u64; 10] = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600];
/// How often axes are halved at most.
const MAGNIFIED_MAX: u8 = 16;
/// The usual one, ten seconds.
const USUAL: usize = 3;
/// One press of a key scrolls by a quarter of what is seen; the cursor goes by a hundredth, or by a tenth.
const SCROLL: u32 = 4;
const FINE: u32 = 100;
const COARSE: u32 = 10;

/// How the values' axes are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// By what is seen.
    Auto,
    /// By the limits in the design, where there are any.
    Limits,
    /// As they were.
    Held,
}

/// What is seen.
#[derive(Debug)]
pub(super) struct View {
    zoom: usize,
    /// The last moment that is seen; none if that is now.
    frozen: Option<Duration>,
    pub(super) cursor: Option<Duration>,
    pub(super) axis: Axis,
    /// How often the values' axes were halved.
    pub(super) magnified: u8,
}

impl View {
    pub(super) fn new() -> Self {
        Self { zoom: USUAL, frozen: None, cursor: None, axis: Axis::Auto, magnified: 0 }
    }

    pub(super) fn span(&self) -> Duration {
        Duration::from_secs(SPANS_S.get(self.zoom).copied().unwrap_or(10))
    }

    pub(super) fn is_frozen(&self) -> bool {
        self.frozen.is_some()
    }

    pub(super) fn end(&self, now: Duration) -> Duration {
        self.frozen.unwrap_or(now)
    }

    /// Less time with more detail, or more time.
    pub(super) fn zoom(&mut self, is_in: bool) {
        let before = self.span();
        self.zoom = if is_in {
            self.zoom.saturating_sub(1)
        } else {
            (self.zoom + 1).min(SPANS_S.len() - 1)
        };
        // What the cursor is on stays where it is.
        if let (Some(cursor), Some(frozen)) = (self.cursor, self.frozen) {
            let behind = frozen.saturating_sub(cursor).as_secs_f64() / before.as_secs_f64();
            self.frozen = Some(cursor + self.span().mul_f64(behind));
        }
    }

    /// Holds the picture, or lets it go on.
    pub(super) fn freeze(&mut self, now: Duration) {
        self.frozen = if self.is_frozen() { None } else { Some(now) };
        if !self.is_frozen() {
            self.cursor = None;
        }
    }

    /// The last moment that can be the end, so that what is oldest is seen.
    fn oldest(&self, now: Duration) -> Duration {
        let oldest = now.saturating_sub(Duration::from_micros(SPAN_US)) + self.span();
        oldest.min(now)
    }

    fn end_at(&mut self, end: Duration, now: Duration) {
        self.frozen = (end < now).then(|| end.max(self.oldest(now)));
    }

    /// To earlier times or to later ones; with a cursor, that goes.
    pub(super) fn step(&mut self, is_back: bool, is_far: bool, now: Duration) {
        let moved = |from: Duration, by: Duration| {
            if is_back { from.saturating_sub(by) } else { (from + by).min(now) }
        };
        let span = self.span();
        let Some(cursor) = self.cursor else {
            let end = self.end(now);
            let by = if is_far { span } else { span / SCROLL };
            return self.end_at(moved(end, by), now);
        };
        let cursor = moved(cursor, span / if is_far { COARSE } else { FINE });
        let cursor = cursor.max(now.saturating_sub(Duration::from_micros(SPAN_US)));
        self.cursor = Some(cursor);
        // It takes the picture along.
        let end = self.end(now).min(cursor + span).max(cursor);
        self.frozen = Some(end);
    }

    pub(super) fn go_oldest(&mut self, now: Duration) {
        self.end_at(self.oldest(now), now);
        self.cursor = self.cursor.map(|_| self.end(now).saturating_sub(self.span()));
    }

    /// To what comes now.
    pub(super) fn go_live(&mut self) {
        (self.frozen, self.cursor) = (None, None);
    }

    /// Shows the cursor in a picture that is held, or takes it away.
    pub(super) fn toggle_cursor(&mut self, now: Duration) {
        if self.cursor.is_some() {
            self.cursor = None;
        } else {
            let end = self.end(now);
            (self.frozen, self.cursor) = (Some(end), Some(end.saturating_sub(self.span() / 2)));
        }
    }

    /// A part of the values with more detail, or more of them.
    pub(super) fn magnify(&mut self, is_in: bool) {
        let by = if is_in { self.magnified + 1 } else { self.magnified.saturating_sub(1) };
        self.magnified = by.min(MAGNIFIED_MAX);
    }

    pub(super) fn next_axis(&mut self) {
        self.magnified = 0;
        self.axis = match self.axis {
            Axis::Auto => Axis::Limits,
            Axis::Limits => Axis::Held,
            Axis::Held => Axis::Auto,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn s(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    #[test]
    fn it_zooms_scrolls_and_comes_back() {
        let mut view = View::new();
        assert_eq!((view.span(), view.end(s(100)), view.is_frozen()), (s(10), s(100), false));
        (0..20).for_each(|_| view.zoom(true));
        assert_eq!(view.span(), s(1));
        (0..20).for_each(|_| view.zoom(false));
        assert_eq!(view.span(), s(600));
        (0..6).for_each(|_| view.zoom(true));
        view.step(true, true, s(1_000));
        assert_eq!((view.end(s(1_001)), view.is_frozen()), (s(990), true));
        view.go_oldest(s(1_000));
        assert_eq!(view.end(s(1_000)), s(410));
        view.step(true, false, s(1_000));
        assert_eq!(view.end(s(1_000)), s(410));
        (0..400).for_each(|_| view.step(false, false, s(1_000)));
        assert!(!view.is_frozen());
        view.freeze(s(1_000));
        assert_eq!(view.end(s(1_020)), s(1_000));
        view.freeze(s(1_020));
        assert_eq!(view.end(s(1_030)), s(1_030));
    }

    #[test]
    fn the_cursor_takes_the_picture_along() {
        let mut view = View::new();
        view.toggle_cursor(s(100));
        assert_eq!((view.cursor, view.end(s(200))), (Some(s(95)), s(100)));
        view.step(true, true, s(200));
        assert_eq!(view.cursor, Some(s(94)));
        (0..5).for_each(|_| view.step(true, true, s(200)));
        assert_eq!((view.cursor, view.end(s(200))), (Some(s(89)), s(99)));
        view.zoom(true);
        assert_eq!((view.span(), view.end(s(200))), (s(5), s(94)));
        view.go_live();
        assert_eq!((view.cursor, view.end(s(200))), (None, s(200)));
    }
}
