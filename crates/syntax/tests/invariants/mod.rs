//! What holds for every text: the tree spells it, each mistake has a place in it, and the layout
//! keeps its tokens and is stable.

use proptest::prelude::*;
use sensedsl_syntax::{SyntaxElement, SyntaxKind, parse};

/// The tokens of a text without white space and comments.
fn tokens(text: &str) -> Vec<(SyntaxKind, String)> {
    let elements = parse(text).syntax().descendants_with_tokens();
    let tokens = elements.filter_map(SyntaxElement::into_token);
    let meaningful = tokens.filter(|token| !token.kind().is_trivia());
    meaningful.map(|token| (token.kind(), token.text().to_owned())).collect()
}

/// The comments of a text, ignoring white space at the ends of their lines.
fn comments(text: &str) -> Vec<String> {
    let elements = parse(text).syntax().descendants_with_tokens();
    let comments =
        elements.filter_map(SyntaxElement::into_token).filter(|token| token.kind().is_comment());
    let trimmed = |comment: &str| {
        let unified = comment.replace("\r\n", "\n").replace('\r', "\n");
        unified.split('\n').map(str::trim_end).collect::<Vec<_>>().join("\n")
    };
    comments.map(|token| trimmed(token.text())).collect()
}

/// Checks that everything that holds for every text holds for this one.
pub(crate) fn check(text: &str) -> Result<(), TestCaseError> {
    let parsed = parse(text);
    prop_assert_eq!(parsed.syntax().text().to_string(), text);
    for error in parsed.errors() {
        // Slicing panics if a range is outside the text or splits a character.
        let _ = &text[error.range];
    }
    let has_error_node = parsed.syntax().descendants().any(|node| node.kind() == SyntaxKind::Error);
    prop_assert!(!has_error_node || !parsed.errors().is_empty(), "an error node without an error");
    match sensedsl_syntax::format(text) {
        Err(errors) => prop_assert_eq!(&errors[..], parsed.errors()),
        Ok(formatted) => {
            prop_assert_eq!(tokens(&formatted), tokens(text));
            prop_assert_eq!(comments(&formatted), comments(text));
            prop_assert_eq!(
                sensedsl_syntax::format(&formatted),
                Ok(formatted.clone()),
                "laid out twice"
            );
            prop_assert!(formatted.lines().all(|line| line.trim_end() == line), "{formatted:?}");
            prop_assert!(!formatted.contains("\n\n\n") || text.contains("/*"), "{formatted:?}");
        }
    }
    Ok(())
}
