//! What was written and where: a file and a range of its syntax in, the place that a diagnostic needs out. Everything
//! that is read keeps its place, so this file needs no other one.

use sensedsl_diagnostics::{FileId, Span};
use sensedsl_syntax::{TextRange, ast};

/// A value and where it was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// The place of the value.
    pub span: Span,
}

/// The span of a syntax range.
pub(crate) fn span(file: FileId, range: TextRange) -> Span {
    Span::new(file, range.start().into()..range.end().into())
}

/// A name and where it is written.
pub(crate) fn named(file: FileId, name: &ast::Name) -> Spanned<String> {
    Spanned { value: name.text().to_owned(), span: span(file, name.range()) }
}
