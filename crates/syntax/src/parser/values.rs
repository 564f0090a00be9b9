//! Names, types and values.

use super::{NESTING_LIMIT, Parser};
use crate::error::{Expected, SyntaxErrorKind};
use crate::kind::SyntaxKind;
use crate::unit::Unit;

impl Parser<'_> {
    /// The token after the name that begins `n` tokens ahead. Hyphens between touching words count
    /// to the name, so that `STM32F407G-DISC1` is one mistake and not several.
    pub(super) fn name_end(&self, n: usize) -> usize {
        // More words than any name has; without a bound, looking ahead would take quadratic time.
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

    /// A name; or a complaint that it is missing, after which a number or string in its place is
    /// stepped over.
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
            self.report(SyntaxErrorKind::HyphenInName { name, suggestion }, range);
            // The report lies behind: what comes next may be wrong for its own reason.
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
        self.name(Expected::Type);
        if self.at(SyntaxKind::LBracket) {
            let open = self.here();
            self.bump();
            if !self.eat(SyntaxKind::Int) {
                self.expected(Expected::ArrayLength);
                if matches!(
                    self.kind(),
                    Some(SyntaxKind::Ident | SyntaxKind::Float | SyntaxKind::Str)
                ) {
                    self.bump_error();
                }
            }
            if !self.eat(SyntaxKind::RBracket) {
                self.complain(SyntaxErrorKind::MissingCloseBracket { open }, self.gap());
            }
        }
        self.finish();
    }

    pub(super) fn at_value(&self) -> bool {
        matches!(
            self.kind(),
            Some(
                SyntaxKind::Ident
                    | SyntaxKind::Int
                    | SyntaxKind::Float
                    | SyntaxKind::Str
                    | SyntaxKind::LBracket
                    | SyntaxKind::Plus
                    | SyntaxKind::Minus
            )
        )
    }

    /// A value; the caller has seen that one begins here.
    pub(super) fn value(&mut self) {
        match self.kind() {
            Some(SyntaxKind::Ident) => {
                self.start(SyntaxKind::NameValue);
                self.name(Expected::Value);
                self.finish();
            }
            Some(SyntaxKind::Str) => {
                self.start(SyntaxKind::StringValue);
                self.bump();
                self.finish();
            }
            Some(SyntaxKind::LBracket) => self.list(),
            Some(_) | None => self.number(),
        }
    }

    fn number(&mut self) {
        self.start(SyntaxKind::Number);
        if self.at(SyntaxKind::Plus) || self.at(SyntaxKind::Minus) {
            self.bump();
        }
        if self.at(SyntaxKind::Int) || self.at(SyntaxKind::Float) {
            self.bump();
            self.unit();
        } else {
            self.expected(Expected::Number);
        }
        self.finish();
    }

    /// The word after a number on its line is its unit, unless it begins the next statement.
    fn unit(&mut self) {
        let begins_next = self.begins_line() || (!self.touches(0) && self.at_item());
        if !self.at(SyntaxKind::Ident) || begins_next {
            return;
        }
        let word = self.nth_text(0);
        if Unit::from_name(word).is_none() {
            let (found, suggestion) = (word.to_owned(), Unit::similar(word));
            self.complain(SyntaxErrorKind::UnknownUnit { found, suggestion }, self.here());
        }
        self.bump_as(SyntaxKind::Unit);
    }

    /// `[VALUE, ...]`, at the `[`.
    fn list(&mut self) {
        if self.depth >= NESTING_LIMIT {
            self.complain(SyntaxErrorKind::NestingTooDeep { limit: NESTING_LIMIT }, self.here());
            self.skip_brackets();
            return;
        }
        self.depth += 1;
        self.start(SyntaxKind::List);
        let open = self.here();
        self.bump();
        self.list_values();
        if !self.eat(SyntaxKind::RBracket) {
            self.complain(SyntaxErrorKind::MissingCloseBracket { open }, self.gap());
        }
        self.finish();
        self.depth -= 1;
    }

    /// The values of a list up to its `]` or to where it must end without one.
    fn list_values(&mut self) {
        // The last comma, while no value has followed it.
        let mut comma = None;
        let mut after_value = false;
        loop {
            match self.kind() {
                Some(SyntaxKind::RBracket) => {
                    if let Some(comma) = comma {
                        self.complain(SyntaxErrorKind::TrailingComma, comma);
                    }
                    return;
                }
                Some(SyntaxKind::Comma) => {
                    if !after_value {
                        self.expected(Expected::Value);
                    }
                    comma = Some(self.here());
                    after_value = false;
                    self.bump();
                }
                Some(SyntaxKind::Eq) => {
                    self.expected(Expected::Value);
                    self.bump_error();
                }
                Some(_) if self.at_value() && !self.at_item() => {
                    if after_value {
                        self.complain(SyntaxErrorKind::MissingComma, self.gap());
                    }
                    self.value();
                    comma = None;
                    after_value = true;
                }
                Some(_) | None => return,
            }
        }
    }

    /// Consumes brackets that nest too deep, without recursion.
    fn skip_brackets(&mut self) {
        self.start(SyntaxKind::Error);
        let mut open = 0_usize;
        let ends =
            |kind| matches!(kind, SyntaxKind::Semicolon | SyntaxKind::LBrace | SyntaxKind::RBrace);
        while self.kind().is_some_and(|kind| !ends(kind)) {
            if self.at(SyntaxKind::LBracket) {
                open += 1;
            } else if self.at(SyntaxKind::RBracket) {
                open = open.saturating_sub(1);
            }
            self.bump();
            if open == 0 {
                break;
            }
        }
        self.finish();
    }
}
