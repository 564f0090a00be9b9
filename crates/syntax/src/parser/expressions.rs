//! Values: numbers, names, texts, lists and expressions.
//!
//! Every function here returns the height of the tree that it has built. Blocks, lists and
//! expressions together are never deeper than the limit, so the tree can be walked by recursion.
//! That is why each operator of a chain, whose tree leans to the left, counts.

use super::{NESTING_LIMIT, Parser};
use crate::error::{Expected, SyntaxErrorKind};
use crate::kind::{SenseDsl, SyntaxKind};
use crate::unit::Unit;
use rowan::{Checkpoint, Language, TextRange};

/// Builds an operand and returns its height.
pub(super) type Operand<'a> = fn(&mut Parser<'a>) -> usize;

impl<'a> Parser<'a> {
    pub(super) fn at_value(&self) -> bool {
        matches!(
            self.kind(),
            Some(
                SyntaxKind::Ident
                    | SyntaxKind::Int
                    | SyntaxKind::Float
                    | SyntaxKind::Str
                    | SyntaxKind::LBracket
                    | SyntaxKind::LParen
                    | SyntaxKind::Plus
                    | SyntaxKind::Minus
                    // No value begins with these; a missing operand before them is reported there.
                    | SyntaxKind::Star
                    | SyntaxKind::Slash
                    | SyntaxKind::DotDot
            )
        )
    }

    /// An expression, or a range of two; the caller has checked that one begins here.
    pub(super) fn value(&mut self) -> usize {
        let start = self.checkpoint();
        let mut height = 0;
        if self.at(SyntaxKind::DotDot) {
            self.expected(Expected::Value);
        } else {
            height = self.expression();
        }
        if !self.at(SyntaxKind::DotDot) {
            return height;
        }
        self.start_at(start, SyntaxKind::Range);
        self.bump();
        height = height.max(self.operand(Self::expression, Expected::RangeEnd));
        self.finish();
        if self.at(SyntaxKind::DotDot) {
            self.expected(Expected::EndOfValue);
            self.skip_value();
        }
        height + 1
    }

    pub(super) fn expression(&mut self) -> usize {
        self.chain([SyntaxKind::Plus, SyntaxKind::Minus], Self::term)
    }

    fn term(&mut self) -> usize {
        self.chain([SyntaxKind::Star, SyntaxKind::Slash], Self::factor)
    }

    /// Operands separated by operators of one precedence.
    pub(super) fn chain(&mut self, operators: [SyntaxKind; 2], operand: Operand<'a>) -> usize {
        let start = self.checkpoint();
        let mut height = operand(self);
        while self.kind().is_some_and(|kind| operators.contains(&kind)) {
            if self.depth + height >= NESTING_LIMIT {
                self.too_deep();
                break;
            }
            self.start_at(start, SyntaxKind::Binary);
            self.bump();
            self.depth += 1;
            height = 1 + height.max(self.operand(operand, Expected::Value));
            self.depth -= 1;
            self.finish();
        }
        height
    }

    /// The operand that must follow an operator, a sign, a `(` or a `..`. The next statement is not
    /// taken for one.
    pub(super) fn operand(&mut self, parse: Operand<'a>, expected: Expected) -> usize {
        let begins = self.at_value() && !self.at(SyntaxKind::DotDot);
        if begins && !(self.begins_line() && self.at_item()) {
            return parse(self);
        }
        self.expected(expected);
        0
    }

    fn factor(&mut self) -> usize {
        let at_operator =
            |parser: &Self| parser.at(SyntaxKind::Star) || parser.at(SyntaxKind::Slash);
        if at_operator(self) {
            self.expected(Expected::Value);
            self.start(SyntaxKind::Error);
            while at_operator(self) {
                self.bump();
            }
            self.finish();
        }
        match self.kind() {
            Some(SyntaxKind::Ident) if self.at_raw() => self.number(),
            Some(SyntaxKind::Ident) => self.name_value(),
            Some(SyntaxKind::Str) => {
                self.start(SyntaxKind::StringValue);
                self.bump();
                self.finish();
            }
            Some(SyntaxKind::Int | SyntaxKind::Float) => self.number(),
            Some(SyntaxKind::LBracket) => return self.list(),
            Some(SyntaxKind::LParen) => return self.parentheses(),
            Some(SyntaxKind::Plus | SyntaxKind::Minus) => return self.signed(),
            Some(_) | None => self.expected(Expected::Value),
        }
        0
    }

    fn name_value(&mut self) {
        let has_hyphen = self.name_end(0) > 1;
        self.start(SyntaxKind::NameValue);
        self.name(Expected::Value);
        self.finish();
        if !self.at_unit() {
        } else if has_hyphen {
            // The unit in `N-5 ms`, which is reported as a hyphen.
            self.bump_error();
        } else {
            self.unit_alone();
        }
    }

    /// Whether a code follows: `raw 307`, `raw -20`.
    pub(super) fn at_raw(&self) -> bool {
        let is_number = |n| self.nth_at(n, SyntaxKind::Int) || self.nth_at(n, SyntaxKind::Float);
        let is_sign = self.nth_at(1, SyntaxKind::Plus) || self.nth_at(1, SyntaxKind::Minus);
        self.nth_word(0, "raw") && (is_number(1) || (is_sign && self.touches(2) && is_number(2)))
    }

    /// A number, at its `raw`, its sign or its digits.
    pub(super) fn number(&mut self) {
        self.start(SyntaxKind::Number);
        if self.at(SyntaxKind::Ident) {
            self.bump_as(SyntaxKind::RawKw);
        }
        if self.at(SyntaxKind::Plus) || self.at(SyntaxKind::Minus) {
            self.bump();
        }
        self.bump();
        self.unit();
        self.finish();
    }

    /// A sign and its number, or a sign and another operand.
    fn signed(&mut self) -> usize {
        if self.nth_at(1, SyntaxKind::Int) || self.nth_at(1, SyntaxKind::Float) {
            self.number();
            return 0;
        }
        self.nested(SyntaxKind::Signed, |parser, _| parser.operand(Self::factor, Expected::Value))
    }

    /// A node that begins with this token and contains expressions. `inside` gets the token, and
    /// returns their height.
    pub(super) fn nested(
        &mut self,
        kind: SyntaxKind,
        inside: impl FnOnce(&mut Self, TextRange) -> usize,
    ) -> usize {
        if self.depth >= NESTING_LIMIT {
            self.too_deep();
            return 0;
        }
        self.depth += 1;
        self.start(kind);
        let open = self.here();
        self.bump();
        let height = inside(self, open);
        self.finish();
        self.depth -= 1;
        height + 1
    }

    /// `(EXPRESSION)`, at the `(`.
    fn parentheses(&mut self) -> usize {
        let height = self.nested(SyntaxKind::Paren, |parser, open| {
            let height = parser.operand(Self::expression, Expected::Value);
            if parser.at(SyntaxKind::Comma) && parser.closes_soon() {
                parser.complain(SyntaxErrorKind::ParenthesesAroundList, open);
                parser.start(SyntaxKind::Error);
                while parser.kind().is_some() && !parser.at(SyntaxKind::RParen) {
                    parser.bump();
                }
                parser.finish();
            } else if parser.at(SyntaxKind::DotDot) {
                parser.expected(Expected::CloseParen);
                parser.skip_value();
            }
            if !parser.eat(SyntaxKind::RParen) {
                parser.complain(SyntaxErrorKind::MissingCloseParen { open }, parser.gap());
            }
            height
        });
        if height > 0 && self.at_unit() {
            self.unit_alone();
        }
        height
    }

    /// Whether a `)` follows before the value must end. The limit keeps this from taking quadratic
    /// time.
    fn closes_soon(&self) -> bool {
        let ends = |kind| {
            matches!(
                kind,
                SyntaxKind::RParen
                    | SyntaxKind::LParen
                    | SyntaxKind::RBracket
                    | SyntaxKind::Semicolon
                    | SyntaxKind::LBrace
                    | SyntaxKind::RBrace
            )
        };
        let end = (0..64).find_map(|n| self.nth(n).filter(|token| ends(token.kind)));
        end.is_some_and(|token| token.kind == SyntaxKind::RParen)
    }

    /// Takes the word after a number on its line as its unit, unless it begins the next statement.
    fn unit(&mut self) {
        let begins_next =
            self.begins_line() || (!self.touches(0) && (self.at_item() || self.at_joint()));
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

    /// Whether a unit follows on the same line, after something that is not a number.
    fn at_unit(&self) -> bool {
        let is_unit = self.at(SyntaxKind::Ident) && Unit::from_name(self.nth_text(0)).is_some();
        is_unit && !self.begins_line() && !self.at_item() && !self.at_joint()
    }

    fn unit_alone(&mut self) {
        let unit = self.nth_text(0).to_owned();
        self.complain(SyntaxErrorKind::UnitAlone { unit }, self.here());
        self.bump_error();
    }

    /// `[VALUE, ...]`, at the `[`.
    fn list(&mut self) -> usize {
        self.nested(SyntaxKind::List, |parser, open| {
            let height = parser.list_values();
            if !parser.eat(SyntaxKind::RBracket) {
                parser.complain(SyntaxErrorKind::MissingCloseBracket { open }, parser.gap());
            }
            height
        })
    }

    /// The values of a list, up to its `]` or to where a list without one must end.
    fn list_values(&mut self) -> usize {
        let mut height = 0;
        // The last comma, as long as no value has followed it.
        let mut comma = None;
        let mut after_value = false;
        loop {
            match self.kind() {
                Some(SyntaxKind::RBracket) => {
                    if let Some(comma) = comma {
                        self.complain(SyntaxErrorKind::TrailingComma, comma);
                    }
                    return height;
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
                    height = height.max(self.value());
                    comma = None;
                    after_value = true;
                }
                Some(_) | None => return height,
            }
        }
    }

    /// Skips the rest of a value that nests too deeply, without recursion.
    pub(super) fn too_deep(&mut self) {
        self.complain(SyntaxErrorKind::NestingTooDeep { limit: NESTING_LIMIT }, self.here());
        self.skip_value();
    }

    /// Skips the next token and everything up to the end of the value.
    fn skip_value(&mut self) {
        self.start(SyntaxKind::Error);
        let mut open = 0_usize;
        let ends = |kind: SyntaxKind| {
            matches!(kind, SyntaxKind::Semicolon | SyntaxKind::LBrace | SyntaxKind::RBrace)
        };
        while let Some(kind) = self.kind().filter(|kind| !ends(*kind)) {
            let closes = matches!(kind, SyntaxKind::RBracket | SyntaxKind::RParen);
            let ends_here = open == 0 && (closes || kind == SyntaxKind::Comma);
            if ends_here || (self.begins_line() && self.at_item()) {
                break;
            }
            if closes {
                open -= 1;
            } else if matches!(kind, SyntaxKind::LBracket | SyntaxKind::LParen) {
                open += 1;
            }
            self.bump();
        }
        self.finish();
    }

    /// A place where a node may begin later; the trivia before it stays outside.
    pub(super) fn checkpoint(&mut self) -> Checkpoint {
        self.build_trivia();
        self.builder.checkpoint()
    }

    pub(super) fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        self.builder.start_node_at(checkpoint, SenseDsl::kind_to_raw(kind));
    }
}
