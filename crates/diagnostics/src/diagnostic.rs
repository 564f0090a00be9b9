//! One diagnostic.

use sensedsl_limits::SENTENCE_CHARS_MAX;

use crate::codes::Code;
use crate::source::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The input cannot be used.
    Error,
    /// It can, but the hardware will do something else than the reader expects.
    Warning,
    /// Good to know.
    Hint,
}

impl Severity {
    /// The word for people and for JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Hint => "hint",
        }
    }
}

/// A further place and what it has to do with the matter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// A few words.
    pub message: String,
}

/// Replace the text at `span`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty for an insertion.
    pub span: Span,
    /// By what.
    pub text: String,
}

/// A change that mends the matter, for editors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What it does, as a command ("change to `analog`").
    pub title: String,
    /// The edits; they do not overlap.
    pub edits: Vec<Edit>,
}

/// Something to say about the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its stable code.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The place, and a few words for it (may be empty).
    pub primary: Label,
    /// Further places.
    pub labels: Vec<Label>,
    /// The way out, one or more sentences without a full stop.
    pub help: Option<String>,
    /// The way out as edits.
    pub fix: Option<Fix>,
}

/// A sentence without the middle of what it quotes, where that is a whole file.
fn short(sentence: String) -> String {
    const HALF: usize = SENTENCE_CHARS_MAX / 2;
    let mut places = sentence.char_indices().map(|(at, _)| at);
    let (Some(end), Some(_)) = (places.nth(HALF), places.nth(SENTENCE_CHARS_MAX - HALF)) else {
        return sentence;
    };
    let start = sentence.char_indices().rev().nth(HALF - 1).map_or(end, |(at, _)| at);
    let (head, tail) = (sentence.get(..end), sentence.get(start..));
    format!("{} … {}", head.unwrap_or_default(), tail.unwrap_or_default())
}

impl Diagnostic {
    /// A diagnostic of `code` with the severity of its registry entry.
    #[must_use]
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.info().severity,
            message: short(message.into()),
            primary: Label { span, message: String::new() },
            labels: Vec::new(),
            help: None,
            fix: None,
        }
    }

    /// Words for the primary place.
    #[must_use]
    pub fn here(mut self, message: impl Into<String>) -> Self {
        self.primary.message = short(message.into());
        self
    }

    /// A further place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(Label { span, message: short(message.into()) });
        self
    }

    /// The way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(short(help.into()));
        self
    }

    /// The way out as one replacement.
    #[must_use]
    pub fn replace(
        mut self,
        title: impl Into<String>,
        span: Span,
        text: impl Into<String>,
    ) -> Self {
        let edits = vec![Edit { span, text: text.into() }];
        self.fix = Some(Fix { title: title.into(), edits });
        self
    }
}
