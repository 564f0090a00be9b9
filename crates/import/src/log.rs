//! The diagnostics of an import, collected while it runs.

use sensedsl_diagnostics::codes::{
    e0317_table_too_large, e0801_import_unreadable, e0802_import_no_table, e0803_import_no_sheet,
    e0807_import_too_large, e0809_include_unreadable, h0806_import_open, w0804_import_dropped,
    w0805_import_doubtful,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Severity, SourceMap, Span};
use sensedsl_limits::{DIAGNOSTICS_MAX, SOURCE_TEXT_BYTES_MAX};
use sensedsl_model::ReadError;

use crate::decode::decode;
use crate::package::Refused;
use crate::place::Places;

/// The texts that were read and the diagnostics so far.
#[derive(Debug, Default)]
pub(crate) struct Log {
    pub(crate) sources: SourceMap,
    diagnostics: Vec<Diagnostic>,
    errors: usize,
    /// The number of diagnostics that are not listed.
    more: usize,
}

impl Log {
    fn push(&mut self, diagnostic: Diagnostic) {
        let is_error = diagnostic.severity == Severity::Error;
        if is_error && self.errors >= DIAGNOSTICS_MAX {
            self.more += 1;
            return;
        }
        // An error is always listed: less severe diagnostics make room for it.
        while is_error && self.diagnostics.len() + 2 > DIAGNOSTICS_MAX {
            let less = self.diagnostics.iter().rposition(|one| one.severity != Severity::Error);
            let Some(less) = less else { break };
            drop(self.diagnostics.remove(less));
            self.more += 1;
        }
        if is_error || self.diagnostics.len() < DIAGNOSTICS_MAX {
            self.errors += usize::from(is_error);
            self.diagnostics.push(diagnostic);
        } else {
            self.more += 1;
        }
    }

    /// Whether the import has already failed.
    pub(crate) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Whether no further error is listed, so that reading on tells nothing new.
    pub(crate) fn is_full(&self) -> bool {
        self.more > 0 && self.errors >= DIAGNOSTICS_MAX
    }

    /// Adds an error, unless there is one with the same code.
    pub(crate) fn once(&mut self, error: Diagnostic) {
        if self.diagnostics.iter().all(|one| one.code != error.code) {
            self.push(error);
        }
    }

    /// Adds a mistake in a table that is already a diagnostic.
    pub(crate) fn say(&mut self, diagnostic: Diagnostic) {
        self.push(diagnostic);
    }

    /// The diagnostics, in the order of the source.
    pub(crate) fn finish(self) -> (SourceMap, Vec<Diagnostic>) {
        let Self { sources, mut diagnostics, more, .. } = self;
        diagnostics.sort_by_key(|one| (one.primary.span, one.code));
        if let Some(last) = diagnostics.last().filter(|_| more > 0) {
            let what = format!("{more} more things to say of the source are not listed");
            let report = w0804_import_dropped::import_dropped(last.primary.span, "", &what);
            diagnostics.push(report);
        }
        (sources, diagnostics)
    }

    /// Reports that a file named by the source was not read.
    pub(crate) fn refused(&mut self, span: Span, path: &str, unread: &ReadError) {
        let help = match unread {
            ReadError::Outside(folder) => {
                format!("copy it into the folder, or allow it with `--allow-outside {folder}`")
            }
            ReadError::Missing
            | ReadError::Why(_)
            | ReadError::NotAFile(_)
            | ReadError::TooLarge
            | ReadError::AllTooLarge => {
                "name a file of a reasonable size that can be read".to_owned()
            }
        };
        self.push(e0809_include_unreadable::include_unreadable(span, path, &unread.why(), &help));
    }

    /// Reports that a workbook or an XML file was not read.
    pub(crate) fn not_read(&mut self, span: Span, name: &str, refused: &Refused) {
        match refused {
            Refused::TooMuch(what, most) => self.too_large(span, name, what, *most),
            Refused::Why(why) => self.unreadable(span, name, why),
        }
    }

    /// Reports that there is more of something than is read.
    pub(crate) fn too_large(&mut self, span: Span, name: &str, what: &str, most: usize) {
        self.once(e0807_import_too_large::import_too_large(span, name, what, most));
    }

    /// Reports that a table has more of something than is read.
    pub(crate) fn table_too_large(&mut self, span: Span, what: &str, most: usize) {
        self.once(e0317_table_too_large::table_too_large(span, what, most));
    }

    pub(crate) fn unreadable(&mut self, span: Span, what: &str, why: &str) {
        self.push(e0801_import_unreadable::import_unreadable(span, what, why));
    }

    pub(crate) fn no_table(&mut self, span: Span, what: &str) {
        self.push(e0802_import_no_table::import_no_table(span, what));
    }

    pub(crate) fn no_pins(&mut self, span: Span, what: &str) {
        self.push(e0802_import_no_table::import_no_pins(span, what));
    }

    pub(crate) fn no_sheet(&mut self, span: Span, name: &str, sheets: &[String]) {
        self.push(e0803_import_no_sheet::import_no_sheet(span, name, sheets));
    }

    pub(crate) fn dropped(&mut self, span: Span, place: &str, what: &str) {
        self.push(w0804_import_dropped::import_dropped(span, place, what));
    }

    pub(crate) fn doubtful(&mut self, span: Span, place: &str, what: &str) {
        self.push(w0805_import_doubtful::import_doubtful(span, place, what));
    }

    pub(crate) fn open(&mut self, span: Span, what: &str) {
        self.push(h0806_import_open::import_open(span, what));
    }

    /// Adds a file as text and reports anything in it that is not UTF-8, each at its cell.
    pub(crate) fn text(&mut self, name: &str, bytes: &[u8]) -> (FileId, String) {
        if bytes.len() > SOURCE_TEXT_BYTES_MAX {
            let file = self.sources.add(name, "");
            let what = "bytes, the most that a text has";
            self.too_large(Span::new(file, 0..0), name, what, SOURCE_TEXT_BYTES_MAX);
            return (file, String::new());
        }
        let Some(decoded) = decode(bytes) else {
            let file = self.sources.add(name, "");
            self.unreadable(Span::new(file, 0..0), name, "it is not text");
            return (file, String::new());
        };
        let file = self.sources.add(name, decoded.text.as_str());
        if let Some(encoding) = decoded.wide {
            let what = format!("the file is no UTF-8 but {encoding}, and was read so");
            self.doubtful(Span::new(file, 0..0), "", &what);
        }
        let places = Places::new(&decoded.text);
        for guess in &decoded.guesses {
            let read = decoded.text.get(guess.range.clone()).unwrap_or_default();
            let bytes: Vec<String> = guess.bytes.iter().map(|b| format!("0x{b:02X}")).collect();
            let (bytes, offset) = (bytes.join(" "), guess.offset);
            let what = if read.contains(char::REPLACEMENT_CHARACTER) {
                format!("byte {offset} ({bytes}) is not a character in UTF-8 or Windows-1252")
            } else {
                format!("byte {offset} ({bytes}) is no UTF-8; read as `{read}` of Windows-1252")
            };
            let span = Span::new(file, guess.range.clone());
            self.doubtful(span, &places.of(guess.range.start), &what);
        }
        if let more @ 1.. = decoded.more {
            let what = format!("{more} more places are no UTF-8 and were read as Windows-1252");
            self.doubtful(Span::new(file, decoded.text.len()..decoded.text.len()), "", &what);
        }
        (file, decoded.text)
    }
}
