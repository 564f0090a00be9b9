//! A program as a part of the world: stepped in lockstep over its standard input and output, a line of JSON each way.
//!
//! In: the commands of a world's programs. Out: plants for the bench. A program that fails is ended, and nothing waits
//! for it longer than two seconds.

use std::io::{Read as _, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

use sensedsl_twin::bench::Bench;
use sensedsl_twin::plants::{Process, Value};
use sensedsl_twin::world::World;
use serde_json::{Map, Value as Json, json};

/// The longest that an answer may take.
const STEP_MAX: Duration = Duration::from_secs(2);
/// The longest that a program may take to be up: interpreters read many files.
const START_MAX: Duration = Duration::from_secs(20);
/// The longest line of an answer: more than all values of a board.
const LINE_BYTES_MAX: usize = 1 << 20;
/// How much of a wrong answer is shown.
const SHOWN_CHARS: usize = 60;

/// Starts all programs of a world, in its folder. One that does not start fails when it is first asked.
pub(crate) fn attach_all(bench: &mut Bench, world: &World, folder: &Path) {
    for plant in &world.plants {
        let Some(command) = plant.command() else { continue };
        bench.attach(&plant.name, Box::new(Program::start(command, folder)));
    }
}

/// A program while it runs, or why it does not.
struct Program(Result<Talk, String>);

/// The ends of a running program.
struct Talk {
    child: Child,
    requests: ChildStdin,
    answers: Receiver<Vec<u8>>,
    /// Bytes that have come and that no step has taken.
    held: Vec<u8>,
    /// How long the next answer may take.
    patience: Duration,
}

impl Program {
    fn start(command: &[String], folder: &Path) -> Self {
        Self(Talk::start(command, folder))
    }
}

impl Talk {
    fn start(command: &[String], folder: &Path) -> Result<Self, String> {
        let (program, arguments) = command.split_first().ok_or("it has no name")?;
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // A program beside the world is named as the world sees it.
        let beside = folder.join(program);
        let is_beside = program.contains('/') && beside.is_file();
        let beside = beside.canonicalize().ok().filter(|_| is_beside);
        let mut command = match beside {
            Some(path) => Command::new(path),
            None => Command::new(program),
        };
        command.args(arguments).current_dir(folder);
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|why| format!("`{program}` cannot be started ({why})"))?;
        let (Some(requests), Some(mut output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("it has no input or output".to_owned());
        };
        let (sender, answers) = sync_channel(16);
        std::thread::spawn(move || {
            let mut bytes = vec![0; 65_536];
            while let Ok(count @ 1..) = output.read(&mut bytes) {
                let Some(read) = bytes.get(..count) else { return };
                if sender.send(read.to_vec()).is_err() {
                    return;
                }
            }
        });
        Ok(Self { child, requests, answers, held: Vec::new(), patience: START_MAX })
    }

    /// The next line that the program writes.
    fn line(&mut self) -> Result<String, String> {
        let patience = std::mem::replace(&mut self.patience, STEP_MAX);
        let end = Instant::now() + patience;
        loop {
            if let Some(length) = self.held.iter().position(|byte| *byte == b'\n') {
                let line: Vec<u8> = self.held.drain(..=length).collect();
                return String::from_utf8(line).map_err(|_| "its answer is not UTF-8".to_owned());
            }
            if self.held.len() > LINE_BYTES_MAX {
                return Err(format!("its answer has no end after {LINE_BYTES_MAX} bytes"));
            }
            match self.answers.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(bytes) => self.held.extend(bytes),
                Err(RecvTimeoutError::Timeout) => {
                    return Err(format!("it gave no answer within {} s", patience.as_secs()));
                }
                Err(RecvTimeoutError::Disconnected) => return Err(self.why()),
            }
        }
    }

    /// How the program ended. One that has closed its output and goes on is ended.
    fn why(&mut self) -> String {
        let end = Instant::now() + Duration::from_millis(500);
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return format!("it ended ({status})"),
                Ok(None) if Instant::now() < end => {
                    std::thread::sleep(Duration::from_millis(5));
                }
                Ok(None) => return "it has closed its output".to_owned(),
                Err(why) => return why.to_string(),
            }
        }
    }
}

impl Drop for Talk {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Process for Program {
    fn step(
        &mut self,
        seconds: f64,
        set: &[(String, Option<Value>)],
    ) -> Result<Vec<(String, Value)>, String> {
        let talk = self.0.as_mut().map_err(|why| why.clone())?;
        let set: Map<String, Json> =
            set.iter().map(|(name, value)| (name.clone(), written(value.as_ref()))).collect();
        let line = format!("{}\n", json!({ "t": seconds, "set": set }));
        let sent = talk.requests.write_all(line.as_bytes());
        if sent.and_then(|()| talk.requests.flush()).is_err() {
            return Err(talk.why());
        }
        answer(&talk.line()?)
    }
}

fn written(value: Option<&Value>) -> Json {
    match value {
        None => Json::Null,
        Some(Value::One(one)) => json!(one),
        Some(Value::Many(all)) => json!(all),
    }
}

/// The sensors in a line.
fn answer(line: &str) -> Result<Vec<(String, Value)>, String> {
    let cut: String = line.trim_end().chars().take(SHOWN_CHARS).collect();
    let json: Json = serde_json::from_str(line)
        .map_err(|_| format!("its answer is not JSON, or has a number that JSON lacks: `{cut}`"))?;
    let sensors = json.get("sensors").and_then(Json::as_object);
    let sensors = sensors.ok_or_else(|| format!("its answer has no `sensors`: `{cut}`"))?;
    let number = |json: &Json| match json {
        Json::Bool(flag) => Some(f64::from(u8::from(*flag))),
        Json::Number(number) => number.as_f64().filter(|number| number.is_finite()),
        Json::Null | Json::String(_) | Json::Array(_) | Json::Object(_) => None,
    };
    let read = |(name, json): (&String, &Json)| {
        let value = match json.as_array() {
            Some(all) => all.iter().map(number).collect::<Option<Vec<f64>>>().map(Value::Many),
            None => number(json).map(Value::One),
        };
        let value = value.ok_or_else(|| format!("its answer for `{name}` is not a number"))?;
        Ok((name.clone(), value))
    };
    sensors.iter().map(read).collect()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn asked(script: &str) -> Result<Vec<(String, Value)>, String> {
        let command = ["sh", "-c", script].map(str::to_owned);
        let mut program = Program::start(&command, Path::new(""));
        if let Ok(talk) = &mut program.0 {
            talk.patience = Duration::from_secs(2);
        }
        program.step(0.5, &[("Left".to_owned(), Some(Value::One(2.0)))])
    }

    #[test]
    fn a_line_goes_there_and_a_line_comes_back() {
        let script = r#"read line; case "$line" in '{"set":{"Left":2.0},"t":0.5}'|'{"t":0.5,"set":{"Left":2.0}}')
            echo '{"sensors":{"A":1.5,"B":[1,2],"C":true}}';; *) echo "$line";; esac; sleep 9"#;
        let wanted = vec![
            ("A".to_owned(), Value::One(1.5)),
            ("B".to_owned(), Value::Many(vec![1.0, 2.0])),
            ("C".to_owned(), Value::One(1.0)),
        ];
        assert_eq!(asked(script), Ok(wanted));
    }

    #[test]
    fn what_a_program_does_wrong_is_said_and_nothing_hangs() {
        let began = Instant::now();
        for (script, why) in [
            ("exit 3", "it ended (exit status: 3)"),
            ("kill -9 $$", "it ended (signal: 9"),
            ("sleep 60", "no answer within 2 s"),
            ("exec >&-; sleep 60", "closed its output"),
            ("read line; echo hello; sleep 9", "is not JSON"),
            ("read line; echo '{\"sensors\":{\"A\":NaN}}'; sleep 9", "is not JSON"),
            ("read line; echo '{\"sensors\":{\"A\":\"x\"}}'; sleep 9", "`A` is not a number"),
            ("read line; echo '{\"sensor\":{}}'; sleep 9", "no `sensors`"),
            ("read line; printf '\\377\\n'; sleep 9", "not UTF-8"),
            ("read line; yes | tr -d '\\n'", "has no end"),
        ] {
            let found = asked(script).unwrap_err();
            assert!(found.contains(why), "{script}: {found}");
        }
        assert!(began.elapsed() < Duration::from_secs(15));
        let command = ["there-is-no-such-program".to_owned()];
        let found = Program::start(&command, Path::new("")).step(0.0, &[]).unwrap_err();
        assert!(found.contains("cannot be started"), "{found}");
    }
}
