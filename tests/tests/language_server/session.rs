//! A client of the language server: it starts the program, and talks to it over pipes.

use std::collections::BTreeMap;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

pub(super) struct Editor {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    next: i64,
    version: i64,
    /// What the server can do.
    pub(super) capabilities: Value,
    /// The diagnostics of each file, as they were told last.
    pub(super) told: BTreeMap<String, Value>,
    /// The version of each file that they are of.
    of_version: BTreeMap<String, i64>,
}

impl Editor {
    pub(super) fn start() -> Self {
        let mut command = Command::new(sensedsl_tests::binary());
        command.arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::inherit());
        let mut child = command.spawn().unwrap();
        let (to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut editor = Self {
            child,
            to,
            from: BufReader::new(from),
            next: 0,
            version: 0,
            capabilities: Value::Null,
            told: BTreeMap::new(),
            of_version: BTreeMap::new(),
        };
        let answer = editor
            .ask("initialize", json!({ "processId": null, "rootUri": null, "capabilities": {} }));
        editor.capabilities = answer["capabilities"].clone();
        editor.tell("initialized", json!({}));
        editor
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        write!(self.to, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        self.to.flush().unwrap();
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.from.read_line(&mut line).unwrap() > 0, "the server has gone");
            if let Some(number) = line.strip_prefix("Content-Length: ") {
                length = number.trim().parse().unwrap();
            }
            if line == "\r\n" {
                break;
            }
        }
        let mut bytes = vec![0; length];
        self.from.read_exact(&mut bytes).unwrap();
        let message: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(message["jsonrpc"], "2.0");
        if message["method"] == "textDocument/publishDiagnostics" {
            let params = &message["params"];
            let uri = params["uri"].as_str().unwrap().to_owned();
            self.of_version.insert(uri.clone(), params["version"].as_i64().unwrap_or_default());
            self.told.insert(uri, params["diagnostics"].clone());
        }
        message
    }

    pub(super) fn ask(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let message = self.receive();
            if message["id"] == id {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
        }
    }

    pub(super) fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Opens a file; its URI.
    pub(super) fn open(&mut self, path: &str, text: &str) -> String {
        let uri = format!("file://{path}");
        self.version += 1;
        let item =
            json!({ "uri": uri, "languageId": "sensedsl", "version": self.version, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }));
        uri
    }

    /// Replaces a range of an open file.
    pub(super) fn edit(&mut self, uri: &str, range: Value, text: &str) {
        self.version += 1;
        let file = json!({ "uri": uri, "version": self.version });
        let change = json!({ "range": range, "text": text });
        self.tell(
            "textDocument/didChange",
            json!({ "textDocument": file, "contentChanges": [change] }),
        );
    }

    /// The diagnostics of the newest text of a file.
    pub(super) fn diagnostics(&mut self, uri: &str) -> Value {
        while self.of_version.get(uri) != Some(&self.version) {
            self.receive();
        }
        self.told[uri].clone()
    }

    /// Ends the session; the status of the program.
    pub(super) fn end(mut self) -> i32 {
        self.ask("shutdown", Value::Null);
        self.tell("exit", Value::Null);
        self.child.wait().unwrap().code().unwrap()
    }

    /// Goes without a word; the status of the program.
    pub(super) fn drop_it(self) -> i32 {
        let Self { mut child, to, from, .. } = self;
        drop((to, from));
        child.wait().unwrap().code().unwrap()
    }
}
