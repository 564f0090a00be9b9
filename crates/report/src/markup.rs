//! Text for XML and HTML.

use sensedsl_diagnostics::visible;

/// The text as content or value of an attribute: no markup, and hidden characters as codes.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in visible(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// A note, in which what stands between grave accents is code. `plain` and `code` write the pieces.
pub(crate) fn noted(
    text: &str,
    plain: impl Fn(&str) -> String,
    code: impl Fn(&str) -> String,
) -> String {
    let pieces: Vec<&str> = text.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return plain(text);
    }
    let pieces = pieces.iter().enumerate();
    pieces
        .map(|(at, piece)| if at.is_multiple_of(2) { plain(piece) } else { code(piece) })
        .collect()
}
