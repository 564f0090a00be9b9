//! How long an editor waits while somebody types into a file of a hundred devices: for each key a change, and what editors
//! ask for after it. The peer is one reading of the whole file from nothing, in the same run.
//!
//! `cargo bench -p sensedsl-tests --bench typing`
#![expect(clippy::disallowed_methods, reason = "a benchmark measures time and prints")]

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use sensedsl_lsp::{Folders, Message, Notification, Request, Server};
use sensedsl_model::{Files, NoFiles};
use sensedsl_session::{On, Patience, Workspace};
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

const URI: &str = "file:///robot/robot.sense";
const DEVICES: usize = 100;
const KEYS: usize = 500;

struct Nothing;

impl Folders for Nothing {
    fn files_of(&self, _: &str) -> Box<dyn Files + '_> {
        Box::new(NoFiles)
    }
}

/// A board with as many devices as there is room for in an hour's work: chips on buses, levels, voltages.
fn text() -> String {
    let mut text = "const CYCLE = 10 ms;\nboard Robot on NUCLEO_F767ZI {\n".to_owned();
    for number in 0..DEVICES {
        let id = number + 1;
        let device = match number {
            0..20 => format!(
                "returns uint16 {{\n        id = {id};\n        type = analog;\n        delay = 2 * CYCLE;\n    }}"
            ),
            20..60 => {
                format!("returns bool {{\n        id = {id};\n        type = digital;\n    }}")
            }
            _ => format!(
                "returns uint8 {{\n        id = {id};\n        type = i2c;\n        address = 0x{:02X};\n        register = 1;\n        length = 1;\n    }}",
                0x10 + number - 60
            ),
        };
        let _ = writeln!(text, "    sensor S{number} {device}");
    }
    text.push_str("}\n");
    text
}

struct Editor {
    server: Server<Nothing>,
    next: i32,
}

impl Editor {
    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let request = Request::new(self.next.into(), method.to_owned(), params);
        let mut answers = self.server.handle(Message::Request(request), Cancel::NEVER);
        match answers.pop() {
            Some(Message::Response(response)) => response.response_result.expect("an answer"),
            other => panic!("{method}: {other:?}"),
        }
    }

    fn tell(&mut self, method: &str, params: Value) {
        let told = Notification::new(method.to_owned(), params);
        self.server.handle(Message::Notification(told), Cancel::NEVER);
    }
}

fn main() {
    let text = text();
    let mut editor = Editor { server: Server::new(Nothing), next: 0 };
    editor.ask("initialize", json!({ "capabilities": {} }));
    let item = json!({ "uri": URI, "languageId": "sensedsl", "version": 1, "text": text });
    editor.tell("textDocument/didOpen", json!({ "textDocument": item }));
    let began = Instant::now();
    let told = editor.server.settle(Patience::default());
    report("first wiring", &mut [began.elapsed()]);
    assert!(!told.is_empty());
    let typed =
        "    sensor Extra returns uint16 { id = 200; type = analog; delay = 30 ms; pin = PA0; }\n";
    let line = text.matches('\n').count() - 1;
    let (mut answers, mut settles) = (Vec::new(), Vec::new());
    for key in 0..KEYS {
        let column = key % typed.len();
        // At the end of the line it is taken out again.
        if column == 0 && key > 0 {
            let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": line + 1, "character": 0 } });
            change(&mut editor, key, &range, "");
        }
        let at = json!({ "line": line, "character": column });
        let character = typed.get(column..=column).unwrap_or(" ");
        let began = Instant::now();
        change(&mut editor, key, &json!({ "start": at, "end": at }), character);
        let next = json!({ "line": line, "character": column + 1 });
        let file = json!({ "uri": URI });
        let seen =
            json!({ "start": { "line": line.saturating_sub(60), "character": 0 }, "end": next });
        for (method, params) in [
            ("textDocument/completion", json!({ "textDocument": file, "position": next })),
            ("textDocument/semanticTokens/range", json!({ "textDocument": file, "range": seen })),
            ("textDocument/inlayHint", json!({ "textDocument": file, "range": seen })),
            ("textDocument/documentHighlight", json!({ "textDocument": file, "position": next })),
        ] {
            editor.ask(method, params);
        }
        answers.push(began.elapsed());
        if key % 10 == 0 {
            let began = Instant::now();
            editor.server.settle(Patience::default());
            settles.push(began.elapsed());
        }
    }
    report("a key: the change and four answers", &mut answers);
    report("diagnostics and wiring, once nobody types", &mut settles);
    let mut peer: Vec<Duration> = (0..50).map(|_| read(&text)).collect();
    report("peer: the file read from nothing", &mut peer);
}

fn change(editor: &mut Editor, version: usize, range: &Value, text: &str) {
    let file = json!({ "uri": URI, "version": version + 2 });
    let change = json!({ "range": range, "text": text });
    editor.tell(
        "textDocument/didChange",
        json!({ "textDocument": file, "contentChanges": [change] }),
    );
}

fn read(text: &str) -> Duration {
    let began = Instant::now();
    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text);
    let snapshot = workspace.snapshot("robot.sense", On::default(), &NoFiles);
    assert!(snapshot.sound().is_some());
    began.elapsed()
}

fn report(what: &str, times: &mut [Duration]) {
    times.sort_unstable();
    let at = |share: usize| {
        times.get((times.len() - 1) * share / 100).map_or(0.0, |time| time.as_secs_f64() * 1e3)
    };
    println!("{what}: median {:.2} ms, p99 {:.2} ms, most {:.2} ms", at(50), at(99), at(100));
}
