//! Conditions of tests: what is true or false of values at a moment.
//!
//! From the loosest to the tightest: `or`, `and`, `not`, one comparison, `+` and `-`, `*` and `/`. Like those of
//! expressions, functions return the height of the tree that they have built.

use super::expressions::Operand;
use super::{NESTING_LIMIT, Parser};
use crate::error::{Block, Expected, SyntaxErrorKind};
use crate::kind::SyntaxKind;
use crate::lexer::JOINTS;

impl<'a> Parser<'a> {
    /// Whether a word of a test that joins its pieces follows.
    pub(super) fn at_joint(&self) -> bool {
        self.block == Block::Test && JOINTS.iter().any(|word| self.at_word(word))
    }

    pub(super) fn condition(&mut self) -> usize {
        self.logic("or", SyntaxKind::OrKw, Self::conjunction)
    }

    fn conjunction(&mut self) -> usize {
        self.logic("and", SyntaxKind::AndKw, Self::negation)
    }

    /// Conditions with a word between them.
    fn logic(&mut self, word: &str, keyword: SyntaxKind, operand: Operand<'a>) -> usize {
        let start = self.checkpoint();
        let mut height = operand(self);
        while self.at_word(word) {
            if self.depth + height >= NESTING_LIMIT {
                self.too_deep();
                break;
            }
            self.start_at(start, SyntaxKind::Logic);
            self.bump_as(keyword);
            self.depth += 1;
            height = 1 + height.max(self.operand(operand, Expected::Condition));
            self.depth -= 1;
            self.finish();
        }
        height
    }

    fn negation(&mut self) -> usize {
        if !self.at_word("not") {
            return self.comparison();
        }
        if self.depth >= NESTING_LIMIT {
            self.too_deep();
            return 0;
        }
        self.depth += 1;
        self.start(SyntaxKind::Not);
        self.bump_as(SyntaxKind::NotKw);
        let height = self.operand(Self::negation, Expected::Condition);
        self.finish();
        self.depth -= 1;
        height + 1
    }

    fn comparison(&mut self) -> usize {
        use SyntaxKind::{EqEq, Gt, GtEq, Lt, LtEq, NotEq};
        let start = self.checkpoint();
        let height = self.quantity();
        if self.at_word("in") {
            self.start_at(start, SyntaxKind::Inside);
            self.bump_as(SyntaxKind::InKw);
            let range = self.operand(Self::value, Expected::Value);
            self.finish();
            return 1 + height.max(range);
        }
        let is_slip = self.at(SyntaxKind::Eq);
        if is_slip {
            self.report(SyntaxErrorKind::SingleEquals, self.here());
        }
        if !is_slip && !matches!(self.kind(), Some(EqEq | Gt | GtEq | Lt | LtEq | NotEq)) {
            return height;
        }
        self.start_at(start, SyntaxKind::Compare);
        self.bump();
        let other = self.operand(Self::quantity, Expected::Value);
        self.finish();
        1 + height.max(other)
    }

    fn quantity(&mut self) -> usize {
        self.chain([SyntaxKind::Plus, SyntaxKind::Minus], Self::product)
    }

    fn product(&mut self) -> usize {
        self.chain([SyntaxKind::Star, SyntaxKind::Slash], Self::atom)
    }

    fn atom(&mut self) -> usize {
        match self.kind() {
            Some(SyntaxKind::Ident) if self.at_raw() => self.number(),
            Some(SyntaxKind::Ident) => return self.signal(),
            Some(SyntaxKind::Int | SyntaxKind::Float) => self.number(),
            Some(SyntaxKind::LParen) => {
                return self.nested(SyntaxKind::Paren, |parser, open| {
                    let height = parser.operand(Self::condition, Expected::Condition);
                    parser.close_paren(open);
                    height
                });
            }
            Some(SyntaxKind::Plus | SyntaxKind::Minus) => {
                if self.nth_at(1, SyntaxKind::Int) || self.nth_at(1, SyntaxKind::Float) {
                    self.number();
                } else {
                    return self.nested(SyntaxKind::Signed, |parser, _| {
                        parser.operand(Self::atom, Expected::Value)
                    });
                }
            }
            Some(_) | None => self.expected(Expected::Value),
        }
        0
    }

    /// A device, one element of it, a word about it, or a function: `Line[3]`, `Follow.overruns`, `age(Front)`.
    fn signal(&mut self) -> usize {
        if self.depth >= NESTING_LIMIT {
            self.too_deep();
            return 0;
        }
        if self.nth_at(1, SyntaxKind::LBracket) {
            self.about(SyntaxKind::Index, Self::index)
        } else if self.nth_at(1, SyntaxKind::LParen) && self.touches(1) {
            self.about(SyntaxKind::Call, Self::arguments)
        } else if self.nth_at(1, SyntaxKind::Dot) {
            self.about(SyntaxKind::Member, Self::member)
        } else {
            self.about(SyntaxKind::NameValue, |_| 0)
        }
    }

    /// A node that begins with a name.
    fn about(&mut self, node: SyntaxKind, inside: Operand<'a>) -> usize {
        self.depth += 1;
        self.start(node);
        self.name(Expected::Value);
        let height = inside(self);
        self.finish();
        self.depth -= 1;
        height
    }

    /// `[INDEX]`, at the `[`.
    fn index(&mut self) -> usize {
        let open = self.here();
        self.bump();
        let height = self.operand(Self::quantity, Expected::Value);
        if !self.eat(SyntaxKind::RBracket) {
            self.complain(SyntaxErrorKind::MissingCloseBracket { open }, self.gap());
        }
        height + 1
    }

    /// `(ARGUMENT, ...)`, at the `(`.
    fn arguments(&mut self) -> usize {
        let open = self.here();
        self.bump();
        let mut height = self.operand(Self::condition, Expected::Value);
        while self.eat(SyntaxKind::Comma) {
            height = height.max(self.operand(Self::condition, Expected::Value));
        }
        self.close_paren(open);
        height + 1
    }

    /// `.WORD`, at the dot.
    fn member(&mut self) -> usize {
        self.bump();
        self.name(Expected::Value);
        1
    }

    fn close_paren(&mut self, open: rowan::TextRange) {
        if !self.eat(SyntaxKind::RParen) {
            self.complain(SyntaxErrorKind::MissingCloseParen { open }, self.gap());
        }
    }
}
