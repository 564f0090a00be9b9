//! Numbers: digits of a base, fractions and exponents.

use super::{Lexer, is_digit, is_name_continue, size};
use crate::error::SyntaxErrorKind;
use crate::kind::SyntaxKind;
use crate::literal;

impl Lexer<'_> {
    pub(super) fn number(&mut self, start: usize) -> SyntaxKind {
        self.position = start;
        if let Some(length) = frame_word(self.rest()) {
            self.position += length;
            return SyntaxKind::Ident;
        }
        let (digits, base) = literal::split_base(self.rest());
        if base != 10 {
            self.position = self.text.len() - digits.len();
            return self.based_integer(start, base);
        }
        self.bump_while(is_digit);
        let fraction = self.fraction(start);
        let exponent = self.exponent();
        if !fraction && !exponent {
            self.check_size(start, literal::integer(self.since(start)).is_some());
            return SyntaxKind::Int;
        }
        self.check_size(start, literal::float(self.since(start)).is_some());
        SyntaxKind::Float
    }

    /// The digits after `0x` or `0b`. Decimal digits that the base does not have still belong to
    /// the number: `0b102` is one wrong number, not two numbers.
    fn based_integer(&mut self, start: usize, base: u32) -> SyntaxKind {
        let digits_start = self.position;
        self.bump_while(|character| is_digit(character) || character.is_digit(base));
        let digits = self.since(digits_start);
        let wrong = digits.char_indices().find(|(_, digit)| *digit != '_' && !digit.is_digit(base));
        if let Some((offset, digit)) = wrong {
            let at = digits_start + offset;
            self.error(SyntaxErrorKind::InvalidDigit { digit, base }, at, at + digit.len_utf8());
        } else if digits.bytes().all(|byte| byte == b'_') {
            let number = self.since(start).to_owned();
            self.error(SyntaxErrorKind::MissingDigits { number }, start, self.position);
        } else {
            self.check_size(start, literal::integer(self.since(start)).is_some());
        }
        SyntaxKind::Int
    }

    /// `.` and digits, after an integer, unless a range begins here.
    fn fraction(&mut self, start: usize) -> bool {
        if self.peek() != Some('.') || self.peek_second() == Some('.') {
            return false;
        }
        self.bump();
        if self.peek().is_some_and(|next| next.is_ascii_digit()) {
            self.bump_while(is_digit);
        } else {
            let number = self.since(start).to_owned();
            self.error(SyntaxErrorKind::MissingDigits { number }, start, self.position);
        }
        true
    }

    pub(super) fn fraction_without_integer(&mut self, start: usize) -> SyntaxKind {
        self.bump_while(is_digit);
        self.exponent();
        let number = self.since(start).to_owned();
        self.error(SyntaxErrorKind::MissingDigits { number }, start, self.position);
        SyntaxKind::Float
    }

    /// `e`, a sign and digits. Without digits, the `e` begins a unit, not an exponent.
    fn exponent(&mut self) -> bool {
        if !matches!(self.peek(), Some('e' | 'E')) {
            return false;
        }
        let signed = matches!(self.peek_second(), Some('+' | '-'));
        let digits = self.rest().get(if signed { 2 } else { 1 }..).unwrap_or_default();
        if !digits.starts_with(|character: char| character.is_ascii_digit()) {
            return false;
        }
        self.position = self.text.len() - digits.len();
        self.bump_while(is_digit);
        true
    }

    fn check_size(&mut self, start: usize, fits: bool) {
        // A number without its digits has already been reported.
        let reported =
            self.errors.list.last().is_some_and(|error| error.range.start() == size(start));
        if !fits && !reported {
            let number = self.since(start).to_owned();
            self.error(SyntaxErrorKind::NumberTooLarge { number }, start, self.position);
        }
    }
}

/// The length of a word such as `8N1`: digits, letters, digits. Such a word is not a number with a
/// unit, because no unit contains digits; it is a frame format of a serial line.
fn frame_word(text: &str) -> Option<usize> {
    let run = |from: usize, of: fn(&u8) -> bool| {
        let rest = text.as_bytes().get(from..).unwrap_or_default();
        from + rest.iter().take_while(|byte| of(byte)).count()
    };
    let digits = run(0, u8::is_ascii_digit);
    let letters = run(digits, u8::is_ascii_uppercase);
    let end = run(letters, u8::is_ascii_digit);
    let ends = text.get(end..)?.chars().next().is_none_or(|next| !is_name_continue(next));
    let prefix = text.get(digits..letters)?;
    // `1E3`, `0B1` and `0XF0` are numbers.
    let is_number = matches!(prefix, "E" | "B") || text.starts_with("0X");
    (letters > digits && end > letters && ends && !is_number).then_some(end)
}
