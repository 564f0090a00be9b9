//! Whatever can be laid out keeps its tokens, and laying it out again changes nothing.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sensedsl_syntax::{SyntaxKind, format, parse};

fn tokens(text: &str) -> Vec<(SyntaxKind, String)> {
    let elements = parse(text).syntax().descendants_with_tokens();
    let tokens = elements.filter_map(sensedsl_syntax::SyntaxElement::into_token);
    let meaningful = tokens.filter(|token| !token.kind().is_trivia());
    meaningful.map(|token| (token.kind(), token.text().to_owned())).collect()
}

fuzz_target!(|text: &str| {
    if let Ok(formatted) = format(text) {
        assert_eq!(tokens(&formatted), tokens(text));
        assert_eq!(format(&formatted).as_deref(), Ok(formatted.as_str()));
    }
});
