//! SARIF 2.1.0, for code-scanning services.

use serde_json::{Value, json};

use super::json_text;
use crate::codes::Code;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{SourceMap, Span};

/// A complete SARIF log with one run; `version` is the tool's.
#[must_use]
pub fn sarif(diagnostics: &[Diagnostic], sources: &SourceMap, version: &str) -> String {
    let mut codes: Vec<Code> = diagnostics.iter().map(|one| one.code).collect();
    codes.sort();
    codes.dedup();
    let rules: Vec<Value> = codes.iter().map(|code| rule(*code)).collect();
    let results: Vec<Value> = diagnostics.iter().map(|one| result(one, sources)).collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "sensedsl", "version": version, "rules": rules } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    json_text(&log)
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Hint => "note",
    }
}

fn rule(code: Code) -> Value {
    let info = code.info();
    json!({
        "id": info.code,
        "shortDescription": { "text": info.title },
        "fullDescription": { "text": format!("{}\n", info.explanation) },
        "defaultConfiguration": { "level": level(code.severity()) },
    })
}

fn result(diagnostic: &Diagnostic, sources: &SourceMap) -> Value {
    let mut message = diagnostic.message.clone();
    if let Some(help) = &diagnostic.help {
        message = format!("{message}. Help: {help}");
    }
    let related: Vec<Value> = diagnostic
        .labels
        .iter()
        .map(|label| {
            let mut value = location(label.span, sources);
            if let Some(object) = value.as_object_mut() {
                object.insert("message".into(), json!({ "text": plain(&label.message) }));
            }
            value
        })
        .collect();
    json!({
        "ruleId": diagnostic.code.name(),
        "level": level(diagnostic.severity),
        "message": { "text": plain(&message) },
        "locations": [location(diagnostic.primary.span, sources)],
        "relatedLocations": related,
    })
}

fn location(span: Span, sources: &SourceMap) -> Value {
    let start = sources.line_column(span.file, span.start);
    let end = sources.line_column(span.file, span.end);
    json!({
        "physicalLocation": {
            "artifactLocation": { "uri": uri(sources.name(span.file)) },
            "region": {
                "startLine": start.line,
                "startColumn": start.column,
                "endLine": end.line,
                "endColumn": end.column,
            },
        },
    })
}

/// Text in which nothing is taken for a link (`[text](target)`) or a placeholder (`{0}`).
fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(character) = rest.chars().next() {
        let after = rest.get(character.len_utf8()..).unwrap_or_default();
        let digits = after.bytes().take_while(u8::is_ascii_digit).count();
        let number = after.get(..digits).filter(|number| !number.is_empty());
        match (character, number) {
            (']', _) if after.starts_with('(') => out.push_str("\\]"),
            ('{', Some(number)) if after.get(digits..).is_some_and(|end| end.starts_with('}')) => {
                out.push_str("{{");
                out.push_str(number);
                out.push_str("}}");
                rest = after.get(digits + 1..).unwrap_or_default();
                continue;
            }
            _ => out.push(character),
        }
        rest = after;
    }
    out
}

/// A relative path as a URI reference: `/` as separator, everything else percent-encoded.
fn uri(path: &str) -> String {
    let mut out = String::new();
    for byte in path.bytes() {
        match byte {
            b'\\' => out.push('/'),
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'~' => {
                out.push(char::from(byte));
            }
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}
