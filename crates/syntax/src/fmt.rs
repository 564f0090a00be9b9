//! The canonical layout: a text in; the same tokens and comments out, with one statement per line,
//! four spaces of indentation per block and one space between words.
//!
//! A block written on one line stays on one line if it fits and contains no comments or blocks.
//!
//! Numbers and strings keep their spelling. Comments keep their place: after a statement, on a line
//! of their own, or within a statement. At most one blank line is kept between statements, and none
//! at the edges of a block. The layout of a laid-out text is the same text.

use crate::error::SyntaxError;
use crate::kind::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
use crate::{lexer, parser};
use sensedsl_limits::TOKENS_MAX;

const INDENT: &str = "    ";
/// The longest line for a block that stays on one line.
const LINE_LETTERS_MAX: usize = 100;

/// The text in its canonical layout, or the mistakes that prevent it.
pub(crate) fn format(text: &str) -> Result<String, Vec<SyntaxError>> {
    let lexed = lexer::lex(text, TOKENS_MAX);
    let (green, errors) = parser::parse(text, &lexed);
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut printer = Printer::new(text.len());
    let elements = SyntaxNode::new_root(green).descendants_with_tokens();
    for token in elements.filter_map(SyntaxElement::into_token) {
        let (kind, text) = (token.kind(), token.text());
        if kind == SyntaxKind::Whitespace {
            printer.breaks += lines(text).count() - 1;
        } else if kind.is_comment() {
            printer.comment(kind, text);
        } else if kind != SyntaxKind::Bom {
            if kind == SyntaxKind::LBrace {
                printer.is_inline = stays_inline(&token, printer.depth);
            }
            printer.token(kind, sides(&token), text);
        }
    }
    Ok(printer.finish())
}

/// The sides on which a token takes a space, if its neighbour does too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Sides {
    before: bool,
    after: bool,
}

fn sides(token: &SyntaxToken) -> Sides {
    use SyntaxKind::{Comma, LBracket, LParen, Minus, Plus, RBracket, RParen, Semicolon};
    let parent = token.parent();
    let within = |kind| parent.as_ref().is_some_and(|node| node.kind() == kind);
    let kind = token.kind();
    if kind == SyntaxKind::Dot {
        return Sides { before: false, after: false };
    }
    if kind == SyntaxKind::DotDot {
        let is_operation = |node: SyntaxNode| node.kind() == SyntaxKind::Binary;
        let is_condition =
            |node: &SyntaxNode| node.parent().is_some_and(|of| of.kind() == SyntaxKind::Inside);
        let spaced =
            parent.is_some_and(|node| is_condition(&node) || node.children().any(is_operation));
        return Sides { before: spaced, after: spaced };
    }
    // A sign has no space before its operand; an operator does.
    let is_sign = matches!(kind, Plus | Minus) && !within(SyntaxKind::Binary);
    let is_array = kind == LBracket && (within(SyntaxKind::Type) || within(SyntaxKind::Index));
    let is_call = kind == LParen && within(SyntaxKind::Call);
    let before = !matches!(kind, Semicolon | Comma | RBracket | RParen) && !is_array && !is_call;
    Sides { before, after: !matches!(kind, LBracket | LParen) && !is_sign }
}

/// Whether the block that the brace opens is written on one line and can stay that way.
fn stays_inline(brace: &SyntaxToken, depth: usize) -> bool {
    let Some(block) = brace.parent().filter(|block| block.kind() != SyntaxKind::Board) else {
        return false;
    };
    let tokens = block.descendants_with_tokens().filter_map(SyntaxElement::into_token);
    let mut letters = depth * INDENT.len();
    let mut braces = 0;
    let (mut has_begun, mut space_after) = (false, false);
    for token in tokens {
        let kind = token.kind();
        if kind == SyntaxKind::Whitespace {
            if has_begun && braces < 2 && lines(token.text()).count() > 1 {
                return false;
            }
            continue;
        }
        if kind.is_comment() {
            return false;
        }
        braces += usize::from(matches!(kind, SyntaxKind::LBrace | SyntaxKind::RBrace));
        let sides = sides(&token);
        letters += usize::from(has_begun && sides.before && space_after);
        letters += token.text().chars().count();
        (has_begun, space_after) = (true, sides.after);
    }
    braces == 2 && letters <= LINE_LETTERS_MAX
}

/// The lines of a text, with any kind of line ending.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.split("\r\n").flat_map(|lines| lines.split(['\n', '\r']))
}

/// The last thing printed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    Nothing,
    Token,
    LineComment,
    BlockComment {
        /// Whether only comments are before it on its line.
        leads: bool,
    },
}

struct Printer {
    out: String,
    /// The number of open blocks.
    depth: usize,
    last: Last,
    /// The last token that is not a comment.
    last_token: Option<SyntaxKind>,
    /// Whether that token takes a space after it.
    space_after: bool,
    /// The line breaks in the source since the last token or comment.
    breaks: usize,
    /// Whether the open block stays on one line.
    is_inline: bool,
}

impl Printer {
    fn new(capacity: usize) -> Self {
        let out = String::with_capacity(capacity);
        let last = Last::Nothing;
        Self {
            out,
            depth: 0,
            last,
            last_token: None,
            space_after: true,
            breaks: 0,
            is_inline: false,
        }
    }

    fn between_statements(&self) -> bool {
        matches!(
            self.last_token,
            None | Some(SyntaxKind::LBrace | SyntaxKind::RBrace | SyntaxKind::Semicolon)
        )
    }

    fn opens_block(&self) -> bool {
        self.last == Last::Token && self.last_token == Some(SyntaxKind::LBrace)
    }

    fn opens_brackets(&self) -> bool {
        matches!(self.last_token, Some(SyntaxKind::LBracket | SyntaxKind::LParen))
    }

    fn comment(&mut self, kind: SyntaxKind, text: &str) {
        let own_line = self.breaks > 0 || matches!(self.last, Last::Nothing | Last::LineComment);
        let leads = own_line || self.last == (Last::BlockComment { leads: true });
        if own_line {
            self.new_line();
        } else if self.last != Last::Token || !self.opens_brackets() {
            self.out.push(' ');
        }
        for (index, line) in lines(text).enumerate() {
            if index > 0 {
                self.out.push('\n');
            }
            self.out.push_str(line.trim_end());
        }
        self.breaks = 0;
        self.last = if kind == SyntaxKind::BlockComment {
            Last::BlockComment { leads }
        } else {
            Last::LineComment
        };
    }

    fn token(&mut self, kind: SyntaxKind, sides: Sides, text: &str) {
        if kind == SyntaxKind::RBrace {
            self.depth = self.depth.saturating_sub(1);
            if std::mem::take(&mut self.is_inline) {
                self.out.push_str(if self.opens_block() { "" } else { " " });
            } else if !self.opens_block() {
                self.breaks = 0;
                self.new_line();
            }
        } else if self.is_inline && self.between_statements() {
            self.out.push(' ');
        } else if self.between_statements() {
            if self.breaks == 0 && self.last == (Last::BlockComment { leads: true }) {
                self.out.push(' ');
            } else {
                self.new_line();
            }
        } else if self.last == Last::LineComment {
            self.new_line();
        } else if sides.before && (self.last != Last::Token || self.space_after) {
            self.out.push(' ');
        }
        self.out.push_str(text);
        if kind == SyntaxKind::LBrace {
            self.depth += 1;
        }
        self.breaks = 0;
        self.last = Last::Token;
        self.last_token = Some(kind);
        self.space_after = sides.after;
    }

    /// Begins a line, after a blank line if the source has one here. A continuation line of a
    /// statement is indented once more.
    fn new_line(&mut self) {
        let between = self.between_statements();
        if self.last != Last::Nothing {
            self.out.push('\n');
            if self.breaks > 1 && between && !self.opens_block() {
                self.out.push('\n');
            }
        }
        let depth = self.depth + usize::from(!between);
        (0..depth).for_each(|_| self.out.push_str(INDENT));
    }

    fn finish(mut self) -> String {
        if self.last != Last::Nothing {
            self.out.push('\n');
        }
        self.out
    }
}
