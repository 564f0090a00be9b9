//! Text for people, in the style of `rustc`.

use std::ops::Range;

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::excerpt::Excerpt;
use crate::diagnostic::{Diagnostic, Label, Severity};
use crate::source::{FileId, SourceMap, Span, boundary};
use crate::visible::{visible, visible_lines};

/// Renders `diagnostics` one below the other, each followed by an empty line.
#[must_use]
pub fn human(diagnostics: &[Diagnostic], sources: &SourceMap, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut out = String::new();
    for diagnostic in diagnostics {
        let rendered = renderer.render(&[group(diagnostic, sources)]);
        out.push_str(&with_columns(rendered, diagnostic, sources));
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
    let title = level.primary_title(visible(&diagnostic.message)).id(diagnostic.code.name());
    let mut group = Group::with_title(title);
    for file in files(diagnostic) {
        group = of_file(group, diagnostic, file, sources);
    }
    match &diagnostic.help {
        Some(help) => group.element(Level::HELP.message(visible_lines(help))),
        None => group,
    }
}

/// The files that a diagnostic refers to, that of the primary place first.
fn files(diagnostic: &Diagnostic) -> Vec<FileId> {
    let mut files = vec![diagnostic.primary.span.file];
    for label in &diagnostic.labels {
        if !files.contains(&label.span.file) {
            files.push(label.span.file);
        }
    }
    files
}

/// Adds the places in a file: in one snippet if they are close to each other, otherwise in separate ones, so that the
/// text between them is never scanned.
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
    let path = visible(sources.name(file));
    if window.text.len() <= WINDOW_MAX {
        let snippet = window.snippet(&here).path(path);
        return group.element(snippet);
    }
    for (kind, label) in here {
        let window = Window::over(std::iter::once(label.span), file, sources).cut(label.span);
        let at = sources.line_column(file, label.span.start);
        // The position of an excerpt is not visible in the text, so the message states line and column.
        let origin = Origin::path(path.clone()).line(at.line as usize);
        group = group.element(origin.char_column(at.column as usize));
        group = group.element(window.snippet(&[(kind, label)]));
    }
    group
}

/// The most bytes of text that are shown around the places of a diagnostic.
const WINDOW_MAX: usize = 16 << 10;
/// The bytes that are shown before and after a place in a line that is longer than a window.
const CUT_BYTES: usize = 60;

/// The lines around some places.
struct Window<'a> {
    text: &'a str,
    /// The start in the file.
    start: usize,
    /// The number of its first line.
    line: usize,
}

impl<'a> Window<'a> {
    /// The lines from the one before the first place to the one after the last.
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

    /// A piece of the line, if that is too long to show.
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

    /// The shown part of the text, with its places marked.
    fn snippet(&self, places: &[(AnnotationKind, &'a Label)]) -> Snippet<'a, Annotation<'a>> {
        let excerpt = Excerpt::new(self.text, self.start == 0);
        let annotations = places.iter().map(|(kind, label)| {
            let annotation = kind.span(excerpt.shown(self.range(label.span)));
            if label.message.is_empty() {
                annotation
            } else {
                annotation.label(visible(&label.message))
            }
        });
        let annotations: Vec<Annotation<'a>> = annotations.collect();
        Snippet::source(excerpt.text).line_start(self.line).annotations(annotations)
    }

    /// The place as a range that is certainly within the text, on character boundaries.
    fn range(&self, span: Span) -> Range<usize> {
        let here = |offset: u32| boundary(self.text, (offset as usize).saturating_sub(self.start));
        let (start, end) = (here(span.start), here(span.end));
        start..end.max(start)
    }
}

/// Sets columns to those of the file, even if some of its characters are shown as longer codes.
fn with_columns(mut rendered: String, diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    for label in std::iter::once(&diagnostic.primary).chain(&diagnostic.labels) {
        let (file, offset) = (label.span.file, label.span.start);
        let place = sources.line_column(file, offset);
        let start = sources.line_start(file, place.line);
        let text = sources.text(file);
        let before = text.get(start..boundary(text, offset as usize)).unwrap_or_default();
        let excerpt = Excerpt::new(before, start == 0);
        if excerpt.is_changed() {
            let shown = excerpt.text.chars().count() + 1;
            let stands = |column: usize| {
                format!(" {}:{}:{column}\n", visible(sources.name(file)), place.line)
            };
            rendered = rendered.replacen(&stands(shown), &stands(place.column as usize), 1);
        }
    }
    rendered
}
