//! For people, in the manner of `rustc`.

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::diagnostic::{Diagnostic, Label, Severity};
use crate::source::{FileId, SourceMap, Span, boundary};

/// Renders `diagnostics` one below the other, each followed by an empty line.
#[must_use]
pub fn human(diagnostics: &[Diagnostic], sources: &SourceMap, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut out = String::new();
    for diagnostic in diagnostics {
        out.push_str(&renderer.render(&[group(diagnostic, sources)]));
        out.push_str("\n\n");
    }
    out
}

fn group<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap) -> Group<'a> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Hint => Level::NOTE.with_name("hint"),
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code.name());
    let mut group = Group::with_title(title);
    for file in files(diagnostic) {
        group = of_file(group, diagnostic, file, sources);
    }
    match &diagnostic.help {
        Some(help) => group.element(Level::HELP.message(help.as_str())),
        None => group,
    }
}

/// The files a diagnostic speaks of, that of the primary place first.
fn files(diagnostic: &Diagnostic) -> Vec<FileId> {
    let mut files = vec![diagnostic.primary.span.file];
    for label in &diagnostic.labels {
        if !files.contains(&label.span.file) {
            files.push(label.span.file);
        }
    }
    files
}

/// Adds the places in a file: in one snippet where they are near each other, otherwise each in its
/// own, so that the text between them is never gone through.
fn of_file<'a>(
    mut group: Group<'a>,
    diagnostic: &'a Diagnostic,
    file: FileId,
    sources: &'a SourceMap,
) -> Group<'a> {
    let primary = (AnnotationKind::Primary, &diagnostic.primary);
    let labels = diagnostic.labels.iter().map(|label| (AnnotationKind::Context, label));
    let here: Vec<(AnnotationKind, &Label)> =
        std::iter::once(primary).chain(labels).filter(|(_, one)| one.span.file == file).collect();
    let window = Window::over(here.iter().map(|(_, label)| label.span), file, sources);
    if window.text.len() <= WINDOW_MAX {
        let annotations = here.into_iter().map(|(kind, label)| window.annotation(kind, label));
        let snippet = Snippet::source(window.text).path(sources.name(file));
        return group.element(snippet.line_start(window.line).annotations(annotations));
    }
    for (kind, label) in here {
        let window = Window::over(std::iter::once(label.span), file, sources).cut(label.span);
        let at = sources.line_column(file, label.span.start);
        // What is cut has no column of its own, so the place is given.
        let origin = Origin::path(sources.name(file)).line(at.line as usize);
        group = group.element(origin.char_column(at.column as usize));
        let snippet = Snippet::source(window.text).line_start(window.line);
        group = group.element(snippet.annotation(window.annotation(kind, label)));
    }
    group
}

/// Bytes of text that are shown around the places of a diagnostic.
const WINDOW_MAX: usize = 16 << 10;
/// Bytes that are shown before and behind a place in a line that is longer than a window.
const CUT_BYTES: usize = 60;

/// The lines around some places.
struct Window<'a> {
    text: &'a str,
    /// Where it starts in the file.
    start: usize,
    /// The number of its first line.
    line: usize,
}

impl<'a> Window<'a> {
    /// From a line before the first place to a line after the last.
    fn over(spans: impl Iterator<Item = Span>, file: FileId, sources: &'a SourceMap) -> Self {
        let (start, end) = spans.fold((u32::MAX, 0), |(start, end), span| {
            (start.min(span.start), end.max(span.start).max(span.end))
        });
        let first = sources.line_column(file, start).line.saturating_sub(1).max(1);
        let last = sources.line_column(file, end).line.saturating_add(2);
        let start = sources.line_start(file, first);
        let text = sources.text(file).get(start..sources.line_start(file, last));
        Self { text: text.unwrap_or_default(), start, line: first as usize }
    }

    /// What is left when the line is too long to be shown: a piece of it.
    fn cut(self, span: Span) -> Self {
        if self.text.len() <= WINDOW_MAX {
            return self;
        }
        let place = boundary(self.text, (span.start as usize).saturating_sub(self.start));
        let line = self.text.get(..place).map_or(0, |before| before.matches('\n').count());
        let begin = self.text.get(..place).and_then(|before| before.rfind('\n'));
        let begin = begin.map_or(0, |newline| newline + 1).max(place.saturating_sub(CUT_BYTES));
        let end = boundary(self.text, place + CUT_BYTES);
        let rest = self.text.get(place..).and_then(|rest| rest.find('\n'));
        let end = rest.map_or(end, |length| end.min(place + length));
        let begin = boundary(self.text, begin);
        let text = self.text.get(begin..end).unwrap_or_default();
        Self { text, start: self.start + begin, line: self.line + line }
    }

    /// The place as a range that surely lies in the text, on character boundaries.
    fn annotation(&self, kind: AnnotationKind, label: &'a Label) -> Annotation<'a> {
        let here = |offset: u32| boundary(self.text, (offset as usize).saturating_sub(self.start));
        let (start, end) = (here(label.span.start), here(label.span.end));
        let annotation = kind.span(start..end.max(start));
        if label.message.is_empty() { annotation } else { annotation.label(label.message.as_str()) }
    }
}
