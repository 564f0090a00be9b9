//! A file in; its items and those of all files it uses out, in their order.

use std::collections::BTreeSet;

use sensedsl_diagnostics::codes::{
    e0110_misplaced_item, e0219_use_cycle, e0224_too_many_used, e0225_too_many_items,
};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap, Span};
use sensedsl_limits::{ITEMS_MAX, STATEMENTS_MAX, TOKENS_MAX, USE_DEPTH_MAX, USED_FILES_MAX};
use sensedsl_syntax::ast::{self, AstNode as _, FileItem};
use sensedsl_syntax::{Parse, SyntaxKind, SyntaxNode, parse_within};

use crate::source::files::{FileRequest, FileUse, Files};
use crate::source::syntax_errors;
use crate::spanned::span;

/// The items of a file and of the files it uses, in order, each with its file.
#[derive(Debug, Default)]
pub(crate) struct Items {
    pub(crate) boards: Vec<(FileId, ast::Board)>,
    pub(crate) drivers: Vec<(FileId, ast::Driver)>,
    pub(crate) constants: Vec<(FileId, ast::Constant)>,
    /// Devices, chips and controllers, with the index of their board.
    pub(crate) parts: Vec<(FileId, ast::Item, Option<usize>)>,
    /// What must hold in runs.
    pub(crate) tests: Vec<(FileId, ast::Test)>,
    /// True if some text could not be parsed, so that something may only seem to be missing.
    pub(crate) broken: bool,
}

pub(crate) struct Reader<'a> {
    pub(crate) files: &'a dyn Files,
    pub(crate) sources: &'a mut SourceMap,
    pub(crate) diagnostics: &'a mut Vec<Diagnostic>,
    pub(crate) items: Items,
    pub(crate) trees: Vec<(FileId, Parse)>,
    /// Paths of the files that are being read, outermost first.
    open: Vec<String>,
    /// Paths of all files that were read.
    done: BTreeSet<String>,
    left: RemainingBudget,
}

/// The blocks and statements that are counted.
const ITEMS: [SyntaxKind; 9] = [
    SyntaxKind::Board,
    SyntaxKind::Driver,
    SyntaxKind::Device,
    SyntaxKind::Chip,
    SyntaxKind::Controller,
    SyntaxKind::Test,
    SyntaxKind::Connection,
    SyntaxKind::Reading,
    SyntaxKind::Command,
];
const STATEMENTS: [SyntaxKind; 13] = [
    SyntaxKind::Const,
    SyntaxKind::Property,
    SyntaxKind::Prefer,
    SyntaxKind::Avoid,
    SyntaxKind::Reserve,
    SyntaxKind::Release,
    SyntaxKind::Allow,
    SyntaxKind::SetStep,
    SyntaxKind::FaultStep,
    SyntaxKind::AlwaysRule,
    SyntaxKind::NeverRule,
    SyntaxKind::EventuallyRule,
    SyntaxKind::WhenRule,
];

/// The part of the budgets not yet used, over all files.
struct RemainingBudget {
    tokens: usize,
    items: usize,
    statements: usize,
    files: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(
        files: &'a dyn Files,
        sources: &'a mut SourceMap,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        let (open, done) = (Vec::new(), BTreeSet::new());
        let left = RemainingBudget {
            tokens: TOKENS_MAX,
            items: ITEMS_MAX,
            statements: STATEMENTS_MAX,
            files: USED_FILES_MAX,
        };
        let (items, trees) = (Items::default(), Vec::new());
        Self { files, sources, diagnostics, items, trees, open, done, left }
    }

    /// Reads the text of `path` (and what it uses).
    pub(crate) fn read(&mut self, path: &str, text: String) -> FileId {
        let file = self.sources.add(path, text);
        let parsed = parse_within(self.sources.text(file), self.left.tokens);
        self.trees.push((file, parsed.clone()));
        self.left.tokens -= parsed.tokens();
        for error in parsed.errors() {
            self.diagnostics.push(syntax_errors::diagnostic(error, file));
            self.items.broken = true;
        }
        if let Some((at, what, most)) = self.beyond(file, &parsed.syntax()) {
            self.diagnostics.push(e0225_too_many_items::too_many_items(at, what, most));
            self.items.broken = true;
            return file;
        }
        self.open.push(normal(path));
        for item in parsed.ast().items() {
            self.item(path, file, item);
        }
        self.done.extend(self.open.pop());
        file
    }

    /// The first block or statement of a file that exceeds the limits of a design, with the name
    /// and the size of that limit.
    fn beyond(&mut self, file: FileId, root: &SyntaxNode) -> Option<(Span, &'static str, usize)> {
        for node in root.descendants() {
            let kind = node.kind();
            let (left, what, most) = if ITEMS.contains(&kind) {
                (&mut self.left.items, "boards, drivers, chips and devices", ITEMS_MAX)
            } else if STATEMENTS.contains(&kind) {
                (&mut self.left.statements, "properties and rules", STATEMENTS_MAX)
            } else {
                continue;
            };
            // A rule can name any number of pins.
            let names = node.children_with_tokens().filter(|one| one.kind() == SyntaxKind::Comma);
            let Some(fewer) = left.checked_sub(1 + names.count()) else {
                let first = node.first_token().map_or(node.text_range(), |t| t.text_range());
                return Some((span(file, first), what, most));
            };
            *left = fewer;
        }
        None
    }

    fn item(&mut self, path: &str, file: FileId, item: FileItem) {
        match item {
            FileItem::Use(used) => self.used(path, file, &used),
            FileItem::Constant(constant) => self.items.constants.push((file, constant)),
            FileItem::Chip(chip) => self.items.parts.push((file, ast::Item::Chip(chip), None)),
            FileItem::Driver(driver) => self.items.drivers.push((file, driver)),
            FileItem::Test(test) => self.items.tests.push((file, test)),
            FileItem::Device(device) => {
                self.items.parts.push((file, ast::Item::Device(device), None));
            }
            FileItem::Board(board) if self.open.len() > 1 => {
                let at = board.name().map_or_else(|| board.range(), |name| name.range());
                self.diagnostics.push(e0110_misplaced_item::misplaced_item(
                    span(file, at),
                    "a board in a used file",
                    "in the file that is solved",
                ));
            }
            FileItem::Board(board) => {
                let index = self.items.boards.len();
                for part in board.parts() {
                    self.items.parts.push((file, part, Some(index)));
                }
                self.items.boards.push((file, board));
            }
        }
    }

    fn used(&mut self, from: &str, file: FileId, used: &ast::Use) {
        let Some(path) = used.path() else { return };
        let at = span(file, path.range());
        let target = beside(from, &path.value());
        let key = normal(&target);
        if let Some(start) = self.open.iter().position(|open| *open == key) {
            let mut circle: Vec<&str> = self.open.iter().skip(start).map(String::as_str).collect();
            circle.push(&key);
            self.diagnostics.push(e0219_use_cycle::use_cycle(at, &circle.join(" -> ")));
            return;
        }
        if self.done.contains(&key) {
            return;
        }
        if self.open.len() > USE_DEPTH_MAX {
            self.refuse(e0224_too_many_used::chain_too_long(at, USE_DEPTH_MAX));
            return;
        }
        let Some(fewer) = self.left.files.checked_sub(1) else {
            self.refuse(e0224_too_many_used::too_many_used(at, USED_FILES_MAX));
            return;
        };
        self.left.files = fewer;
        let wanted = FileRequest { path: &target, what: FileUse::Sense, by_user: false };
        match self.files.read(&wanted) {
            Ok(text) => {
                self.read(&target, text);
            }
            Err(unread) => {
                self.items.broken = true;
                self.diagnostics.push(unread.diagnostic(at, &wanted));
            }
        }
    }

    /// Reports only once what would be reported for each further file.
    fn refuse(&mut self, report: Diagnostic) {
        self.items.broken = true;
        if self.diagnostics.iter().all(|one| one.code != report.code) {
            self.diagnostics.push(report);
        }
    }
}

/// The path `relative` as seen from the folder of the file `from`.
pub(crate) fn beside(from: &str, relative: &str) -> String {
    let absolute = relative.starts_with('/') || relative.get(1..2) == Some(":");
    match from.rfind(['/', '\\']) {
        Some(end) if !absolute => {
            let folder = from.get(..=end).unwrap_or_default();
            format!("{folder}{relative}")
        }
        Some(_) | None => relative.into(),
    }
}

/// A path without `.`, and with `..` resolved as far as the text allows.
#[must_use]
pub fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| !matches!(*last, ".." | "")) => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_to_the_using_file() {
        assert_eq!(beside("a/b.sense", "c.sense"), "a/c.sense");
        assert_eq!(beside("b.sense", "c.sense"), "c.sense");
        assert_eq!(beside("a/b.sense", "/c.sense"), "/c.sense");
        assert_eq!(normal("a/./b/../c.sense"), "a/c.sense");
        assert_eq!(normal("../c.sense"), "../c.sense");
    }
}
