//! Blocks and their items: what begins an item, what is allowed where, and where an unclosed block
//! ends.

use sensedsl_diagnostics::{distance, nearest};

use super::{NESTING_LIMIT, Parser};
use crate::error::{Block, Expected, Item, SyntaxErrorKind};
use crate::kind::SyntaxKind;

/// A word that begins an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyword {
    Use,
    Const,
    Spare,
    Board,
    Chip,
    Sensor,
    Actuator,
    Driver,
    Connection,
    Reading,
    Command,
    Link,
    Controller,
    Test,
    Step(StepKeyword),
    Rule(RuleKeyword),
}

/// A word that begins a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RuleKeyword {
    Prefer,
    Avoid,
    Reserve,
    Release,
    Allow,
}

/// A word that begins a step of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepKeyword {
    At,
    Fault,
    Always,
    Never,
    Eventually,
    When,
}

const KEYWORDS: [(&str, Keyword); 25] = [
    ("use", Keyword::Use),
    ("const", Keyword::Const),
    ("spare", Keyword::Spare),
    ("board", Keyword::Board),
    ("chip", Keyword::Chip),
    ("sensor", Keyword::Sensor),
    ("actuator", Keyword::Actuator),
    ("driver", Keyword::Driver),
    ("connection", Keyword::Connection),
    ("reading", Keyword::Reading),
    ("command", Keyword::Command),
    ("link", Keyword::Link),
    ("controller", Keyword::Controller),
    ("test", Keyword::Test),
    ("at", Keyword::Step(StepKeyword::At)),
    ("fault", Keyword::Step(StepKeyword::Fault)),
    ("always", Keyword::Step(StepKeyword::Always)),
    ("never", Keyword::Step(StepKeyword::Never)),
    ("eventually", Keyword::Step(StepKeyword::Eventually)),
    ("when", Keyword::Step(StepKeyword::When)),
    ("prefer", Keyword::Rule(RuleKeyword::Prefer)),
    ("avoid", Keyword::Rule(RuleKeyword::Avoid)),
    ("reserve", Keyword::Rule(RuleKeyword::Reserve)),
    ("release", Keyword::Rule(RuleKeyword::Release)),
    ("allow", Keyword::Rule(RuleKeyword::Allow)),
];

impl Keyword {
    fn from_word(word: &str) -> Option<Self> {
        KEYWORDS.into_iter().find(|entry| entry.0 == word).map(|entry| entry.1)
    }

    /// The item that the word begins.
    fn item(self) -> Item {
        match self {
            Self::Use => Item::Use,
            Self::Const => Item::Const,
            Self::Chip => Item::Chip,
            Self::Connection => Item::Connection,
            Self::Reading => Item::Reading,
            Self::Command => Item::Command,
            Self::Spare | Self::Board => Item::Board,
            Self::Sensor => Item::Sensor,
            Self::Actuator => Item::Actuator,
            Self::Driver => Item::Driver,
            Self::Link => Item::Link,
            Self::Controller => Item::Controller,
            Self::Test => Item::Test,
            Self::Step(_) => Item::Step,
            Self::Rule(_) => Item::Rule,
        }
    }
}

/// Whether a block may hold an item.
fn allows(block: Block, item: Item) -> bool {
    match block {
        Block::File => {
            matches!(
                item,
                Item::Use
                    | Item::Const
                    | Item::Board
                    | Item::Driver
                    | Item::Chip
                    | Item::Sensor
                    | Item::Actuator
                    | Item::Test
            )
        }
        Block::Board => {
            matches!(
                item,
                Item::Sensor
                    | Item::Actuator
                    | Item::Chip
                    | Item::Rule
                    | Item::Property
                    | Item::Link
                    | Item::Controller
            )
        }
        Block::Chip => {
            matches!(
                item,
                Item::Sensor | Item::Actuator | Item::Connection | Item::Rule | Item::Property
            )
        }
        Block::Sensor | Block::Actuator | Block::Controller => {
            matches!(item, Item::Rule | Item::Property)
        }
        Block::Test => matches!(item, Item::Step | Item::Property),
        Block::Driver => {
            matches!(item, Item::Connection | Item::Reading | Item::Command | Item::Property)
        }
        Block::Connection | Block::Reading | Block::Command | Block::Link => item == Item::Property,
    }
}

impl Parser<'_> {
    pub(super) fn file(&mut self) {
        self.builder.start_node(rowan::SyntaxKind(SyntaxKind::SourceFile as u16));
        while self.kind().is_some() {
            if self.at(SyntaxKind::RBrace) {
                self.report(SyntaxErrorKind::StrayCloseBrace, self.here());
                self.bump_error();
            } else {
                self.item();
            }
        }
        self.build_trivia();
        self.finish();
    }

    /// `{`, items, `}`.
    pub(super) fn body(&mut self, block: Block) {
        if self.depth >= NESTING_LIMIT {
            self.complain(SyntaxErrorKind::NestingTooDeep { limit: NESTING_LIMIT }, self.here());
            if self.at(SyntaxKind::LBrace) {
                self.start(SyntaxKind::Error);
                self.bump_braces();
                self.finish();
            }
            return;
        }
        let open = self.here();
        if !self.open_brace() {
            return;
        }
        let outer = std::mem::replace(&mut self.block, block);
        self.depth += 1;
        self.items_of(block, open);
        self.depth -= 1;
        self.block = outer;
    }

    /// The `{` of a block. Returns whether items follow, even if the `{` itself is missing.
    fn open_brace(&mut self) -> bool {
        if self.eat(SyntaxKind::LBrace) {
            return true;
        }
        self.expected(Expected::OpenBrace);
        // Extra words before the `{`, on its line. The limit keeps this from taking quadratic time.
        let between = |parser: &Self, n: usize| {
            parser.nth(n).is_some_and(|token| {
                !matches!(
                    token.kind,
                    SyntaxKind::LBrace | SyntaxKind::RBrace | SyntaxKind::Semicolon
                )
            }) && !parser.nth_begins_line(n)
        };
        let count = (0..8).find(|&n| !between(self, n)).unwrap_or(8);
        if self.nth_at(count, SyntaxKind::LBrace) && !self.nth_begins_line(count) {
            self.start(SyntaxKind::Error);
            (0..count).for_each(|_| self.bump());
            self.finish();
            self.bump();
            return true;
        }
        if self.at(SyntaxKind::Eq) && !self.begins_line() {
            // `chip NAME = VALUE;`
            self.start(SyntaxKind::Error);
            while !self.at_statement_end() {
                self.bump_group();
            }
            self.finish();
        }
        !self.eat(SyntaxKind::Semicolon) && self.at_property()
    }

    fn items_of(&mut self, block: Block, open: rowan::TextRange) {
        while self.kind().is_some() {
            if self.eat(SyntaxKind::RBrace) {
                return;
            }
            if !self.item() {
                break;
            }
        }
        // The end of the file, or an item that shows that a `}` is missing before it.
        self.unclosed = self.unclosed.saturating_sub(1);
        self.report(SyntaxErrorKind::MissingCloseBrace { block, open }, self.gap());
    }

    /// Parses one item. Returns false, without consuming anything, if the block must end.
    fn item(&mut self) -> bool {
        if !self.at(SyntaxKind::Ident) {
            self.stray();
        } else if self.at_property() {
            if self.block == Block::File {
                let (item, block) = (Item::Property, Block::File);
                self.report(SyntaxErrorKind::NotAllowedHere { item, block }, self.here());
            }
            self.property();
        } else if let Some(keyword) = self.keyword_ahead() {
            return self.keyword_item(keyword);
        } else {
            self.unknown_item();
        }
        true
    }

    /// The keyword of the item that begins here, if any.
    fn keyword_ahead(&self) -> Option<Keyword> {
        let keyword = Keyword::from_word(self.nth_text(0))?;
        (allows(self.block, keyword.item()) || self.has_shape(keyword)).then_some(keyword)
    }

    /// Whether the tokens after the next word fit this keyword. This distinguishes a misspelled
    /// keyword from a property without `=`, and an item in the wrong block from a property with the
    /// same name.
    fn has_shape(&self, keyword: Keyword) -> bool {
        let ident = |n| self.nth_at(n, SyntaxKind::Ident);
        match keyword {
            Keyword::Use => self.nth_at(1, SyntaxKind::Str),
            Keyword::Const => ident(1) && self.nth_at(self.name_end(1), SyntaxKind::Eq),
            Keyword::Spare => self.nth_word(1, "board"),
            Keyword::Board => {
                let end = self.name_end(1);
                ident(1) && (self.nth_at(end, SyntaxKind::LBrace) || self.nth_word(end, "on"))
            }
            Keyword::Chip => ident(1) && self.nth_at(self.name_end(1), SyntaxKind::LBrace),
            Keyword::Sensor | Keyword::Actuator | Keyword::Reading | Keyword::Command => {
                let near = |verb: &str| distance(self.nth_text(2), verb) <= 2;
                ident(1) && ident(2) && (near("returns") || near("accepts"))
            }
            Keyword::Driver | Keyword::Connection => {
                let end = self.name_end(1);
                ident(1) && (self.nth_at(end, SyntaxKind::LBrace) || self.nth_word(end, "for"))
            }
            Keyword::Link => self.nth_at(1, SyntaxKind::LBrace),
            Keyword::Controller => ident(1) && self.nth_word(self.name_end(1), "every"),
            Keyword::Test => ident(1) && self.nth_at(self.name_end(1), SyntaxKind::LBrace),
            Keyword::Step(_) => self.block == Block::Test && !self.nth_at(1, SyntaxKind::Eq),
            Keyword::Rule(RuleKeyword::Prefer | RuleKeyword::Avoid) => {
                ident(1) && self.nth_at(2, SyntaxKind::Eq)
            }
            Keyword::Rule(RuleKeyword::Reserve | RuleKeyword::Release) => {
                let ends =
                    self.nth_at(2, SyntaxKind::Comma) || self.nth_at(2, SyntaxKind::Semicolon);
                ident(1) && ends
            }
            Keyword::Rule(RuleKeyword::Allow) => ident(1) && self.nth_at(2, SyntaxKind::Str),
        }
    }

    /// Whether a property or an item clearly begins here.
    pub(super) fn at_item(&self) -> bool {
        let keyword = || Keyword::from_word(self.nth_text(0));
        self.at_property() || keyword().is_some_and(|keyword| self.has_shape(keyword))
    }

    fn keyword_item(&mut self, keyword: Keyword) -> bool {
        let (item, block) = (keyword.item(), self.block);
        if !allows(block, item) {
            let is_block = !matches!(item, Item::Rule | Item::Step);
            if is_block && block != Block::File && self.unclosed > 0 {
                return false;
            }
            self.report(SyntaxErrorKind::NotAllowedHere { item, block }, self.here());
        }
        self.parse_item(keyword);
        true
    }

    fn parse_item(&mut self, keyword: Keyword) {
        match keyword {
            Keyword::Use => self.use_file(),
            Keyword::Const => self.constant(),
            Keyword::Spare | Keyword::Board => self.board(keyword == Keyword::Spare),
            Keyword::Chip => self.chip(),
            Keyword::Sensor => self.valued(Block::Sensor),
            Keyword::Actuator => self.valued(Block::Actuator),
            Keyword::Driver => self.wired(Block::Driver),
            Keyword::Connection => self.wired(Block::Connection),
            Keyword::Reading => self.valued(Block::Reading),
            Keyword::Command => self.valued(Block::Command),
            Keyword::Link => self.link(),
            Keyword::Controller => self.controller(),
            Keyword::Test => self.test(),
            Keyword::Step(step) => self.step(step),
            Keyword::Rule(rule) => self.rule(rule),
        }
    }

    /// Reports a word that is not a keyword and has no `=` after it.
    fn unknown_item(&mut self) {
        let (word, block) = (self.nth_text(0), self.block);
        let allowed = KEYWORDS.into_iter().filter(|entry| allows(block, entry.1.item()));
        let similar = nearest(word, allowed.map(|entry| entry.0))
            .or_else(|| nearest(word, KEYWORDS.map(|entry| entry.0)));
        // `int N = 5;`, `let N = 5;`
        let is_constant = block == Block::File && self.has_shape(Keyword::Const);
        let similar = if is_constant { Some("const") } else { similar };
        let unknown =
            SyntaxErrorKind::UnknownItem { found: word.to_owned(), suggestion: similar, block };
        let keyword = similar.and_then(Keyword::from_word);
        if let Some(keyword) = keyword.filter(|&keyword| self.has_shape(keyword)) {
            self.report(unknown, self.here());
            self.parse_item(keyword);
        } else if block != Block::File && self.at_broken_property() {
            self.property();
        } else {
            self.report(unknown, self.here());
            self.skip_statement();
        }
    }

    /// Whether this word is more likely a property without `=` or value than an unknown item.
    fn at_broken_property(&self) -> bool {
        let end = self.name_end(0);
        let Some(next) = self.nth(end) else { return true };
        if self.nth_begins_line(end) {
            return next.kind != SyntaxKind::LBrace;
        }
        if next.kind == SyntaxKind::Ident {
            let end = self.name_end(end);
            let more = self.nth_at(end, SyntaxKind::Ident) || self.nth_at(end, SyntaxKind::LBrace);
            return !more || self.nth_begins_line(end);
        }
        next.kind != SyntaxKind::LBrace
    }
}
