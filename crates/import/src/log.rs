//! What an import has to say, collected while it runs.

use sensedsl_diagnostics::codes::{
    e0801_import_unreadable, e0802_import_no_table, e0803_import_no_sheet, h0806_import_open,
    w0804_import_dropped, w0805_import_doubtful,
};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap, Span};

use crate::decode::decode;
use crate::place::place_of;

/// So many places of a wrong encoding are reported one by one.
const GUESSES_MAX: usize = 100;

/// The texts that were read and the diagnostics so far.
#[derive(Debug, Default)]
pub(crate) struct Log {
    pub(crate) sources: SourceMap,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Log {
    pub(crate) fn unreadable(&mut self, span: Span, what: &str, why: &str) {
        self.diagnostics.push(e0801_import_unreadable::import_unreadable(span, what, why));
    }

    pub(crate) fn no_table(&mut self, span: Span, what: &str) {
        self.diagnostics.push(e0802_import_no_table::import_no_table(span, what));
    }

    pub(crate) fn no_sheet(&mut self, span: Span, name: &str, sheets: &[String]) {
        self.diagnostics.push(e0803_import_no_sheet::import_no_sheet(span, name, sheets));
    }

    pub(crate) fn dropped(&mut self, span: Span, place: &str, what: &str) {
        self.diagnostics.push(w0804_import_dropped::import_dropped(span, place, what));
    }

    pub(crate) fn doubtful(&mut self, span: Span, place: &str, what: &str) {
        self.diagnostics.push(w0805_import_doubtful::import_doubtful(span, place, what));
    }

    pub(crate) fn open(&mut self, span: Span, what: &str) {
        self.diagnostics.push(h0806_import_open::import_open(span, what));
    }

    /// Adds a file as text and reports what of it is no UTF-8, each at its cell.
    pub(crate) fn text(&mut self, name: &str, bytes: &[u8]) -> (FileId, String) {
        let Some(decoded) = decode(bytes) else {
            let file = self.sources.add(name, "");
            self.unreadable(Span::new(file, 0..0), name, "it is no text");
            return (file, String::new());
        };
        let file = self.sources.add(name, decoded.text.as_str());
        if let Some(encoding) = decoded.wide {
            let what = format!("the file is no UTF-8 but {encoding}, and was read so");
            self.doubtful(Span::new(file, 0..0), "", &what);
        }
        for guess in decoded.guesses.iter().take(GUESSES_MAX) {
            let read = decoded.text.get(guess.range.clone()).unwrap_or_default();
            let bytes: Vec<String> = guess.bytes.iter().map(|b| format!("0x{b:02X}")).collect();
            let (bytes, offset) = (bytes.join(" "), guess.offset);
            let what = if read.contains(char::REPLACEMENT_CHARACTER) {
                format!("byte {offset} ({bytes}) is no character in UTF-8 or Windows-1252")
            } else {
                format!("byte {offset} ({bytes}) is no UTF-8; read as `{read}` of Windows-1252")
            };
            let span = Span::new(file, guess.range.clone());
            self.doubtful(span, &place_of(&decoded.text, guess.range.start), &what);
        }
        if let Some(more) = decoded.guesses.len().checked_sub(GUESSES_MAX).filter(|more| *more > 0)
        {
            let what = format!("{more} more places are no UTF-8 and were read as Windows-1252");
            self.doubtful(Span::new(file, decoded.text.len()..decoded.text.len()), "", &what);
        }
        (file, decoded.text)
    }
}
