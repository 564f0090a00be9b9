//! The steps of a test: what is set, what breaks, and what must hold.

use super::Parser;
use super::items::StepKeyword;
use crate::error::{Expected, Item};
use crate::kind::SyntaxKind;

impl Parser<'_> {
    pub(super) fn step(&mut self, keyword: StepKeyword) {
        match keyword {
            StepKeyword::At => self.set_step(),
            StepKeyword::Fault => self.fault_step(),
            StepKeyword::Always => self.rule_step(SyntaxKind::AlwaysRule, SyntaxKind::AlwaysKw),
            StepKeyword::Never => self.rule_step(SyntaxKind::NeverRule, SyntaxKind::NeverKw),
            StepKeyword::Eventually => {
                self.rule_step(SyntaxKind::EventuallyRule, SyntaxKind::EventuallyKw);
            }
            StepKeyword::When => self.rule_step(SyntaxKind::WhenRule, SyntaxKind::WhenKw),
        }
    }

    /// A time: a number with its unit, or an expression.
    pub(super) fn time(&mut self) {
        if self.at_joint() {
            self.expected(Expected::Time);
        } else {
            let _ = self.operand(Self::expression, Expected::Time);
        }
    }

    /// `at TIME set NAME = VALUE;`
    fn set_step(&mut self) {
        self.start(SyntaxKind::SetStep);
        self.bump_as(SyntaxKind::AtKw);
        self.time();
        self.keyword("set", SyntaxKind::SetKw);
        if self.at(SyntaxKind::Ident) && !self.begins_line() {
            self.assignment(Expected::NameOf(Item::Actuator));
        } else {
            self.expected(Expected::NameOf(Item::Actuator));
        }
        self.end_statement();
        self.finish();
    }

    /// `fault KIND [of DEVICE] at TIME [for TIME];`
    fn fault_step(&mut self) {
        self.start(SyntaxKind::FaultStep);
        self.bump_as(SyntaxKind::FaultKw);
        self.named_value(Expected::Fault);
        if self.at_word("of") {
            self.bump_as(SyntaxKind::OfKw);
            self.named_value(Expected::NameOf(Item::Sensor));
        }
        self.keyword("at", SyntaxKind::AtKw);
        self.time();
        if self.at_word("for") {
            self.start(SyntaxKind::Clause);
            self.bump_as(SyntaxKind::ForKw);
            self.time();
            self.finish();
        }
        self.end_statement();
        self.finish();
    }

    fn named_value(&mut self, expected: Expected) {
        if self.at_joint() {
            self.expected(expected);
            return;
        }
        self.start(SyntaxKind::NameValue);
        self.name(expected);
        self.finish();
    }

    /// A keyword, a condition, of `when` a second one after `then`, and clauses of time.
    fn rule_step(&mut self, node: SyntaxKind, keyword: SyntaxKind) {
        self.start(node);
        self.bump_as(keyword);
        self.condition_of_step();
        if node == SyntaxKind::WhenRule {
            self.keyword("then", SyntaxKind::ThenKw);
            self.condition_of_step();
        }
        while let Some(kind) = self.clause_ahead() {
            self.start(SyntaxKind::Clause);
            self.bump_as(kind);
            self.time();
            self.finish();
        }
        self.end_statement();
        self.finish();
    }

    fn condition_of_step(&mut self) {
        let _ = self.operand(Self::condition, Expected::Condition);
    }

    fn clause_ahead(&self) -> Option<SyntaxKind> {
        let words = [
            ("within", SyntaxKind::WithinKw),
            ("from", SyntaxKind::FromKw),
            ("to", SyntaxKind::ToKw),
        ];
        words.into_iter().find(|(word, _)| self.at_word(word)).map(|(_, kind)| kind)
    }
}
