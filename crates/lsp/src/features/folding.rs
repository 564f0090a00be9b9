//! Folding: blocks, and comments of several lines.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxToken};

use crate::context::Context;
use crate::protocol::FoldingRange;

pub(crate) fn ranges(cx: &Context<'_>) -> Vec<FoldingRange> {
    let mut found = Vec::new();
    let mut open = Vec::new();
    // The lines of the comments behind which nothing but a line break has come yet.
    let mut comments: Option<(u32, u32)> = None;
    let tokens = cx.root().descendants_with_tokens().filter_map(SyntaxElement::into_token);
    for token in tokens {
        let lines = lines(cx, &token);
        match token.kind() {
            SyntaxKind::Whitespace => continue,
            kind if kind.is_comment() => {
                comments = match comments {
                    Some((first, last)) if last + 1 >= lines.0 => Some((first, lines.1)),
                    before => {
                        found.extend(before.and_then(comment));
                        Some(lines)
                    }
                };
                continue;
            }
            SyntaxKind::LBrace | SyntaxKind::LBracket => open.push(lines.0),
            SyntaxKind::RBrace | SyntaxKind::RBracket => {
                // The line of the closing brace stays.
                let block = open.pop().zip(lines.0.checked_sub(1));
                found.extend(block.and_then(|(first, last)| range(first, last, None)));
            }
            _ => {}
        }
        found.extend(comments.take().and_then(comment));
    }
    found.extend(comments.and_then(comment));
    found.sort_by_key(|one| (one.start_line, one.end_line));
    found
}

fn lines(cx: &Context<'_>, token: &SyntaxToken) -> (u32, u32) {
    let range = cx.range_of(token.text_range());
    (range.start.line, range.end.line)
}

fn comment((first, last): (u32, u32)) -> Option<FoldingRange> {
    range(first, last, Some("comment".to_owned()))
}

fn range(start_line: u32, end_line: u32, kind: Option<String>) -> Option<FoldingRange> {
    (start_line < end_line).then_some(FoldingRange { start_line, end_line, kind })
}
