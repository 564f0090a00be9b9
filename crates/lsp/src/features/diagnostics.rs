//! Diagnostics: what is wrong in a design in, what each of its files shows out.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{w0601_unused_property, w0604_unused_rule};
use sensedsl_diagnostics::{Diagnostic, Severity, Span};

use crate::analysis::{Analysis, Wired};
use crate::documents::Documents;
use crate::place::Lines;
use crate::protocol::{self, Location, Range, Related};

/// The mark of what could be left out.
const UNNECESSARY: u8 = 1;

/// The diagnostics by the URI of their file. What is about a built-in text is shown where the file begins.
pub(crate) fn by_file(
    analysis: &Analysis,
    wired: &Wired,
    documents: &Documents,
) -> BTreeMap<String, Vec<protocol::Diagnostic>> {
    let places = Places::new(analysis, documents);
    let mut found: BTreeMap<String, Vec<protocol::Diagnostic>> = BTreeMap::new();
    for (uri, told) in wired.diagnostics.iter().filter_map(|one| places.told(one)) {
        found.entry(uri).or_default().push(told);
    }
    found
}

/// The lines of all files that were read.
pub(crate) struct Places<'a> {
    analysis: &'a Analysis,
    documents: &'a Documents,
    lines: Vec<Lines>,
}

impl<'a> Places<'a> {
    pub(crate) fn new(analysis: &'a Analysis, documents: &'a Documents) -> Self {
        let snapshot = &analysis.snapshot;
        let texts = snapshot.files().iter().map(|file| snapshot.sources().text(*file));
        let lines = texts.map(|text| Lines::new(text, documents.encoding)).collect();
        Self { analysis, documents, lines }
    }

    /// A diagnostic as the client is told it, with the URI of its file.
    pub(crate) fn told(&self, one: &Diagnostic) -> Option<(String, protocol::Diagnostic)> {
        let Location { uri, range } = self.of(one.primary.span).or_else(|| self.start())?;
        Some((uri, self.shown(one, range)))
    }

    fn of(&self, span: Span) -> Option<Location> {
        let snapshot = &self.analysis.snapshot;
        let at = snapshot.files().iter().position(|file| *file == span.file)?;
        let text = snapshot.sources().text(span.file);
        let uri = self.documents.uri(snapshot.sources().name(span.file));
        Some(Location { uri, range: self.lines.get(at)?.range(text, span.range()) })
    }

    fn start(&self) -> Option<Location> {
        let file = self.analysis.snapshot.files().first()?;
        self.of(Span::new(*file, 0..0))
    }

    fn shown(&self, one: &Diagnostic, range: Range) -> protocol::Diagnostic {
        let mut message = one.message.clone();
        let here = Some(&one.primary.message).filter(|here| !here.is_empty());
        let help = one.help.as_ref().map(|help| format!("help: {help}"));
        for more in here.into_iter().chain(help.as_ref()) {
            message.push('\n');
            message.push_str(more);
        }
        let related = one.labels.iter().filter_map(|label| {
            let location = self.of(label.span)?;
            Some(Related { location, message: label.message.clone() })
        });
        let is_of_no_use =
            [w0601_unused_property::CODE, w0604_unused_rule::CODE].contains(&one.code);
        protocol::Diagnostic {
            range,
            severity: match one.severity {
                Severity::Error => 1,
                Severity::Warning => 2,
                Severity::Hint => 4,
            },
            code: one.code.to_string(),
            source: "sensedsl".to_owned(),
            message,
            related_information: related.collect(),
            tags: if is_of_no_use { vec![UNNECESSARY] } else { Vec::new() },
        }
    }
}
