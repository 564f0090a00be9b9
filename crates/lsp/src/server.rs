//! The server as a state machine: a message in, messages out.
//!
//! [`Server::handle`] answers at once from what the text says; it never looks for a wiring. [`Server::settle`] does, once
//! no message waits, and publishes the diagnostics; a new message cancels it.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use sensedsl_model::Files;
use sensedsl_session::Patience;
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

use crate::analysis::{Analysis, Wired};
use crate::answer::{Refusal, of};
use crate::context::Context;
use crate::documents::Documents;
use crate::features;
use crate::place::{Encoding, path_of};
use crate::protocol::{
    ChangeParams, CommandParams, Diagnostic, DocumentParams, Identifier, OpenParams, PublishParams,
};

/// Where the server gets files that are not open.
pub trait Folders {
    /// The files that a design at that path may name.
    fn files_of(&self, path: &str) -> Box<dyn Files + '_>;
}

/// How far a session is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Stage {
    #[default]
    New,
    Running,
    ShutDown,
    /// As the protocol asks for, or not.
    Exited(bool),
}

/// A language server.
pub struct Server<F> {
    folders: F,
    stage: Stage,
    documents: Documents,
    /// By path, of what the texts are now.
    analyses: BTreeMap<String, Rc<Analysis>>,
    /// By path, of what the texts were when there was time to look for a wiring.
    wired: BTreeMap<String, Rc<Wired>>,
    /// What the client was told, by URI.
    published: BTreeMap<String, (Option<i32>, Vec<Diagnostic>)>,
    /// Whether diagnostics may have changed.
    is_dirty: bool,
    /// What the client redraws when it is asked to.
    refreshes: Vec<&'static str>,
    requests_sent: i32,
}

impl<F: Folders> Server<F> {
    /// A server that waits for `initialize`.
    pub fn new(folders: F) -> Self {
        Self {
            folders,
            stage: Stage::New,
            documents: Documents::default(),
            analyses: BTreeMap::new(),
            wired: BTreeMap::new(),
            published: BTreeMap::new(),
            is_dirty: false,
            refreshes: Vec::new(),
            requests_sent: 0,
        }
    }

    /// The surroundings that it was made with.
    pub fn folders_mut(&mut self) -> &mut F {
        &mut self.folders
    }

    /// Whether the client has ended the session: `Some(true)` if it had asked for that before.
    pub fn exited(&self) -> Option<bool> {
        match self.stage {
            Stage::Exited(properly) => Some(properly),
            Stage::New | Stage::Running | Stage::ShutDown => None,
        }
    }

    /// Whether [`Self::settle`] has anything to do.
    pub fn is_dirty(&self) -> bool {
        self.is_dirty
    }

    /// Takes a message, and answers it. `cancel` ends searches that a request needs; such a request is refused.
    pub fn handle(&mut self, message: Message, cancel: Cancel<'_>) -> Vec<Message> {
        match message {
            Message::Request(request) => vec![Message::Response(self.answer(request, cancel))],
            Message::Notification(told) => {
                self.take(told);
                Vec::new()
            }
            // Only to requests to draw something again.
            Message::Response(_) => Vec::new(),
        }
    }

    fn answer(&mut self, request: Request, cancel: Cancel<'_>) -> Response {
        let Request { id, method, params } = request;
        let early = self.stage == Stage::New && method != "initialize";
        if early {
            let code = ErrorCode::ServerNotInitialized as i32;
            return Response::new_err(id, code, "`initialize` comes first".to_owned());
        }
        if self.stage == Stage::ShutDown {
            let code = ErrorCode::InvalidRequest as i32;
            return Response::new_err(id, code, "the server was shut down".to_owned());
        }
        let result = match method.as_str() {
            "initialize" => Some(Ok(self.initialize(&params))),
            "shutdown" => {
                self.stage = Stage::ShutDown;
                Some(Ok(Value::Null))
            }
            other => self.ask(other, params, cancel),
        };
        match result {
            Some(Ok(result)) => Response::new_ok(id, result),
            Some(Err(refusal)) => refused(id, refusal),
            None => {
                let code = ErrorCode::MethodNotFound as i32;
                Response::new_err(id, code, format!("there is no method {method}"))
            }
        }
    }

    fn initialize(&mut self, params: &Value) -> Value {
        self.stage = Stage::Running;
        let offered = params.pointer("/capabilities/general/positionEncodings").cloned();
        let offered: Vec<String> = offered.and_then(of).unwrap_or_default();
        self.documents.encoding = Encoding::of(&offered);
        let can = |path: &str| params.pointer(path).and_then(Value::as_bool).unwrap_or_default();
        self.documents.snippets =
            can("/capabilities/textDocument/completion/completionItem/snippetSupport");
        for (path, method) in [
            ("/capabilities/workspace/inlayHint/refreshSupport", "workspace/inlayHint/refresh"),
            ("/capabilities/workspace/codeLens/refreshSupport", "workspace/codeLens/refresh"),
        ] {
            self.refreshes.extend(can(path).then_some(method));
        }
        json!({
            "capabilities": features::capabilities(self.documents.encoding),
            "serverInfo": { "name": "sensedsl", "version": env!("CARGO_PKG_VERSION") },
        })
    }

    /// Answers a request about a file; none if there is no such request.
    fn ask(
        &mut self,
        method: &str,
        params: Value,
        cancel: Cancel<'_>,
    ) -> Option<Result<Value, Refusal>> {
        if let Some(feature) = features::of_all(method) {
            let paths: Vec<String> = self.documents.paths().map(str::to_owned).collect();
            let roots: BTreeSet<String> = paths.iter().map(|path| self.root_of(path)).collect();
            let found = roots.iter().map(|root| {
                self.context(root, cancel).map_or(Ok(Vec::new()), |cx| feature(&cx, &params))
            });
            let found: Result<Vec<Vec<Value>>, Refusal> = found.collect();
            return Some(found.map(|found| Value::from(found.concat())));
        }
        if let Some(feature) = features::of_nothing(method) {
            return Some(feature(params));
        }
        if method == "workspace/executeCommand" {
            return Some(self.execute(params, cancel));
        }
        let feature = features::of_document(method)?;
        let Some(about) = of::<DocumentParams>(params.clone()) else {
            return Some(Err(Refusal::Parameters("a file is missing".to_owned())));
        };
        let Identifier { uri } = about.text_document;
        let answer = self.context(&path_of(&uri), cancel).map(|cx| feature(&cx, params));
        Some(answer.unwrap_or(Ok(Value::Null)))
    }

    /// Answers a command, whose arguments are a file and the name of something in it.
    fn execute(&mut self, params: Value, cancel: Cancel<'_>) -> Result<Value, Refusal> {
        let misused = || Refusal::Parameters("a command has a file and a name".to_owned());
        let CommandParams { command, arguments } = of(params).ok_or_else(misused)?;
        let mut words = arguments.iter().map(|one| one.as_str().unwrap_or_default());
        let (Some(uri), Some(name)) = (words.next(), words.next()) else { return Err(misused()) };
        let cx = self.context(&path_of(uri), cancel);
        let cx = cx.ok_or_else(|| Refusal::Impossible(format!("{uri} is not open")))?;
        features::executed(&cx, &command, name)
    }

    fn take(&mut self, told: Notification) {
        let Notification { method, params } = told;
        match method.as_str() {
            "textDocument/didOpen" => {
                if let Some(OpenParams { text_document: item }) = of(params) {
                    let path = self.documents.open(item.uri, item.version, item.text);
                    self.changed(&path);
                }
            }
            "textDocument/didChange" => {
                if let Some(ChangeParams { text_document: at, content_changes }) = of(params) {
                    let path = self.documents.change(&at.uri, at.version, content_changes);
                    path.iter().for_each(|path| self.changed(path));
                }
            }
            "textDocument/didClose" => {
                if let Some(DocumentParams { text_document }) = of(params) {
                    let path = self.documents.close(&text_document.uri);
                    self.wired.remove(&path);
                    self.changed(&path);
                }
            }
            "workspace/didChangeWatchedFiles" | "textDocument/didSave" => self.forget(),
            "exit" => self.stage = Stage::Exited(self.stage == Stage::ShutDown),
            _ => {}
        }
    }

    /// Takes note that files which are not open have changed.
    pub fn forget(&mut self) {
        self.analyses.clear();
        self.is_dirty = true;
    }

    /// Drops what the text of a file was part of, or could be part of now.
    fn changed(&mut self, path: &str) {
        let stale = |analysis: &Analysis| {
            let snapshot = &analysis.snapshot;
            let is_read = analysis.file(path).is_some();
            // A file that could not be read may be this one.
            is_read || snapshot.sources().find(path).is_some() || snapshot.design().is_none()
        };
        self.analyses.retain(|root, analysis| root != path && !stale(analysis));
        self.is_dirty = true;
    }

    fn analysis(&mut self, path: &str) -> Rc<Analysis> {
        if let Some(known) = self.analyses.get(path) {
            return Rc::clone(known);
        }
        let files = self.folders.files_of(path);
        let new = Rc::new(Analysis::new(&self.documents.workspace, path, files.as_ref()));
        drop(files);
        self.analyses.insert(path.to_owned(), Rc::clone(&new));
        new
    }

    /// The file that a file is read as a part of: an open one that uses it, or else itself.
    fn root_of(&mut self, path: &str) -> String {
        let others: Vec<String> = self.documents.paths().map(str::to_owned).collect();
        let uses = |root: &String| root != path && self.analysis(root).file(path).is_some();
        others.into_iter().find(uses).unwrap_or_else(|| path.to_owned())
    }

    /// Everything that is known of an open file.
    fn context<'a>(&'a mut self, path: &str, cancel: Cancel<'a>) -> Option<Context<'a>> {
        self.documents.get(path)?;
        let root = self.root_of(path);
        let analysis = self.analysis(&root);
        let wired = analysis.known().or_else(|| self.wired.get(&root).cloned());
        Context::new(&self.documents, path, analysis, wired, cancel)
    }

    /// Looks for wirings, and publishes what has changed. If it is stopped it tells nothing, and begins anew the next time.
    pub fn settle(&mut self, patience: Patience<'_>) -> Vec<Message> {
        if !self.is_dirty || self.stage != Stage::Running {
            return Vec::new();
        }
        let open: Vec<String> = self.documents.paths().map(str::to_owned).collect();
        let roots: BTreeSet<String> = open.iter().map(|path| self.root_of(path)).collect();
        let mut found: BTreeMap<String, Vec<Diagnostic>> = BTreeMap::new();
        for path in &open {
            found.entry(self.documents.uri(path)).or_default();
        }
        let mut has_moved = false;
        for root in &roots {
            let analysis = self.analysis(root);
            let Some(wired) = analysis.answer(patience) else { return Vec::new() };
            let told = features::diagnostics::by_file(&analysis, &wired, &self.documents);
            for (uri, mut diagnostics) in told {
                let of_file = found.entry(uri).or_default();
                diagnostics.retain(|one| !of_file.contains(one));
                of_file.append(&mut diagnostics);
            }
            // After a mistake the last good wiring is still worth showing.
            if wired.wired().is_some() {
                let old = self.wired.insert(root.clone(), Rc::clone(&wired));
                has_moved |= old.is_none_or(|old| !Rc::ptr_eq(&old, &wired));
            }
        }
        self.is_dirty = false;
        let mut messages = self.publish(found);
        if has_moved {
            for method in self.refreshes.clone() {
                self.requests_sent += 1;
                let id = RequestId::from(self.requests_sent);
                messages.push(Message::Request(Request::new(id, method.to_owned(), Value::Null)));
            }
        }
        messages
    }

    /// Tells the diagnostics that differ from those that were told, and that there are none any more.
    fn publish(&mut self, mut found: BTreeMap<String, Vec<Diagnostic>>) -> Vec<Message> {
        for uri in self.published.keys() {
            found.entry(uri.clone()).or_default();
        }
        let mut messages = Vec::new();
        for (uri, diagnostics) in found {
            let version = self.documents.get(&path_of(&uri)).map(|document| document.version);
            let known = self.published.get(&uri);
            let is_known = known.is_some_and(|known| known.0 == version && known.1 == diagnostics);
            let is_gone = version.is_none() && diagnostics.is_empty();
            if is_gone {
                self.published.remove(&uri);
            } else {
                self.published.insert(uri.clone(), (version, diagnostics.clone()));
            }
            if !is_known {
                let params = PublishParams { uri, version, diagnostics };
                let method = "textDocument/publishDiagnostics".to_owned();
                messages.push(Message::Notification(Notification::new(method, params)));
            }
        }
        messages
    }
}

fn refused(id: RequestId, refusal: Refusal) -> Response {
    let (code, why) = match refusal {
        Refusal::Parameters(why) => (ErrorCode::InvalidParams, why),
        Refusal::Impossible(why) => (ErrorCode::RequestFailed, why),
        Refusal::Cancelled => {
            (ErrorCode::ContentModified, "the text changed before the answer was found".to_owned())
        }
    };
    Response::new_err(id, code as i32, why)
}
