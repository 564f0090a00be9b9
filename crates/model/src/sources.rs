//! Reading a file and all files it uses, in the order of their items.

use sensedsl_diagnostics::codes::{e0110_misplaced_item, e0218_used_file_missing, e0219_use_cycle};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap};
use sensedsl_syntax::ast::{self, AstNode as _, FileItem};
use sensedsl_syntax::parse;

use crate::fields::span;
use crate::syntax_errors;

/// How library code reads files: given by the binary, or by a test.
pub trait Files {
    /// The text of the file at `path`.
    ///
    /// # Errors
    /// The machine's reason, in words.
    fn read(&self, path: &str) -> Result<String, String>;
}

/// The items of a file and of what it uses, each with its file, in order.
#[derive(Debug, Default)]
pub(crate) struct Items {
    pub(crate) boards: Vec<(FileId, ast::Board)>,
    pub(crate) drivers: Vec<(FileId, ast::Driver)>,
    /// Devices with the index of their board.
    pub(crate) devices: Vec<(FileId, ast::Device, Option<usize>)>,
    /// Some text could not be parsed: what is missing may be a consequence.
    pub(crate) broken: bool,
}

pub(crate) struct Reader<'a> {
    pub(crate) files: &'a dyn Files,
    pub(crate) sources: &'a mut SourceMap,
    pub(crate) diagnostics: &'a mut Vec<Diagnostic>,
    pub(crate) items: Items,
    /// Paths of the files that are being read, outermost first.
    open: Vec<String>,
    /// Paths of all files that were read.
    done: Vec<String>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(
        files: &'a dyn Files,
        sources: &'a mut SourceMap,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        let (open, done) = (Vec::new(), Vec::new());
        Self { files, sources, diagnostics, items: Items::default(), open, done }
    }

    /// Reads the text of `path` (and what it uses).
    pub(crate) fn read(&mut self, path: &str, text: String) -> FileId {
        let file = self.sources.add(path, text);
        let parsed = parse(self.sources.text(file));
        for error in parsed.errors() {
            self.diagnostics.push(syntax_errors::diagnostic(error, file));
            self.items.broken = true;
        }
        self.open.push(normal(path));
        for item in parsed.ast().items() {
            self.item(path, file, item);
        }
        self.done.extend(self.open.pop());
        file
    }

    fn item(&mut self, path: &str, file: FileId, item: FileItem) {
        match item {
            FileItem::Use(used) => self.used(path, file, &used),
            FileItem::Driver(driver) => self.items.drivers.push((file, driver)),
            FileItem::Device(device) => self.items.devices.push((file, device, None)),
            FileItem::Board(board) if self.open.len() > 1 => {
                let at = board.name().map_or_else(|| board.range(), |name| name.range());
                self.diagnostics.push(e0110_misplaced_item::misplaced_item(
                    span(file, at),
                    "a board in a used file",
                    "into the file that is solved",
                ));
            }
            FileItem::Board(board) => {
                let index = self.items.boards.len();
                for device in board.devices() {
                    self.items.devices.push((file, device, Some(index)));
                }
                self.items.boards.push((file, board));
            }
        }
    }

    fn used(&mut self, from: &str, file: FileId, used: &ast::Use) {
        let Some(path) = used.path() else { return };
        let at = span(file, path.range());
        let target = beside(from, &path.value());
        let key = normal(&target);
        if let Some(start) = self.open.iter().position(|open| *open == key) {
            let mut circle: Vec<&str> = self.open.iter().skip(start).map(String::as_str).collect();
            circle.push(&key);
            self.diagnostics.push(e0219_use_cycle::use_cycle(at, &circle.join(" -> ")));
            return;
        }
        if self.done.contains(&key) {
            return;
        }
        match self.files.read(&target) {
            Ok(text) => {
                self.read(&target, text);
            }
            Err(why) => {
                let missing = e0218_used_file_missing::used_file_missing(at, &target, &why);
                self.diagnostics.push(missing);
            }
        }
    }
}

/// The path `relative` as seen from the folder of the file `from`.
pub(crate) fn beside(from: &str, relative: &str) -> String {
    let absolute = relative.starts_with('/') || relative.get(1..2) == Some(":");
    match from.rfind(['/', '\\']) {
        Some(end) if !absolute => {
            let folder = from.get(..=end).unwrap_or_default();
            format!("{folder}{relative}")
        }
        Some(_) | None => relative.into(),
    }
}

/// A path without `.` and with `..` resolved where that is possible in the text.
fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| !matches!(*last, ".." | "")) => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_to_the_using_file() {
        assert_eq!(beside("a/b.sense", "c.sense"), "a/c.sense");
        assert_eq!(beside("b.sense", "c.sense"), "c.sense");
        assert_eq!(beside("a/b.sense", "/c.sense"), "/c.sense");
        assert_eq!(normal("a/./b/../c.sense"), "a/c.sense");
        assert_eq!(normal("../c.sense"), "../c.sense");
    }
}
