//! One case: its lines, run one after another in a folder.

use std::fs;

use sensedsl_tests::{RunOutput, TempDir, design, read, root, sensedsl};
use serde_json::Value;

use super::block;

/// A folder, and the last call in it.
pub(super) struct Place {
    name: String,
    folder: TempDir,
    /// The standard input of the next call, if it has no block.
    input: String,
    ran: RunOutput,
}

impl Place {
    pub(super) fn new(name: String) -> Self {
        let ran = RunOutput { status: 0, stdout: String::new(), stderr: String::new() };
        Self { name, folder: TempDir::new("script"), input: String::new(), ran }
    }

    pub(super) fn run(mut self, lines: &[String]) {
        let mut rest = lines;
        while let Some(line) = rest.first() {
            let own = block(rest);
            rest = &rest[1 + own.len()..];
            let text: String = own.iter().map(|line| format!("{}\n", &line[4..])).collect();
            let text = text.strip_prefix('@').map_or(text.clone(), shorthand);
            let line = line.replace("$FIG2", "$ROOT/examples/fig2.sense");
            let line = line.replace("$ROOT", &root().display().to_string());
            let reported = self.reported();
            let is_right = line.is_empty() || line.starts_with('#') || self.line(&line, text);
            assert!(is_right, "{}\n{line}\n{reported}{}", self.name, self.reported());
        }
    }

    /// Does what a line says; returns whether it holds.
    fn line(&mut self, line: &str, text: String) -> bool {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        if let Some(status) = word.strip_prefix('>') {
            let input = if text.is_empty() { std::mem::take(&mut self.input) } else { text };
            self.ran = sensedsl(words(rest)).within(self.folder.path()).stdin(input).run();
            let is_silent = self.ran.status == 2 && self.ran.stderr.is_empty();
            let wanted = if status.is_empty() { "0" } else { status };
            return !is_silent && (wanted == "*" || self.ran.status.to_string() == wanted);
        }
        let path = self.folder.join(rest);
        match word {
            "file" => drop(self.folder.write(rest, text)),
            "save" => drop(self.folder.write(rest, &self.ran.stdout)),
            "copy" => {
                let name = rest.rsplit('/').next().unwrap_or(rest);
                drop(self.folder.write(name, sensedsl_tests::text(rest)));
            }
            "feed" => self.input = read(&path),
            "remove" if path.is_dir() => fs::remove_dir_all(path).unwrap(),
            "remove" => fs::remove_file(path).unwrap(),
            "exists" => return path.exists(),
            "missing" => return !path.exists(),
            "same" => return self.ran.stdout == read(&path),
            "is" => return self.ran.stdout == text,
            "silent" => return self.ran.stderr.is_empty(),
            "out" => return self.ran.stdout.contains(rest),
            "err" => return self.ran.stderr.contains(rest),
            "rows" => return self.ran.stdout.lines().count().to_string() == rest,
            "pins" => return self.wires(|_, wire| word_of(&wire["pin"])).join(" ") == rest,
            "wires" => {
                let shown = |device: &Value, wire: &Value| {
                    [&device["unit"], &wire["pin"], &wire["signal"]].map(word_of).join(" ")
                };
                return self.wires(shown).join(", ") == rest;
            }
            "told" => return self.tells(rest),
            "holds" if !text.is_empty() => return read(&path).contains(&text),
            _ => return self.compared(word, rest),
        }
        true
    }

    /// Whether a line with a place, a number or a value holds.
    fn compared(&self, word: &str, rest: &str) -> bool {
        let (first, others) = rest.split_once(' ').unwrap();
        let both = [&self.ran.stdout, &self.ran.stderr];
        match word {
            "no" if first == "out" => !self.ran.stdout.contains(others),
            "no" if first == "err" => !self.ran.stderr.contains(others),
            "count" => {
                let count: usize =
                    both.map(|reported| reported.matches(others).count()).iter().sum();
                count.to_string() == first
            }
            "json" => {
                let value = serde_json::from_str(others).unwrap_or_else(|_| Value::from(others));
                self.ran.json().pointer(first).unwrap_or(&Value::Null) == &value
            }
            "times" => {
                let (path, text) = others.split_once(": ").unwrap();
                read(&self.folder.join(path)).matches(text).count().to_string() == first
            }
            "holds" => read(&self.folder.join(first.trim_end_matches(':'))).contains(others),
            "lacks" => !read(&self.folder.join(first.trim_end_matches(':'))).contains(others),
            "files" => {
                let folder = fs::read_dir(self.folder.join(first.trim_end_matches(':'))).unwrap();
                let names = folder.map(|entry| entry.unwrap().file_name().into_string().unwrap());
                let mut names: Vec<String> = names.collect();
                names.sort();
                names.join(" ") == others
            }
            _ => panic!("{}: what is `{word}`?", self.name),
        }
    }

    fn reported(&self) -> String {
        format!("status {}\n{}\n{}\n", self.ran.status, self.ran.stdout, self.ran.stderr)
    }

    /// What is shown of the wires of an answer, by board, device and role.
    fn wires(&self, shown: impl Fn(&Value, &Value) -> String) -> Vec<String> {
        let answer = self.ran.json();
        let list = |of: &Value, key: &str| of[key].as_array().cloned().unwrap();
        let mut wires = Vec::new();
        for board in list(&answer, "boards") {
            for device in list(&board, "devices") {
                for wire in list(&device, "wires") {
                    let at = [&board["name"], &device["name"], &wire["role"]].map(word_of);
                    wires.push((at, shown(&device, &wire)));
                }
            }
        }
        wires.sort();
        wires.into_iter().map(|(_, shown)| shown).collect()
    }

    /// Whether the diagnostics have this code, at a place below the first line and with a way out.
    fn tells(&self, code: &str) -> bool {
        let all = self.ran.json()["diagnostics"].as_array().cloned().unwrap();
        all.iter().any(|one| {
            let is_inside = one["start"]["line"].as_u64() >= Some(2);
            one["code"] == code && is_inside && one["help"].is_string()
        })
    }
}

fn word_of(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// A design from `BOARD` and its devices, such as `analog: pin = PA1;`, one a line or between ` + `; a line that begins
/// with `!` is a rule of the board.
fn shorthand(text: &str) -> String {
    let (board, lines) = text.split_once('\n').unwrap();
    let (rules, devices): (Vec<&str>, Vec<&str>) =
        lines.lines().partition(|line| line.starts_with('!'));
    let devices: Vec<&str> = devices.iter().flat_map(|line| line.split(" + ")).collect();
    let devices: Vec<&str> = devices.into_iter().filter(|one| !one.trim().is_empty()).collect();
    design(board, &devices).replacen('{', &format!("{{{}", rules.concat().replace('!', "")), 1)
}

/// The words of a line; those with spaces are in single quotes.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    let words = parts.flat_map(|(at, part)| match at % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    words.collect()
}
