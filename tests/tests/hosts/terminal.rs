//! The example of host `cpp` on a pseudo-terminal; the test plays the board.

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_job::host::HostBoard;
use sensedsl_tests::{compiled_once, has, printed, run};
use sensedsl_wire::{
    Decoder, Direction, Event, Scalar, encode_health_request, encode_hello, encode_hello_request,
    encode_report,
};

use super::{designs, files, tools};

/// The board's end of a serial line. The host's end starts like a login terminal: it echoes and
/// waits for whole lines, until the host makes it raw.
pub(crate) struct Line {
    board: File,
    /// The device that the host opens.
    pub(crate) device: PathBuf,
}

impl Line {
    pub(crate) fn new() -> Self {
        use rustix::fs::{OFlags, fcntl_setfl};
        use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
        let board = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&board).unwrap();
        unlockpt(&board).unwrap();
        let device = ptsname(&board, Vec::new()).unwrap().into_string().unwrap();
        fcntl_setfl(&board, OFlags::NONBLOCK).unwrap();
        Self { board: File::from(board), device: device.into() }
    }

    /// Sends like a board, whether anybody listens or not.
    pub(crate) fn say(&mut self, bytes: &[u8]) {
        match self.board.write_all(bytes) {
            Err(error) if error.kind() != std::io::ErrorKind::WouldBlock => panic!("{error}"),
            _ => {}
        }
    }

    /// Sends all of the bytes, however slowly the host takes them.
    #[cfg(feature = "machine")]
    pub(crate) fn say_all(&mut self, mut bytes: &[u8]) {
        let start = Instant::now();
        while !bytes.is_empty() {
            match self.board.write(bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(error) if error.kind() == std::io::ErrorKind::WouldBlock => {
                    assert!(start.elapsed() < Duration::from_secs(60), "the host does not listen");
                    std::thread::sleep(Duration::from_millis(1));
                }
                Err(error) => panic!("{error}"),
            }
        }
    }

    /// Bytes that the host has sent.
    #[cfg(feature = "machine")]
    pub(crate) fn received(&mut self) -> Vec<u8> {
        let mut bytes = [0_u8; 256];
        let count = self.board.read(&mut bytes).unwrap_or(0);
        bytes[..count].to_vec()
    }

    /// The bytes that the host sends within the time, or the first `enough` of them.
    pub(crate) fn hear(&mut self, enough: usize, time: Duration) -> Vec<u8> {
        let start = Instant::now();
        let mut received = Vec::new();
        let mut bytes = [0_u8; 256];
        while received.len() < enough && start.elapsed() < time {
            match self.board.read(&mut bytes) {
                Ok(count) if count > 0 => received.extend_from_slice(&bytes[..count]),
                _ => std::thread::sleep(Duration::from_millis(5)),
            }
        }
        received
    }
}

/// Compiles the example as its README states. Returns an empty folder for the test's own files, and the program.
pub(crate) fn build(test: &str, boards: &[HostBoard], board: &str) -> Option<(PathBuf, PathBuf)> {
    if !has("g++") {
        return None;
    }
    // Tests of the same boards share the program, which takes longer to compile than to run.
    let what = format!("host of {board} of {boards:?}");
    let program = compiled_once(what, || compile(test, boards, board));
    Some((files::folder(test), program))
}

fn compile(test: &str, boards: &[HostBoard], board: &str) -> PathBuf {
    let folder = files::generate("cpp", test, boards);
    let program = folder.join(format!("monitor_{board}"));
    run(Command::new("g++")
        .current_dir(&folder)
        .args(["-std=c++17", "-O0", "-pthread", "-Iinclude"])
        .arg(format!("src/monitor_{board}.cpp"))
        .arg("-o")
        .arg(&program));
    program
}

/// Whether an event is a command; hosts send requests whenever they like.
pub(crate) fn is_command(event: &Event) -> bool {
    !matches!(event, Event::HelloRequest | Event::HealthRequest)
}

/// Types lines into the example until the board has received so many commands. Returns these, and what the example
/// says.
pub(crate) fn commanded(
    program: &Path,
    board: &HostBoard,
    typed: &str,
    count: usize,
) -> (Vec<Event>, String) {
    let mut line = Line::new();
    let mut child = Command::new(program)
        .args(["--no-reconnect".as_ref(), line.device.as_os_str()])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let second = Duration::from_secs(10);
    let request = encode_hello_request(&board.schema);
    assert_eq!(line.hear(request.len(), second), request);
    line.say(&encode_hello(&board.schema));
    std::thread::sleep(Duration::from_millis(200));
    child.stdin.take().unwrap().write_all(typed.as_bytes()).unwrap();
    let mut events = Vec::new();
    let mut decoder = Decoder::new(&board.schema, Direction::Actuator);
    let start = Instant::now();
    while events.len() < count && start.elapsed() < second {
        let bytes = line.hear(1, Duration::from_millis(100));
        decoder.feed(&bytes, |event| events.extend(Some(event).filter(is_command)));
    }
    assert_eq!(decoder.dropped_bytes(), 0);
    drop(line);
    (events, String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap())
}

fn fig2_frame(front: u64, right: u64, rear: u64, encoder: u64) -> Vec<u8> {
    let values = [(17, front), (18, right), (19, rear), (20, encoder)]
        .map(|(id, value)| (id, vec![Scalar::Unsigned(value)]));
    encode_report(&designs::fig2()[0].schema, Direction::Sensor, &values).unwrap()
}

#[test]
fn the_paper_s_frames_become_lines() {
    let boards = designs::fig2();
    let Some((folder, program)) = build("fig2", &boards, "STM32F4DiscoveryBoard") else { return };
    let mut line = Line::new();
    let mut command = Command::new(program);
    command.arg("--no-reconnect").arg(&line.device);
    let mut monitor = tools::Background::start(&mut command, &folder);
    let second = Duration::from_secs(10);
    assert_eq!(line.hear(4, second), encode_hello_request(&boards[0].schema), "request first");
    line.say(&encode_hello(&boards[0].schema));
    assert_eq!(fig2_frame(300, 0, 255, 100_000).len(), 17);
    line.say(&fig2_frame(300, 0, 255, 100_000));
    // All bytes that a terminal may act on: interrupt, end of file, return, flow control, stop,
    // erase.
    line.say(&fig2_frame(0x0304, 0x0d11, 0x13, 0x1a1c_7f0a));
    line.say(b"ch> \r\n9:");
    line.say(&fig2_frame(1, 2, 3, 4)[..10]);
    line.say(&fig2_frame(1, 2, 3, 4));
    monitor.wait_for("WheelEncoder = 4\n");
    let greeting =
        format!("STM32F4DiscoveryBoard on {}: firmware and program agree\n", line.device.display());
    assert_eq!(
        monitor.output().replace(&greeting, ""),
        "IRFront = 300\nIRFrontRight = 0\nUSRear = 255\nWheelEncoder = 100000\n\
         IRFront = 772\nIRFrontRight = 3345\nUSRear = 19\nWheelEncoder = 438075146\n\
         IRFront = 1\nIRFrontRight = 2\nUSRear = 3\nWheelEncoder = 4\n"
    );
    let received = line.hear(6, Duration::from_millis(200));
    assert_eq!(received, encode_health_request(&boards[0].schema), "the host echoes nothing");
    drop(line);
    monitor.wait_for(": the device is gone\n4 frames, 18 bytes dropped\n");
    assert_eq!(monitor.exit_status(), Some(1));
}

#[test]
fn a_board_of_another_design_is_told() {
    let boards = designs::fig2();
    let Some((_, program)) = build("other", &boards, "STM32F4DiscoveryBoard") else { return };
    let mut line = Line::new();
    let mut command = Command::new(program);
    command.arg(&line.device).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    line.hear(4, Duration::from_secs(10));
    // The stream is sent in one piece: values after the hello must not be shown either.
    let mut stream = encode_hello(&designs::several_boards()[1].schema);
    stream.extend(fig2_frame(1, 2, 3, 4));
    line.say(&stream);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty(), "values of another design");
    assert!(String::from_utf8_lossy(&output.stderr).contains("the board runs other firmware"));
}

#[test]
fn typed_lines_become_commands() {
    let mut boards = designs::all_types();
    let limited = sensedsl_model::design::Presentation {
        quantity: Some("deg".into()),
        scale: Some(0.5),
        min: Some(-30.0),
        max: Some(30.0),
        ..Default::default()
    };
    boards[0].presentations.insert(65, limited);
    let fast = sensedsl_model::design::Presentation {
        quantity: Some("m/s^2".into()),
        scale: Some(0.1),
        ..Default::default()
    };
    boards[0].presentations.insert(66, fast);
    let Some((_, program)) = build("commands", &boards, "Everything") else { return };
    let typed = "T0 true\nT2 raw -0128\nT7 raw 18446744073709551615\n\
                 T8 raw -9223372036854775808\nT9 raw 0.1\n\
                 B3 raw 1 65535\nT2 raw 128\nT1 raw -1\nB3 1\nnothing 1\nT6 raw 4e9\nT4 61\nT4 raw 61\n\
                 T4 20 m\nT4 40000\nT4 raw 40 deg\nT10 raw -2.5\nT4 -12.5 deg\nT4 raw 50\nT4 20deg\n\
                 T5 9.8m/s^2\nT5 1e1m/s^2\n";
    let (events, errors) = commanded(&program, &boards[0], typed, 12);
    let expected = [
        (61, vec![Scalar::Bool(true)]),
        (63, vec![Scalar::Signed(-128)]),
        (68, vec![Scalar::Unsigned(u64::MAX)]),
        (69, vec![Scalar::Signed(i64::MIN)]),
        (70, vec![Scalar::Float32(0.1)]),
        (94, vec![Scalar::Unsigned(1), Scalar::Unsigned(65_535)]),
        (71, vec![Scalar::Float64(-2.5)]),
        (65, vec![Scalar::Signed(-25)]),
        (65, vec![Scalar::Signed(50)]),
        (65, vec![Scalar::Signed(40)]),
        (66, vec![Scalar::Unsigned(98)]),
        (66, vec![Scalar::Unsigned(100)]),
    ];
    assert_eq!(events, expected.map(|value| Event::Report(None, vec![value])));
    for expected in [
        "not sent: T2 raw 128: 128 is not in the range -128 to 127\n",
        "not sent: T1 raw -1: -1 is not in the range 0 to 255\n",
        "not sent: B3 1: B3 takes 2 values\n",
        "not sent: nothing 1: no actuator is called nothing; there are: T0 B0 T1 ",
        "not sent: T4 61: 61 deg (above the maximum of 30 deg)\n",
        "not sent: T4 raw 61: T4 = 61 (30.5 deg) (above the maximum of 30 deg)\n",
        "not sent: T4 20 m: m is not a unit of the value, which is in deg\n",
        "not sent: T4 40000: 40000 deg (above the maximum of 30 deg)\n",
        "not sent: T4 raw 40 deg: 40 is a code, which has no unit: leave out deg\n",
        "sent: T2 = -128",
        "sent: T4 = -25 (-12.5 deg)\n",
        "sent: T4 = 40 (20 deg)\n",
        "not sent: T6 raw 4e9: 4e9 is not a whole number\n",
    ] {
        assert!(errors.contains(expected), "no {expected:?} in:\n{errors}");
    }
}

#[test]
fn a_recorded_stream_is_played_with_scaled_values() {
    let mut boards = designs::fig2();
    let shown = sensedsl_model::design::Presentation {
        quantity: Some("cm".into()),
        scale: Some(0.5),
        offset: Some(3.0),
        ..Default::default()
    };
    boards[0].presentations.insert(17, shown);
    let Some((folder, program)) = build("record", &boards, "STM32F4DiscoveryBoard") else { return };
    let stream: Vec<u8> = (0..1000).flat_map(|n| fig2_frame(n, n, n % 256, n)).collect();
    let record = folder.join("record.bin");
    std::fs::write(&record, &stream).unwrap();
    let printed = printed(Command::new(&program).arg(&record));
    assert_eq!(printed.lines().count(), 4000);
    assert_eq!(printed.lines().nth(4), Some("IRFront = 1 (3.5 cm)"));
    assert_eq!(play_from_standard_input(&program, &record), printed);
}

fn play_from_standard_input(program: &Path, record: &Path) -> String {
    printed(Command::new(program).arg("-").stdin(File::open(record).unwrap()))
}
