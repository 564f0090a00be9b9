//! The heads of blocks: everything between the keyword and the `{`.

use super::Parser;
use crate::error::{Block, Expected, Item, SyntaxErrorKind};
use crate::kind::SyntaxKind;

impl Parser<'_> {
    pub(super) fn board(&mut self, spare: bool) {
        self.start(SyntaxKind::Board);
        if spare {
            self.bump_as(SyntaxKind::SpareKw);
            self.keyword("board", SyntaxKind::BoardKw);
        } else {
            self.bump_as(SyntaxKind::BoardKw);
        }
        // `board on X {` lacks its name; `board on {` is named `on`.
        let source = |n| self.nth_at(n, SyntaxKind::Ident) || self.nth_at(n, SyntaxKind::Str);
        if self.at_word("on") && source(1) && !self.nth_word(1, "on") {
            self.expected(Expected::NameOf(Item::Board));
        } else {
            self.name(Expected::NameOf(Item::Board));
        }
        if self.at_word("on") {
            self.start(SyntaxKind::OnClause);
            self.bump_as(SyntaxKind::OnKw);
            if !self.eat(SyntaxKind::Str) {
                self.name(Expected::BoardSource);
            }
            self.finish();
        }
        self.body(Block::Board);
        self.finish();
    }

    pub(super) fn link(&mut self) {
        self.start(SyntaxKind::Link);
        self.bump_as(SyntaxKind::LinkKw);
        self.body(Block::Link);
        self.finish();
    }

    pub(super) fn chip(&mut self) {
        self.start(SyntaxKind::Chip);
        self.bump_as(SyntaxKind::ChipKw);
        self.name(Expected::NameOf(Item::Chip));
        self.body(Block::Chip);
        self.finish();
    }

    /// A block with a type: a sensor, an actuator, a reading or a command.
    pub(super) fn valued(&mut self, block: Block) {
        let (node, item, first) = if block == Block::Reading {
            (SyntaxKind::Reading, Item::Reading, SyntaxKind::ReadingKw)
        } else if block == Block::Command {
            (SyntaxKind::Command, Item::Command, SyntaxKind::CommandKw)
        } else if block == Block::Actuator {
            (SyntaxKind::Device, Item::Actuator, SyntaxKind::ActuatorKw)
        } else {
            (SyntaxKind::Device, Item::Sensor, SyntaxKind::SensorKw)
        };
        let (verb, verb_kind) = if matches!(item, Item::Sensor | Item::Reading) {
            ("returns", SyntaxKind::ReturnsKw)
        } else {
            ("accepts", SyntaxKind::AcceptsKw)
        };
        self.start(node);
        let (keyword, name) = (self.nth_text(0), self.nth_text(1));
        self.bump_as(first);
        let verb_at = |n| self.nth_word(n, "returns") || self.nth_word(n, "accepts");
        if verb_at(0) && !verb_at(1) {
            self.expected(Expected::NameOf(item));
        } else {
            self.name(Expected::NameOf(item));
        }
        if self.at_pin() {
            let of = if verb == "accepts" { "bool" } else { "uint16" };
            self.pin_in_head(block, format!("{keyword} {name} {verb} {of}"));
        } else {
            self.keyword(verb, verb_kind);
            self.data_type();
            self.body(block);
        }
        self.finish();
    }

    /// Whether a pin is in the place of a type, as in a wiring list: `sensor Front on PA0`.
    fn at_pin(&self) -> bool {
        let is_at = ["on", "at", "pin"].iter().any(|word| self.at_word(word));
        let is_pin = self.nth_at(1, SyntaxKind::Ident) && !self.nth_begins_line(1);
        is_at && is_pin && !self.begins_line()
    }

    /// The pin, reported once, and the block or the `;` after it.
    fn pin_in_head(&mut self, block: Block, head: String) {
        let pin = self.nth_text(1).to_owned();
        self.report(SyntaxErrorKind::PinInHead { head, pin }, self.here());
        self.start(SyntaxKind::Error);
        self.bump();
        self.bump();
        self.finish();
        if self.at(SyntaxKind::LBrace) {
            self.body(block);
        } else {
            self.eat(SyntaxKind::Semicolon);
        }
    }

    /// A block that may be for a kind: a driver or a connection.
    pub(super) fn wired(&mut self, block: Block) {
        let (node, item, first) = if block == Block::Driver {
            (SyntaxKind::Driver, Item::Driver, SyntaxKind::DriverKw)
        } else {
            (SyntaxKind::Connection, Item::Connection, SyntaxKind::ConnectionKw)
        };
        self.start(node);
        self.bump_as(first);
        if self.at_word("for") && !self.nth_word(1, "for") {
            self.expected(Expected::NameOf(item));
        } else {
            self.name(Expected::NameOf(item));
        }
        // A word on the same line is a kind without its `for`, or a misspelled `for`.
        if self.at_word("for") || (self.at(SyntaxKind::Ident) && !self.begins_line()) {
            self.keyword("for", SyntaxKind::ForKw);
            self.start(SyntaxKind::Kind);
            self.name(Expected::Kind);
            self.finish();
        }
        self.body(block);
        self.finish();
    }

    /// `controller NAME every TIME { ... }`
    pub(super) fn controller(&mut self) {
        self.start(SyntaxKind::Controller);
        self.bump_as(SyntaxKind::ControllerKw);
        if self.at_word("every") && !self.nth_word(1, "every") {
            self.expected(Expected::NameOf(Item::Controller));
        } else {
            self.name(Expected::NameOf(Item::Controller));
        }
        self.keyword("every", SyntaxKind::EveryKw);
        self.time();
        self.body(Block::Controller);
        self.finish();
    }

    /// `test NAME { ... }`
    pub(super) fn test(&mut self) {
        self.start(SyntaxKind::Test);
        self.bump_as(SyntaxKind::TestKw);
        self.name(Expected::NameOf(Item::Test));
        self.body(Block::Test);
        self.finish();
    }

    /// A keyword within a head. Another word in its place is skipped.
    pub(super) fn keyword(&mut self, word: &'static str, kind: SyntaxKind) {
        if self.at_word(word) {
            self.bump_as(kind);
            return;
        }
        self.expected(Expected::Keyword(word));
        let next_is_word = self.nth_at(1, SyntaxKind::Ident) && !self.nth_begins_line(1);
        if self.at(SyntaxKind::Ident) && next_is_word && !self.begins_line() {
            self.bump_error();
        }
    }
}
