//! Formatting: the canonical layout of the whole file, and as little of it as has changed.
//!
//! A text with mistakes is not laid out, so that nothing is moved that is not understood.

use std::ops::Range as Bytes;

use sensedsl_syntax::format;

use crate::context::Context;
use crate::protocol::TextEdit;

pub(crate) fn whole(cx: &Context<'_>) -> Vec<TextEdit> {
    changes(cx, 0..cx.text.len())
}

/// What the layout changes in the lines of a range.
pub(crate) fn part(cx: &Context<'_>, range: Bytes<usize>) -> Vec<TextEdit> {
    changes(cx, lines_around(cx.text, range))
}

/// What it changes in the block or the line that a typed character ends.
pub(crate) fn typed(cx: &Context<'_>, offset: usize, character: &str) -> Vec<TextEdit> {
    let before = offset.saturating_sub(character.len());
    if cx.text.get(before..offset) != Some(character) {
        return Vec::new();
    }
    let block = cx.token(before).filter(|_| character == "}").and_then(|token| token.parent());
    let start = block.map_or(before, |block| block.text_range().start().into());
    part(cx, start..offset)
}

/// The range with the beginning of its first line and the end of its last one, without the line break.
fn lines_around(text: &str, range: Bytes<usize>) -> Bytes<usize> {
    let before = text.get(..range.start).unwrap_or_default();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let behind = text.get(range.end..).unwrap_or_default();
    start..range.end + behind.find(['\r', '\n']).unwrap_or(behind.len())
}

/// What the layout changes within a range, or in the indentation before it: in order, each as one edit.
fn changes(cx: &Context<'_>, within: Bytes<usize>) -> Vec<TextEdit> {
    let Ok(new) = format(cx.text) else { return Vec::new() };
    let touches = |old: &Bytes<usize>| {
        let is_at_end = within.end == cx.text.len() && old.start == within.end;
        old.end >= within.start && (old.start < within.end || is_at_end)
    };
    let all = hunks(cx.text, &new).into_iter();
    let wanted = all.filter(|(old, _)| touches(old));
    wanted.map(|(old, new)| cx.edit(old, new)).collect()
}

/// What differs between two texts of which one is a layout of the other: bytes of the old one, and what is there
/// instead.
///
/// A layout changes only blank space, so the characters between are the same in both, in order. Each run of blank space
/// that differs is a hunk; those in one line are joined.
fn hunks(old: &str, new: &str) -> Vec<(Bytes<usize>, String)> {
    let (mut at_old, mut at_new) = (0, 0);
    let mut found: Vec<(Bytes<usize>, Bytes<usize>)> = Vec::new();
    loop {
        let (blank_old, blank_new) = (blank(old, at_old), blank(new, at_new));
        if old.get(blank_old.clone()) != new.get(blank_new.clone()) {
            found.push((blank_old.clone(), blank_new.clone()));
        }
        (at_old, at_new) = (blank_old.end, blank_new.end);
        let next = |text: &str, at: usize| text.get(at..).and_then(|rest| rest.chars().next());
        match (next(old, at_old), next(new, at_new)) {
            (Some(one), Some(other)) if one == other => {
                at_old += one.len_utf8();
                at_new += other.len_utf8();
            }
            (None, None) => break,
            // Not only blank space differs: one hunk up to the end.
            (_, _) => {
                found.push((at_old..old.len(), at_new..new.len()));
                break;
            }
        }
    }
    let text = |range: Bytes<usize>| new.get(range).unwrap_or_default().to_owned();
    found.into_iter().map(|(old, new)| (old, text(new))).collect()
}

/// The blank space from an offset on.
fn blank(text: &str, at: usize) -> Bytes<usize> {
    let rest = text.get(at..).unwrap_or_default();
    at..at + rest.len() - rest.trim_start().len()
}
