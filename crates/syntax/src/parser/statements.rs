//! Statements that end with `;` (`use`, constants, properties and rules), and how to continue after
//! a broken one.

use super::Parser;
use super::items::RuleKeyword;
use crate::error::{Block, Expected, Item, SyntaxErrorKind};
use crate::kind::SyntaxKind;

/// Properties whose value may itself be a name with a value: `mux = Page = 3`. For any other
/// property, a second `=` belongs to the next property, and the `;` before it is missing.
const PAIRED: &[&str] = &["mux"];

impl Parser<'_> {
    pub(super) fn use_file(&mut self) {
        self.start(SyntaxKind::Use);
        self.bump_as(SyntaxKind::UseKw);
        if !self.eat(SyntaxKind::Str) {
            self.expected(Expected::FilePath);
        }
        self.end_statement();
        self.finish();
    }

    /// `const NAME = VALUE;`
    pub(super) fn constant(&mut self) {
        self.start(SyntaxKind::Const);
        self.bump_as(SyntaxKind::ConstKw);
        let is_next = self.begins_line() && self.at_item() && !self.at_property();
        if self.at(SyntaxKind::Ident) && !is_next {
            if self.nth_at(1, SyntaxKind::Ident) && self.nth_at(2, SyntaxKind::Eq) {
                // A type, as in other languages.
                self.expected(Expected::NameOf(Item::Const));
                self.bump_error();
            }
            self.assignment(Expected::NameOf(Item::Const));
        } else {
            self.expected(Expected::NameOf(Item::Const));
        }
        self.end_statement();
        self.finish();
    }

    pub(super) fn at_property(&self) -> bool {
        // In a test `==` compares; elsewhere it is a slip for `=`.
        let end = self.name_end(0);
        let is_slip = || self.block != Block::Test && self.nth_at(end, SyntaxKind::EqEq);
        self.at(SyntaxKind::Ident) && (self.nth_at(end, SyntaxKind::Eq) || is_slip())
    }

    /// `NAME = VALUE;`, at the name.
    pub(super) fn property(&mut self) {
        self.start(SyntaxKind::Property);
        self.assignment(Expected::PropertyName);
        self.end_statement();
        self.finish();
    }

    /// `NAME = VALUE`, at the name.
    pub(super) fn assignment(&mut self, expected: Expected) {
        let property = self.nth_text(0).to_owned();
        self.name(expected);
        let mut equals = self.eat(SyntaxKind::Eq);
        if !equals && self.at(SyntaxKind::EqEq) {
            self.report(SyntaxErrorKind::DoubledEquals, self.here());
            self.bump_error();
            equals = true;
        } else if equals && self.at(SyntaxKind::Eq) {
            self.expected(Expected::Value);
            self.bump_error();
        }
        if !equals {
            self.other_assignment(&property);
        }
        if !self.at_value() || (self.begins_line() && (!equals || self.at_item())) {
            self.complain(SyntaxErrorKind::MissingValue { property }, self.gap());
        } else {
            if !equals {
                self.complain(
                    SyntaxErrorKind::MissingEquals { property: property.clone() },
                    self.gap(),
                );
            }
            if PAIRED.contains(&property.as_str()) && self.at_property() {
                self.pair();
            } else {
                self.value();
            }
        }
    }

    /// `NAME = VALUE` as a value, which is a list of the two.
    fn pair(&mut self) {
        self.start(SyntaxKind::List);
        self.start(SyntaxKind::NameValue);
        self.name(Expected::Value);
        self.finish();
        self.eat(SyntaxKind::Eq);
        if self.at_value() {
            self.value();
        } else {
            self.expected(Expected::Value);
        }
        self.finish();
    }

    /// `->` and `+=` instead of `=`.
    fn other_assignment(&mut self, property: &str) {
        use SyntaxKind::{Gt, Minus, Plus, Slash, Star, Unknown};
        if !matches!(self.kind(), Some(Plus | Minus | Star | Slash)) || self.begins_line() {
            return;
        }
        if self.nth_at(1, SyntaxKind::Eq) && self.touches(1) {
            let property = property.to_owned();
            self.complain(SyntaxErrorKind::MissingEquals { property }, self.gap());
            self.start(SyntaxKind::Error);
            self.bump();
            self.bump();
            self.finish();
            self.complained = Some(self.consumed);
        } else if self.nth_at(1, Gt) && self.touches(1) {
            self.start(SyntaxKind::Error);
            self.bump();
            self.bump();
            self.finish();
        } else if self.trivia_before(1).iter().any(|token| token.kind == Unknown) {
            self.bump_error();
        }
    }

    pub(super) fn rule(&mut self, keyword: RuleKeyword) {
        let (node, kind) = match keyword {
            RuleKeyword::Prefer => (SyntaxKind::Prefer, SyntaxKind::PreferKw),
            RuleKeyword::Avoid => (SyntaxKind::Avoid, SyntaxKind::AvoidKw),
            RuleKeyword::Reserve => (SyntaxKind::Reserve, SyntaxKind::ReserveKw),
            RuleKeyword::Release => (SyntaxKind::Release, SyntaxKind::ReleaseKw),
            RuleKeyword::Allow => (SyntaxKind::Allow, SyntaxKind::AllowKw),
        };
        self.start(node);
        self.bump_as(kind);
        match keyword {
            RuleKeyword::Prefer | RuleKeyword::Avoid => {
                if self.at(SyntaxKind::Ident) {
                    self.property();
                } else {
                    self.expected(Expected::PropertyName);
                    self.end_statement();
                }
            }
            RuleKeyword::Reserve | RuleKeyword::Release => self.resource_names(),
            RuleKeyword::Allow => {
                if self.at(SyntaxKind::Str) {
                    self.expected(Expected::Code);
                } else {
                    self.name(Expected::Code);
                }
                if !self.eat(SyntaxKind::Str) {
                    self.expected(Expected::Reason);
                }
                self.end_statement();
            }
        }
        self.finish();
    }

    /// `NAME { , NAME } ;`
    fn resource_names(&mut self) {
        self.name(Expected::ResourceName);
        loop {
            let next_is_name = self.at(SyntaxKind::Ident) && !self.begins_line();
            if self.at(SyntaxKind::Comma) {
                let comma = self.here();
                self.bump();
                if self.at(SyntaxKind::Ident) && !(self.begins_line() && self.at_item()) {
                    self.name(Expected::ResourceName);
                } else if self.at(SyntaxKind::Comma) || !self.at_statement_end() {
                    self.expected(Expected::ResourceName);
                } else {
                    self.complain(SyntaxErrorKind::TrailingComma, comma);
                }
            } else if next_is_name && !self.at_item() {
                self.complain(SyntaxErrorKind::MissingComma, self.gap());
                self.name(Expected::ResourceName);
            } else {
                break;
            }
        }
        self.end_statement();
    }

    /// The `;` of a statement. Skips anything before it on the line.
    pub(super) fn end_statement(&mut self) {
        if self.eat(SyntaxKind::Semicolon) {
            return;
        }
        if self.at_statement_end() {
            self.complain(SyntaxErrorKind::MissingSemicolon, self.gap());
            return;
        }
        let (found, block) = (self.found(), self.block);
        if block == Block::File {
            self.expected(Expected::Semicolon);
        } else {
            self.complain(SyntaxErrorKind::StrayToken { found, block }, self.here());
        }
        self.start(SyntaxKind::Error);
        while !self.at_statement_end() {
            self.bump_group();
        }
        self.finish();
        self.eat(SyntaxKind::Semicolon);
    }

    /// Whether the next token cannot continue a statement.
    pub(super) fn at_statement_end(&self) -> bool {
        match self.kind() {
            None | Some(SyntaxKind::Semicolon | SyntaxKind::RBrace) => true,
            Some(_) => self.begins_line() || self.at_item(),
        }
    }

    /// Consumes one token, or a whole block.
    pub(super) fn bump_group(&mut self) {
        if self.at(SyntaxKind::LBrace) {
            self.bump_braces();
        } else {
            self.bump();
        }
    }

    /// Reports a token where an item should begin.
    pub(super) fn stray(&mut self) {
        let (found, block) = (self.found(), self.block);
        self.report(SyntaxErrorKind::StrayToken { found, block }, self.here());
        self.skip_statement();
    }

    /// Puts a statement or block that is not understood into an `Error` node.
    pub(super) fn skip_statement(&mut self) {
        self.start(SyntaxKind::Error);
        loop {
            let last = matches!(self.kind(), Some(SyntaxKind::Semicolon | SyntaxKind::LBrace));
            self.bump_group();
            if last {
                break;
            }
            // The block of an unknown item may begin on the next line.
            let ends = self.kind().is_none() || self.at(SyntaxKind::RBrace);
            let goes_on = self.at(SyntaxKind::LBrace) || !self.begins_line();
            if ends || !goes_on || self.at_item() {
                break;
            }
        }
        self.finish();
    }
}
