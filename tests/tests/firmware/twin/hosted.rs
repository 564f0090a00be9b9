//! The generated host program at the other end of an emulated board's link: it opens a
//! pseudo-terminal, is greeted by the firmware, and prints the values that the judge has seen.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, has, run, sensedsl};
use sensedsl_wire::Scalar;

use super::trial::Trial;
use crate::firmware::tools::scratch;
use crate::hosts::terminal::Line;
use crate::hosts::tools::Background;

const NOTES: &str = "notes.txt";
/// The time at which the host's first bytes reach the board, which has started by then.
const GREETING_MS: u64 = 500;
/// The time between two looks at what the host says. It repeats itself in its own time, while the board's is slower:
/// answers to all of that would leave the board little time for reports.
const HEARS_EVERY_MS: u64 = 250;
const PATIENCE: Duration = Duration::from_secs(60);

/// A running host.
pub(super) struct Host {
    line: Line,
    program: Background,
    folder: PathBuf,
    received: Vec<u8>,
}

impl Host {
    /// Starts the host of a design's only board, generated and compiled as its README states;
    /// `None` without a compiler.
    pub(super) fn start(name: &str, text: &str) -> Option<Self> {
        if !has("g++") {
            return None;
        }
        let folder = generated(name, text);
        let program = folder.join("monitor");
        let mut command = Command::new("g++");
        command.current_dir(&folder).args(["-std=c++17", "-O0", "-pthread", "-Iinclude"]);
        let _ = run(command.arg(source(&folder)).arg("-o").arg(&program));
        let mut line = Line::new();
        let mut command = Command::new(&program);
        command.arg("--no-reconnect").arg(&line.device);
        let program = Background::start_apart(&mut command, &folder, NOTES);
        // By the time of its first request, it has set the terminal to raw mode.
        let received = line.hear(1, PATIENCE);
        assert!(!received.is_empty(), "the host asks nothing: {}", program.output());
        Some(Self { line, program, folder, received })
    }

    /// Passes one millisecond: sends the board's bytes to the host, and returns the host's bytes.
    pub(super) fn pass(&mut self, ms: u64, messages: &[u8]) -> Vec<u8> {
        self.line.say_all(messages);
        self.received.extend(self.line.received());
        if ms < GREETING_MS || !ms.is_multiple_of(HEARS_EVERY_MS) {
            return Vec::new();
        }
        std::mem::take(&mut self.received)
    }

    /// Pulls the cable. The host must have shown each value since the greeting, in order, and
    /// dropped no byte that our decoder accepts.
    #[track_caller]
    pub(super) fn assert_shows(mut self, what: &str, trial: &Trial) {
        let greeted = trial.greeted.unwrap_or_else(|| panic!("{what}: the board greets nobody"));
        let wanted: Vec<String> = trial.reported[greeted..]
            .iter()
            .map(|(_, id, value)| format!("{} = {}", trial.names[id], text(value)))
            .collect();
        let start = Instant::now();
        while self.program.output().lines().count() < wanted.len() && start.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(20));
        }
        drop(self.line);
        let _ = self.program.exit_status();
        let notes = sensedsl_tests::read(&self.folder.join(NOTES));
        assert!(notes.contains("firmware and program agree\n"), "{what}: {notes}");
        let dropped = format!(" frames, {} bytes dropped\n", trial.dropped);
        assert!(notes.contains(&dropped), "{what}: {notes}");
        let output = self.program.output();
        let shown: Vec<&str> = output.lines().collect();
        assert_eq!(shown.len(), wanted.len(), "{what}");
        for (line, wanted) in shown.iter().zip(&wanted) {
            let behind = line.strip_prefix(wanted.as_str());
            let is_right = behind.is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("));
            assert!(is_right, "{what}: `{line}`, not `{wanted}`");
        }
        eprintln!("{what}: the host shows {} values", shown.len());
    }
}

/// A value as the host prints it.
fn text(value: &[Scalar]) -> String {
    let all: Vec<String> = value.iter().map(ToString::to_string).collect();
    if all.len() == 1 { all.concat() } else { format!("[{}]", all.join(", ")) }
}

/// Generates the host without middleware, and returns its folder.
fn generated(name: &str, text: &str) -> PathBuf {
    let name = format!("{name}_host");
    let designs = TempDir::new(&name);
    let file = designs.write("design.sense", text).display().to_string();
    let folder = scratch(&name);
    let out = folder.display().to_string();
    let call = ["generate", &file, "--host", "cpp", "--without", "firmware", "-q", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    folder.join("host/cpp")
}

/// The source of its only program.
fn source(folder: &Path) -> PathBuf {
    let mut all = std::fs::read_dir(folder.join("src")).unwrap().map(|entry| entry.unwrap().path());
    all.find(|path| path.extension().is_some_and(|one| one == "cpp")).unwrap()
}
