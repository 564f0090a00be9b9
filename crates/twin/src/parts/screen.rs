//! A display with an SSD1306 on I2C: bytes of a transfer in, what people can read on its lines out.
//!
//! The commands are those of Solomon Systech's data sheet SSD1306, rev 1.1. What was in its memory before the board has
//! spoken is dots without a meaning, and a panel that was not told its height, or is dark, shows nothing.

use std::collections::BTreeSet;

use super::letters::{COLUMNS, Letters, NONE};

const WIDTH: usize = 128;
const PAGES: usize = 8;
const PAGE_ROWS: usize = 8;
/// What the memory holds before anything is written.
const NOISE: u8 = 0xA5;

/// A display.
#[derive(Clone, Debug)]
pub(crate) struct Screen {
    rows: usize,
    letters: Letters,
    memory: Vec<u8>,
    page: usize,
    column: usize,
    /// Whether it goes on in the next page.
    is_running_on: bool,
    columns: (usize, usize),
    pages: (usize, usize),
    settings: Settings,
    /// What the next bytes of the transfer are.
    next: Next,
    /// A command that waits for its other bytes.
    command: Vec<u8>,
    touched: BTreeSet<usize>,
    wrong: Option<String>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Settings {
    is_on: bool,
    has_pump: bool,
    is_turned: bool,
    is_upside_up: bool,
    is_lit: bool,
    is_inverted: bool,
    rows: usize,
    com_pins: u8,
    shift: u8,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Next {
    Control,
    /// One byte, or all that follow.
    Command(bool),
    Data(bool),
}

/// What a line shows.
pub(crate) type Line = Result<Vec<u8>, String>;

impl Screen {
    pub(crate) fn new(rows: usize) -> Self {
        Self {
            rows,
            letters: Letters::drawn(),
            memory: vec![NOISE; WIDTH * PAGES],
            page: 0,
            column: 0,
            is_running_on: false,
            columns: (0, WIDTH - 1),
            pages: (0, PAGES - 1),
            settings: Settings { rows: 64, com_pins: 0x12, ..Settings::default() },
            next: Next::Control,
            command: Vec::new(),
            touched: BTreeSet::new(),
            wrong: None,
        }
    }

    /// It has lost its supply.
    pub(crate) fn reset(&mut self) {
        *self = Self::new(self.rows);
    }

    /// A transfer begins.
    pub(crate) fn start(&mut self) {
        self.next = Next::Control;
        self.command.clear();
        self.touched.clear();
    }

    pub(crate) fn write(&mut self, byte: u8) {
        match self.next {
            Next::Control => {
                let is_one = byte & 0x80 != 0;
                if byte & 0x3F != 0 {
                    self.complain(format!("0x{byte:02X} in place of a control byte"));
                }
                self.next =
                    if byte & 0x40 == 0 { Next::Command(is_one) } else { Next::Data(is_one) };
                return;
            }
            Next::Command(_) => self.instruct(byte),
            Next::Data(_) => self.put(byte),
        }
        if matches!(self.next, Next::Command(true) | Next::Data(true)) {
            self.next = Next::Control;
        }
    }

    /// The transfer is over: each line that it has changed, its number first.
    pub(crate) fn stop(&mut self) -> Vec<Line> {
        let touched = std::mem::take(&mut self.touched);
        if let Some(wrong) = self.wrong.take() {
            return vec![Err(wrong)];
        }
        // While it is set up it is dark.
        if touched.is_empty() || !self.settings.is_on {
            return Vec::new();
        }
        if let Some(why) = self.unreadable() {
            return vec![Err(why)];
        }
        let strange = (0..self.rows / PAGE_ROWS).find(|page| self.line(*page).contains(&NONE));
        if let Some(page) = strange {
            return vec![Err(format!("dots on line {page} that are no letters"))];
        }
        let shown = |page: usize| {
            let number = u8::try_from(page).unwrap_or(u8::MAX);
            Ok([vec![number], self.line(page)].concat())
        };
        touched.into_iter().filter(|page| *page < self.rows / PAGE_ROWS).map(shown).collect()
    }

    /// Why nobody can read it.
    fn unreadable(&self) -> Option<String> {
        let Settings { has_pump, rows, com_pins, shift, .. } = self.settings;
        let right_pins = if self.rows == 64 { 0x12 } else { 0x02 };
        if !has_pump {
            Some("a panel without its charge pump, which is dark".to_owned())
        } else if rows != self.rows || com_pins != right_pins || shift != 0 {
            let own = self.rows;
            Some(format!(
                "{rows} rows, pins 0x{com_pins:02X}, shifted by {shift}, on a panel of {own} rows"
            ))
        } else if !self.settings.is_turned || !self.settings.is_upside_up {
            Some("a picture that stands on its head or is mirrored".to_owned())
        } else if self.settings.is_lit || self.settings.is_inverted {
            Some("a panel that is lit as a whole or inverted".to_owned())
        } else {
            None
        }
    }

    fn line(&self, page: usize) -> Vec<u8> {
        let columns = self.memory.chunks(WIDTH).nth(page).unwrap_or_default();
        columns.chunks_exact(COLUMNS).map(|letter| self.letters.read(letter)).collect()
    }

    fn complain(&mut self, what: String) {
        self.wrong.get_or_insert(what);
    }

    fn put(&mut self, byte: u8) {
        if let Some(place) = self.memory.get_mut(self.page * WIDTH + self.column) {
            *place = byte;
        }
        self.touched.insert(self.page);
        let last = if self.is_running_on { self.columns.1 } else { WIDTH - 1 };
        if self.column < last {
            self.column += 1;
            return;
        }
        self.column = if self.is_running_on { self.columns.0 } else { 0 };
        if self.is_running_on {
            self.page = if self.page < self.pages.1 { self.page + 1 } else { self.pages.0 };
        }
    }

    fn instruct(&mut self, byte: u8) {
        self.command.push(byte);
        let needed = match self.command.first() {
            Some(0x20 | 0x81 | 0x8D | 0xA8 | 0xD3 | 0xD5 | 0xD9 | 0xDA | 0xDB) => 2,
            Some(0x21 | 0x22) => 3,
            _ => 1,
        };
        if self.command.len() == needed {
            let command = std::mem::take(&mut self.command);
            self.obey(&command);
        }
    }

    fn obey(&mut self, command: &[u8]) {
        let settings = &mut self.settings;
        match *command {
            [low @ 0x00..=0x0F] => self.column = self.column & 0x70 | usize::from(low),
            [high @ 0x10..=0x17] => self.column = self.column & 0x0F | usize::from(high & 7) << 4,
            [page @ 0xB0..=0xB7] => self.page = usize::from(page & 7),
            [0x20, mode @ (0 | 2)] => self.is_running_on = mode == 0,
            [0x21, first, last] if first <= last && last < 128 => {
                self.columns = (first.into(), last.into());
                self.column = first.into();
            }
            [0x22, first, last] if first <= last && last < 8 => {
                self.pages = (first.into(), last.into());
                self.page = first.into();
            }
            [0x8D, pump] => settings.has_pump = pump == 0x14,
            [0xA0 | 0xA1] => settings.is_turned = command == [0xA1],
            [0xC0 | 0xC8] => settings.is_upside_up = command == [0xC8],
            [0xA4 | 0xA5] => settings.is_lit = command == [0xA5],
            [0xA6 | 0xA7] => settings.is_inverted = command == [0xA7],
            [0xA8, rows @ 15..=63] => settings.rows = usize::from(rows) + 1,
            [0xAE | 0xAF] => settings.is_on = command == [0xAF],
            [0xD3, shift @ 0..=63] => settings.shift = shift,
            [line @ 0x40..=0x7F] => settings.shift = line & 0x3F,
            [0xDA, pins @ (0x02 | 0x12 | 0x22 | 0x32)] => settings.com_pins = pins,
            [0x81 | 0xD5 | 0xD9 | 0xDB, _] | [0xE3 | 0x2E] => {}
            _ => self.complain(format!("{command:02X?}, which no command of an SSD1306 is")),
        }
    }
}
