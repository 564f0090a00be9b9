//! From tokens to the tree: recursive descent that never stops at a mistake.
//!
//! This file has the machinery (look-ahead, building the tree, reporting). The grammar is in
//! [`items`], [`heads`], [`statements`], [`steps`], [`names`], [`expressions`] and [`conditions`]. Every token ends up in the
//! tree exactly once. A mistake is reported where it is, tokens that cannot be understood go into
//! an `Error` node, and parsing continues at the next statement.
//!
//! Two rules keep a mistake from being reported twice: there is no second report before another
//! token has been consumed, and none right after unknown characters that the lexer has reported.

mod conditions;
mod expressions;
mod heads;
mod items;
mod names;
mod statements;
mod steps;

use crate::error::{Block, Errors, Expected, Found, SyntaxError, SyntaxErrorKind};
use crate::kind::{SenseDsl, SyntaxKind};
use crate::lexer::{Lexed, Token};
use rowan::{GreenNode, GreenNodeBuilder, Language, TextRange, TextSize};
use std::collections::BTreeSet;

/// How deep blocks, lists and expressions together may nest. A design needs only a few levels; the
/// limit protects the stack from hostile input, here and wherever the tree is walked.
pub(crate) const NESTING_LIMIT: usize = 32;

/// Builds the tree of `text` and lists all its mistakes in order, including the lexer's.
pub(crate) fn parse(text: &str, lexed: &Lexed) -> (GreenNode, Vec<SyntaxError>) {
    let mut parser = Parser::new(text, &lexed.tokens);
    parser.file();
    let mut errors = parser.unswallowed_errors(&lexed.errors.list);
    let more = parser.errors.more + lexed.errors.more;
    if lexed.cut.is_some() {
        // What seems to be missing at the cut may be in the text after it.
        errors.retain(|error| !error.range.is_empty() || error.range.start() < parser.gap().end());
    }
    errors.extend_from_slice(&lexed.errors.list);
    // At the same place, a missing item comes before a mistake in the next token.
    errors.sort_by_key(|error| (error.range.start(), error.range.end()));
    let end = TextRange::empty(lexed.cut.unwrap_or(parser.gap().end()));
    if lexed.cut.is_some() {
        let kind = SyntaxErrorKind::TooManyTokens { limit: lexed.tokens.len() };
        errors.push(SyntaxError { kind, range: end });
    }
    if more > 0 {
        let kind = SyntaxErrorKind::More { listed: errors.len(), more };
        errors.push(SyntaxError { kind, range: end });
    }
    (parser.builder.finish(), errors)
}

struct Parser<'a> {
    text: &'a str,
    tokens: &'a [Token],
    /// The indices of the tokens that are not trivia.
    significant: Vec<usize>,
    /// The number of significant tokens consumed.
    consumed: usize,
    /// The number of tokens of any kind in the tree.
    built: usize,
    builder: GreenNodeBuilder<'static>,
    errors: Errors,
    /// The value of `consumed` at the last report.
    complained: Option<usize>,
    /// The block whose items are being parsed.
    block: Block,
    /// The number of open blocks, lists and operations.
    depth: usize,
    /// How many more `{` than `}` the file has, minus those already explained by a report.
    unclosed: usize,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str, tokens: &'a [Token]) -> Self {
        let of_kind = |kind| tokens.iter().filter(|token| token.kind == kind).count();
        let indices = tokens.iter().enumerate().filter(|(_, token)| !token.kind.is_trivia());
        Self {
            text,
            tokens,
            significant: indices.map(|(index, _)| index).collect(),
            consumed: 0,
            built: 0,
            builder: GreenNodeBuilder::new(),
            errors: Errors::default(),
            complained: None,
            block: Block::File,
            depth: 0,
            unclosed: of_kind(SyntaxKind::LBrace).saturating_sub(of_kind(SyntaxKind::RBrace)),
        }
    }

    // Look-ahead, which ignores trivia.

    fn significant_token(&self, index: usize) -> Option<Token> {
        self.significant.get(index).and_then(|&index| self.tokens.get(index)).copied()
    }

    fn nth(&self, n: usize) -> Option<Token> {
        self.significant_token(self.consumed + n)
    }

    fn kind(&self) -> Option<SyntaxKind> {
        self.nth(0).map(|token| token.kind)
    }

    fn nth_at(&self, n: usize, kind: SyntaxKind) -> bool {
        self.nth(n).is_some_and(|token| token.kind == kind)
    }

    fn at(&self, kind: SyntaxKind) -> bool {
        self.nth_at(0, kind)
    }

    /// The text of a token ahead; empty after the last token.
    fn nth_text(&self, n: usize) -> &'a str {
        self.nth(n)
            .and_then(|token| self.text.get(std::ops::Range::from(token.range)))
            .unwrap_or("")
    }

    fn nth_word(&self, n: usize, word: &str) -> bool {
        self.nth_at(n, SyntaxKind::Ident) && self.nth_text(n) == word
    }

    fn at_word(&self, word: &str) -> bool {
        self.nth_word(0, word)
    }

    /// Whether the tokens `n - 1` and `n` ahead touch each other.
    fn touches(&self, n: usize) -> bool {
        let before = (self.consumed + n).checked_sub(1).and_then(|i| self.significant_token(i));
        match (before, self.nth(n)) {
            (Some(before), Some(token)) => before.range.end() == token.range.start(),
            _ => false,
        }
    }

    /// The trivia between the tokens `n - 1` and `n` ahead.
    fn trivia_before(&self, n: usize) -> &'a [Token] {
        let index = self.consumed + n;
        let last_index = |i| self.significant.get(i).copied();
        let start = index.checked_sub(1).map_or(0, |i| last_index(i).unwrap_or_default() + 1);
        let end = last_index(index).unwrap_or(self.tokens.len());
        self.tokens.get(start..end).unwrap_or_default()
    }

    /// Whether the token `n` ahead begins a line or does not exist.
    fn nth_begins_line(&self, n: usize) -> bool {
        let breaks = |token: &Token| {
            let text = self.text.get(std::ops::Range::from(token.range));
            text.is_some_and(|text| text.contains(['\n', '\r']))
        };
        self.nth(n).is_none() || self.trivia_before(n).iter().any(breaks)
    }

    fn begins_line(&self) -> bool {
        self.nth_begins_line(0)
    }

    // Building the tree.

    /// Begins a node at the next token; the trivia before it stays outside.
    fn start(&mut self, kind: SyntaxKind) {
        self.build_trivia();
        self.builder.start_node(SenseDsl::kind_to_raw(kind));
    }

    fn finish(&mut self) {
        self.builder.finish_node();
    }

    /// Consumes the next token with its own kind.
    fn bump(&mut self) {
        if let Some(kind) = self.kind() {
            self.bump_as(kind);
        }
    }

    /// Consumes the next token as a keyword or unit.
    fn bump_as(&mut self, kind: SyntaxKind) {
        self.build_trivia();
        self.build_token(Some(kind));
        self.consumed += 1;
    }

    fn eat(&mut self, kind: SyntaxKind) -> bool {
        let there = self.at(kind);
        if there {
            self.bump();
        }
        there
    }

    /// Consumes the next token into an `Error` node of its own.
    fn bump_error(&mut self) {
        self.start(SyntaxKind::Error);
        self.bump();
        self.finish();
    }

    /// Consumes a `{` and everything up to its `}`, without recursion.
    fn bump_braces(&mut self) {
        let mut open = 0_usize;
        while self.kind().is_some() {
            if self.at(SyntaxKind::LBrace) {
                open += 1;
            } else if self.at(SyntaxKind::RBrace) {
                open = open.saturating_sub(1);
            }
            self.bump();
            if open == 0 {
                break;
            }
        }
    }

    fn build_trivia(&mut self) {
        while self.tokens.get(self.built).is_some_and(|token| token.kind.is_trivia()) {
            self.build_token(None);
        }
    }

    fn build_token(&mut self, kind: Option<SyntaxKind>) {
        let Some(token) = self.tokens.get(self.built) else { return };
        let text = self.text.get(std::ops::Range::from(token.range)).unwrap_or_default();
        self.builder.token(SenseDsl::kind_to_raw(kind.unwrap_or(token.kind)), text);
        self.built += 1;
    }

    // Reporting.

    /// The end of the last consumed token, as an empty range, which is the place of a missing
    /// token.
    fn gap(&self) -> TextRange {
        let last = self.consumed.checked_sub(1).and_then(|index| self.significant_token(index));
        TextRange::empty(last.map_or(TextSize::new(0), |token| token.range.end()))
    }

    /// The range of the next token; after the last token, the place directly after it.
    fn here(&self) -> TextRange {
        self.nth(0).map_or_else(|| self.gap(), |token| token.range)
    }

    fn found(&self) -> Found {
        self.nth(0).map_or(Found::EndOfFile, |_| Found::Token(self.nth_text(0).to_owned()))
    }

    fn report(&mut self, kind: SyntaxErrorKind, range: TextRange) {
        self.errors.push(kind, range);
        self.complained = Some(self.consumed);
    }

    /// Reports a mistake, unless it would be a consequence of what has just been reported.
    fn complain(&mut self, kind: SyntaxErrorKind, range: TextRange) {
        let unknown = |token: &Token| token.kind == SyntaxKind::Unknown;
        let explained =
            self.complained == Some(self.consumed) || self.trivia_before(0).iter().any(unknown);
        if !explained {
            self.report(kind, range);
        }
    }

    /// Reports an unexpected token: at the token, or at the end of the line if that comes too
    /// early.
    fn expected(&mut self, expected: Expected) {
        let range = if self.begins_line() { self.gap() } else { self.here() };
        self.complain(SyntaxErrorKind::Expected { expected, found: self.found() }, range);
    }

    /// The errors, without those for missing tokens that an unterminated comment or string has
    /// swallowed.
    fn unswallowed_errors(&mut self, lexer_errors: &[SyntaxError]) -> Vec<SyntaxError> {
        let in_comment = |error: &SyntaxError| error.kind == SyntaxErrorKind::UnterminatedComment;
        let in_string = |error: &&SyntaxError| error.kind == SyntaxErrorKind::UnterminatedString;
        let strings = lexer_errors.iter().filter(in_string);
        let mut swallowed: BTreeSet<_> = strings.map(|error| error.range.end()).collect();
        if lexer_errors.iter().any(in_comment) {
            swallowed.insert(self.gap().end());
        }
        let mut errors = std::mem::take(&mut self.errors.list);
        errors.retain(|error| !error.range.is_empty() || !swallowed.contains(&error.range.end()));
        errors
    }
}
