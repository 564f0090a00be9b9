//! What all actions need: their kinds, how one is put together, and the part at a place.

use std::ops::Range as Bytes;
use std::rc::Rc;

use sensedsl_model::design::{Part, PartIndex};
use sensedsl_session::Patience;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::{SyntaxNode, TextRange, TextSize};

use super::changes::Changes;
use crate::analysis::Wired;
use crate::context::{Context, bytes};
use crate::protocol::CodeAction;

pub(super) const QUICK_FIX: &str = "quickfix";
pub(super) const REWRITE: &str = "refactor.rewrite";
pub(super) const EXTRACT: &str = "refactor.extract";
pub(super) const FIX_ALL: &str = "source.fixAll";

/// The wiring of the text as it is now; it is looked for if nobody has. None if that takes too long.
pub(super) fn wired(cx: &Context<'_>) -> Option<Rc<Wired>> {
    cx.analysis
        .known()
        .or_else(|| cx.analysis.answer(Patience { late: cx.cancel, stop: cx.cancel }))
}

/// An action, if it changes anything.
pub(super) fn action(
    cx: &Context<'_>,
    title: String,
    kind: &str,
    changes: &Changes,
) -> Option<CodeAction> {
    Some(CodeAction {
        title,
        kind: kind.to_owned(),
        diagnostics: Vec::new(),
        is_preferred: false,
        edit: Some(changes.edit(cx)?),
        command: None,
    })
}

/// A title as it begins in a menu.
pub(super) fn capital(title: &str) -> String {
    let mut letters = title.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

pub(super) fn touches(one: &Bytes<usize>, other: &Bytes<usize>) -> bool {
    one.start <= other.end && other.start <= one.end
}

/// A device or a chip of a file, on a board or outside any.
pub(super) fn part_at(cx: &Context<'_>, range: &Bytes<usize>) -> Option<ast::Item> {
    let root = cx.root();
    let (start, end) = (TextSize::try_from(range.start).ok()?, TextSize::try_from(range.end).ok()?);
    if end > root.text_range().end() {
        return None;
    }
    let around = root.covering_element(TextRange::new(start, end));
    let node = around.into_node().or_else(|| cx.token(range.start)?.parent())?;
    // The outermost: a device of a chip is wired as a part of the chip.
    node.ancestors().filter_map(ast::Item::cast).last()
}

/// The part of a design that is written there.
pub(super) fn part_of<'a>(
    cx: &Context<'_>,
    parts: &'a [Part],
    node: &SyntaxNode,
) -> Option<(PartIndex, &'a Part)> {
    let mut all = (0..).map(PartIndex).zip(parts);
    all.find(|(_, part)| {
        part.block.file == cx.file && part.block.range() == bytes(node.text_range())
    })
}

/// The name of a device or a chip.
pub(super) fn name_of(part: &ast::Item) -> Option<ast::Name> {
    match part {
        ast::Item::Device(device) => device.name(),
        ast::Item::Chip(chip) => chip.name(),
        ast::Item::Controller(one) => one.name(),
    }
}

/// The property of that name, of those of a block.
pub(super) fn property(
    mut properties: impl Iterator<Item = ast::Property>,
    wanted: &str,
) -> Option<ast::Property> {
    properties.find(|one| one.name().is_some_and(|name| name.text() == wanted))
}

/// A statement as it is written, without what surrounds it.
pub(super) fn written(node: &SyntaxNode) -> String {
    node.text().to_string().trim().to_owned()
}
