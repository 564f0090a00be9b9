//! Workflow commands of GitHub Actions: one line per diagnostic.

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::SourceMap;
use crate::visible::{visible, visible_lines};

/// A `::error file=…` line for each diagnostic.
#[must_use]
pub fn github(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics {
        let span = diagnostic.primary.span;
        let (start, end) =
            (sources.line_column(span.file, span.start), sources.line_column(span.file, span.end));
        let command = match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Hint => "notice",
        };
        let mut message = diagnostic.message.clone();
        if let Some(help) = &diagnostic.help {
            message = format!("{message}\nhelp: {help}");
        }
        out.push_str(&format!(
            "::{command} file={},line={},endLine={},col={},endColumn={},title={}::{}\n",
            escape_property(&visible(sources.name(span.file))),
            start.line,
            end.line,
            start.column,
            end.column,
            diagnostic.code,
            escape(&visible_lines(&message)),
        ));
    }
    out
}

fn escape(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn escape_property(text: &str) -> String {
    escape(text).replace(':', "%3A").replace(',', "%2C")
}
