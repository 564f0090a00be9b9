//! A line that somebody writes: an actuator and its value, checked before it is sent, with completion and history.
//!
//! In: keys, and the boards. Out: the line, what it would do, and the words that can follow.

use sensedsl_diagnostics::visible;
use sensedsl_host::{Board, CommandError, Device};
use sensedsl_wire::{Direction, ScalarType};

use super::keys::Key;

/// The most characters of a line.
const LINE_MAX: usize = 400;
/// How many lines are remembered.
const HISTORY_MAX: usize = 100;
/// Units that have prefixes, and these.
const BASES: [&str; 9] = ["m", "s", "V", "A", "Hz", "g", "N", "W", "Pa"];
const PREFIXES: [&str; 6] = ["", "u", "m", "c", "k", "M"];

/// A line and the place of the cursor in it, in characters.
#[derive(Default)]
pub(super) struct Prompt {
    letters: Vec<char>,
    pub(super) cursor: usize,
    history: Vec<String>,
    /// The place in the history, if a line of it is shown, and the line that was written before.
    recalled: Option<(usize, String)>,
    /// The word that is completed begins there, and these can be there.
    cycle: Option<(usize, Vec<String>, usize)>,
}

/// What a line would do.
#[derive(Debug, PartialEq)]
pub(super) enum Check {
    /// It can be sent: the name and the value, and what is told of it.
    Sends { name: String, text: String, told: String },
    /// It cannot, and why.
    Wrong(String),
    /// It is not finished, and what comes next.
    Hint(String),
}

impl Prompt {
    pub(super) fn text(&self) -> String {
        self.letters.iter().collect()
    }

    /// Begins a line with a text.
    pub(super) fn begin(&mut self, text: &str) {
        self.letters = text.chars().collect();
        self.cursor = self.letters.len();
        (self.recalled, self.cycle) = (None, None);
    }

    /// The line is done: it is remembered.
    pub(super) fn finish(&mut self) {
        let text = self.text();
        if self.history.last() != Some(&text) {
            self.history.push(text);
        }
        if self.history.len() > HISTORY_MAX {
            let _ = self.history.remove(0);
        }
        self.begin("");
    }

    /// Writes the first line of a text at the cursor.
    pub(super) fn paste(&mut self, text: &str) {
        let line = text.trim_start().lines().next().unwrap_or_default();
        visible(line).chars().for_each(|letter| self.write(letter));
    }

    fn write(&mut self, letter: char) {
        self.cycle = None;
        if self.letters.len() < LINE_MAX && !letter.is_control() {
            self.letters.insert(self.cursor.min(self.letters.len()), letter);
            self.cursor += 1;
        }
    }

    /// Takes a key that changes the line.
    pub(super) fn press(&mut self, key: Key, boards: &[&Board]) {
        match key {
            Key::Char(letter) => self.write(letter),
            Key::Named("tab") => self.complete(boards, true),
            Key::Named("back-tab") => self.complete(boards, false),
            Key::Named(name) => {
                self.cycle = None;
                self.edit(name);
            }
        }
    }

    fn edit(&mut self, name: &str) {
        match name {
            "left" => self.cursor = self.cursor.saturating_sub(1),
            "right" => self.cursor = (self.cursor + 1).min(self.letters.len()),
            "home" => self.cursor = 0,
            "end" => self.cursor = self.letters.len(),
            "backspace" if self.cursor > 0 => {
                self.cursor -= 1;
                self.erase(self.cursor, self.cursor + 1);
            }
            "delete" => self.erase(self.cursor, self.cursor + 1),
            "ctrl-u" => {
                self.erase(0, self.cursor);
                self.cursor = 0;
            }
            "ctrl-w" => {
                let before: String = self.letters.iter().take(self.cursor).collect();
                let kept = before.trim_end().rfind(' ').map_or(0, |at| at + 1);
                let kept = before.get(..kept).unwrap_or_default().chars().count();
                self.erase(kept, self.cursor);
                self.cursor = kept;
            }
            "up" => self.recall(true),
            "down" => self.recall(false),
            _ => {}
        }
    }

    fn erase(&mut self, from: usize, to: usize) {
        let to = to.min(self.letters.len());
        if from < to {
            let _ = self.letters.drain(from..to);
        }
    }

    fn recall(&mut self, is_earlier: bool) {
        let (at, written) = match self.recalled.take() {
            Some(recalled) => recalled,
            None => (self.history.len(), self.text()),
        };
        let at = if is_earlier { at.saturating_sub(1) } else { at + 1 };
        let found = self.history.get(at).cloned();
        let text = found.clone().unwrap_or_else(|| written.clone());
        self.begin(&text);
        self.recalled = found.map(|_| (at, written));
    }

    /// The next word that fits, or as much as all that fit begin with.
    fn complete(&mut self, boards: &[&Board], is_next: bool) {
        if let Some((start, words, at)) = self.cycle.take() {
            let step = if is_next { 1 } else { words.len().saturating_sub(1) };
            let at = (at + step) % words.len().max(1);
            self.replace(start, words.get(at).map_or("", String::as_str));
            self.cycle = Some((start, words, at));
            return;
        }
        let (start, words) = self.fitting(boards);
        let Some(first) = words.first() else { return };
        if words.len() == 1 {
            let word = format!("{first} ");
            return self.replace(start, &word);
        }
        let common = words.iter().fold(first.as_str(), |common, word| {
            let same = common.chars().zip(word.chars()).take_while(|(one, other)| one == other);
            let bytes: usize = same.map(|(one, _)| one.len_utf8()).sum();
            common.get(..bytes).unwrap_or_default()
        });
        let written = self.cursor.saturating_sub(start);
        if common.chars().count() > written {
            let common = common.to_owned();
            return self.replace(start, &common);
        }
        let (first, last) = (first.clone(), words.len() - 1);
        let at = if is_next { 0 } else { last };
        let word = words.get(at).cloned().unwrap_or(first);
        self.replace(start, &word);
        self.cycle = Some((start, words, at));
    }

    /// Puts a word in the place of what is written from a place to the cursor.
    fn replace(&mut self, start: usize, word: &str) {
        self.erase(start, self.cursor);
        self.cursor = start;
        for letter in word.chars() {
            if self.letters.len() < LINE_MAX {
                self.letters.insert(self.cursor.min(self.letters.len()), letter);
                self.cursor += 1;
            }
        }
    }

    /// The words that fit at the cursor, and where they begin.
    pub(super) fn fitting(&self, boards: &[&Board]) -> (usize, Vec<String>) {
        let before: Vec<char> = self.letters.iter().take(self.cursor).copied().collect();
        let is_space = |letter: &char| letter.is_whitespace() || *letter == '=';
        let start = before.iter().rposition(is_space).map_or(0, |at| at + 1);
        let word: String = before.iter().skip(start).collect();
        let earlier: String = before.iter().take(start).collect();
        let mut words = earlier.split(|letter| is_space(&letter)).filter(|word| !word.is_empty());
        let Some(name) = words.next() else {
            let beginning = word.to_lowercase();
            let names = names(boards).into_iter();
            // The board may be left out.
            let begins = |name: &String| {
                let name = name.to_lowercase();
                let own = name.split_once('/').map_or("", |(_, own)| own);
                name.starts_with(&beginning)
                    || (!beginning.is_empty() && own.starts_with(&beginning))
            };
            return (start, names.filter(begins).collect());
        };
        let Some((_, device)) = found(boards, name) else { return (start, Vec::new()) };
        let values: Vec<&str> = words.collect();
        let fits = following(device, &values).into_iter();
        (start, fits.filter(|one| one.starts_with(&word) && *one != word).collect())
    }

    /// What the line would do.
    pub(super) fn check(&self, boards: &[&Board]) -> Check {
        let line = self.text();
        let line = line.trim_start();
        let split = line.split_once(|letter: char| letter.is_whitespace() || letter == '=');
        let Some((name, text)) = split else {
            return match found(boards, line) {
                Some((_, device)) => Check::Hint(range(device)),
                None if self.fitting(boards).1.is_empty() && !line.is_empty() => {
                    Check::Wrong(unknown(boards, line))
                }
                None => Check::Hint("an actuator and its value; Tab completes".to_owned()),
            };
        };
        let Some((board, device)) = found(boards, name) else {
            return Check::Wrong(unknown(boards, name));
        };
        let text = text.trim().trim_start_matches(['=', ' ']);
        if text.is_empty() {
            return Check::Hint(range(device));
        }
        match board.command(&device.name, text) {
            Ok((_, _, value)) => Check::Sends {
                name: format!("{}/{}", board.name, device.name),
                text: text.to_owned(),
                told: format!("Enter sends {}", device.text(&value)),
            },
            Err(CommandError::Count { expected, found }) if found < expected => {
                Check::Hint(format!("{found} of {expected} values; {}", range(device)))
            }
            Err(why) => Check::Wrong(why.to_string()),
        }
    }
}

/// The names of all actuators; with their boards where several have one.
pub(super) fn names(boards: &[&Board]) -> Vec<String> {
    let is_actuator = |one: &&Device| one.direction == Direction::Actuator;
    let all = boards.iter().flat_map(|board| {
        let devices = board.devices.iter().filter(is_actuator);
        devices.map(|device| match boards.len() {
            1 => device.name.clone(),
            _ => format!("{}/{}", board.name, device.name),
        })
    });
    all.collect()
}

/// The actuator of a name.
fn found<'b>(boards: &[&'b Board], name: &str) -> Option<(&'b Board, &'b Device)> {
    let (of, name) = match name.split_once('/') {
        Some((of, name)) => (Some(of), name),
        None => (None, name),
    };
    let boards = boards.iter().filter(|board| of.is_none_or(|of| board.name == of));
    let mut all = boards.flat_map(|board| {
        let fits = |one: &&Device| {
            one.direction == Direction::Actuator && one.name.eq_ignore_ascii_case(name)
        };
        board.devices.iter().filter(fits).map(|device| (*board, device))
    });
    let exact = all.clone().find(|(_, device)| device.name == name);
    let is_one = all.clone().count() == 1 || (of.is_some() && exact.is_some());
    if is_one { exact.or_else(|| all.next()) } else { None }
}

/// Why nothing is meant by a name.
fn unknown(boards: &[&Board], name: &str) -> String {
    let several: Vec<String> = names(boards)
        .into_iter()
        .filter(|one| one.split_once('/').is_some_and(|(_, own)| own.eq_ignore_ascii_case(name)))
        .collect();
    match (several.len(), boards) {
        (2.., _) => format!("several boards have it: {}", several.join(", ")),
        (_, [board]) => match board.command(name, "") {
            Err(why @ (CommandError::Name(..) | CommandError::Sensor(_))) => why.to_string(),
            _ => format!("no actuator `{name}`"),
        },
        _ => format!("no actuator `{name}`"),
    }
}

/// What can be set, for people.
pub(super) fn range(device: &Device) -> String {
    let unit = device.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let what = match (device.value.scalar, device.min, device.max) {
        (ScalarType::Bool, ..) => "true or false".to_owned(),
        (_, Some(least), Some(most)) => format!("{least} to {most}{unit}"),
        (_, Some(least), None) => format!("{least}{unit} or more"),
        (_, None, Some(most)) => format!("{most}{unit} or less"),
        (scalar, None, None) => match &device.quantity {
            Some(unit) => format!("a value in {unit}"),
            None => format!("a number ({})", scalar.name()),
        },
    };
    let count =
        device.value.length.map_or(String::new(), |length| format!("{length} values, each "));
    let raw = if device.scale.is_plain() { "" } else { ", or `raw` and a code" };
    format!("{}: {count}{what}{raw}", device.name)
}

/// The words that can follow some values of a device.
fn following(device: &Device, values: &[&str]) -> Vec<String> {
    let is_bool = device.value.scalar == ScalarType::Bool;
    let is_raw = values.first() == Some(&"raw");
    let numbers = values.len() - usize::from(is_raw);
    if numbers < device.value.count() {
        let words: &[&str] = match (is_bool, values.is_empty()) {
            (true, _) => &["true", "false"],
            (false, true) => &["raw"],
            (false, false) => &[],
        };
        return words.iter().map(|word| (*word).to_owned()).collect();
    }
    if is_raw || is_bool || numbers > device.value.count() {
        return Vec::new();
    }
    device.quantity.as_deref().map_or_else(Vec::new, units)
}

/// The unit itself, and others of its base.
fn units(own: &str) -> Vec<String> {
    let mut all = vec![own.to_owned()];
    let bases = BASES
        .iter()
        .filter(|base| PREFIXES.iter().any(|prefix| own.strip_prefix(prefix) == Some(**base)));
    for base in bases {
        all.extend(
            PREFIXES.iter().map(|prefix| format!("{prefix}{base}")).filter(|unit| unit != own),
        );
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensedsl_host::Scale;
    use sensedsl_wire::{Schema, ValueType};

    fn board() -> Board {
        let device = |id, name: &str, scalar, length| Device {
            name: name.to_owned(),
            id,
            direction: Direction::Actuator,
            value: ValueType { scalar, length },
            kind: String::new(),
            quantity: (scalar != ScalarType::Bool).then(|| "us".to_owned()),
            scale: Scale::default(),
            min: None,
            max: Some(3_000.0),
            cycle_ms: None,
            obeys: None,
        };
        let devices = vec![
            device(1, "Winch", ScalarType::Uint16, None),
            device(2, "Window", ScalarType::Bool, None),
            device(3, "Pair", ScalarType::Uint16, Some(2)),
        ];
        let items = devices.iter().map(|one| sensedsl_wire::Item {
            id: one.id,
            name: one.name.clone(),
            direction: one.direction,
            value: one.value,
        });
        let schema = Schema { items: items.collect(), ..Schema::default() };
        Board { name: "Crane".into(), schema, baud: None, silence_ms: None, devices }
    }

    /// Presses letters, and keys in angle brackets.
    fn press(prompt: &mut Prompt, boards: &[&Board], keys: &[&'static str]) -> String {
        for key in keys {
            match key.strip_prefix('<').and_then(|key| key.strip_suffix('>')) {
                Some(named) => prompt.press(Key::Named(named), boards),
                None => key.chars().for_each(|letter| prompt.press(Key::Char(letter), boards)),
            }
        }
        prompt.text()
    }

    #[test]
    fn words_are_completed() {
        let board = board();
        let mut prompt = Prompt::default();
        let mut line = |keys: &[&'static str]| {
            prompt.begin("");
            press(&mut prompt, &[&board], keys)
        };
        assert_eq!(line(&["w", "<tab>"]), "Win");
        assert_eq!(line(&["w", "<tab>", "<tab>"]), "Winch");
        assert_eq!(line(&["w", "<tab>", "<tab>", "<tab>"]), "Window");
        assert_eq!(line(&["w", "<tab>", "<back-tab>"]), "Window");
        assert_eq!(line(&["p", "<tab>", "7 8 ", "<tab>"]), "Pair 7 8 us");
        assert_eq!(line(&["Winch 2 ", "m", "<tab>"]), "Winch 2 ms ");
        assert_eq!(line(&["Window ", "f", "<tab>"]), "Window false ");
        assert_eq!(line(&["zz", "<tab>"]), "zz");
    }

    #[test]
    fn lines_are_changed_and_come_back() {
        let board = board();
        let mut prompt = Prompt::default();
        for line in ["Winch 1", "Winch 2", "Winch 2"] {
            prompt.begin(line);
            prompt.finish();
        }
        let mut line = |keys: &[&'static str]| press(&mut prompt, &[&board], keys);
        assert_eq!(line(&["Wi", "<up>"]), "Winch 2");
        assert_eq!(line(&["<up>", "<up>"]), "Winch 1");
        assert_eq!(line(&["<down>", "<down>"]), "Wi");
        assert_eq!(line(&["nch 77", "<left>", "<backspace>", "<home>", "<delete>"]), "inch 7");
        assert_eq!(line(&["<end>", "<ctrl-w>", "<ctrl-w>"]), "");
        prompt.paste("  Winch \u{1b}[2J5\nWinch 6");
        assert!(!prompt.text().contains(char::is_control) && prompt.text().starts_with("Winch "));
        prompt.begin("");
        prompt.paste(&"x".repeat(9_000));
        assert_eq!(prompt.text().len(), LINE_MAX);
    }

    #[test]
    fn it_says_what_a_line_would_do() {
        let board = board();
        let mut prompt = Prompt::default();
        let mut check = |line: &str| {
            prompt.begin(line);
            match prompt.check(&[&board]) {
                Check::Sends { name, text, told } => format!("{name}|{text}|{told}"),
                Check::Wrong(text) | Check::Hint(text) => text,
            }
        };
        assert_eq!(check("Winch=1.5 ms"), "Crane/Winch|1.5 ms|Enter sends 1500 (1500 us)");
        assert_eq!(check("winch"), "Winch: 3000 us or less");
        assert_eq!(check("Winch 4000"), "4000 us is above the maximum of 3000");
        assert_eq!(check("Pair 1"), "1 of 2 values; Pair: 2 values, each 3000 us or less");
        assert_eq!(check("Wintch 1"), "the board has no actuator `Wintch`, did you mean `Winch`?");
        assert_eq!(check(""), "an actuator and its value; Tab completes");
    }
}
