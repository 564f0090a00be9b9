//! Any text is parsed into a tree that spells it, with errors inside the text.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let parse = sensedsl_syntax::parse(text);
    assert_eq!(parse.syntax().text(), text);
    for error in parse.errors() {
        let _ = &text[error.range];
    }
    let mut nodes = parse.syntax().descendants();
    let broken = nodes.any(|node| node.kind() == sensedsl_syntax::SyntaxKind::Error);
    assert!(!broken || !parse.errors().is_empty());
});
