//! What a feature is given: the file that it is asked about, and everything that is known of it.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use std::ops::Range as Bytes;
use std::rc::Rc;

use sensedsl_diagnostics::{FileId, Span};
use sensedsl_model::SyntaxTree;
use sensedsl_syntax::ast::SourceFile;
use sensedsl_syntax::{SyntaxKind, SyntaxNode, SyntaxToken, TextRange, TextSize};
use sensedsl_wiring::Cancel;

use crate::analysis::{Analysis, Wired};
use crate::documents::{Document, Documents};
use crate::place::Lines;
use crate::protocol::{Location, Position, Range, TextEdit};

/// A file at one moment.
pub(crate) struct Context<'a> {
    pub(crate) documents: &'a Documents,
    /// What the file is part of: itself, or an open file that uses it.
    pub(crate) analysis: Rc<Analysis>,
    /// The newest wiring, which may be one of an earlier text.
    pub(crate) wired: Option<Rc<Wired>>,
    pub(crate) path: String,
    pub(crate) file: FileId,
    pub(crate) text: &'a str,
    lines: &'a Lines,
    tree: SyntaxTree,
    /// Ends searches that are long.
    pub(crate) cancel: Cancel<'a>,
}

impl<'a> Context<'a> {
    /// None if the file is not open, or could not be read.
    pub(crate) fn new(
        documents: &'a Documents,
        path: &str,
        analysis: Rc<Analysis>,
        wired: Option<Rc<Wired>>,
        cancel: Cancel<'a>,
    ) -> Option<Self> {
        let Document { text, lines, .. } = documents.get(path)?;
        let file = analysis.file(path)?;
        let tree = analysis.tree(file)?.clone();
        let path = path.to_owned();
        Some(Self { documents, analysis, wired, path, file, text, lines, tree, cancel })
    }

    pub(crate) fn offset(&self, at: Position) -> usize {
        self.lines.offset(self.text, at)
    }

    pub(crate) fn range(&self, bytes: Bytes<usize>) -> Range {
        self.lines.range(self.text, bytes)
    }

    /// The range of a node or a token of this file.
    pub(crate) fn range_of(&self, range: TextRange) -> Range {
        self.range(bytes(range))
    }

    /// The place of a span in any file that was read; none of what is built in.
    pub(crate) fn location(&self, span: Span) -> Option<Location> {
        let snapshot = &self.analysis.snapshot;
        snapshot.files().contains(&span.file).then(|| {
            let sources = snapshot.sources();
            let text = sources.text(span.file);
            let lines = Lines::new(text, self.documents.encoding);
            let uri = self.documents.uri(sources.name(span.file));
            Location { uri, range: lines.range(text, span.range()) }
        })
    }

    pub(crate) fn edit(&self, bytes: Bytes<usize>, text: impl Into<String>) -> TextEdit {
        TextEdit { range: self.range(bytes), new_text: text.into() }
    }

    pub(crate) fn bytes(&self, range: Range) -> Bytes<usize> {
        self.lines.bytes(self.text, range)
    }

    pub(crate) fn root(&self) -> SyntaxNode {
        self.tree.syntax()
    }

    pub(crate) fn ast(&self) -> SourceFile {
        self.tree.ast()
    }

    /// The token at an offset; between two the one that says more.
    pub(crate) fn token(&self, offset: usize) -> Option<SyntaxToken> {
        let offset = TextSize::from(u32::try_from(offset).ok()?);
        let root = self.root();
        if offset > root.text_range().end() {
            return None;
        }
        root.token_at_offset(offset).max_by_key(|token| weight(token.kind()))
    }
}

/// How much a kind of token says.
fn weight(kind: SyntaxKind) -> u8 {
    match kind {
        SyntaxKind::Ident | SyntaxKind::Str => 3,
        kind if kind.is_trivia() => 0,
        kind if kind >= SyntaxKind::LBrace && kind <= SyntaxKind::DotDot => 1,
        _ => 2,
    }
}

/// The bytes of a range of the tree.
pub(crate) fn bytes(range: TextRange) -> Bytes<usize> {
    range.start().into()..range.end().into()
}
