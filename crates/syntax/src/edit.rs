//! Changes of a text in the language: statements that are added to blocks, or taken out.
//!
//! In: a block or a statement of the tree. Out: the bytes to replace, and what is there instead, laid out as its
//! surroundings are, so that the rest of the text stays as it is.

use std::ops::Range as Bytes;

use rowan::{Direction, NodeOrToken, TextRange};

use crate::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};

/// A change: bytes of a text, and what is there instead.
pub type Edit = (Bytes<usize>, String);

/// Adds a statement at the end of a block; none if the node has no block.
#[must_use]
pub fn added(block: &SyntaxNode, statement: &str) -> Option<Edit> {
    let mut elements = block.children_with_tokens();
    let open = elements.find(|one| one.kind() == SyntaxKind::LBrace)?;
    let from_the_end =
        std::iter::successors(block.last_child_or_token(), SyntaxElement::prev_sibling_or_token);
    let close = from_the_end
        .take_while(|one| *one != open)
        .filter_map(SyntaxElement::into_token)
        .find(|one| one.kind() == SyntaxKind::RBrace)?;
    let blank = close.prev_token().filter(|token| token.kind() == SyntaxKind::Whitespace);
    let end = blank.map_or(close.text_range().start(), |blank| blank.text_range().start());
    let place = usize::from(end)..usize::from(close.text_range().start());
    let start = block.text_range().start();
    let inner = TextRange::new(open.text_range().end() - start, close.text_range().start() - start);
    if !block.text().slice(inner).contains_char('\n') && !statement.contains('\n') {
        return Some((place, format!(" {statement} ")));
    }
    let outer = indent(block);
    let inner_indent = format!("{outer}    ");
    let statement = statement.replace('\n', &format!("\n{inner_indent}"));
    Some((place, format!("\n{inner_indent}{statement}\n{outer}")))
}

/// Takes a statement out, with its line if nothing else is in it.
#[must_use]
pub fn removed(text: &str, statement: &SyntaxNode) -> Edit {
    let range = statement.text_range();
    let whole = usize::from(range.start())..usize::from(range.end());
    let written = text.get(whole.clone()).unwrap_or_default();
    let start = whole.start + written.len() - written.trim_start().len();
    let end = start + written.trim().len();
    let before = text.get(..start).unwrap_or_default();
    let behind = text.get(end..).unwrap_or_default();
    let blank = before.len() - before.trim_end_matches([' ', '\t']).len();
    let is_first = before.len() == blank || before.trim_end_matches([' ', '\t']).ends_with('\n');
    let rest = behind.trim_start_matches([' ', '\t']);
    let line_break = ["\r\n", "\n"].into_iter().find(|one| rest.starts_with(one));
    match line_break {
        Some(line_break) if is_first => {
            (start - blank..end + behind.len() - rest.len() + line_break.len(), String::new())
        }
        // A comment behind it keeps its place in the line.
        None if is_first && !rest.is_empty() => {
            (start..end + behind.len() - rest.len(), String::new())
        }
        Some(_) | None => (start - blank..end, String::new()),
    }
}

/// Adds a statement at the beginning of a block; none if the node has no block.
#[must_use]
pub fn begun(block: &SyntaxNode, statement: &str) -> Option<Edit> {
    let whole = block.text().to_string();
    let start = usize::from(block.text_range().start());
    let is_open = |one: &SyntaxElement| one.kind() == SyntaxKind::LBrace;
    let open = block.children_with_tokens().find(is_open)?.text_range().end();
    let open = usize::from(open);
    let rest = whole.get(open - start..)?;
    if !rest.contains('\n') {
        let blank = if rest.starts_with([' ', '}']) { "" } else { " " };
        let end = if rest.starts_with('}') { " " } else { "" };
        return Some((open..open, format!(" {statement}{blank}{end}")));
    }
    Some((open..open, format!("\n{}    {statement}", indent(block))))
}

/// The token that begins at an offset or is around it; none behind the end of the text. Unlike the tree's own function
/// it does not look at each of a node's children.
#[must_use]
pub fn token_at(root: &SyntaxNode, offset: u32) -> Option<SyntaxToken> {
    let wanted = TextRange::at(offset.into(), 1.into());
    let mut node = root.clone();
    loop {
        if !node.text_range().contains_range(wanted) {
            return None;
        }
        match node.child_or_token_at_range(wanted)? {
            NodeOrToken::Node(inner) => node = inner,
            NodeOrToken::Token(token) => return Some(token),
        }
    }
}

/// The statement that a token is in: a property, a rule, or a link. A property within a rule is a part of the rule.
#[must_use]
pub fn statement(token: &SyntaxToken) -> Option<SyntaxNode> {
    let is_statement = |node: &SyntaxNode| {
        matches!(
            node.kind(),
            SyntaxKind::Property
                | SyntaxKind::Prefer
                | SyntaxKind::Avoid
                | SyntaxKind::Reserve
                | SyntaxKind::Release
                | SyntaxKind::Allow
                | SyntaxKind::Link
        )
    };
    let first = token.parent()?.ancestors().find(is_statement)?;
    Some(
        first
            .parent()
            .filter(|outer| is_statement(outer) && outer.kind() != SyntaxKind::Link)
            .unwrap_or(first),
    )
}

/// Takes out the statement that a token is in; of a rule with several names, only the one that the token is.
#[must_use]
pub fn without(text: &str, token: &SyntaxToken) -> Option<Edit> {
    let statement = statement(token)?;
    let is_list = matches!(statement.kind(), SyntaxKind::Reserve | SyntaxKind::Release);
    let is_name = is_list && token.parent().as_ref() == Some(&statement);
    let own = token.text_range();
    let neighbour = |direction| {
        let mut others = token.siblings_with_tokens(direction).skip(1);
        others.find(|one| one.kind() == SyntaxKind::Ident).map(|one| one.text_range())
    };
    let range = match (neighbour(Direction::Prev), neighbour(Direction::Next)) {
        (Some(before), _) if is_name => TextRange::new(before.end(), own.end()),
        (None, Some(next)) if is_name => TextRange::new(own.start(), next.start()),
        _ => return Some(removed(text, &statement)),
    };
    Some((range.start().into()..range.end().into(), String::new()))
}

/// The blank space before the line in which a node begins.
#[must_use]
pub fn indent(node: &SyntaxNode) -> String {
    let first = node.first_token();
    let before = std::iter::successors(first, SyntaxToken::prev_token).skip(1);
    let mut line = String::new();
    for token in before {
        let (text, is_blank) = (token.text(), token.kind() == SyntaxKind::Whitespace);
        let end = text.rfind('\n').map_or(text, |at| text.get(at + 1..).unwrap_or_default());
        line = if is_blank { end.to_owned() } else { String::new() };
        if end.len() < text.len() {
            break;
        }
    }
    line
}

/// The text after changes that do not overlap.
#[must_use]
pub fn applied(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|(range, _)| std::cmp::Reverse((range.start, range.end)));
    let mut text = text.to_owned();
    for (range, new) in edits {
        if text.get(range.clone()).is_some() {
            text.replace_range(range, &new);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ast::AstNode as _;
    use crate::parse;

    fn with(text: &str, statement: &str) -> String {
        let block = parse(text).ast().devices().next().unwrap();
        applied(text, vec![added(block.syntax(), statement).unwrap()])
    }

    fn without(text: &str) -> String {
        let block = parse(text).ast().devices().next().unwrap();
        let property = block.properties().last().unwrap();
        applied(text, vec![removed(text, property.syntax())])
    }

    #[test]
    fn statements_begin_a_block() {
        let begun = |text: &str| {
            let block = parse(text).ast().devices().next().unwrap();
            applied(text, vec![begun(block.syntax(), "id = 1;").unwrap()])
        };
        assert_eq!(
            begun("sensor A returns uint8 { type = analog; }"),
            "sensor A returns uint8 { id = 1; type = analog; }"
        );
        assert_eq!(begun("sensor A returns uint8 {}"), "sensor A returns uint8 { id = 1; }");
        assert_eq!(
            begun("  sensor A returns uint8 {\n    type = analog;\n  }"),
            "  sensor A returns uint8 {\n      id = 1;\n    type = analog;\n  }"
        );
    }

    #[test]
    fn one_name_of_a_rule_goes_without_the_others() {
        let without = |text: &str, name: &str| {
            let root = parse(text).syntax();
            let at = u32::try_from(text.find(name).unwrap()).unwrap();
            let token = token_at(&root, at).unwrap();
            applied(text, vec![super::without(text, &token).unwrap()])
        };
        let text = "board B {\n    reserve PA1, PA2, PA3;\n    prefer unit = ADC1;\n}\n";
        let rest = "\n    prefer unit = ADC1;\n}\n";
        assert_eq!(without(text, "PA1"), format!("board B {{\n    reserve PA2, PA3;{rest}"));
        assert_eq!(without(text, "PA2"), format!("board B {{\n    reserve PA1, PA3;{rest}"));
        assert_eq!(without(text, "PA3"), format!("board B {{\n    reserve PA1, PA2;{rest}"));
        assert_eq!(without(text, "unit"), "board B {\n    reserve PA1, PA2, PA3;\n}\n");
        let alone = "board B { reserve PA1; }";
        assert_eq!(without(alone, "PA1"), "board B { }");
    }

    #[test]
    fn statements_come_and_go_as_people_would_write_them() {
        let line = "sensor A returns uint8 { type = analog; }";
        assert_eq!(
            with(line, "pin = PA0;"),
            "sensor A returns uint8 { type = analog; pin = PA0; }"
        );
        assert_eq!(without(line), "sensor A returns uint8 { }");
        let lines = "sensor A returns uint8 {\n    type = analog; // light\n    id = 3;\n}";
        assert_eq!(
            with(lines, "pin = PA0;"),
            "sensor A returns uint8 {\n    type = analog; // light\n    id = 3;\n    pin = PA0;\n}"
        );
        assert_eq!(without(lines), "sensor A returns uint8 {\n    type = analog; // light\n}");
        let noted = "sensor A returns uint8 {\n    id = 3; // three\n}";
        assert_eq!(without(noted), "sensor A returns uint8 {\n    // three\n}");
        assert_eq!(
            with("sensor A returns uint8 {}", "id = 1;"),
            "sensor A returns uint8 { id = 1; }"
        );
    }
}
