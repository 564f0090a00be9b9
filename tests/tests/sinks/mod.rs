//! Other programs that get the values of `monitor`, each played by somebody who knows nothing of this project: a UDP
//! socket, a WebSocket client after RFC 6455, the broker and the clients of Eclipse Mosquitto.

mod configuration;
mod foxglove;
mod mqtt;
mod od4;
mod peer;
mod plotjuggler;
mod prometheus;
#[cfg(feature = "all-sinks")]
mod ros2;
mod websocket;
#[cfg(feature = "all-sinks")]
mod zenoh;

use std::io::{BufRead as _, BufReader, Read, Write as _};
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, binary, root};
use sensedsl_wire::Schema;
use serde_json::Value;

/// A board that reports fifty and twenty times a second.
const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Light returns uint16 { id = 17; type = analog; delay = 20 ms; scale = 0.5; offset = -10; quantity = cm; max = 900; }
    sensor Turns returns int32 { id = 18; type = encoder; delay = 50 ms; }
    actuator Servo accepts uint16 { id = 19; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; failsafe = 0; }
    link { silence = 400 ms; }
}";

/// A folder with the board, its generated schema, and the link that it gives.
fn robot(name: &str) -> (TempDir, Schema) {
    crate::monitor::robot_of(name, ROBOT)
}

/// How long a test waits for what must come.
const PATIENCE: Duration = Duration::from_secs(20);

/// A program that runs beside the test, and the lines that it has printed so far. It ends with its value.
pub(crate) struct Running {
    child: Child,
    stdin: Option<ChildStdin>,
    pub(crate) out: Arc<Mutex<Vec<String>>>,
    pub(crate) err: Arc<Mutex<Vec<String>>>,
}

fn lines(pipe: impl Read + Send + 'static) -> Arc<Mutex<Vec<String>>> {
    let all = Arc::new(Mutex::new(Vec::new()));
    let own = Arc::clone(&all);
    std::thread::spawn(move || {
        for line in BufReader::new(pipe).lines().map_while(Result::ok) {
            own.lock().unwrap().push(line);
        }
    });
    all
}

impl Running {
    pub(crate) fn start(command: &mut Command) -> Self {
        let command = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap_or_else(|error| panic!("{command:?}: {error}"));
        let stdin = child.stdin.take();
        let (out, err) = (lines(child.stdout.take().unwrap()), lines(child.stderr.take().unwrap()));
        Self { child, stdin, out, err }
    }

    /// `sensedsl monitor` with these arguments.
    pub(crate) fn monitor<S: AsRef<std::ffi::OsStr>>(
        arguments: impl IntoIterator<Item = S>,
    ) -> Self {
        Self::start(Command::new(binary()).arg("monitor").args(arguments).current_dir(root()))
    }

    pub(crate) fn said(&self) -> String {
        self.err.lock().unwrap().join("\n")
    }

    pub(crate) fn printed(&self) -> Vec<String> {
        self.out.lock().unwrap().clone()
    }

    /// Waits until it has said something.
    #[track_caller]
    pub(crate) fn says(&self, what: &str) {
        until(|| self.said().contains(what), || format!("`{what}` is not in:\n{}", self.said()));
    }

    /// Types a line.
    pub(crate) fn type_in(&mut self, line: &str) {
        writeln!(self.stdin.as_mut().unwrap(), "{line}").unwrap();
    }

    /// Ends it at once, as the system does.
    pub(crate) fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Waits for its end; its exit status.
    #[track_caller]
    pub(crate) fn ends(&mut self) -> i32 {
        let start = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                // What it printed last is on its way through the threads.
                std::thread::sleep(Duration::from_millis(100));
                return status.code().unwrap_or(-1);
            }
            assert!(start.elapsed() < PATIENCE, "it does not end: {}", self.said());
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Waits until something is so; the time that it took.
#[track_caller]
pub(crate) fn until(mut is_so: impl FnMut() -> bool, why: impl Fn() -> String) -> Duration {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < PATIENCE, "{}", why());
        std::thread::sleep(Duration::from_millis(10));
    }
    start.elapsed()
}

/// A TCP port that is free.
pub(crate) fn free_port() -> u16 {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

/// What `--format ndjson` printed: the name and the shown value of each device, in order.
pub(crate) fn shown(lines: &[String]) -> Vec<(String, Value)> {
    let of = |line: &String| {
        let object: Value =
            serde_json::from_str(line).unwrap_or_else(|why| panic!("{why}: {line}"));
        (object["device"].as_str().unwrap().to_owned(), object["value"].clone())
    };
    lines.iter().map(of).collect()
}

pub(crate) fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}
