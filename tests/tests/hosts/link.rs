//! The behaviour of each host when its board goes, comes back, is a different one, or is already in
//! use by another program. All hosts go through the same scenes on a pseudo-terminal; the test
//! plays the board.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use sensedsl_job::host::HostBoard;
use sensedsl_wire::{Direction, Scalar, Schema, encode_hello, encode_hello_request, encode_report};

use super::terminal::Line;
use super::tools::Background;
use super::{designs, files};

/// A host application of Fig. 2 that prints each value as `IRFront = 300`, and other events.
pub(crate) struct Application<'a> {
    /// The name for folders and messages.
    pub(crate) name: &'static str,
    /// The program's own name, as the system knows it.
    pub(crate) program: &'static str,
    /// Starts it on a device.
    pub(crate) start: &'a dyn Fn(&Path) -> Background,
}

/// Fig. 2 with a cycle time of 40 ms for each sensor.
pub(crate) fn design() -> Vec<HostBoard> {
    let mut boards = designs::fig2();
    for id in [17, 18, 19, 20] {
        boards[0].cycles_ms.insert(id, 40);
    }
    boards
}

fn frame(schema: &Schema, front: u64) -> Vec<u8> {
    let values = [(17, front), (18, 1), (19, 2), (20, 3)];
    let values = values.map(|(id, value)| (id, vec![Scalar::Unsigned(value)]));
    encode_report(schema, Direction::Sensor, &values).unwrap()
}

/// A board on a thread: it answers requests with its hello, has a shell if `has_shell`, and sends
/// `IRFront = front` every 20 ms whether it was asked or not.
struct Board {
    stop: Sender<()>,
    thread: Option<JoinHandle<()>>,
}

impl Board {
    fn start(mut line: Line, schema: Schema, front: u64, has_shell: bool) -> Self {
        let (stop, stopped): (Sender<()>, Receiver<()>) = channel();
        let thread = std::thread::spawn(move || {
            let frame = frame(&designs::fig2()[0].schema, front);
            let request = encode_hello_request(&schema);
            let mut received = Vec::new();
            while stopped.try_recv().is_err() {
                received.extend(line.hear(1, Duration::from_millis(20)));
                if received.windows(request.len()).any(|bytes| bytes == request) {
                    received.clear();
                    line.say(&encode_hello(&schema));
                }
                if has_shell && received.ends_with(b"schema\r") {
                    received.clear();
                    let text = schema.canonical_text().replace('\n', "\r\n");
                    line.say(format!("\r\nch> schema\r\n{text}ch> ").as_bytes());
                }
                line.say(&frame);
            }
        });
        Self { stop, thread: Some(thread) }
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.stop.send(());
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap();
        }
    }
}

/// Gives the board's device a stable name, like those in `/dev/serial/by-id`.
fn name_for(link: &Path, device: &Path) {
    let fresh = link.with_extension("new");
    let _ = std::fs::remove_file(&fresh);
    std::os::unix::fs::symlink(device, &fresh).unwrap();
    std::fs::rename(fresh, link).unwrap();
}

/// Unplugs the board and removes its name, because the next terminal that another test opens may
/// get its number.
fn unplug(link: &Path, board: Board) {
    std::fs::remove_file(link).unwrap();
    drop(board);
}

/// The scenes, which are the same for every host.
pub(crate) fn scenes(application: &Application<'_>) {
    unplugged_and_plugged_again(application);
    the_second_opener_is_told(application);
    other_firmware_shows_not_one_value(application);
    asked_until_answered(application);
}

fn folder(application: &Application<'_>, scene: &str) -> PathBuf {
    files::folder(&format!("{scene}-{}", application.name))
}

/// Judges the fastest of three tries, because the machine may be busy.
fn unplugged_and_plugged_again(application: &Application<'_>) {
    let boards = design();
    let link = folder(application, "replug").join("board");
    let line = Line::new();
    name_for(&link, &line.device);
    let board = Board::start(line, boards[0].schema.clone(), 300, false);
    let host = (application.start)(&link);
    host.wait_for("IRFront = 300\n");
    unplug(&link, board);
    host.wait_for(&format!("lost {}: the device is gone; waiting for it\n", link.display()));
    let mut quickest = Duration::MAX;
    for front in [301, 302, 303] {
        std::thread::sleep(Duration::from_millis(300));
        let line = Line::new();
        let plugged = Instant::now();
        name_for(&link, &line.device);
        let board = Board::start(line, boards[0].schema.clone(), front, false);
        host.wait_for(&format!("IRFront = {front}\n"));
        quickest = quickest.min(plugged.elapsed());
        unplug(&link, board);
    }
    host.wait_for(&format!("back on {} after ", link.display()));
    eprintln!("{}: data resumes after {} ms", application.name, quickest.as_millis());
    assert!(quickest < Duration::from_secs(1), "{}: {quickest:?}", application.name);
}

fn the_second_opener_is_told(application: &Application<'_>) {
    let line = Line::new();
    let device = line.device.clone();
    let _board = Board::start(line, design()[0].schema.clone(), 300, false);
    let first = (application.start)(&device);
    first.wait_for("IRFront = 300\n");
    let mut second = (application.start)(&device);
    assert_eq!(second.exit_status(), Some(2), "{}", second.output());
    let reported = format!(
        "cannot open {}: {} (process {}) has it open: end that program first\n",
        device.display(),
        // The system keeps only 15 characters of a name.
        application.program.get(..15).unwrap_or(application.program),
        first.child.id()
    );
    assert!(second.output().contains(&reported), "no {reported:?} in:\n{}", second.output());
    assert!(!second.output().contains("IRFront"), "{}", second.output());
    let before = first.output().matches("IRFront = ").count();
    std::thread::sleep(Duration::from_millis(300));
    assert!(first.output().matches("IRFront = ").count() > before, "the first goes on");
}

fn other_firmware_shows_not_one_value(application: &Application<'_>) {
    let mut other = design()[0].schema.clone();
    other.items[0].value.scalar = sensedsl_wire::ScalarType::Int16;
    other.items.remove(1);
    other.items.push(designs::item("30 actuator Steering int8"));
    for has_shell in [true, false] {
        let mut line = Line::new();
        let device = line.device.clone();
        // Some values are queued before the host opens the device, and more before it asks the
        // board.
        for front in 0..10 {
            line.say(&frame(&design()[0].schema, front));
        }
        let _board = Board::start(line, other.clone(), 300, has_shell);
        let mut host = (application.start)(&device);
        assert_eq!(host.exit_status(), Some(1), "{}", host.output());
        let output = host.output();
        assert!(!output.contains("IRFront ="), "a value of other firmware:\n{output}");
        assert!(!output.contains("USRear ="), "a value of other firmware:\n{output}");
        assert!(output.contains("the board runs other firmware"), "{output}");
        let named = "  IRFront: sensor uint16, identifier 17 here, sensor int16, identifier 17 on the board\n  \
             IRFrontRight: only here (sensor uint16, identifier 18)\n  \
             Steering: only on the board (actuator int8, identifier 30)\n";
        assert_eq!(output.contains(named), has_shell, "{output}");
    }
}

/// The first three requests are lost; the values that arrive with them must not be shown.
fn asked_until_answered(application: &Application<'_>) {
    let board = &design()[0];
    let mut line = Line::new();
    let host = (application.start)(&line.device);
    let request = encode_hello_request(&board.schema);
    for front in 0..3 {
        line.hear(request.len(), Duration::from_secs(30));
        line.say(&frame(&board.schema, front));
    }
    let _board = Board::start(line, board.schema.clone(), 300, false);
    host.wait_for("IRFront = 300\n");
    assert!(!host.output().contains("IRFront = 0\n"), "{}", host.output());
    assert!(!host.output().contains("IRFront = 2\n"), "{}", host.output());
    // The host must end before its board is gone; otherwise it would wait for the board's terminal.
    drop(host);
}
