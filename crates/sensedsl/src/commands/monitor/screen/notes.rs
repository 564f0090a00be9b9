//! The sentences that were said, with their times.

use std::collections::VecDeque;
use std::time::Duration;

use sensedsl_diagnostics::visible;

/// How many are kept.
const NOTES_MAX: usize = 500;
/// How many are printed after the screen.
const LEFT_MAX: usize = 100;

/// What was said.
#[derive(Default)]
pub(super) struct Notes {
    said: VecDeque<(Duration, String)>,
    before: usize,
    /// How many of the latest ones are below what is seen.
    pub(super) back: usize,
}

/// What a sentence about a command is of: `sent: Servo`.
fn command(text: &str) -> Option<&str> {
    text.starts_with("sent: ").then(|| text.split_once(" = ")).flatten().map(|(name, _)| name)
}

impl Notes {
    /// Takes a sentence, whose text may be a stranger's.
    pub(super) fn say(&mut self, at: Duration, text: &str) {
        let text = visible(text).into_owned();
        // A slider says the same of many values: the last one counts.
        if let Some(last) = self.said.back_mut()
            && command(&text).is_some()
            && command(&text) == command(&last.1)
        {
            *last = (at, text);
            return;
        }
        if self.said.len() >= NOTES_MAX {
            let _ = self.said.pop_front();
            self.before += 1;
        }
        self.said.push_back((at, text));
        if self.back > 0 {
            self.back += 1;
        }
    }

    pub(super) fn scroll(&mut self, lines: isize) {
        let most = self.said.len().saturating_sub(1);
        self.back = self.back.saturating_add_signed(lines).min(most);
    }

    /// So many, the latest that are seen last.
    pub(super) fn seen(&self, count: usize) -> impl Iterator<Item = &(Duration, String)> {
        let end = self.said.len() - self.back.min(self.said.len().saturating_sub(count));
        self.said.range(end.saturating_sub(count)..end)
    }

    pub(super) fn len(&self) -> usize {
        self.said.len()
    }

    /// What stays in the terminal after the screen.
    pub(super) fn left(&self) -> Vec<String> {
        let first = self.said.len().saturating_sub(LEFT_MAX);
        let missing = self.before + first;
        let head = (missing > 0).then(|| format!("({missing} earlier notes)"));
        head.into_iter().chain(self.said.range(first..).map(|(_, text)| text.clone())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_kept_and_seen() {
        let mut notes = Notes::default();
        for n in 0..600 {
            notes.say(Duration::from_secs(n), &format!("note {n}"));
        }
        let seen = |notes: &Notes| notes.seen(2).map(|(_, text)| text.clone()).collect::<Vec<_>>();
        assert_eq!((notes.len(), seen(&notes)), (500, vec!["note 598".into(), "note 599".into()]));
        notes.scroll(3);
        notes.say(Duration::ZERO, "\x1b[2Jred");
        assert_eq!(seen(&notes), ["note 595", "note 596"]);
        notes.scroll(isize::MAX);
        assert_eq!(seen(&notes)[0], "note 101");
        notes.scroll(isize::MIN);
        assert_eq!(notes.left().len(), 101);
        assert_eq!(notes.left()[0], "(501 earlier notes)");
        assert!(!notes.left()[100].contains('\x1b'));
        notes.say(Duration::ZERO, "sent: Servo = 1");
        notes.say(Duration::ZERO, "sent: Servo = 2");
        notes.say(Duration::ZERO, "sent: Lamp = 2");
        assert_eq!(seen(&notes), ["sent: Servo = 2", "sent: Lamp = 2"]);
    }
}
