//! Blocks and their items: what begins an item, what may stand where, and where a block ends that
//! was never closed.

use super::{NESTING_LIMIT, Parser};
use crate::error::{Block, Expected, Item, SyntaxErrorKind};
use crate::kind::SyntaxKind;
use crate::suggest;

/// A word that begins an item.
#[derive(Clone, Copy)]
pub(super) struct Keyword {
    word: &'static str,
    kind: SyntaxKind,
    item: Item,
}

const fn keyword(word: &'static str, kind: SyntaxKind, item: Item) -> Keyword {
    Keyword { word, kind, item }
}

const KEYWORDS: [Keyword; 12] = [
    keyword("use", SyntaxKind::UseKw, Item::Use),
    keyword("spare", SyntaxKind::SpareKw, Item::Board),
    keyword("board", SyntaxKind::BoardKw, Item::Board),
    keyword("sensor", SyntaxKind::SensorKw, Item::Sensor),
    keyword("actuator", SyntaxKind::ActuatorKw, Item::Actuator),
    keyword("driver", SyntaxKind::DriverKw, Item::Driver),
    keyword("link", SyntaxKind::LinkKw, Item::Link),
    keyword("prefer", SyntaxKind::PreferKw, Item::Rule),
    keyword("avoid", SyntaxKind::AvoidKw, Item::Rule),
    keyword("reserve", SyntaxKind::ReserveKw, Item::Rule),
    keyword("release", SyntaxKind::ReleaseKw, Item::Rule),
    keyword("allow", SyntaxKind::AllowKw, Item::Rule),
];

/// Whether a block may hold an item.
fn allows(block: Block, item: Item) -> bool {
    match block {
        Block::File => {
            matches!(item, Item::Use | Item::Board | Item::Driver | Item::Sensor | Item::Actuator)
        }
        Block::Board => {
            matches!(item, Item::Sensor | Item::Actuator | Item::Rule | Item::Property | Item::Link)
        }
        Block::Sensor | Block::Actuator => matches!(item, Item::Rule | Item::Property),
        Block::Driver | Block::Link => item == Item::Property,
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
    fn body(&mut self, block: Block) {
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

    /// The `{` of a block. Returns whether items follow, be it that the `{` itself is missing.
    fn open_brace(&mut self) -> bool {
        if self.eat(SyntaxKind::LBrace) {
            return true;
        }
        self.expected(Expected::OpenBrace);
        // Words too many before the `{`, on its line.
        let between = |parser: &Self, n: usize| {
            parser.nth(n).is_some_and(|token| {
                !matches!(
                    token.kind,
                    SyntaxKind::LBrace | SyntaxKind::RBrace | SyntaxKind::Semicolon
                )
            }) && !parser.nth_begins_line(n)
        };
        let count = (0..).find(|&n| !between(self, n)).unwrap_or_default();
        if self.nth_at(count, SyntaxKind::LBrace) && !self.nth_begins_line(count) {
            self.start(SyntaxKind::Error);
            (0..count).for_each(|_| self.bump());
            self.finish();
            self.bump();
            return true;
        }
        !self.eat(SyntaxKind::Semicolon) && self.at_property()
    }

    fn items_of(&mut self, block: Block, open: rowan::TextRange) {
        loop {
            match self.kind() {
                Some(SyntaxKind::RBrace) => {
                    self.bump();
                    return;
                }
                Some(_) if self.item() => {}
                // The end of the file, or an item that shows that a `}` is missing before it.
                Some(_) | None => {
                    self.unclosed = self.unclosed.saturating_sub(1);
                    let kind = SyntaxErrorKind::MissingCloseBrace { block, open };
                    self.report(kind, self.gap());
                    return;
                }
            }
        }
    }

    /// Parses one item. Returns false, without consuming anything, where the block must end.
    fn item(&mut self) -> bool {
        self.complained = None;
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

    /// The keyword of the item that begins here, if one does.
    fn keyword_ahead(&self) -> Option<Keyword> {
        let word = self.nth_text(0);
        let keyword = KEYWORDS.into_iter().find(|keyword| keyword.word == word)?;
        (allows(self.block, keyword.item) || self.has_shape(keyword)).then_some(keyword)
    }

    /// Whether what follows the next word is as it must be after this keyword. With this a misspelled
    /// keyword is told from a property without `=`, and an item in the wrong block from a property
    /// of the same name.
    fn has_shape(&self, keyword: Keyword) -> bool {
        let ident = |n| self.nth_at(n, SyntaxKind::Ident);
        match keyword.kind {
            SyntaxKind::UseKw => self.nth_at(1, SyntaxKind::Str),
            SyntaxKind::SpareKw => self.nth_word(1, "board"),
            SyntaxKind::BoardKw => {
                let end = self.name_end(1);
                ident(1) && (self.nth_at(end, SyntaxKind::LBrace) || self.nth_word(end, "on"))
            }
            SyntaxKind::SensorKw | SyntaxKind::ActuatorKw => {
                let word = self.nth_text(2);
                let near = |keyword: &str| suggest::distance(word, keyword) <= 2;
                ident(1) && ident(2) && (near("returns") || near("accepts"))
            }
            SyntaxKind::DriverKw => ident(1) && self.nth_word(2, "for"),
            SyntaxKind::LinkKw => self.nth_at(1, SyntaxKind::LBrace),
            SyntaxKind::PreferKw | SyntaxKind::AvoidKw => {
                ident(1) && self.nth_at(2, SyntaxKind::Eq)
            }
            SyntaxKind::ReserveKw | SyntaxKind::ReleaseKw => {
                let after =
                    self.nth_at(2, SyntaxKind::Comma) || self.nth_at(2, SyntaxKind::Semicolon);
                ident(1) && after
            }
            _ => ident(1) && self.nth_at(2, SyntaxKind::Str),
        }
    }

    /// Whether a statement or block visibly begins here.
    pub(super) fn at_item(&self) -> bool {
        let keyword = || KEYWORDS.into_iter().find(|keyword| self.at_word(keyword.word));
        self.at_property() || keyword().is_some_and(|keyword| self.has_shape(keyword))
    }

    fn keyword_item(&mut self, keyword: Keyword) -> bool {
        let (item, block) = (keyword.item, self.block);
        if !allows(block, item) {
            let is_block = !matches!(item, Item::Rule | Item::Property);
            if is_block && block != Block::File && self.unclosed > 0 {
                return false;
            }
            self.report(SyntaxErrorKind::NotAllowedHere { item, block }, self.here());
        }
        self.parse_item(keyword);
        true
    }

    fn parse_item(&mut self, keyword: Keyword) {
        match keyword.item {
            Item::Use => self.use_file(),
            Item::Board => self.board(keyword.kind),
            Item::Sensor => self.device(keyword.kind, Block::Sensor),
            Item::Actuator => self.device(keyword.kind, Block::Actuator),
            Item::Driver => self.driver(),
            Item::Link => {
                self.start(SyntaxKind::Link);
                self.bump_as(SyntaxKind::LinkKw);
                self.body(Block::Link);
                self.finish();
            }
            Item::Rule | Item::Property => self.rule(keyword.kind),
        }
    }

    /// A word that is no keyword and has no `=` after it.
    fn unknown_item(&mut self) {
        let (word, block) = (self.nth_text(0), self.block);
        let words = |all: bool| {
            let candidates = KEYWORDS.into_iter();
            candidates.filter(move |k| all || allows(block, k.item)).map(|keyword| keyword.word)
        };
        let similar =
            suggest::nearest(word, words(false)).or_else(|| suggest::nearest(word, words(true)));
        let keyword = KEYWORDS.into_iter().find(|keyword| similar == Some(keyword.word));
        let unknown = || SyntaxErrorKind::UnknownItem {
            found: word.to_owned(),
            suggestion: keyword.map(|keyword| keyword.word),
            block,
        };
        if let Some(keyword) = keyword.filter(|&keyword| self.has_shape(keyword)) {
            self.report(unknown(), self.here());
            self.parse_item(keyword);
        } else if block != Block::File && self.at_broken_property() {
            self.property();
        } else {
            self.report(unknown(), self.here());
            self.skip_statement();
        }
    }

    /// Whether this word is rather a property without `=` or value than an unknown item.
    fn at_broken_property(&self) -> bool {
        let end = self.name_end(0);
        let Some(next) = self.nth(end) else { return true };
        if self.nth_begins_line(end) {
            return next.kind != SyntaxKind::LBrace;
        }
        match next.kind {
            SyntaxKind::LBrace => false,
            SyntaxKind::Ident => {
                let end = self.name_end(end);
                let more =
                    self.nth_at(end, SyntaxKind::Ident) || self.nth_at(end, SyntaxKind::LBrace);
                !more || self.nth_begins_line(end)
            }
            _ => true,
        }
    }

    fn board(&mut self, first: SyntaxKind) {
        self.start(SyntaxKind::Board);
        self.bump_as(first);
        if first == SyntaxKind::SpareKw {
            self.keyword("board", SyntaxKind::BoardKw);
        }
        // `board on X {` lacks its name; `board on {` is named so.
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

    fn device(&mut self, first: SyntaxKind, block: Block) {
        let (item, verb, verb_kind) = if block == Block::Sensor {
            (Item::Sensor, "returns", SyntaxKind::ReturnsKw)
        } else {
            (Item::Actuator, "accepts", SyntaxKind::AcceptsKw)
        };
        self.start(SyntaxKind::Device);
        self.bump_as(first);
        let verb_at = |n| self.nth_word(n, "returns") || self.nth_word(n, "accepts");
        if verb_at(0) && !verb_at(1) {
            self.expected(Expected::NameOf(item));
        } else {
            self.name(Expected::NameOf(item));
        }
        self.keyword(verb, verb_kind);
        self.data_type();
        self.body(block);
        self.finish();
    }

    fn driver(&mut self) {
        self.start(SyntaxKind::Driver);
        self.bump_as(SyntaxKind::DriverKw);
        if self.at_word("for") && !self.nth_word(1, "for") {
            self.expected(Expected::NameOf(Item::Driver));
        } else {
            self.name(Expected::NameOf(Item::Driver));
        }
        self.keyword("for", SyntaxKind::ForKw);
        self.start(SyntaxKind::Kind);
        self.name(Expected::Kind);
        self.finish();
        self.body(Block::Driver);
        self.finish();
    }

    /// A keyword within a head. Another word in its place is stepped over.
    fn keyword(&mut self, word: &'static str, kind: SyntaxKind) {
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
