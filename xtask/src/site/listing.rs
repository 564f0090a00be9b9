//! Fenced blocks of a page: those in the language come out with their colours, as the project's own parser sees them;
//! those that the page names as files tell the playground so.
//!
//! In: the word or words behind a fence, and the lines below it. Out: Markdown with HTML in it. A block in the language
//! that begins without a word is found by parsing it: what is correct is in the language.

use std::fmt::Write as _;

use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxToken, parse};

/// A fenced block.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Block<'a> {
    /// What stands before the fence: spaces.
    pub(super) indent: &'a str,
    /// What stands behind it.
    pub(super) info: &'a str,
    pub(super) text: String,
}

/// A page in pieces.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Piece<'a> {
    Line(&'a str),
    Block(Block<'a>),
}

/// The pieces of a page. A fence that nothing closes goes to the end, as in Markdown.
pub(super) fn pieces(page: &str) -> Vec<Piece<'_>> {
    let (mut all, mut open) = (Vec::new(), None::<(Block<'_>, &str)>);
    for line in page.lines() {
        let bare = line.trim_start();
        let indent = line.get(..line.len() - bare.len()).unwrap_or("");
        if let Some((block, fence)) = &mut open {
            let is_end = bare.starts_with(*fence) && bare.trim_end().trim_matches('`').is_empty();
            if is_end {
                all.extend(open.take().map(|(block, _)| Piece::Block(block)));
            } else {
                let text = line.strip_prefix(block.indent).unwrap_or(bare);
                block.text.push_str(text);
                block.text.push('\n');
            }
            continue;
        }
        let info = bare.trim_start_matches('`');
        let fence = bare.get(..bare.len() - info.len()).unwrap_or("");
        if fence.len() >= 3 && !info.contains('`') {
            open = Some((Block { indent, info: info.trim(), text: String::new() }, fence));
        } else {
            all.push(Piece::Line(line));
        }
    }
    all.extend(open.map(|(block, _)| Piece::Block(block)));
    all
}

/// A block as the book has it.
pub(super) fn written(block: &Block<'_>) -> String {
    let mut words = block.info.split_whitespace();
    let language = words.next().unwrap_or("");
    let file = words.next().filter(|word| word.contains('.') && !word.contains('='));
    let is_ours = language == "sense" || (language.is_empty() && is_sense(&block.text));
    let html = if is_ours {
        sense(&block.text, file)
    } else if let (Some(file), false) = (file, language == "sh") {
        let text = escaped(&block.text);
        let file = escaped(file);
        format!(
            "<pre data-file=\"{file}\"><code class=\"language-{language}\">{text}</code></pre>\n"
        )
    } else {
        let language = match language {
            "output" | "" => "text",
            other => other,
        };
        let fence = fence(&block.text);
        format!("{fence}{language}\n{}{fence}\n", block.text)
    };
    let indented = html.lines().map(|line| format!("{}{line}\n", block.indent));
    indented.collect()
}

/// A fence that is longer than any in the text.
pub(super) fn fence(text: &str) -> String {
    let ticks = |line: &str| line.len() - line.trim_start_matches('`').len();
    let longest = text.lines().map(|line| ticks(line.trim_start())).max().unwrap_or(0);
    "`".repeat(longest.max(2) + 1)
}

/// Whether a text is one of the language, without a mistake.
fn is_sense(text: &str) -> bool {
    let parse = parse(text);
    let has_items = parse.syntax().children().next().is_some();
    has_items && parse.errors().is_empty()
}

/// A listing in the language. With a board in it, it can be run.
fn sense(text: &str, file: Option<&str>) -> String {
    let mut shown = String::new();
    let tree = parse(text).syntax();
    for token in tree.descendants_with_tokens().filter_map(SyntaxElement::into_token) {
        let text = escaped(token.text());
        // A string always takes what is written.
        let _ = match class(&token) {
            Some(class) => write!(shown, "<span class=\"hljs-{class}\">{text}</span>"),
            None => write!(shown, "{text}"),
        };
    }
    let is_run = parse(text).ast().boards().next().is_some();
    let file = file.map(|file| format!(" data-file=\"{}\"", escaped(file))).unwrap_or_default();
    let run = if is_run { " data-run=\"\"" } else { "" };
    format!(
        "<pre class=\"sense\"{file}{run}><code class=\"language-sense nohighlight hljs\">{shown}</code></pre>\n"
    )
}

/// The colour of a token, by the names that highlight.js has for them.
#[expect(clippy::wildcard_enum_match_arm, reason = "most kinds have the colour of the text")]
fn class(token: &SyntaxToken) -> Option<&'static str> {
    let kind = token.kind();
    match kind {
        kind if kind.is_comment() => Some("comment"),
        SyntaxKind::Str => Some("string"),
        SyntaxKind::Int | SyntaxKind::Float | SyntaxKind::Unit => Some("number"),
        kind if kind.word().is_some() => Some("keyword"),
        SyntaxKind::Ident => match token.parent()?.kind() {
            SyntaxKind::Property | SyntaxKind::Connection => Some("attr"),
            SyntaxKind::Type | SyntaxKind::Kind | SyntaxKind::OnClause => Some("type"),
            SyntaxKind::NameValue => None,
            _ => Some("title"),
        },
        _ => None,
    }
}

/// A text in HTML.
pub(super) fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listing_has_its_colours_its_file_and_can_be_run() {
        let page = "Text\n\n```sense robot.sense\nboard A on B {\n\n    sensor L returns uint8 { id = 1; }\n}\n```\n";
        let all = pieces(page);
        let [Piece::Line("Text"), Piece::Line(""), Piece::Block(block)] = all.as_slice() else {
            panic!("{all:?}");
        };
        let html = written(block);
        let begin = "<pre class=\"sense\" data-file=\"robot.sense\" data-run=\"\"><code class=\"language-sense nohighlight hljs\">\
                     <span class=\"hljs-keyword\">board</span> <span class=\"hljs-title\">A</span> \
                     <span class=\"hljs-keyword\">on</span> <span class=\"hljs-type\">B</span> {\n\n";
        assert!(html.starts_with(begin), "{html}");
        assert!(
            html.contains(
                "<span class=\"hljs-attr\">id</span> = <span class=\"hljs-number\">1</span>;"
            ),
            "{html}"
        );
    }

    #[test]
    fn what_is_in_no_language_is_found_by_its_grammar() {
        let of = |text: &str| written(&Block { text: text.to_owned(), ..Block::default() });
        assert!(of("sensor A returns bool { type = gpio; }\n").contains("hljs-keyword"));
        assert_eq!(of("sensedsl solve a.sense\n"), "```text\nsensedsl solve a.sense\n```\n");
        assert_eq!(of("// nothing\n"), "```text\n// nothing\n```\n");
    }

    #[test]
    fn other_blocks_stay_and_files_are_named() {
        let of =
            |info: &'static str| written(&Block { indent: "  ", info, text: "a < b\n".to_owned() });
        assert_eq!(of("sh status=1"), "  ```sh\n  a < b\n  ```\n");
        assert_eq!(of("output"), "  ```text\n  a < b\n  ```\n");
        assert!(
            of("csv pins.csv")
                .contains("<pre data-file=\"pins.csv\"><code class=\"language-csv\">a &lt; b")
        );
        let nested = pieces("````md\n```\ninside\n```\n````\n");
        assert_eq!(nested.len(), 1, "{nested:?}");
    }
}
