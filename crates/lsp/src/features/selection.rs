//! Growing selections: from a word to what it stands in, and on to the whole file.

use crate::context::{Context, bytes};
use crate::protocol::SelectionRange;

pub(crate) fn growing(cx: &Context<'_>, offset: usize) -> SelectionRange {
    let mut ranges = Vec::new();
    if let Some(token) = cx.token(offset) {
        ranges.push(bytes(token.text_range()));
        ranges.extend(token.parent_ancestors().map(|node| bytes(node.text_range())));
    }
    ranges.push(0..cx.text.len());
    // Blank space around what is written belongs to the tree, not to what people select.
    let trimmed = ranges.into_iter().map(|range| {
        let text = cx.text.get(range.clone()).unwrap_or_default();
        let start = range.start + text.len() - text.trim_start().len();
        let is_whole = range == (0..cx.text.len());
        if text.trim().is_empty() || is_whole { range } else { start..start + text.trim().len() }
    });
    let mut ranges: Vec<_> = trimmed.collect();
    ranges.dedup();
    let parent = ranges.into_iter().rev().fold(None, |parent, range| {
        Some(Box::new(SelectionRange { range: cx.range(range), parent }))
    });
    parent.map_or_else(
        || SelectionRange { range: cx.range(offset..offset), parent: None },
        |parent| *parent,
    )
}
