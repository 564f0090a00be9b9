//! What a sketch sends, played to the generated hosts in Python and C++: they show the values that our decoder reads.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_job::BoardJob;
use sensedsl_job::host::HostBoard;
use sensedsl_tests::{has, has_python, printed, run as compile, text};
use sensedsl_wire::Scalar;

use super::sketches::built;
use super::tools::can_compile_sketches;
use super::trial::{Host, Trial, run};
use crate::embassy::with_job;
use crate::hosts::files;

/// The board as its hosts see it.
fn board(job: &BoardJob<'_>) -> HostBoard {
    let devices = || job.devices.iter().map(|one| one.device);
    let cycles = devices().filter_map(|one| Some((one.id.value, job.design.told_every_ms(one)?)));
    HostBoard {
        name: job.board.name.value.clone(),
        schema: job.schema.clone(),
        baud: job.board.link.baud,
        silence_ms: job.board.link.silence_ms,
        presentations: devices().map(|one| (one.id.value, one.shown.clone())).collect(),
        cycles_ms: cycles.collect(),
    }
}

/// The values of a run: the name, and each element.
fn wanted(job: &BoardJob<'_>, trial: &Trial) -> Vec<(String, Vec<String>)> {
    let name = |id: &u8| {
        let item = job.schema.items.iter().find(|item| item.id == *id).unwrap();
        item.name.clone()
    };
    let shown = |value: &[Scalar]| value.iter().map(ToString::to_string).collect();
    trial.reported.iter().map(|(_, id, value)| (name(id), shown(value))).collect()
}

/// Plays a recording to the generated package, which prints names and raw values.
fn in_python(folder: &Path, recording: &Path) -> Vec<(String, Vec<String>)> {
    const PROGRAM: &str = "import json, sys\nimport sense_robot\nfrom sense_robot import Board\n\
        board, = Board.__subclasses__()\n\
        for one in board.play(sys.argv[1]):\n    \
        print(json.dumps([one.FACTS.item.name, one.raw]))\n";
    let mut python = Command::new("python3");
    python.args(["-c", PROGRAM]).arg(recording).env("PYTHONDONTWRITEBYTECODE", "1");
    let output = printed(python.env("PYTHONPATH", folder));
    let read = |line: &str| {
        let (name, raw): (String, serde_json::Value) = serde_json::from_str(line).unwrap();
        let all = raw.as_array().cloned().unwrap_or_else(|| vec![raw]);
        (name, all.iter().map(ToString::to_string).collect())
    };
    output.lines().map(read).collect()
}

/// Compiles the generated monitor as its README says, and plays a recording to it.
fn in_cpp(folder: &Path, name: &str, recording: &Path) -> String {
    let program: PathBuf = folder.join("monitor");
    let mut command = Command::new("g++");
    command.current_dir(folder).args(["-std=c++17", "-O0", "-pthread", "-Iinclude"]);
    command.arg(format!("src/monitor_{name}.cpp")).arg("-o").arg(&program);
    let _ = compile(&mut command);
    printed(Command::new(&program).arg(recording))
}

#[test]
fn both_hosts_show_what_a_sketch_sends() {
    if !can_compile_sketches() || !has_python("serial") || !has("g++") {
        return;
    }
    let design = text("tests/avr/designs/gauge.sense");
    let world = text("tests/avr/designs/gauge.toml");
    with_job(&design, None, |job| {
        let trial = run(job, &world, &built(job, "hosts"), Host::that_asks(5, &[3_000]));
        assert_eq!(trial.noticed(), "");
        let wanted = wanted(job, &trial);
        assert!(wanted.len() > 500 && trial.dropped == 0, "{}", wanted.len());
        let boards = [board(job)];
        let [python, cpp] =
            ["python", "cpp"].map(|host| files::generate(host, "avr-sketch", &boards));
        let recording = cpp.join("recording");
        std::fs::write(&recording, &trial.bytes).unwrap();
        assert_eq!(in_python(&python, &recording), wanted);
        let shown = in_cpp(&cpp, &job.board.name.value, &recording);
        let lines: Vec<&str> = shown.lines().collect();
        assert_eq!(lines.len(), wanted.len(), "{shown}");
        for (line, (name, elements)) in lines.iter().zip(&wanted) {
            let value = match &elements[..] {
                [one] => one.clone(),
                all => format!("[{}]", all.join(", ")),
            };
            let behind = line.strip_prefix(&format!("{name} = {value}"));
            let is_right = behind.is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("));
            assert!(is_right, "`{line}`, not `{name} = {value}`");
        }
    });
}
