//! One diagnostic.

use sensedsl_limits::SENTENCE_CHARS_MAX;

use crate::codes::Code;
use crate::source::Span;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The input cannot be used.
    Error,
    /// The input can be used, but the hardware will behave differently than the reader expects.
    Warning,
    /// Something worth knowing.
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

/// A further place and how it relates to the diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// A few words.
    pub message: String,
}

/// The replacement of the text at `span`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; empty for an insertion.
    pub span: Span,
    /// The new text.
    pub text: String,
}

/// A change that fixes the problem, for editors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The effect, as a command ("change to `analog`").
    pub title: String,
    /// The edits; they do not overlap.
    pub edits: Vec<Edit>,
}

/// A statement about the input.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The stable code.
    pub code: Code,
    /// The severity.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The place, and a few words about it (may be empty).
    pub primary: Label,
    /// Further places.
    pub labels: Vec<Label>,
    /// The way out, one or more sentences without a full stop.
    pub help: Option<String>,
    /// The way out as edits.
    pub fix: Option<Fix>,
}

/// A sentence without the middle of a quotation that is as long as a whole file.
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
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.severity(),
            message: short(message.into()),
            primary: Label { span, message: String::new() },
            labels: Vec::new(),
            help: None,
            fix: None,
        }
    }

    /// Sets the words for the primary place.
    pub fn here(mut self, message: impl Into<String>) -> Self {
        self.primary.message = short(message.into());
        self
    }

    /// Adds a further place, if there is one.
    pub fn label(mut self, span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        let place = |span| Label { span, message: short(message.into()) };
        self.labels.extend(span.into().map(place));
        self
    }

    /// Sets the way out.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(short(help.into()));
        self
    }

    /// Asks whether another word was meant, if there is one, and sets it as the way out.
    pub fn meant(self, word: Option<&str>) -> Self {
        let Some(word) = word else { return self };
        let span = self.primary.span;
        self.here(format!("did you mean `{word}`?")).replace(
            format!("change to `{word}`"),
            span,
            word,
        )
    }

    /// Sets the way out as one replacement.
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
