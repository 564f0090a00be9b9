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

/// A change of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The place of the change.
    pub span: Span,
    /// The new text.
    pub text: String,
    /// What of the text the place stands for.
    pub scope: Scope,
}

/// What is changed at the place of an edit.
///
/// Only a tree knows where statements and blocks end. Whoever has the tree turns these edits into edits of
/// [`Scope::Text`] before anybody sees them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The text at the place is replaced; an empty place is one to insert at.
    Text,
    /// The statement in which the place begins is replaced; without a new text, it is removed with its line.
    Statement,
    /// The new text is a statement. It is added to the block in whose head, or in which, the place begins.
    Block,
}

/// A change that fixes the problem, for editors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The effect, as a command ("change to `analog`").
    pub title: String,
    /// The edits; they do not overlap. There may be several files.
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
    /// The ways out as edits. If there are several, each is a different one.
    pub fixes: Vec<Fix>,
}

/// The most texts that are offered to choose from.
const CHOICES_MAX: usize = 8;

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
            fixes: Vec::new(),
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

    /// Asks whether another word was meant, if there is one, and adds it as a way out.
    pub fn meant(self, word: Option<&str>) -> Self {
        let Some(word) = word else { return self };
        let span = self.primary.span;
        self.here(format!("did you mean `{word}`?")).replace(
            format!("change to `{word}`"),
            span,
            word,
        )
    }

    /// Adds a way out: one replacement.
    pub fn replace(self, title: impl Into<String>, span: Span, text: impl Into<String>) -> Self {
        self.change(title, span, text, Scope::Text)
    }

    /// Adds a way out for each of a few texts: it replaces the text at the primary place. Of more texts than a person
    /// would read, there is none.
    pub fn one_of<'a>(mut self, texts: impl IntoIterator<Item = &'a str>) -> Self {
        let texts: Vec<&str> = texts.into_iter().collect();
        if texts.len() <= CHOICES_MAX {
            let span = self.primary.span;
            for text in texts {
                self = self.replace(format!("change to `{text}`"), span, text);
            }
        }
        self
    }

    /// Adds a way out: the statement in which `span` begins is removed.
    pub fn remove(self, title: impl Into<String>, span: Span) -> Self {
        self.change(title, span, "", Scope::Statement)
    }

    /// Adds a way out: a statement is added to the block in whose head `span` is.
    pub fn add(self, span: Span, statement: &str) -> Self {
        self.change(format!("add `{statement}`"), span, statement, Scope::Block)
    }

    /// Adds a way out: a longer cycle time. `delay` is the place of the one that is written; where none is, the statement
    /// is added to the block in whose head `name` is.
    pub fn longer_delay(self, name: Span, delay: Option<Span>, needs_ms: &str) -> Self {
        let statement = format!("delay = {needs_ms} ms;");
        match delay {
            Some(delay) => {
                self.replace(format!("write `{statement}`"), delay, statement.trim_end_matches(';'))
            }
            None => {
                self.change(format!("write `{statement}`"), name, statement.clone(), Scope::Block)
            }
        }
    }

    /// Adds a way out as one edit.
    pub fn change(
        mut self,
        title: impl Into<String>,
        span: Span,
        text: impl Into<String>,
        scope: Scope,
    ) -> Self {
        let edits = vec![Edit { span, text: text.into(), scope }];
        self.fixes.push(Fix { title: title.into(), edits });
        self
    }
}
