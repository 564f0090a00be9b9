//! An editor that is played: it opens texts, moves a cursor, and asks.

use std::collections::BTreeMap;

use sensedsl_lsp::{Folders, Message, Notification, Request, Response, Server};
use sensedsl_model::{FileRequest, Files, ReadError};
use sensedsl_session::Patience;
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

/// Files that are on the disk, and not open.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stored(pub BTreeMap<String, String>);

impl Files for Stored {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        self.0.get(wanted.path).cloned().ok_or(ReadError::Missing)
    }
}

impl Folders for Stored {
    fn files_of(&self, _: &str) -> Box<dyn Files + '_> {
        Box::new(self.clone())
    }
}

/// A session after `initialize`.
pub(crate) struct Session {
    pub server: Server<Stored>,
    next: i32,
    version: i32,
    /// The diagnostics that were told last, by URI.
    pub told: BTreeMap<String, Vec<Value>>,
}

/// The file that most tests are about.
pub(crate) const FILE: &str = "file:///robot/a.sense";

impl Session {
    pub(crate) fn new() -> Self {
        Self::with(Stored::default(), &json!({}))
    }

    pub(crate) fn with(stored: Stored, capabilities: &Value) -> Self {
        let server = Server::new(stored);
        let mut session = Self { server, next: 0, version: 0, told: BTreeMap::new() };
        session.ask("initialize", json!({ "capabilities": capabilities }));
        session.tell("initialized", json!({}));
        session
    }

    /// A session with an open text, and the places of its marks `$0`, in order, which are not part of it.
    pub(crate) fn of(marked: &str) -> (Self, Vec<Value>) {
        let mut session = Self::new();
        let places = session.open(FILE, marked);
        (session, places)
    }

    pub(crate) fn open(&mut self, uri: &str, marked: &str) -> Vec<Value> {
        let (text, places) = unmarked(marked);
        self.version += 1;
        let item =
            json!({ "uri": uri, "languageId": "sensedsl", "version": self.version, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }));
        places
    }

    pub(crate) fn response(&mut self, method: &str, params: Value) -> Response {
        self.next += 1;
        let request = Request::new(self.next.into(), method.to_owned(), params);
        let mut answers = self.server.handle(Message::Request(request), Cancel::NEVER);
        assert_eq!(answers.len(), 1, "{answers:?}");
        match answers.pop() {
            Some(Message::Response(response)) => response,
            other => panic!("{other:?}"),
        }
    }

    /// The answer to a request, which must have one.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> Value {
        match self.response(method, params).response_result {
            Ok(result) => result,
            Err(error) => panic!("{method}: {error:?}"),
        }
    }

    /// The answer to a request about a place of [`FILE`].
    pub(crate) fn at(&mut self, method: &str, place: &Value) -> Value {
        self.ask(method, json!({ "textDocument": { "uri": FILE }, "position": place }))
    }

    /// The answer to a request about all of [`FILE`].
    pub(crate) fn whole(&mut self, method: &str) -> Value {
        self.ask(method, json!({ "textDocument": { "uri": FILE } }))
    }

    pub(crate) fn tell(&mut self, method: &str, params: Value) {
        let told = Notification::new(method.to_owned(), params);
        let answers = self.server.handle(Message::Notification(told), Cancel::NEVER);
        assert!(answers.is_empty(), "{answers:?}");
    }

    /// Lets the server look for wirings; what it asks the client for.
    pub(crate) fn settle(&mut self) -> Vec<String> {
        let mut asked = Vec::new();
        for message in self.server.settle(Patience::default()) {
            match message {
                Message::Notification(told) => {
                    let uri = told.params["uri"].as_str().unwrap().to_owned();
                    let all = told.params["diagnostics"].as_array().unwrap().clone();
                    self.told.insert(uri, all);
                }
                Message::Request(request) => asked.push(request.method),
                Message::Response(response) => panic!("{response:?}"),
            }
        }
        asked
    }

    /// The codes that [`FILE`] has.
    pub(crate) fn codes(&self) -> Vec<&str> {
        let told = self.told.get(FILE).into_iter().flatten();
        told.map(|one| one["code"].as_str().unwrap()).collect()
    }
}

/// A text without its marks, and their places in UTF-16.
pub(crate) fn unmarked(marked: &str) -> (String, Vec<Value>) {
    let (mut text, mut places) = (String::new(), Vec::new());
    let mut parts = marked.split("$0").peekable();
    while let Some(part) = parts.next() {
        text.push_str(part);
        if parts.peek().is_some() {
            let line = text.matches('\n').count();
            let column = text.rsplit('\n').next().unwrap().encode_utf16().count();
            places.push(json!({ "line": line, "character": column }));
        }
    }
    (text, places)
}

/// A text after the edits of an answer.
pub(crate) fn edited(text: &str, edits: &Value) -> String {
    let offset = |at: &Value| {
        let line = usize::try_from(at["line"].as_u64().unwrap()).unwrap();
        let column = usize::try_from(at["character"].as_u64().unwrap()).unwrap();
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        let mut units = 0;
        let rest = &text[start..];
        let found = rest.char_indices().find(|(_, one)| {
            let is_here = units >= column;
            units += one.len_utf16();
            is_here
        });
        start + found.map_or(rest.len(), |(at, _)| at)
    };
    let mut all: Vec<(usize, usize, &str)> = edits
        .as_array()
        .unwrap()
        .iter()
        .map(|one| {
            let range = &one["range"];
            (offset(&range["start"]), offset(&range["end"]), one["newText"].as_str().unwrap())
        })
        .collect();
    all.sort_by_key(|one| std::cmp::Reverse((one.0, one.1)));
    let mut text = text.to_owned();
    for (start, end, new) in all {
        text.replace_range(start..end, new);
    }
    text
}
