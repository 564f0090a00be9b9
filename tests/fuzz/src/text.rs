//! Any text: it is parsed into a tree that spells it, with errors inside the text; what can be laid
//! out keeps its tokens, and laying it out again changes nothing.

use sensedsl_syntax::{SyntaxKind, format, parse};

fn tokens(text: &str) -> Vec<(SyntaxKind, String)> {
    let elements = parse(text).syntax().descendants_with_tokens();
    let tokens = elements.filter_map(sensedsl_syntax::SyntaxElement::into_token);
    let meaningful = tokens.filter(|token| !token.kind().is_trivia());
    meaningful.map(|token| (token.kind(), token.text().to_owned())).collect()
}

/// The body of the target.
///
/// # Panics
/// Where the tree or the layout is wrong.
pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let tree = parse(text);
    assert_eq!(tree.syntax().text(), text);
    for error in tree.errors() {
        let _ = &text[error.range];
    }
    let mut nodes = tree.syntax().descendants();
    let broken = nodes.any(|node| node.kind() == SyntaxKind::Error);
    assert!(!broken || !tree.errors().is_empty());
    if let Ok(formatted) = format(text) {
        assert_eq!(tokens(&formatted), tokens(text));
        assert_eq!(format(&formatted).as_deref(), Ok(formatted.as_str()));
    }
}
