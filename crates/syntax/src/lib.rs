//! From the text of a `.sense` file to a lossless tree, typed views over it and a canonical layout.
//!
//! Any text goes in. Out come a tree that spells exactly that text, as far as the token budget
//! goes, and a list of mistakes. Parsing never fails and never panics: one tree serves the
//! compiler, the formatter and the editor, even while the text is incomplete. Nothing here knows
//! boards, kinds or properties: the model decides what names mean.
//!
//! ```
//! use sensedsl_syntax::parse;
//! let parse = parse("board Rover { sensor Front returns uint16 { id = 17; type = analog; } }");
//! assert!(parse.errors().is_empty());
//! let board = parse.ast().boards().next().expect("one board");
//! assert_eq!(board.name().expect("a name").text(), "Rover");
//! ```

pub mod ast;
pub mod edit;
mod error;
mod fmt;
mod kind;
mod lexer;
mod literal;
mod parser;
mod unit;

pub use error::{Block, Expected, Found, Item, SyntaxError, SyntaxErrorKind};
pub use kind::{SenseDsl, SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
pub use rowan::{TextRange, TextSize};
pub use unit::Unit;

use ast::AstNode as _;
use sensedsl_limits::TOKENS_MAX;

/// The tree of a file and the mistakes in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parse {
    green: rowan::GreenNode,
    errors: Vec<SyntaxError>,
    tokens: usize,
}

impl Parse {
    /// The root of the tree. Its text is the text that was parsed.
    #[must_use]
    pub fn syntax(&self) -> SyntaxNode {
        SyntaxNode::new_root(self.green.clone())
    }

    /// The mistakes, in text order.
    #[must_use]
    pub fn errors(&self) -> &[SyntaxError] {
        &self.errors
    }

    /// The number of tokens read, including spaces and comments.
    #[must_use]
    pub fn tokens(&self) -> usize {
        self.tokens
    }

    /// The typed view over the whole file.
    #[must_use]
    pub fn ast(&self) -> ast::SourceFile {
        #[expect(clippy::expect_used, reason = "the parser makes every root a source file")]
        ast::SourceFile::cast(self.syntax()).expect("the root is a source file")
    }
}

/// Parses the text of a file.
#[must_use]
pub fn parse(text: &str) -> Parse {
    parse_within(text, TOKENS_MAX)
}

/// Parses the text of a file up to `most` tokens. Any further tokens are reported as one of the
/// mistakes, and that part of the text is not in the tree.
#[must_use]
pub fn parse_within(text: &str, most: usize) -> Parse {
    let lexed = lexer::lex(text, most);
    let (green, errors) = parser::parse(text, &lexed);
    Parse { green, errors, tokens: lexed.tokens.len() }
}

/// The text in its canonical layout.
///
/// # Errors
///
/// The mistakes, because a text with mistakes is not laid out.
pub fn format(text: &str) -> Result<String, Vec<SyntaxError>> {
    fmt::format(text)
}
