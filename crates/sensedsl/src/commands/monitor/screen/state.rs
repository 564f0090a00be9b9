//! What the screen knows: which device is chosen, what is plotted, what is being written.
//!
//! In: keys and pasted texts. Out: what is asked for, and the state that `draw.rs` shows. Nothing here reads a terminal.

use std::collections::BTreeMap;
use std::time::Duration;

use sensedsl_host::{Board, Device, News, What};
use sensedsl_wire::{Direction, Scalar};

use super::super::face::Ask;
use super::keys::{Key, Pressed};
use super::notes::Notes;
use super::prompt::{Check, Prompt};
use super::slider::{Slide, slid};
use super::table::Column;
use super::traces::Traces;
use super::view::View;

/// The most devices that are plotted at once.
const PLOTTED_MAX: usize = 12;

/// A device of a board.
pub(super) struct Item<'a> {
    pub(super) board: usize,
    pub(super) index: usize,
    pub(super) device: &'a Device,
    /// With its board where there are several.
    pub(super) name: String,
}

/// What keys mean at present.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Table,
    Prompt,
    Filter,
    Notes,
    Help,
}

/// What the screen knows.
pub(super) struct State<'a> {
    pub(super) boards: Vec<&'a Board>,
    pub(super) items: Vec<Item<'a>>,
    /// The items whose names have the filter.
    pub(super) shown: Vec<usize>,
    pub(super) filter: String,
    /// The place of the chosen one in `shown`.
    pub(super) chosen: usize,
    /// The first one that is seen.
    pub(super) top: usize,
    /// How many are seen at once.
    pub(super) page: usize,
    pub(super) plotted: Vec<usize>,
    /// Whether plots have the whole window.
    pub(super) is_large: bool,
    pub(super) mode: Mode,
    pub(super) view: View,
    pub(super) prompt: Prompt,
    pub(super) notes: Notes,
    pub(super) traces: Traces,
    /// The axis of each unit, as it was drawn last.
    pub(super) ranges: BTreeMap<String, (f64, f64)>,
    /// The widest cells of the table so far, so that it does not tremble.
    pub(super) widths: BTreeMap<Column, usize>,
    /// What the last key came to, where that is not seen otherwise.
    pub(super) told: Option<String>,
    /// The moment that is shown.
    pub(super) now: Duration,
    /// The first line of the help that is seen.
    pub(super) help_top: usize,
    /// How each board is.
    conditions: Vec<Condition>,
    /// The last value of each actuator.
    last: Vec<Option<Vec<Scalar>>>,
    /// The least and the greatest number of each item since the start.
    extremes: Vec<Option<(f64, f64)>>,
}

/// How a board is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Condition {
    /// It has not said who it is.
    Asking,
    /// It is there.
    Online,
    /// It is not, and why.
    Offline(String),
}

impl<'a> State<'a> {
    pub(super) fn new(boards: Vec<&'a Board>) -> Self {
        let mut items = Vec::new();
        for (place, board) in boards.iter().enumerate() {
            for (index, device) in board.devices.iter().enumerate() {
                let own = &device.name;
                let name =
                    if boards.len() > 1 { format!("{}/{own}", board.name) } else { own.clone() };
                items.push(Item { board: place, index, device, name });
            }
        }
        Self {
            traces: Traces::new(&boards),
            conditions: vec![Condition::Asking; boards.len()],
            boards,
            shown: (0..items.len()).collect(),
            filter: String::new(),
            chosen: 0,
            top: 0,
            page: 1,
            plotted: Vec::new(),
            is_large: false,
            mode: Mode::Table,
            view: View::new(),
            prompt: Prompt::default(),
            notes: Notes::default(),
            ranges: BTreeMap::new(),
            widths: BTreeMap::new(),
            told: None,
            now: Duration::ZERO,
            help_top: 0,
            last: vec![None; items.len()],
            extremes: vec![None; items.len()],
            items,
        }
    }

    /// Takes what happened.
    pub(super) fn hear(&mut self, news: &News<'_>) {
        let (board, at) = (news.board, news.at.run);
        self.now = self.now.max(at);
        match news.what {
            What::Online => self.change(board, Condition::Online),
            What::Offline(why) => self.change(board, Condition::Offline(why.to_owned())),
            What::Report(report) => {
                // A recording may have no hello.
                self.change(board, Condition::Online);
                for (device, value) in &report.values {
                    self.take(board, *device, at, value);
                }
            }
            What::Command { device, value } => self.take(board, device, at, value),
            What::Received(_) | What::Sent(_) | What::Health(_) => {}
        }
    }

    /// Takes a value of a device.
    fn take(&mut self, board: usize, index: usize, at: Duration, value: &[Scalar]) {
        let before: usize = self.boards.iter().take(board).map(|board| board.devices.len()).sum();
        let Some(item) = self.items.get(before + index) else { return };
        if let Some(extremes) = self.extremes.get_mut(before + index) {
            for raw in value {
                let shown = item.device.shown(*raw);
                let (least, most) = extremes.unwrap_or((shown, shown));
                // What is no number is neither less nor more.
                *extremes = Some((least.min(shown), most.max(shown)));
            }
        }
        self.traces.add(board, index, item.device, at, value);
        if item.device.direction == Direction::Actuator
            && let Some(last) = self.last.get_mut(before + index)
        {
            *last = Some(value.to_vec());
        }
    }

    fn change(&mut self, board: usize, condition: Condition) {
        if let Some(place) = self.conditions.get_mut(board) {
            *place = condition;
        }
    }

    /// How a board is.
    pub(super) fn condition(&self, board: usize) -> &Condition {
        self.conditions.get(board).unwrap_or(&Condition::Asking)
    }

    /// Whether values of a board are those of now.
    pub(super) fn is_there(&self, board: usize) -> bool {
        *self.condition(board) == Condition::Online
    }

    /// What an actuator was set to last.
    pub(super) fn last(&self, item: usize) -> Option<&[Scalar]> {
        self.last.get(item).and_then(Option::as_deref)
    }

    /// The least and the greatest number of an item since the start.
    pub(super) fn extremes(&self, item: usize) -> Option<(f64, f64)> {
        self.extremes.get(item).copied().flatten()
    }

    /// Moves the rows that are seen, of which there are so many at once, to the chosen one.
    pub(super) fn scroll(&mut self, page: usize) {
        self.page = page.max(1);
        self.chosen = self.chosen.min(self.shown.len().saturating_sub(1));
        let last = self.shown.len().saturating_sub(self.page);
        let first = (self.chosen + 1).saturating_sub(self.page);
        self.top = self.top.clamp(first, self.chosen.max(first)).min(last);
    }

    /// The item that is chosen; none if none is shown.
    pub(super) fn item(&self) -> Option<&Item<'a>> {
        self.shown.get(self.chosen).and_then(|item| self.items.get(*item))
    }

    fn actuator(&self) -> Option<(usize, &Item<'a>)> {
        let index = *self.shown.get(self.chosen)?;
        let item = self.items.get(index)?;
        (item.device.direction == Direction::Actuator).then_some((index, item))
    }

    /// Takes what came of the terminal.
    pub(super) fn press(&mut self, pressed: &Pressed) -> Option<Ask> {
        self.told = None;
        let now = self.now;
        match pressed {
            Pressed::Key(Key::Named("ctrl-c")) => Some(Ask::Quit),
            Pressed::Key(key) => match self.mode {
                Mode::Table => self.in_table(*key, now),
                Mode::Prompt => self.in_prompt(*key),
                Mode::Filter => self.in_filter(*key),
                Mode::Notes => self.in_notes(*key),
                Mode::Help => self.in_help(*key),
            },
            Pressed::Text(text) => {
                if self.mode == Mode::Filter {
                    self.filter.extend(text.chars().filter(|letter| !letter.is_control()).take(40));
                    self.sift();
                } else {
                    if self.mode != Mode::Prompt {
                        self.write("");
                    }
                    self.prompt.paste(text);
                }
                None
            }
            Pressed::Resized => {
                self.widths.clear();
                None
            }
        }
    }

    fn in_table(&mut self, key: Key, now: Duration) -> Option<Ask> {
        match key {
            Key::Char(letter) => self.letter(letter, now),
            Key::Named(name) => {
                self.named(name, now);
                None
            }
        }
    }

    fn letter(&mut self, letter: char, now: Duration) -> Option<Ask> {
        match letter {
            'q' => return Some(Ask::Quit),
            'j' => self.choose(1),
            'k' => self.choose(-1),
            ' ' => self.toggle(),
            'x' => {
                self.plotted.clear();
                self.is_large = false;
            }
            '+' | '=' => self.view.zoom(true),
            '-' | '_' => self.view.zoom(false),
            'f' | 'p' => self.view.freeze(now),
            'c' if !self.plotted.is_empty() => self.view.toggle_cursor(now),
            'v' => self.view.next_axis(),
            '>' => self.view.magnify(true),
            '<' => self.view.magnify(false),
            'n' => self.mode = Mode::Notes,
            '?' | 'h' => self.mode = Mode::Help,
            '/' => self.mode = Mode::Filter,
            ':' => self.write(""),
            's' => self.set(""),
            '[' | ']' | '{' | '}' | '0' => return self.slide(letter),
            '1'..='9' => self.set(&letter.to_string()),
            'A'..='Z' => self.write(&letter.to_string()),
            _ => {}
        }
        None
    }

    fn named(&mut self, name: &str, now: Duration) {
        let page = isize::try_from(self.page).unwrap_or(1).max(1);
        let is_plot = !self.plotted.is_empty();
        match name {
            "up" => self.choose(-1),
            "down" => self.choose(1),
            "page-up" => self.choose(-page),
            "page-down" => self.choose(page),
            "home" if is_plot => self.view.go_oldest(now),
            "end" if is_plot => self.view.go_live(),
            "home" => self.choose(isize::MIN),
            "end" => self.choose(isize::MAX),
            "left" | "far-left" if is_plot => self.view.step(true, name == "far-left", now),
            "right" | "far-right" if is_plot => self.view.step(false, name == "far-right", now),
            "enter" => self.enlarge(),
            "esc" => self.back(),
            "help" => self.mode = Mode::Help,
            _ => {}
        }
    }

    /// Undoes what was done last, as far as it is a way to look.
    fn back(&mut self) {
        if self.view.cursor.is_some() {
            self.view.cursor = None;
        } else if self.is_large {
            self.is_large = false;
        } else if self.view.is_frozen() {
            self.view.go_live();
        } else if !self.filter.is_empty() {
            self.filter.clear();
            self.sift();
        }
    }

    fn choose(&mut self, by: isize) {
        self.chosen = self.chosen.saturating_add_signed(by).min(self.shown.len().saturating_sub(1));
    }

    fn toggle(&mut self) {
        let Some(item) = self.shown.get(self.chosen).copied() else { return };
        if self.plotted.contains(&item) {
            self.plotted.retain(|one| *one != item);
            self.is_large &= !self.plotted.is_empty();
        } else if self.plotted.len() < PLOTTED_MAX {
            self.plotted.push(item);
        } else {
            self.told = Some(format!("no more than {PLOTTED_MAX} devices are plotted at once"));
        }
    }

    fn enlarge(&mut self) {
        if self.plotted.is_empty() {
            self.toggle();
        }
        self.is_large = !self.is_large && !self.plotted.is_empty();
    }

    /// Keeps the items whose names have the filter; the chosen one stays if it is among them.
    fn sift(&mut self) {
        let chosen = self.shown.get(self.chosen).copied();
        let wanted = self.filter.to_lowercase();
        let all = self.items.iter().enumerate();
        let found = all.filter(|(_, item)| item.name.to_lowercase().contains(&wanted));
        self.shown = found.map(|(index, _)| index).collect();
        let place = self.shown.iter().position(|item| Some(*item) == chosen);
        (self.chosen, self.top) = (place.unwrap_or_default(), 0);
    }

    fn in_filter(&mut self, key: Key) -> Option<Ask> {
        match key {
            Key::Char(letter) => self.filter.push(letter),
            Key::Named("backspace") if self.filter.is_empty() => self.mode = Mode::Table,
            Key::Named("backspace") => {
                let _ = self.filter.pop();
            }
            Key::Named("enter") => self.mode = Mode::Table,
            Key::Named("esc") => {
                self.filter.clear();
                self.mode = Mode::Table;
            }
            Key::Named("up") => self.choose(-1),
            Key::Named("down") => self.choose(1),
            Key::Named("ctrl-u") => self.filter.clear(),
            Key::Named(_) => {}
        }
        self.sift();
        None
    }

    fn in_help(&mut self, key: Key) -> Option<Ask> {
        match key {
            Key::Char('j' | ' ') | Key::Named("down" | "page-down") => self.help_top += 1,
            Key::Char('k') | Key::Named("up" | "page-up") => {
                self.help_top = self.help_top.saturating_sub(1);
            }
            Key::Char('q') => return Some(Ask::Quit),
            Key::Char(_) | Key::Named(_) => (self.mode, self.help_top) = (Mode::Table, 0),
        }
        None
    }

    fn in_notes(&mut self, key: Key) -> Option<Ask> {
        let page = isize::try_from(self.page).unwrap_or(1).max(1);
        match key {
            Key::Char('k') | Key::Named("up") => self.notes.scroll(1),
            Key::Char('j') | Key::Named("down") => self.notes.scroll(-1),
            Key::Named("page-up") => self.notes.scroll(page),
            Key::Named("page-down") => self.notes.scroll(-page),
            Key::Named("home") => self.notes.scroll(isize::MAX),
            Key::Named("end") => self.notes.scroll(isize::MIN),
            Key::Char('n') | Key::Named("esc" | "enter") => {
                self.notes.scroll(isize::MIN);
                self.mode = Mode::Table;
            }
            Key::Char('q') => return Some(Ask::Quit),
            Key::Char(_) | Key::Named(_) => {}
        }
        None
    }

    /// Begins a line in the prompt.
    fn write(&mut self, text: &str) {
        self.prompt.begin(text);
        self.mode = Mode::Prompt;
    }

    /// Begins a line with the chosen actuator.
    fn set(&mut self, text: &str) {
        match self.actuator() {
            Some((_, item)) => {
                let line = format!("{} {text}", item.name);
                self.write(&line);
            }
            None if text.is_empty() => self.write(""),
            None => {
                self.told =
                    Some("choose an actuator to set it, or press : and write its name".into());
            }
        }
    }

    fn slide(&mut self, letter: char) -> Option<Ask> {
        let slide = Slide::of(letter)?;
        let Some((index, item)) = self.actuator() else {
            self.told = Some("choose an actuator: brackets and 0 set it".to_owned());
            return None;
        };
        let last = self.last(index);
        let text = slid(item.device, last, slide);
        let board = self.boards.get(item.board)?;
        if let Err(why) = board.command(&item.device.name, &text) {
            self.told = Some(format!("not sent: {}: {why}", item.name));
            return None;
        }
        Some(Ask::Set { name: format!("{}/{}", board.name, item.device.name), text })
    }

    fn in_prompt(&mut self, key: Key) -> Option<Ask> {
        match key {
            Key::Named("esc") => self.mode = Mode::Table,
            Key::Named("backspace") if self.prompt.text().is_empty() => self.mode = Mode::Table,
            Key::Named("enter") => {
                if self.prompt.text().trim().is_empty() {
                    self.mode = Mode::Table;
                }
                // What is wrong stays, and why is below it.
                if let Check::Sends { name, text, .. } = self.prompt.check(&self.boards) {
                    self.prompt.finish();
                    self.mode = Mode::Table;
                    return Some(Ask::Set { name, text });
                }
            }
            Key::Char(_) | Key::Named(_) => self.prompt.press(key, &self.boards),
        }
        None
    }
}
