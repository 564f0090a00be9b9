//! The machine-readable form of `check --format json`.

use serde_json::{Map, Value, json};

use crate::diagnostic::{Diagnostic, Fix, Label};
use crate::source::{LineColumn, SourceMap, Span};
use crate::visible::visible_json;

/// `{ "diagnostics": [ … ] }` and a final line break.
#[must_use]
pub fn json(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    let list: Vec<Value> = diagnostics.iter().map(|one| json_value(one, sources)).collect();
    json_text(&json!({ "diagnostics": list }))
}

/// A value as text that is safe to print, with a final line break.
#[must_use]
pub fn json_text(value: &Value) -> String {
    format!("{}\n", visible_json(&format!("{value:#}")))
}

/// One diagnostic as a JSON object.
#[must_use]
pub fn json_value(diagnostic: &Diagnostic, sources: &SourceMap) -> Value {
    let mut object = Map::new();
    object.insert("code".into(), diagnostic.code.name().into());
    object.insert("severity".into(), diagnostic.severity.name().into());
    object.insert("message".into(), diagnostic.message.as_str().into());
    place(&mut object, diagnostic.primary.span, sources);
    object.insert("help".into(), diagnostic.help.as_deref().map_or(Value::Null, Value::from));
    if !diagnostic.labels.is_empty() {
        let labels = diagnostic.labels.iter().map(|label| label_value(label, sources));
        object.insert("labels".into(), labels.collect());
    }
    // A reader may apply the only way out; of several, a person chooses one.
    match diagnostic.fixes.as_slice() {
        [] => {}
        [fix] => {
            object.insert("fix".into(), fix_value(fix, sources));
        }
        fixes => {
            let fixes = fixes.iter().map(|fix| fix_value(fix, sources));
            object.insert("fixes".into(), fixes.collect());
        }
    }
    Value::Object(object)
}

fn place(object: &mut Map<String, Value>, span: Span, sources: &SourceMap) {
    let point = |LineColumn { line, column }| json!({ "line": line, "column": column });
    object.insert("file".into(), sources.name(span.file).into());
    object.insert("start".into(), point(sources.line_column(span.file, span.start)));
    object.insert("end".into(), point(sources.line_column(span.file, span.end)));
}

fn label_value(label: &Label, sources: &SourceMap) -> Value {
    let mut object = Map::new();
    object.insert("message".into(), label.message.as_str().into());
    place(&mut object, label.span, sources);
    Value::Object(object)
}

fn fix_value(fix: &Fix, sources: &SourceMap) -> Value {
    let edits = fix.edits.iter().map(|edit| {
        let mut object = Map::new();
        object.insert("text".into(), edit.text.as_str().into());
        place(&mut object, edit.span, sources);
        Value::Object(object)
    });
    json!({ "title": fix.title, "edits": edits.collect::<Vec<_>>() })
}
