//! Names and types.

use super::Parser;
use crate::error::{Expected, SyntaxErrorKind};
use crate::kind::SyntaxKind;

impl Parser<'_> {
    /// The index of the token after the name that begins `n` tokens ahead. Hyphens between touching
    /// words are part of the name, so that `STM32F407G-DISC1` is one mistake, not several.
    pub(super) fn name_end(&self, n: usize) -> usize {
        // More words than any name has. Without a limit, looking ahead would take quadratic time.
        let last = n + 16;
        let mut end = n + 1;
        let word = |n| self.nth_at(n, SyntaxKind::Ident) || self.nth_at(n, SyntaxKind::Int);
        let touch = |n| self.touches(n) && self.touches(n + 1);
        while end < last && self.nth_at(end, SyntaxKind::Minus) && word(end + 1) && touch(end) {
            end += 2;
            // `407G` is a number and a word to the lexer.
            while word(end) && self.touches(end) {
                end += 1;
            }
        }
        end
    }

    /// A name. If it is missing, reports that and skips a number or string in its place.
    pub(super) fn name(&mut self, expected: Expected) {
        match self.kind() {
            Some(SyntaxKind::Ident) => {}
            Some(SyntaxKind::Int | SyntaxKind::Float | SyntaxKind::Str) if !self.begins_line() => {
                self.expected(expected);
                self.start(SyntaxKind::Error);
                self.bump();
                while self.touches(0)
                    && matches!(self.kind(), Some(SyntaxKind::Ident | SyntaxKind::Int))
                {
                    self.bump();
                }
                self.finish();
                return;
            }
            Some(_) | None => {
                self.expected(expected);
                return;
            }
        }
        let start = self.here();
        let count = self.name_end(0);
        self.check_ascii();
        self.bump();
        if count > 1 {
            self.start(SyntaxKind::Error);
            (1..count).for_each(|_| self.bump());
            self.finish();
            let range = start.cover(self.gap());
            let name = self.text.get(std::ops::Range::from(range)).unwrap_or_default().to_owned();
            let suggestion = name.replace('-', "_");
            let in_value = expected == Expected::Value;
            self.report(SyntaxErrorKind::HyphenInName { name, suggestion, in_value }, range);
            // The reported mistake is over: what comes next may be wrong for a different reason.
            self.complained = None;
        }
    }

    fn check_ascii(&mut self) {
        let name = self.nth_text(0);
        if !name.is_ascii() {
            let kind = SyntaxErrorKind::NonAsciiName { name: name.to_owned() };
            self.report(kind, self.here());
        }
    }

    /// A scalar and an optional array length.
    pub(super) fn data_type(&mut self) {
        if !self.at(SyntaxKind::Ident) {
            self.expected(Expected::Type);
            return;
        }
        self.start(SyntaxKind::Type);
        if self.at_type_of_words() {
            self.type_of_words();
        } else {
            self.name(Expected::Type);
        }
        if self.at(SyntaxKind::LBracket) {
            let open = self.here();
            self.bump();
            self.array_length();
            if !self.eat(SyntaxKind::RBracket) {
                self.complain(SyntaxErrorKind::MissingCloseBracket { open }, self.gap());
            }
        }
        self.finish();
    }

    /// Whether several words are here, as in `unsigned int {`.
    fn at_type_of_words(&self) -> bool {
        let is_word = |n: usize| self.nth_at(n, SyntaxKind::Ident) && !self.nth_begins_line(n);
        let end = (1..4).find(|&n| !is_word(n)).unwrap_or(4);
        let block = self.nth_at(end, SyntaxKind::LBrace) || self.nth_at(end, SyntaxKind::LBracket);
        end > 1 && block
    }

    fn type_of_words(&mut self) {
        let (start, mut name) = (self.here(), String::new());
        self.start(SyntaxKind::Error);
        while self.at(SyntaxKind::Ident) && (name.is_empty() || !self.begins_line()) {
            name.push_str(if name.is_empty() { "" } else { " " });
            name.push_str(self.nth_text(0));
            self.bump();
        }
        self.finish();
        self.report(SyntaxErrorKind::TypeOfWords { name }, start.cover(self.gap()));
    }

    /// A number or the name of a constant. An expression is reported and skipped.
    fn array_length(&mut self) {
        let is_plain = matches!(self.kind(), Some(SyntaxKind::Int | SyntaxKind::Ident));
        let operator = |kind: Option<SyntaxKind>| {
            matches!(
                kind,
                Some(SyntaxKind::Plus | SyntaxKind::Minus | SyntaxKind::Star | SyntaxKind::Slash)
            )
        };
        if self.at(SyntaxKind::Ident) {
            self.name(Expected::ArrayLength);
        } else {
            self.eat(SyntaxKind::Int);
        }
        if is_plain && !operator(self.kind()) {
            return;
        }
        self.expected(Expected::ArrayLength);
        let skipped = |kind: Option<SyntaxKind>| {
            let plain = [SyntaxKind::Ident, SyntaxKind::Int, SyntaxKind::Float, SyntaxKind::Str];
            operator(kind) || kind.is_some_and(|kind| plain.contains(&kind))
        };
        if skipped(self.kind()) {
            self.start(SyntaxKind::Error);
            while skipped(self.kind()) {
                self.bump();
            }
            self.finish();
        }
    }
}
