//! Writing identifiers into a file: its text and its design's identifiers in, a text that states
//! them out.

use std::collections::BTreeMap;
use std::ops::Range;

use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

use crate::design::Design;

/// The text of the design's own file, with an `id` added to each device, and to each chip without
/// devices, that states none; none if all state one. It is not in the canonical layout.
#[must_use]
pub fn with_ids(design: &Design, tree: &ast::SourceFile, text: &str) -> Option<String> {
    let mut missing: Vec<(Range<usize>, String)> = Vec::new();
    for (block, id) in blocks_without_ids(design, tree) {
        // A block on one line stays on one line.
        let is_line = !block.text().contains_char('\n') && !block.text().contains_char('\r');
        let written = if is_line { format!(" id = {id};") } else { format!("\nid = {id};\n") };
        missing.extend(place(&block).map(|place| (place, written)));
    }
    missing.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    if missing.is_empty() {
        return None;
    }
    let mut text = text.to_owned();
    for (range, written) in missing {
        text.replace_range(range, &written);
    }
    Some(text)
}

/// The devices of the design's own file, and the chips without devices, that state no `id`: their blocks in the tree of
/// the file, each with the identifier that it has.
#[must_use]
pub fn blocks_without_ids(design: &Design, tree: &ast::SourceFile) -> Vec<(SyntaxNode, u8)> {
    let of_file = design.devices.iter().filter(|device| device.name.span.file == design.file);
    let mut ids: BTreeMap<usize, u8> = BTreeMap::new();
    for device in of_file {
        // All values of a chip that names no devices share the place of the chip's name: the first
        // one counts.
        ids.entry(device.name.span.range().start).or_insert(device.id.value);
    }
    let boards = tree.boards().flat_map(|board| board.parts().collect::<Vec<_>>());
    let blocks = tree.parts().chain(boards).flat_map(|part| blocks_without(&part));
    let with_id = blocks.filter_map(|(name, block)| {
        let at: usize = name.range().start().into();
        Some((block, *ids.get(&at)?))
    });
    with_id.collect()
}

/// The blocks of a part that lack an `id`, each with its name.
fn blocks_without(part: &ast::Item) -> Vec<(ast::Name, SyntaxNode)> {
    let states = |mut properties: Box<dyn Iterator<Item = ast::Property>>| {
        properties.any(|one| one.name().is_some_and(|name| name.text() == "id"))
    };
    let of_device = |one: &ast::Device| {
        let is_stated = states(Box::new(one.properties()));
        one.name().filter(|_| !is_stated).map(|name| (name, one.syntax().clone()))
    };
    match part {
        ast::Item::Device(device) => of_device(device).into_iter().collect(),
        ast::Item::Controller(one) if states(Box::new(one.properties())) => Vec::new(),
        ast::Item::Controller(one) => {
            one.name().map(|name| (name, one.syntax().clone())).into_iter().collect()
        }
        // The chip's identifier is that of its first value; the others follow.
        ast::Item::Chip(chip) if states(Box::new(chip.properties())) => Vec::new(),
        ast::Item::Chip(chip) if chip.devices().next().is_none() => {
            chip.name().map(|name| (name, chip.syntax().clone())).into_iter().collect()
        }
        ast::Item::Chip(chip) => chip.devices().filter_map(|one| of_device(&one)).collect(),
    }
}

/// Where to insert a first line in a block: after its brace and any comments on that line,
/// including the line break; empty if something else follows on the line.
fn place(block: &SyntaxNode) -> Option<Range<usize>> {
    let is_brace = |one: &SyntaxElement| one.kind() == SyntaxKind::LBrace;
    let brace = block.children_with_tokens().find(is_brace)?.into_token()?;
    let mut end = brace.text_range().end();
    let mut next = brace.next_token();
    while let Some(token) = next {
        let is_space = token.kind() == SyntaxKind::Whitespace;
        if is_space && token.text().contains(['\n', '\r']) {
            return Some(end.into()..token.text_range().end().into());
        }
        if !is_space && !token.kind().is_comment() {
            break;
        }
        if !is_space {
            end = token.text_range().end();
        }
        next = token.next_token();
    }
    Some(end.into()..end.into())
}
