//! Hints: the chosen pins behind each device, and what expressions come to.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use std::ops::Range as Bytes;

use sensedsl_report::Row;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

use crate::context::{Context, bytes};
use crate::protocol::{InlayHint, Markup};
use crate::wires;

/// The hints of a range, in the order of their places.
pub(crate) fn within(cx: &Context<'_>, range: Bytes<usize>) -> Vec<InlayHint> {
    let mut found = Vec::new();
    let rows = cx.wired.as_ref().and_then(|wired| wired.wired().map(wires::all));
    for node in cx.root().descendants() {
        let touches = bytes(node.text_range());
        if touches.end < range.start || touches.start > range.end {
            continue;
        }
        let hint = match node.kind() {
            SyntaxKind::Device | SyntaxKind::Chip => {
                rows.as_ref().and_then(|rows| pins(cx, rows, &node))
            }
            SyntaxKind::Property | SyntaxKind::Const => value(cx, &node),
            _ => None,
        };
        found.extend(hint.filter(|(at, _)| range.start <= *at && *at <= range.end));
    }
    found.sort_by_key(|(at, _)| *at);
    found.into_iter().map(|(_, hint)| hint).collect()
}

/// The pins of a device or a chip: behind its block if that is one line, else behind its first line.
fn pins(cx: &Context<'_>, rows: &[Row], part: &SyntaxNode) -> Option<(usize, InlayHint)> {
    let name = ast::Device::cast(part.clone()).map(|device| device.name());
    let name = name.or_else(|| ast::Chip::cast(part.clone()).map(|chip| chip.name()))??;
    let rows = wires::of_part(rows, name.text());
    let first = rows.first()?;
    let mut tokens = part.children_with_tokens().filter_map(SyntaxElement::into_token);
    let open = tokens.find(|token| token.kind() == SyntaxKind::LBrace)?;
    let own = bytes(part.text_range());
    let written = cx.text.get(own.clone()).unwrap_or_default();
    let end = own.start + written.trim_end().len();
    let start = own.start + written.len() - written.trim_start().len();
    let is_line = !cx.text.get(start..end).unwrap_or_default().contains('\n');
    let at = if is_line { end } else { usize::from(open.text_range().end()) };
    let is_several = rows.iter().any(|row| row.board != first.board);
    let board = if is_several { format!("{}: ", first.board) } else { String::new() };
    let label = format!("→ {board}{}", wires::short(&rows));
    let tooltip = Some(Markup::new(wires::table(&rows)));
    let position = cx.range(at..at).start;
    Some((at, InlayHint { position, label, padding_left: true, tooltip }))
}

/// What the value of a statement comes to, if it is more than a number.
fn value(cx: &Context<'_>, statement: &SyntaxNode) -> Option<(usize, InlayHint)> {
    let value = ast::Property::cast(statement.clone()).map(|one| one.value());
    let value =
        value.or_else(|| ast::Constant::cast(statement.clone()).map(|one| one.value()))??;
    let is_computed = |node: SyntaxNode| {
        [SyntaxKind::Binary, SyntaxKind::NameValue, SyntaxKind::Paren].contains(&node.kind())
    };
    let mut nodes = value.syntax().descendants();
    if !nodes.any(is_computed) {
        return None;
    }
    let computed = cx.analysis.snapshot.constants().computed(cx.file, &value)?;
    let written = value.syntax().text().to_string();
    let end = usize::from(value.range().start()) + written.trim_end().len();
    let label = format!("= {computed}");
    let position = cx.range(end..end).start;
    Some((end, InlayHint { position, label, padding_left: true, tooltip: None }))
}
