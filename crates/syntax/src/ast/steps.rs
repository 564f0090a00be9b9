//! Views over controllers, tests, their steps and conditions.

use super::node::{AstNode, children, choice, nodes, token};
use super::values::{
    Name, NameValue, Number, Operator, Paren, Property, Range, Signed, Value, name, names, operand,
    sign,
};
use super::{Rule, Sign};
use crate::kind::{SyntaxKind, SyntaxNode, SyntaxToken};

nodes! {
    /// `controller NAME every TIME { ... }`
    Controller = Controller {
        /// The properties.
        properties: Property,
        /// The rules.
        rules: Rule,
    };
    /// `test NAME { ... }`
    Test = Test {
        /// The properties.
        properties: Property,
        /// What happens and what must hold, in order.
        steps: Step,
    };
    /// `at TIME set NAME = VALUE;`
    SetStep = SetStep;
    /// `fault KIND [of DEVICE] at TIME [for TIME];`
    FaultStep = FaultStep;
    /// `always CONDITION ...;`
    AlwaysRule = AlwaysRule;
    /// `never CONDITION ...;`
    NeverRule = NeverRule;
    /// `eventually CONDITION ...;`
    EventuallyRule = EventuallyRule;
    /// `when CONDITION then CONDITION ...;`
    WhenRule = WhenRule;
    /// `within TIME`, `from TIME`, `to TIME`, and `for TIME` of a fault.
    Clause = Clause;
    /// Two quantities and how they are compared.
    Compare = Compare;
    /// `VALUE in FIRST .. LAST`
    Inside = Inside;
    /// Two conditions with `and` or `or` between them.
    Logic = Logic;
    /// `not CONDITION`
    Not = Not;
    /// `NAME[INDEX]`
    Index = Index;
    /// `NAME(ARGUMENT, ...)`
    Call = Call {
        /// The arguments.
        arguments: Condition,
    };
    /// `NAME.WORD`
    Member = Member;
    /// Two quantities with an operator between them.
    Operation = Binary;
}
choice!(
    /// A step of a test.
    Step {
        /// The host sets an actuator.
        Set(SetStep),
        /// Something breaks.
        Fault(FaultStep),
        /// What holds all the time.
        Always(AlwaysRule),
        /// What never holds.
        Never(NeverRule),
        /// What holds at some time.
        Eventually(EventuallyRule),
        /// What follows what.
        When(WhenRule),
    }
);
choice!(
    /// What stands in a condition: it is true or false, or a quantity.
    Condition {
        /// `and`, `or`.
        Logic(Logic),
        /// `not`.
        Not(Not),
        /// A comparison.
        Compare(Compare),
        /// A range that a quantity is in.
        Inside(Inside),
        /// `+`, `-`, `*`, `/`.
        Operation(Operation),
        /// A sign before something other than digits.
        Signed(Signed),
        /// Something in parentheses.
        Paren(Paren),
        /// A number with its unit.
        Number(Number),
        /// A device or a constant.
        Name(NameValue),
        /// An element of a device.
        Index(Index),
        /// A function.
        Call(Call),
        /// A word about a controller.
        Member(Member),
    }
);

/// How two quantities are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Comparison {
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    Greater,
    /// `>=`
    AtLeast,
    /// `==`
    Equal,
    /// `!=`
    Unequal,
}

impl Comparison {
    const ALL: [(SyntaxKind, Self); 6] = [
        (SyntaxKind::Lt, Self::Less),
        (SyntaxKind::LtEq, Self::AtMost),
        (SyntaxKind::Gt, Self::Greater),
        (SyntaxKind::GtEq, Self::AtLeast),
        (SyntaxKind::EqEq, Self::Equal),
        (SyntaxKind::NotEq, Self::Unequal),
    ];
}

impl Controller {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// Its cycle.
    #[must_use]
    pub fn every(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

impl Test {
    /// The name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
}

impl SetStep {
    /// When.
    #[must_use]
    pub fn at(&self) -> Option<Value> {
        let set = token(&self.0, SyntaxKind::SetKw)?;
        operand(&self.0, &set, true)
    }
    /// The actuator.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The value.
    #[must_use]
    pub fn value(&self) -> Option<Value> {
        let set = token(&self.0, SyntaxKind::SetKw)?;
        operand(&self.0, &set, false)
    }
}

impl FaultStep {
    /// What breaks.
    #[must_use]
    pub fn kind(&self) -> Option<Name> {
        children(&self.0).next().and_then(|value: NameValue| value.name())
    }
    /// The device that it is about.
    #[must_use]
    pub fn device(&self) -> Option<Name> {
        let of = token(&self.0, SyntaxKind::OfKw)?;
        let mut names = children(&self.0);
        let after = |value: &NameValue| value.range().start() > of.text_range().start();
        names.find(after).and_then(|value: NameValue| value.name())
    }
    /// When it begins.
    #[must_use]
    pub fn at(&self) -> Option<Value> {
        let at = token(&self.0, SyntaxKind::AtKw)?;
        operand(&self.0, &at, false)
    }
    /// How long it lasts.
    #[must_use]
    pub fn lasts(&self) -> Option<Value> {
        clause(&self.0, SyntaxKind::ForKw)
    }
}

/// Gives views over rules what all of them have.
macro_rules! rules {
    ($($view:ident),+) => { $(
        impl $view {
            /// The condition.
            #[must_use]
            pub fn condition(&self) -> Option<Condition> {
                children(&self.0).next()
            }
            /// The time after `within`.
            #[must_use]
            pub fn within(&self) -> Option<Value> {
                clause(&self.0, SyntaxKind::WithinKw)
            }
            /// The time after `from`.
            #[must_use]
            pub fn from(&self) -> Option<Value> {
                clause(&self.0, SyntaxKind::FromKw)
            }
            /// The time after `to`.
            #[must_use]
            pub fn to(&self) -> Option<Value> {
                clause(&self.0, SyntaxKind::ToKw)
            }
        }
    )+ };
}

rules!(AlwaysRule, NeverRule, EventuallyRule, WhenRule);

impl WhenRule {
    /// The condition after `then`.
    #[must_use]
    pub fn then(&self) -> Option<Condition> {
        let then = token(&self.0, SyntaxKind::ThenKw)?;
        side(&self.0, &then, false)
    }
}

impl Clause {
    /// The time.
    #[must_use]
    pub fn time(&self) -> Option<Value> {
        children(&self.0).next()
    }
}

impl Compare {
    /// How.
    #[must_use]
    pub fn comparison(&self) -> Option<Comparison> {
        self.operator().map(|found| found.0)
    }
    /// The left side.
    #[must_use]
    pub fn left(&self) -> Option<Condition> {
        side(&self.0, &self.operator()?.1, true)
    }
    /// The right side.
    #[must_use]
    pub fn right(&self) -> Option<Condition> {
        side(&self.0, &self.operator()?.1, false)
    }
    fn operator(&self) -> Option<(Comparison, SyntaxToken)> {
        let of = |(kind, how)| token(&self.0, kind).map(|token| (how, token));
        Comparison::ALL.into_iter().find_map(of)
    }
}

impl Inside {
    /// The quantity.
    #[must_use]
    pub fn value(&self) -> Option<Condition> {
        children(&self.0).next()
    }
    /// The range.
    #[must_use]
    pub fn range_of(&self) -> Option<Range> {
        children(&self.0).next()
    }
}

impl Logic {
    /// Whether both must hold.
    #[must_use]
    pub fn is_and(&self) -> bool {
        token(&self.0, SyntaxKind::AndKw).is_some()
    }
    /// The left side.
    #[must_use]
    pub fn left(&self) -> Option<Condition> {
        side(&self.0, &self.word()?, true)
    }
    /// The right side.
    #[must_use]
    pub fn right(&self) -> Option<Condition> {
        side(&self.0, &self.word()?, false)
    }
    fn word(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::AndKw).or_else(|| token(&self.0, SyntaxKind::OrKw))
    }
}

impl Not {
    /// The condition.
    #[must_use]
    pub fn condition(&self) -> Option<Condition> {
        children(&self.0).next()
    }
}

impl Index {
    /// The device.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The element, counted from 0.
    #[must_use]
    pub fn index(&self) -> Option<Condition> {
        children(&self.0).next()
    }
}

impl Call {
    /// The function.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
}

impl Member {
    /// What the word is about.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The word.
    #[must_use]
    pub fn word(&self) -> Option<Name> {
        names(&self.0).nth(1)
    }
}

impl Operation {
    /// The operator.
    #[must_use]
    pub fn operator(&self) -> Option<Operator> {
        self.operator_and_token().map(|found| found.0)
    }
    /// The left operand.
    #[must_use]
    pub fn left(&self) -> Option<Condition> {
        side(&self.0, &self.operator_and_token()?.1, true)
    }
    /// The right operand.
    #[must_use]
    pub fn right(&self) -> Option<Condition> {
        side(&self.0, &self.operator_and_token()?.1, false)
    }
    fn operator_and_token(&self) -> Option<(Operator, SyntaxToken)> {
        let of = |(kind, operator)| token(&self.0, kind).map(|token| (operator, token));
        Operator::ALL.into_iter().find_map(of)
    }
}

impl Signed {
    /// What the sign stands before, in a condition.
    #[must_use]
    pub fn condition(&self) -> Option<Condition> {
        children(self.syntax()).next()
    }
    /// Whether the sign is a minus.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        sign(self.syntax()) == Some(Sign::Minus)
    }
}

impl Paren {
    /// What stands in the parentheses, in a condition.
    #[must_use]
    pub fn condition(&self) -> Option<Condition> {
        children(self.syntax()).next()
    }
}

fn clause(node: &SyntaxNode, keyword: SyntaxKind) -> Option<Value> {
    let mut clauses = children(node);
    clauses.find(|one: &Clause| token(&one.0, keyword).is_some()).and_then(|one| one.time())
}

/// The condition on one side of a token.
fn side(node: &SyntaxNode, middle: &SyntaxToken, before: bool) -> Option<Condition> {
    let start = middle.text_range().start();
    children(node).find(|value: &Condition| (value.range().start() < start) == before)
}
