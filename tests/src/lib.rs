//! Helpers that all tests share: running the program as users do, scratch folders, tools that may
//! be missing, seeded random numbers.
//!
//! [`sensedsl`] runs the real binary. It is built on first use, with the profile of the tests, so a
//! test never sees a stale one; `SENSEDSL_BIN` names another binary to test instead, such as an
//! installed one. If a tool is missing, its tests pass with `SKIPPED: …` on stderr; with
//! `SENSEDSL_REQUIRE_TOOLS=1` they fail.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests: a panic is a failed test, and tests touch the machine"
)]

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rustix::fs::StatVfsMountFlags;

mod depth;
mod mistakes;
mod random;

pub use depth::{drawn, few, is_drawn, is_exhaustive, is_thorough, is_whole, one_in};
pub use mistakes::{Mistake, Place, mistakes};
pub use random::Random;

/// The root of the repository.
#[must_use]
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().map_or_else(|| own.to_path_buf(), Path::to_path_buf)
}

/// A file of the repository as text.
#[must_use]
pub fn text(path: &str) -> String {
    read(&root().join(path))
}

/// Compares the tables of a page's section, from its first row to the next heading of the same level, with the wanted
/// text; with `SENSEDSL_BLESS=1`, writes that text. What is above the first row belongs to the page alone.
#[track_caller]
pub fn assert_section(page: &str, heading: &str, wanted: &str) {
    let whole = text(page);
    let of =
        |at: usize, mark: &str| whole.get(at..).and_then(|rest| rest.find(mark)).map(|to| at + to);
    let start = of(0, &format!("\n## {heading}\n\n")).and_then(|at| of(at, "\n|"));
    let start = start.unwrap_or_else(|| panic!("{page} has no table in {heading}")) + 1;
    assert_part(page, start, of(start, "\n## ").unwrap_or(whole.len()), wanted);
}

/// The rows of a table must be in a page, which has all rows; `assert_section` compares a whole table.
#[track_caller]
pub fn assert_rows(page: &str, table: &str) {
    let whole = text(page);
    for row in table.lines().filter(|line| line.starts_with("| ")) {
        assert!(whole.lines().any(|line| line == row), "{page} lacks {row}");
    }
}

/// The same from the first line that begins with `mark` to the end of a page.
#[track_caller]
pub fn assert_page(page: &str, mark: &str, wanted: &str) {
    let whole = text(page);
    let start = whole.find(&format!("\n{mark}")).unwrap_or_else(|| panic!("{page} has no {mark}"));
    assert_part(page, start + 1, whole.len(), wanted);
}

/// Compares all files of a folder with the wanted ones; with `SENSEDSL_BLESS=1`, writes them.
#[track_caller]
pub fn assert_tree(folder: &str, wanted: &BTreeMap<String, Vec<u8>>) {
    let place = root().join(folder);
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        let _ = fs::remove_dir_all(&place);
        write_all(&place, wanted);
    }
    let agreed = tree(&place);
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(wanted), names(&agreed), "{folder}: SENSEDSL_BLESS=1");
    for ((path, found), agreed) in wanted.iter().zip(agreed.values()) {
        let [one, other] = [found, agreed].map(|bytes| String::from_utf8_lossy(bytes));
        let mut lines = (1..).zip(one.lines().zip(other.lines()));
        if let Some((number, (one, other))) = lines.find(|(_, (one, other))| one != other) {
            panic!("{folder}/{path}:{number}: SENSEDSL_BLESS=1\n- {other}\n+ {one}\n");
        }
        assert_eq!(found, agreed, "{folder}/{path}: another end");
    }
}

#[track_caller]
fn assert_part(page: &str, begin: usize, end: usize, wanted: &str) {
    let whole = text(page);
    let found = whole.get(begin..end).unwrap_or_default();
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        let [before, after] = [whole.get(..begin), whole.get(end..)].map(Option::unwrap_or_default);
        fs::write(root().join(page), [before, wanted, after].concat()).unwrap();
    } else {
        assert!(found == wanted, "{page}: SENSEDSL_BLESS=1\n{found}\n---\n{wanted}");
    }
}

/// Writes a file, and creates the folders that it needs.
pub fn write_file(path: &Path, bytes: impl AsRef<[u8]>) {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    fs::write(path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

/// Writes the files of a tree into a folder.
pub fn write_all<B: AsRef<[u8]>, P: AsRef<Path>>(
    folder: &Path,
    files: impl IntoIterator<Item = (P, B)>,
) {
    for (path, bytes) in files {
        write_file(&folder.join(path), bytes);
    }
}

/// The text of any file.
#[must_use]
pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The binary under test.
#[must_use]
pub fn binary() -> &'static Path {
    static BINARY: OnceLock<Option<PathBuf>> = OnceLock::new();
    let given = || std::env::var_os("SENSEDSL_BIN").map(PathBuf::from);
    let found = BINARY.get_or_init(|| given().or_else(|| built("sensedsl")));
    found.as_deref().unwrap_or_else(|| panic!("there is no binary to test"))
}

/// The program that verifies certificates.
#[must_use]
pub fn verifier() -> &'static Path {
    static BINARY: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = BINARY.get_or_init(|| built("sensedsl-verify"));
    found.as_deref().unwrap_or_else(|| panic!("there is no verifier to test"))
}

/// A program that several tests run, compiled by the first of them; `what` tells it from others.
pub fn compiled_once(what: String, compile: impl FnOnce() -> PathBuf) -> PathBuf {
    static BUILT: Mutex<BTreeMap<String, Arc<OnceLock<PathBuf>>>> = Mutex::new(BTreeMap::new());
    let mut all = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    let built = Arc::clone(all.entry(what).or_default());
    drop(all);
    built.get_or_init(compile).clone()
}

/// Builds a program with the profile of this test, into its target folder.
///
/// The workspace is named, and one of its tests, so that Cargo picks the same features as `cargo
/// test --workspace`: it then does not rebuild with other features what that command has built.
fn built(program: &str) -> Option<PathBuf> {
    let test = std::env::current_exe().unwrap();
    // A test is in TARGET/PROFILE/deps. Cargo marks TARGET (CACHEDIR.TAG) only if it created it.
    let target = test.ancestors().nth(3);
    let target = target.unwrap_or_else(|| panic!("{} is in no target folder", test.display()));
    let release = test.components().any(|part| part.as_os_str() == "release");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root()).args(["build", "--quiet", "--workspace", "--bin", program]);
    command.args(["--test", "help", "--profile", if release { "release" } else { "test" }]);
    command.args(["--message-format", "json-render-diagnostics", "--target-dir"]).arg(target);
    if cfg!(feature = "machine") {
        // Tests run images the way users do.
        command.args(["--features", "sensedsl-tests/machine,sensedsl/twin"]);
    }
    if cfg!(feature = "all-sinks") {
        command.args(["--features", "sensedsl-tests/all-sinks,sensedsl/ros2,sensedsl/zenoh"]);
    }
    let output = command.stderr(Stdio::inherit()).output().unwrap();
    let messages = String::from_utf8_lossy(&output.stdout).into_owned();
    messages.lines().find_map(|line| {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        let is_program = message.pointer("/target/name")?.as_str()? == program;
        let file = message.get("executable")?.as_str()?;
        is_program.then(|| PathBuf::from(file))
    })
}

/// A call of the program.
#[derive(Debug)]
pub struct Call {
    command: Command,
    stdin: Option<Vec<u8>>,
}

/// The result of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunOutput {
    /// The exit status; -1 if a signal ended the program.
    pub status: i32,
    /// The text on stdout: the result.
    pub stdout: String,
    /// The text on stderr: the messages.
    pub stderr: String,
}

/// A call of the program, without colours on any terminal.
pub fn sensedsl<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Call {
    let mut command = Command::new(binary());
    command.args(arguments).current_dir(root()).env_remove("NO_COLOR");
    command.env("XDG_STATE_HOME", state());
    Call { command, stdin: None }
}

/// The folder where the programs under test record what they have written, outside the tester's
/// home.
#[must_use]
pub fn state() -> PathBuf {
    scratch_folder().join("sensedsl-tests-state")
}

impl Call {
    /// Adds an argument.
    #[must_use]
    pub fn arg(mut self, argument: impl AsRef<OsStr>) -> Self {
        self.command.arg(argument);
        self
    }

    /// Adds several arguments.
    #[must_use]
    pub fn args<S: AsRef<OsStr>>(mut self, arguments: impl IntoIterator<Item = S>) -> Self {
        self.command.args(arguments);
        self
    }

    /// Runs in the given folder instead of the root of the repository.
    #[must_use]
    pub fn within(mut self, folder: &Path) -> Self {
        self.command.current_dir(folder);
        self
    }

    /// Sets an environment variable.
    #[must_use]
    pub fn env(mut self, name: &str, value: &str) -> Self {
        self.command.env(name, value);
        self
    }

    /// Passes these bytes on stdin.
    #[must_use]
    pub fn stdin(mut self, bytes: impl Into<Vec<u8>>) -> Self {
        self.stdin = Some(bytes.into());
        self
    }

    /// Runs the program to its end.
    #[must_use]
    pub fn run(mut self) -> RunOutput {
        let output = match self.stdin.take() {
            Some(bytes) => fed(&mut self.command, bytes),
            None => self.command.stdin(Stdio::null()).output().unwrap(),
        };
        RunOutput {
            status: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

impl RunOutput {
    /// Fails unless the exit status is the given one.
    #[must_use]
    #[track_caller]
    pub fn exits(self, status: i32) -> Self {
        assert_eq!(self.status, status, "\nstdout: {}\nstderr: {}", self.stdout, self.stderr);
        self
    }

    /// The result as JSON.
    #[must_use]
    #[track_caller]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout)
            .unwrap_or_else(|error| panic!("{error}\n{}\n{}", self.stdout, self.stderr))
    }
}

/// Bytes in hexadecimal; `-` if there are none.
#[must_use]
pub fn hex(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "-".to_owned();
    }
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The folder that has the tests' own folders: `TMPDIR`, or the memory of the machine, where a file
/// is safe without the disk being waited for.
#[must_use]
pub fn scratch_folder() -> PathBuf {
    let named = std::env::var_os("TMPDIR").map(PathBuf::from);
    named.or_else(memory).unwrap_or_else(std::env::temp_dir)
}

/// The file system in memory, if there is one from which programs run and that has room.
fn memory() -> Option<PathBuf> {
    /// Tests at the same time take some 200 MB.
    const FREE_BYTES_MIN: u64 = 1 << 30;
    let path = PathBuf::from("/dev/shm");
    let about = rustix::fs::statvfs(&path).ok()?;
    let refused = StatVfsMountFlags::NOEXEC | StatVfsMountFlags::RDONLY;
    let has_room = about.f_bavail.saturating_mul(about.f_frsize) >= FREE_BYTES_MIN;
    (has_room && !about.f_flag.intersects(refused)).then_some(path)
}

/// A test's own folder, empty at first and removed at the end.
#[derive(Debug)]
pub struct TempDir(PathBuf);

impl TempDir {
    /// A new folder; its name includes `name`, for people to recognise.
    #[must_use]
    pub fn new(name: &str) -> Self {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let own = format!("sensedsl-{name}-{}-{number}", std::process::id());
        let path = scratch_folder().join(own);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// The path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// A path in the folder.
    #[must_use]
    pub fn join(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Writes a file in the folder, and creates the parent folders that it needs.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        write_file(&path, bytes);
        path
    }
}

impl Drop for TempDir {
    fn drop(&mut self) {
        // Files that cannot be removed are left to the machine's own cleaning.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// All files below a folder with their bytes, by path relative to it.
#[must_use]
pub fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(current) = folders.pop() {
        for entry in fs::read_dir(&current).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let relative = path.strip_prefix(folder).unwrap();
                let parts: Vec<_> = relative.iter().map(OsStr::to_string_lossy).collect();
                files.insert(parts.join("/"), fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// The files of a folder with this extension, in order.
#[must_use]
pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    paths.sort();
    paths
}

/// Runs a command that must succeed; returns its output.
#[track_caller]
pub fn run(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert_success(command, &output);
    output
}

/// What a command that must succeed prints.
#[track_caller]
pub fn printed(command: &mut Command) -> String {
    String::from_utf8_lossy(&run(command).stdout).into_owned()
}

/// What a command that must succeed answers to this input.
#[track_caller]
pub fn answered(command: &mut Command, input: impl Into<Vec<u8>>) -> String {
    let output = fed(command, input);
    assert_success(command, &output);
    String::from_utf8(output.stdout).unwrap()
}

/// Runs a command with this input; a command that stops reading is not a failure by itself.
pub fn fed(command: &mut Command, input: impl Into<Vec<u8>>) -> Output {
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let (pipe, input) = (child.stdin.take(), input.into());
    let writer = std::thread::spawn(move || {
        let _ = pipe.map(|mut pipe| pipe.write_all(&input));
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    output
}

/// Fails with all that a command has printed unless it has succeeded.
#[track_caller]
pub fn assert_success(command: &Command, output: &Output) {
    let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{command:?}: {}\n{out}\n{err}", output.status);
}

/// Whether the program answers `--version`; if not, reports it on stderr.
#[must_use]
pub fn has(tool: &str) -> bool {
    let mut command = Command::new(tool);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let found = command.status().is_ok_and(|status| status.success());
    if !found {
        missing(tool);
    }
    found
}

/// Whether Python has all these modules, with commas between them; if not, reports it on stderr.
#[must_use]
pub fn has_python(modules: &str) -> bool {
    let mut python = Command::new("python3");
    python.args(["-c", &format!("import {modules}")]).stdin(Stdio::null());
    python.stdout(Stdio::null()).stderr(Stdio::null());
    let found = python.status().is_ok_and(|status| status.success());
    if !found {
        missing(&format!("python3 with {modules}"));
    }
    found
}

/// Reports what a test had to leave out; fails if tools are required.
pub fn missing(what: &str) {
    assert!(
        std::env::var("SENSEDSL_REQUIRE_TOOLS").as_deref() != Ok("1"),
        "{what} is not here, and SENSEDSL_REQUIRE_TOOLS is set"
    );
    eprintln!("SKIPPED: {what} is not here");
}

/// A file with one board and the given devices, with identifiers from 1 on.
///
/// A device is `kind` or `kind: properties`, as in `i2c: address = 0x10; exclusive = true;`.
#[must_use]
pub fn design(board: &str, devices: &[&str]) -> String {
    let blocks: String =
        devices.iter().enumerate().map(|(at, device)| device_block(at + 1, device)).collect();
    format!("board {board} {{\n{blocks}}}\n")
}

/// One device of [`design`], called `D<id>`.
#[must_use]
pub fn device_block(id: usize, device: &str) -> String {
    let (kind, properties) = device.split_once(':').unwrap_or((device, ""));
    let head = match kind {
        "pwm" | "dac" => "actuator D{} accepts uint16",
        "digital" => "sensor D{} returns bool",
        "icu" | "encoder" => "sensor D{} returns uint32",
        _ => "sensor D{} returns uint16",
    };
    let head = head.replace("{}", &id.to_string());
    format!("    {head} {{ id = {id}; type = {kind}; {} }}\n", properties.trim())
}
