//! The open files: what an editor tells of them in, their texts out.

use std::collections::BTreeMap;

use sensedsl_session::Workspace;

use crate::place::{Encoding, Lines, path_of, uri_of};
use crate::protocol::Change;

/// An open file.
#[derive(Debug)]
pub(crate) struct Document {
    /// As the editor spells it.
    pub(crate) uri: String,
    pub(crate) version: i32,
    pub(crate) text: String,
    pub(crate) lines: Lines,
}

/// All open files, by path.
#[derive(Debug, Default)]
pub(crate) struct Documents {
    open: BTreeMap<String, Document>,
    /// The same texts, as the rest of the tool reads them.
    pub(crate) workspace: Workspace,
    pub(crate) encoding: Encoding,
    /// Whether the client can fill in the places of a text.
    pub(crate) snippets: bool,
}

impl Documents {
    pub(crate) fn open(&mut self, uri: String, version: i32, text: String) -> String {
        let path = path_of(&uri);
        self.workspace.open(&path, text.as_str());
        let lines = Lines::new(&text, self.encoding);
        self.open.insert(path.clone(), Document { uri, version, text, lines });
        path
    }

    /// Changes an open file in the order of the changes, and returns its path; none if it is not open.
    pub(crate) fn change(
        &mut self,
        uri: &str,
        version: i32,
        changes: Vec<Change>,
    ) -> Option<String> {
        let path = path_of(uri);
        let document = self.open.get_mut(&path)?;
        for change in changes {
            match change.range {
                Some(range) => {
                    let bytes = document.lines.bytes(&document.text, range);
                    document.text.replace_range(bytes, &change.text);
                }
                None => document.text = change.text,
            }
            document.lines = Lines::new(&document.text, self.encoding);
        }
        document.version = version;
        self.workspace.open(&path, document.text.as_str());
        Some(path)
    }

    pub(crate) fn close(&mut self, uri: &str) -> String {
        let path = path_of(uri);
        self.open.remove(&path);
        self.workspace.close(&path);
        path
    }

    pub(crate) fn get(&self, path: &str) -> Option<&Document> {
        self.open.get(path)
    }

    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        self.open.keys().map(String::as_str)
    }

    /// The URI of a path: that of the editor where it has named one.
    pub(crate) fn uri(&self, path: &str) -> String {
        self.open.get(path).map_or_else(|| uri_of(path), |document| document.uri.clone())
    }
}
