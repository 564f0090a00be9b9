//! The language server in a page or a worker: JSON texts in and out, files from the client.
//!
//! A page has no disk. What a design uses and is not open the client is asked for once, with the notification
//! `sensedsl/wanted` and its `uris`; it answers with `sensedsl/files`, a map from URIs to texts, `null` where there is no
//! such file.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use sensedsl_lsp::{Folders, Message, Notification, Server, path_of, uri_of};
use sensedsl_model::{FileRequest, Files, ReadError};
use sensedsl_session::Patience;
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

use crate::request::Request;

/// What the client has given, and what it has not been asked for yet.
#[derive(Debug, Default)]
struct Given {
    texts: BTreeMap<String, Option<String>>,
    wanted: BTreeSet<String>,
}

#[derive(Clone, Debug, Default)]
struct Client(Rc<RefCell<Given>>);

impl Files for Client {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        let mut given = self.0.borrow_mut();
        match given.texts.get(wanted.path) {
            Some(Some(text)) if text.len() > wanted.what.bytes_max() => Err(ReadError::TooLarge),
            Some(Some(text)) => Ok(text.clone()),
            Some(None) => Err(ReadError::Missing),
            None => {
                given.wanted.insert(wanted.path.to_owned());
                Err(ReadError::Missing)
            }
        }
    }
}

impl Folders for Client {
    fn files_of(&self, _: &str) -> Box<dyn Files + '_> {
        Box::new(self.clone())
    }
}

/// A language server for one client.
pub struct Editor {
    server: Server<Client>,
    client: Client,
}

impl Default for Editor {
    fn default() -> Self {
        let client = Client::default();
        Self { server: Server::new(client.clone()), client }
    }
}

impl Editor {
    /// Takes a message, a JSON object, and returns a JSON list of messages. A text that is no message is answered with
    /// an empty list.
    pub fn message(&mut self, text: &str) -> String {
        let Ok(message) = serde_json::from_str::<Message>(text) else { return "[]".to_owned() };
        if let Message::Notification(Notification { method, params }) = &message
            && method == "sensedsl/files"
        {
            self.take(params);
            return "[]".to_owned();
        }
        listed(self.server.handle(message, Cancel::NEVER))
    }

    /// Looks for wirings; a JSON list of messages. To be called once no message waits: it runs to its end.
    pub fn settle(&mut self) -> String {
        let mut messages = self.server.settle(Patience::default());
        let wanted = std::mem::take(&mut self.client.0.borrow_mut().wanted);
        if !wanted.is_empty() {
            let uris: Vec<String> = wanted.iter().map(|path| uri_of(path)).collect();
            let method = "sensedsl/wanted".to_owned();
            let told = Notification::new(method, json!({ "uris": uris }));
            messages.push(Message::Notification(told));
        }
        listed(messages)
    }

    /// Takes files of the client.
    fn take(&mut self, params: &Value) {
        let files = params.get("files").and_then(Value::as_object);
        for (uri, text) in files.into_iter().flatten() {
            let text = text.as_str().map(str::to_owned);
            self.client.0.borrow_mut().texts.insert(path_of(uri), text);
        }
        self.server.forget();
    }
}

/// The texts of the files that change when a wire of a device or a chip is put on a pin; `error` says why it cannot be.
pub(crate) fn pinned(of: &Request, name: &str, wire: &str, pin: &str) -> Value {
    let mut editor = Editor::default();
    let uri = |path: &str| uri_of(path);
    let open = |path: &str, text: &str| {
        let item =
            json!({ "uri": uri(path), "languageId": "sensedsl", "version": 1, "text": text });
        json!({ "method": "textDocument/didOpen", "params": { "textDocument": item } })
    };
    let ask = json!({ "id": 1, "method": "initialize", "params": { "capabilities": {
        "general": { "positionEncodings": ["utf-8"] } } } });
    editor.message(&ask.to_string());
    for (path, text) in &of.files {
        editor.message(&open(path, text).to_string());
    }
    let params =
        json!({ "textDocument": { "uri": uri(&of.path) }, "name": name, "wire": wire, "pin": pin });
    let ask = json!({ "id": 2, "method": "sensedsl/pin", "params": params });
    let answers: Vec<Value> =
        serde_json::from_str(&editor.message(&ask.to_string())).unwrap_or_default();
    let answer = answers.into_iter().find(|one| one.get("id") == Some(&json!(2)));
    let Some(changes) = answer.as_ref().and_then(|one| one.pointer("/result/changes")) else {
        let why = answer.as_ref().and_then(|one| one.pointer("/error/message"));
        return json!({ "files": null, "error": why });
    };
    let edited = of.files.iter().filter_map(|(path, text)| {
        let text = edited(text, changes.get(uri(path))?)?;
        Some((path.clone(), Value::from(text)))
    });
    json!({ "files": edited.collect::<serde_json::Map<_, _>>(), "error": null })
}

/// A text after edits whose characters are counted in UTF-8.
fn edited(text: &str, edits: &Value) -> Option<String> {
    let starts: Vec<usize> =
        std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let place = |edit: &Value, end: &str| {
        let number =
            |what: &str| edit.pointer(&format!("/range/{end}/{what}"))?.as_u64()?.try_into().ok();
        let line: usize = number("line")?;
        let character: usize = number("character")?;
        Some(starts.get(line)? + character)
    };
    let all = edits.as_array()?.iter().map(|edit| {
        let new = edit.get("newText")?.as_str()?.to_owned();
        Some((place(edit, "start")?..place(edit, "end")?, new))
    });
    Some(sensedsl_syntax::edit::applied(text, all.collect::<Option<Vec<_>>>()?))
}

/// Messages as JSON, each with the version of the protocol, which a client may insist on.
fn listed(messages: Vec<Message>) -> String {
    let shown = messages.into_iter().filter_map(|message| {
        let mut value = serde_json::to_value(message).ok()?;
        value.as_object_mut()?.insert("jsonrpc".to_owned(), json!("2.0"));
        Some(value)
    });
    Value::from(shown.collect::<Vec<_>>()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(editor: &mut Editor, method: &str, params: &Value) {
        let message = json!({ "jsonrpc": "2.0", "method": method, "params": params });
        assert_eq!(editor.message(&message.to_string()), "[]");
    }

    fn settled(editor: &mut Editor) -> Vec<Value> {
        serde_json::from_str(&editor.settle()).unwrap()
    }

    #[test]
    fn files_that_are_not_open_come_from_the_client() {
        let mut editor = Editor::default();
        let ask = json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } });
        let answer: Value = serde_json::from_str(&editor.message(&ask.to_string())).unwrap();
        assert_eq!((&answer[0]["jsonrpc"], &answer[0]["id"]), (&json!("2.0"), &json!(1)));
        let text = "use \"legs.sense\";\nboard B on STM32F4DiscoveryBoard {}\n";
        let item = json!({ "uri": "vscode-vfs://github/me/a.sense", "languageId": "sensedsl", "version": 1, "text": text });
        told(&mut editor, "textDocument/didOpen", &json!({ "textDocument": item }));
        let first = settled(&mut editor);
        assert_eq!(first[0]["params"]["diagnostics"][0]["code"], "E0218");
        let legs = "vscode-vfs://github/me/legs.sense";
        assert_eq!(first[1]["params"]["uris"], json!([legs]));
        let leg = "sensor Leg returns uint16 { id = 1; type = analog; }";
        told(&mut editor, "sensedsl/files", &json!({ "files": { legs: leg } }));
        let second = settled(&mut editor);
        assert_eq!(second[0]["params"]["diagnostics"], json!([]));
        assert_eq!(second.len(), 1);
        assert_eq!(editor.message("no message"), "[]");
    }
}
