//! What leaves a board for strips of LEDs and displays: bytes and levels in; what is lit, kept with the other outputs,
//! out.

use sensedsl_job::JobConnection;
use sensedsl_model::design::ConnectionIndex;

use super::Bench;
use crate::parts::lamps::{Shown, Strip};
use crate::parts::screen::Screen;
use crate::world::FaultKind;

/// Rows of a display whose driver does not tell.
const ROWS: usize = 64;
/// Drivers of displays with other ones.
const ROWS_OF: [(&str, usize); 1] = [("ssd1306_128x32", 32)];

impl Bench {
    /// Puts the strip of a connection on its unit; whether it has one.
    pub(super) fn light(&mut self, one: &JobConnection<'_>, unit: u8) -> bool {
        let strip = Strip::of(one);
        let is_strip = strip.is_some();
        self.shows.strips.extend(strip.map(|strip| (unit, (one.index, strip))));
        is_strip
    }

    /// Puts a display on a bus, if the connection has one.
    pub(super) fn display(&mut self, one: &JobConnection<'_>, is_text: bool) {
        if is_text {
            let driver = one.part.driver.as_deref();
            let own = ROWS_OF.iter().find(|(name, _)| Some(*name) == driver);
            let rows = own.map_or(ROWS, |(_, rows)| *rows);
            self.shows.screens.insert(one.index, Screen::new(rows));
        }
    }

    /// The strips and displays have lost their supply.
    pub(super) fn darken(&mut self) {
        self.shows.strips.values_mut().for_each(|(_, strip)| strip.reset());
        self.shows.screens.values_mut().for_each(Screen::reset);
    }

    /// A byte for a strip with a clock; whether the unit has one.
    pub(super) fn clocked(&mut self, unit: u8, byte: u8, now_ns: u64) -> bool {
        let Some((at, shown)) =
            self.shows.strips.get_mut(&unit).map(|(at, one)| (*at, one.clocked(byte)))
        else {
            return false;
        };
        self.shown(at, shown, now_ns);
        true
    }

    /// Eight levels for a strip on one wire.
    pub(crate) fn levels_out(&mut self, unit: u8, byte: u8, from_ps: u64, bit_ps: u64) {
        let Some((at, strip)) = self.shows.strips.get_mut(&unit) else { return };
        let (at, shown) = (*at, strip.levels(byte, from_ps, bit_ps));
        self.shown(at, shown, (from_ps + 8 * bit_ps) / 1_000);
    }

    fn shown(&mut self, at: ConnectionIndex, shown: Option<Shown>, now_ns: u64) {
        let part = self.wires.get(&at).map(|wired| wired.part);
        if part.is_some_and(|part| self.has(FaultKind::Torn, part, now_ns)) {
            return;
        }
        if let Some(shown) = shown {
            self.recorder.shown(at, shown, now_ns);
        }
    }

    /// A transfer to a display begins.
    pub(super) fn page_begins(&mut self, at: ConnectionIndex) {
        if let Some(screen) = self.shows.screens.get_mut(&at) {
            screen.start();
        }
    }

    pub(super) fn page_goes_on(&mut self, at: ConnectionIndex, byte: u8) {
        if let Some(screen) = self.shows.screens.get_mut(&at) {
            screen.write(byte);
        }
    }

    pub(super) fn page_ends(&mut self, at: ConnectionIndex, now_ns: u64) {
        let lines = self.shows.screens.get_mut(&at).map(Screen::stop).unwrap_or_default();
        for line in lines {
            self.recorder.shown(at, line, now_ns);
        }
    }
}
