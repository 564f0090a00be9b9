//! Views over names, strings, numbers, lists, expressions, and the properties that have them.

use super::node::{AstNode, children, choice, nodes, token, tokens};
use crate::kind::{SyntaxKind, SyntaxNode, SyntaxToken};
use crate::{literal, unit::Unit};
use rowan::TextRange;

nodes! {
    /// A number with its sign and its unit.
    Number = Number;
    /// A name as a value.
    NameValue = NameValue;
    /// A string as a value.
    StringValue = StringValue;
    /// `[VALUE, ...]`
    List = List {
        /// The values.
        values: Value,
    };
    /// A sign before anything but the digits of a number: `-N`, `-(1 + N)`.
    Signed = Signed;
    /// `(EXPRESSION)`
    Paren = Paren;
    /// Two operands with an operator between them.
    Binary = Binary;
    /// `FIRST..LAST`
    Range = Range;
    /// `NAME = VALUE;`
    Property = Property;
}

choice!(
    /// The value of a property.
    Value {
        /// A number.
        Number(Number),
        /// A name: a pin, a kind, `true`.
        Name(NameValue),
        /// A text.
        String(StringValue),
        /// Several values.
        List(List),
        /// A sign and its operand.
        Signed(Signed),
        /// An expression in parentheses.
        Paren(Paren),
        /// An operation.
        Binary(Binary),
        /// A range. It can be in a list, but not in an operation.
        Range(Range),
    }
);

/// A name, as written in the text.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name(pub(super) SyntaxToken);

impl Name {
    /// The name.
    #[must_use]
    pub fn text(&self) -> &str {
        self.0.text()
    }
    /// The range of the name.
    #[must_use]
    pub fn range(&self) -> TextRange {
        self.0.text_range()
    }
    /// The token.
    #[must_use]
    pub fn token(&self) -> &SyntaxToken {
        &self.0
    }
    /// The name that was meant, with its range. A hyphen cuts a name short, which is a reported
    /// mistake: for `NUCLEO-F446RE` this is the whole name, and [`Name::text`] the first word.
    #[must_use]
    pub fn whole(&self) -> (String, TextRange) {
        let rest = self.0.next_sibling_or_token().and_then(rowan::NodeOrToken::into_node);
        let rest = rest.filter(|node| node.kind() == SyntaxKind::Error);
        match rest.filter(|node| node.text().char_at(0.into()) == Some('-')) {
            Some(rest) => {
                (format!("{}{}", self.0.text(), rest.text()), self.range().cover(rest.text_range()))
            }
            None => (self.0.text().to_owned(), self.range()),
        }
    }
}

/// A string, as written in the text.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct StringLiteral(pub(super) SyntaxToken);

impl StringLiteral {
    /// The content of the string: without the quotes, with escapes replaced.
    #[must_use]
    pub fn value(&self) -> String {
        literal::unescape(self.0.text())
    }
    /// The range of the string, including the quotes.
    #[must_use]
    pub fn range(&self) -> TextRange {
        self.0.text_range()
    }
    /// The token.
    #[must_use]
    pub fn token(&self) -> &SyntaxToken {
        &self.0
    }
}

/// The sign before a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sign {
    /// `+`
    Plus,
    /// `-`
    Minus,
}

/// A number without its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Magnitude {
    /// An exact integer.
    Integer(u64),
    /// A number with a fraction or an exponent; always finite.
    Float(f64),
}

impl Number {
    /// The sign, if one is written.
    #[must_use]
    pub fn sign(&self) -> Option<Sign> {
        sign(&self.0)
    }
    /// Whether it is a code, not a shown value: `raw 307`.
    #[must_use]
    pub fn is_raw(&self) -> bool {
        token(&self.0, SyntaxKind::RawKw).is_some()
    }
    /// The number without its sign; `None` if it is out of range, which is already an error.
    #[must_use]
    pub fn magnitude(&self) -> Option<Magnitude> {
        if let Some(digits) = token(&self.0, SyntaxKind::Int) {
            return literal::integer(digits.text()).map(Magnitude::Integer);
        }
        literal::float(token(&self.0, SyntaxKind::Float)?.text()).map(Magnitude::Float)
    }
    /// The digits as written, without sign and unit.
    #[must_use]
    pub fn digits(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::Int).or_else(|| token(&self.0, SyntaxKind::Float))
    }
    /// The unit; `None` also if there is no such unit, which is already an error.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        Unit::from_name(self.unit_token()?.text())
    }
    /// The unit as written.
    #[must_use]
    pub fn unit_token(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::Unit)
    }
}

impl StringValue {
    /// The string.
    #[must_use]
    pub fn literal(&self) -> Option<StringLiteral> {
        string(&self.0)
    }
}

/// The operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

impl Operator {
    pub(super) const ALL: [(SyntaxKind, Self); 4] = [
        (SyntaxKind::Plus, Self::Add),
        (SyntaxKind::Minus, Self::Subtract),
        (SyntaxKind::Star, Self::Multiply),
        (SyntaxKind::Slash, Self::Divide),
    ];
}

impl Signed {
    /// The sign.
    #[must_use]
    pub fn sign(&self) -> Option<Sign> {
        sign(&self.0)
    }
    /// The operand: a name, an expression in parentheses, or another signed value; the grammar also
    /// allows a text or a list, which cannot be negative.
    #[must_use]
    pub fn value(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

impl Paren {
    /// The expression.
    #[must_use]
    pub fn value(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

impl Binary {
    /// The operator.
    #[must_use]
    pub fn operator(&self) -> Option<Operator> {
        self.operator_and_token().map(|found| found.0)
    }
    /// The operator's token.
    #[must_use]
    pub fn operator_token(&self) -> Option<SyntaxToken> {
        self.operator_and_token().map(|found| found.1)
    }
    /// The left operand.
    #[must_use]
    pub fn left(&self) -> Option<Value> {
        operand(&self.0, &self.operator_token()?, true)
    }
    /// The right operand.
    #[must_use]
    pub fn right(&self) -> Option<Value> {
        operand(&self.0, &self.operator_token()?, false)
    }
    fn operator_and_token(&self) -> Option<(Operator, SyntaxToken)> {
        let of = |(kind, operator)| token(&self.0, kind).map(|token| (operator, token));
        Operator::ALL.into_iter().find_map(of)
    }
}

impl Range {
    /// The value before the `..`.
    #[must_use]
    pub fn first(&self) -> Option<Value> {
        operand(&self.0, &token(&self.0, SyntaxKind::DotDot)?, true)
    }
    /// The value after the `..`.
    #[must_use]
    pub fn last(&self) -> Option<Value> {
        operand(&self.0, &token(&self.0, SyntaxKind::DotDot)?, false)
    }
}

/// The value on one side of a token. The value on the other side may be missing.
pub(super) fn operand(node: &SyntaxNode, middle: &SyntaxToken, before: bool) -> Option<Value> {
    let start = middle.text_range().start();
    children(node).find(|value: &Value| (value.range().start() < start) == before)
}

pub(super) fn sign(node: &SyntaxNode) -> Option<Sign> {
    let plus = token(node, SyntaxKind::Plus).map(|_| Sign::Plus);
    plus.or_else(|| token(node, SyntaxKind::Minus).map(|_| Sign::Minus))
}

impl Property {
    /// The value.
    #[must_use]
    pub fn value(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

/// The identifiers of a node are names; keywords and units have other token kinds.
pub(super) fn names(node: &SyntaxNode) -> impl Iterator<Item = Name> + use<> {
    tokens(node, SyntaxKind::Ident).map(Name)
}

pub(super) fn name(node: &SyntaxNode) -> Option<Name> {
    names(node).next()
}

pub(super) fn string(node: &SyntaxNode) -> Option<StringLiteral> {
    token(node, SyntaxKind::Str).map(StringLiteral)
}
