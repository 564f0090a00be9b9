//! Keys, by names of our own, and the page that says what they do.
//!
//! In: events of the terminal. Out: what was pressed or pasted.

use ratatui_crossterm::crossterm::event::{Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// A key. Those that write nothing have a name: `up`, `enter`, `ctrl-c`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Char(char),
    Named(&'static str),
}

/// What came of the terminal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Pressed {
    Key(Key),
    /// A text that was pasted.
    Text(String),
    /// The window has another size.
    Resized,
}

const NAMED: [(KeyCode, &str); 15] = [
    (KeyCode::Up, "up"),
    (KeyCode::Down, "down"),
    (KeyCode::Left, "left"),
    (KeyCode::Right, "right"),
    (KeyCode::PageUp, "page-up"),
    (KeyCode::PageDown, "page-down"),
    (KeyCode::Home, "home"),
    (KeyCode::End, "end"),
    (KeyCode::Enter, "enter"),
    (KeyCode::Esc, "esc"),
    (KeyCode::Tab, "tab"),
    (KeyCode::BackTab, "back-tab"),
    (KeyCode::Backspace, "backspace"),
    (KeyCode::Delete, "delete"),
    (KeyCode::F(1), "help"),
];

/// Keys with Ctrl.
const CONTROL: [(char, &str); 8] = [
    ('c', "ctrl-c"),
    ('z', "ctrl-z"),
    ('l', "ctrl-l"),
    ('a', "home"),
    ('e', "end"),
    ('u', "ctrl-u"),
    ('w', "ctrl-w"),
    ('h', "backspace"),
];

/// What an event means here; none if it means nothing.
pub(super) fn read(event: Event) -> Option<Pressed> {
    match event {
        Event::Key(key) if key.kind != KeyEventKind::Release => named(key).map(Pressed::Key),
        Event::Paste(text) => Some(Pressed::Text(text)),
        Event::Resize(..) => Some(Pressed::Resized),
        Event::Key(_) | Event::Mouse(_) | Event::FocusGained | Event::FocusLost => None,
    }
}

fn named(key: KeyEvent) -> Option<Key> {
    let has = |modifier| key.modifiers.contains(modifier);
    if let KeyCode::Char(letter) = key.code {
        if has(KeyModifiers::CONTROL) {
            let letter = letter.to_ascii_lowercase();
            let found = CONTROL.iter().find(|(control, _)| *control == letter);
            return found.map(|(_, name)| Key::Named(name));
        }
        return (!has(KeyModifiers::ALT)).then_some(Key::Char(letter));
    }
    let is_far = has(KeyModifiers::SHIFT) || has(KeyModifiers::CONTROL);
    match key.code == KeyCode::Left || key.code == KeyCode::Right {
        true if is_far && key.code == KeyCode::Left => return Some(Key::Named("far-left")),
        true if is_far => return Some(Key::Named("far-right")),
        _ => {}
    }
    NAMED.iter().find(|(code, _)| *code == key.code).map(|(_, name)| Key::Named(name))
}

/// What the keys do, in groups: no more than 16 characters of keys, and 22 of what they do.
pub(super) const HELP: [(&str, &[(&str, &str)]); 4] = [
    (
        "Devices",
        &[
            ("↑ ↓ PgUp PgDn", "choose; also j and k"),
            ("/", "only names with a text"),
            ("Space", "plot it, or not"),
            ("x", "plot nothing"),
            ("n", "all notes"),
        ],
    ),
    (
        "Plots",
        &[
            ("Enter", "plots alone, or not"),
            ("+ -", "less time, more time"),
            ("> <", "values larger, smaller"),
            ("v", "axis: seen/limits/held"),
            ("f", "hold, or go on"),
            ("← →", "scroll; far with Shift"),
            ("Home End", "oldest, newest"),
            ("c", "cursor: values there"),
        ],
    ),
    (
        "Actuators",
        &[
            ("s", "set the chosen one"),
            (": or a capital", "write NAME VALUE"),
            ("1 to 9", "write its value"),
            ("[ ]", "a step less, more"),
            ("{ }", "ten steps less, more"),
            ("0", "to zero"),
        ],
    ),
    ("Else", &[("?", "this page"), ("Esc", "back"), ("q Ctrl-C", "end"), ("Ctrl-Z", "pause")]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_names() {
        let key = |code, modifiers| read(Event::Key(KeyEvent::new(code, modifiers)));
        let named = |name| Some(Pressed::Key(Key::Named(name)));
        assert_eq!(key(KeyCode::Char('q'), KeyModifiers::NONE), Some(Pressed::Key(Key::Char('q'))));
        assert_eq!(
            key(KeyCode::Char('S'), KeyModifiers::SHIFT),
            Some(Pressed::Key(Key::Char('S')))
        );
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::CONTROL), named("ctrl-c"));
        assert_eq!(key(KeyCode::Left, KeyModifiers::NONE), named("left"));
        assert_eq!(key(KeyCode::Left, KeyModifiers::SHIFT), named("far-left"));
        assert_eq!(key(KeyCode::Right, KeyModifiers::CONTROL), named("far-right"));
        assert_eq!(key(KeyCode::F(5), KeyModifiers::NONE), None);
        assert_eq!(read(Event::FocusLost), None);
        let mut released = KeyEvent::new(KeyCode::Up, KeyModifiers::NONE);
        released.kind = KeyEventKind::Release;
        assert_eq!(read(Event::Key(released)), None);
    }
}
