//! The screen of `monitor` on a pseudo-terminal: keys in, what is drawn out, and the terminal as it was before, however
//! the program ends. The board is on another pseudo-terminal, and the test plays it.

use std::fs::{File, OpenOptions};
use std::io::{Read as _, Write as _};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use rustix::fs::{OFlags, fcntl_setfl};
use rustix::process::{Pid, Signal, kill_process};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{LocalModes, Winsize, tcgetattr, tcsetwinsize};
use sensedsl_tests::{binary, root};
use sensedsl_wire::{Decoder, Direction, Event, Scalar, Schema, encode_hello, encode_report};

use crate::hosts::terminal::Line;
use crate::monitor::robot;

const TAKE: &str = "\u{1b}[?1049h";
const GIVE_BACK: &str = "\u{1b}[?1049l";
const SHOW_CURSOR: &str = "\u{1b}[?25h";

/// A terminal with a program on it, and a board beside it.
struct Window {
    keys: File,
    /// The program's end: what its settings are is seen there.
    inner: File,
    child: Child,
    seen: String,
    line: Line,
    schema: Schema,
    decoder: Decoder<'static>,
    /// What the program has sent to the board, apart from questions.
    sent: Vec<Event>,
    is_playing: bool,
    is_met: bool,
}

impl Window {
    fn new(schema: &'static Schema, arguments: &[&str]) -> Self {
        let keys = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&keys).unwrap();
        unlockpt(&keys).unwrap();
        fcntl_setfl(&keys, OFlags::NONBLOCK).unwrap();
        let path = ptsname(&keys, Vec::new()).unwrap().into_string().unwrap();
        let inner = OpenOptions::new().read(true).write(true).open(path).unwrap();
        size(&inner, 80, 24);
        let line = Line::new();
        let end = || Stdio::from(inner.try_clone().unwrap());
        let child = Command::new(binary())
            .arg("monitor")
            .arg(&line.device)
            .args(arguments)
            .current_dir(root())
            .env("TERM", "xterm-256color")
            .env_remove("NO_COLOR")
            .stdin(end())
            .stdout(end())
            .stderr(end())
            .spawn()
            .unwrap();
        Self {
            keys: File::from(keys),
            inner,
            child,
            seen: String::new(),
            line,
            schema: schema.clone(),
            decoder: Decoder::new(schema, Direction::Actuator),
            sent: Vec::new(),
            is_playing: true,
            is_met: false,
        }
    }

    fn press(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).unwrap();
    }

    /// Plays the board for a moment, and reads what the program draws.
    fn turn(&mut self, hello: &[u8]) {
        let bytes = self.line.hear(1, Duration::from_millis(20));
        let (mut is_asked, sent) = (false, &mut self.sent);
        self.decoder.feed(&bytes, |event| match event {
            Event::HelloRequest => is_asked = true,
            Event::HealthRequest => {}
            other => sent.push(other),
        });
        self.is_met |= is_asked;
        // The shell of a board that does not report is asked without a question of ours.
        if is_asked || (self.is_met && !self.is_playing) {
            self.line.say(hello);
        }
        if self.is_playing {
            let values = [(17, vec![Scalar::Unsigned(841)]), (18, vec![Scalar::Signed(-3)])];
            self.line.say(&encode_report(&self.schema, Direction::Sensor, &values).unwrap());
        }
        let mut bytes = [0; 1 << 14];
        while let Ok(count @ 1..) = self.keys.read(&mut bytes) {
            self.seen.push_str(&String::from_utf8_lossy(&bytes[..count]));
        }
    }

    fn wait_for(&mut self, what: &str, is_there: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        let hello = encode_hello(&self.schema);
        while !is_there(self) {
            assert!(start.elapsed() < Duration::from_secs(20), "no {what} in {:?}", self.seen);
            self.turn(&hello);
        }
    }

    /// Forgets what was drawn, and has everything drawn anew: otherwise only what changes is.
    fn renew(&mut self) {
        self.seen = if self.seen.contains(TAKE) { TAKE.to_owned() } else { String::new() };
        self.press("\u{c}");
    }

    /// Waits until a text is drawn.
    fn wait_for_text(&mut self, text: &str) {
        let start = Instant::now();
        let hello = encode_hello(&self.schema);
        let mut turns = 0;
        self.renew();
        while !words(&self.seen).contains(text) {
            assert!(
                start.elapsed() < Duration::from_secs(20),
                "no {text} in {}",
                words(&self.seen)
            );
            self.turn(&hello);
            turns += 1;
            if turns % 20 == 0 {
                self.renew();
            }
        }
    }

    fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
    }

    /// Whether keys come one by one and are not echoed.
    fn is_raw(&self) -> bool {
        let modes = tcgetattr(&self.inner).unwrap().local_modes;
        !modes.intersects(LocalModes::ICANON | LocalModes::ECHO | LocalModes::ISIG)
    }

    fn ended(&mut self, hello: &[u8]) -> ExitStatus {
        let start = Instant::now();
        loop {
            assert!(start.elapsed() < Duration::from_secs(20), "it does not end: {:?}", self.seen);
            self.turn(hello);
            if let Some(status) = self.child.try_wait().unwrap() {
                self.turn(hello);
                return status;
            }
        }
    }

    /// What was printed after the screen; it must have been given back as it was.
    fn after(&self) -> &str {
        let (drawn, after) = self.seen.rsplit_once(GIVE_BACK).unwrap();
        assert!(drawn.starts_with(TAKE) || drawn.contains(TAKE), "{drawn:?}");
        assert_eq!(drawn.matches(TAKE).count(), self.seen.matches(GIVE_BACK).count());
        assert!(after.contains(SHOW_CURSOR), "{after:?}");
        let modes = tcgetattr(&self.inner).unwrap().local_modes;
        assert!(modes.contains(LocalModes::ICANON | LocalModes::ECHO | LocalModes::ISIG));
        after
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What was drawn, with a space where the cursor went elsewhere.
fn words(drawn: &str) -> String {
    let mut text = String::new();
    let mut rest = drawn;
    while let Some((before, after)) = rest.split_once("\u{1b}[") {
        text.push_str(before);
        let end = after.find(|letter: char| letter.is_ascii_alphabetic()).unwrap_or(0);
        if after[end..].starts_with('H') {
            text.push(' ');
        }
        rest = after.get(end + 1..).unwrap_or_default();
    }
    text.push_str(rest);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn size(terminal: &File, columns: u16, rows: u16) {
    let size = Winsize { ws_row: rows, ws_col: columns, ws_xpixel: 0, ws_ypixel: 0 };
    tcsetwinsize(terminal, size).unwrap();
}

/// The robot's design, and its link for as long as the tests run.
fn design(name: &str) -> (sensedsl_tests::TempDir, String, &'static Schema) {
    let (scratch, schema) = robot(name);
    let file: &Path = &scratch.join("robot.sense");
    let file = file.to_str().unwrap().to_owned();
    (scratch, file, Box::leak(Box::new(schema)))
}

#[test]
fn keys_set_an_actuator_and_end_it() {
    let (_scratch, file, schema) = design("screen-keys");
    let mut window = Window::new(schema, &[&file]);
    for text in ["online", "Light", "410.5 cm", "Servo", "firmware and design agree"] {
        window.wait_for_text(text);
    }
    assert!(window.is_raw());
    // To the last device, which is the servo; what is wrong is told before it is sent.
    window.press("\u{1b}[F");
    window.press("s181");
    window.wait_for_text("above the maximum of 180");
    window.press("\r\u{7f}\u{7f}\u{7f}45.5\r");
    let set = Event::Report(None, vec![(19, vec![Scalar::Unsigned(455)])]);
    let expected = set.clone();
    window.wait_for("command", move |window| window.sent == [expected.clone()]);
    window.wait_for_text("sent: Servo = 455 (45.5 deg)");
    window.press("?");
    window.wait_for_text("less time, more time");
    // By itself: with the next byte it would be another key.
    window.press("\u{1b}");
    (0..10).for_each(|_| window.turn(&encode_hello(schema)));
    window.wait_for_text("Device Value");
    window.press("\u{1b}OAk ");
    window.wait_for_text("a Light 410.5");
    // Another size: everything is drawn again.
    size(&window.inner, 20, 5);
    window.signal(Signal::WINCH);
    window.wait_for_text("1-2/3 Value");
    window.press("q");
    let hello = encode_hello(schema);
    assert_eq!(window.ended(&hello).code(), Some(0));
    let after = window.after();
    for text in ["Rover for ", "45.5 deg", "sent: Servo = 455 (45.5 deg)", " frames, "] {
        assert!(after.contains(text), "{text}: {after:?}");
    }
    assert_eq!(window.sent, [set]);
}

#[test]
fn the_terminal_is_given_back_however_it_ends() {
    let (_scratch, file, schema) = design("screen-signals");
    let hello = encode_hello(schema);
    for signal in [Some(Signal::TERM), Some(Signal::HUP), Some(Signal::INT), None] {
        let mut window = Window::new(schema, &[&file]);
        window.wait_for_text("410.5 cm");
        assert!(window.is_raw());
        match signal {
            Some(signal) => window.signal(signal),
            None => window.press("\u{3}"),
        }
        assert_eq!(window.ended(&hello).code(), Some(0), "{signal:?}");
        assert!(window.after().contains("Rover for "));
    }
}

#[test]
fn other_firmware_is_told_after_the_screen() {
    let (_scratch, file, schema) = design("screen-other");
    let mut other = schema.clone();
    other.items[0].name = "Dark".to_owned();
    let text = other.canonical_text().replace('\n', "\r\n");
    let hello = [encode_hello(&other), format!("ch> schema\r\n{text}ch> ").into_bytes()].concat();
    let mut window = Window::new(schema, &[&file]);
    window.is_playing = false;
    assert_eq!(window.ended(&hello).code(), Some(1));
    let after = window.after();
    for text in ["E0558", "Light: not on the board", "Dark: only on the board"] {
        assert!(after.contains(text), "{text}: {after:?}");
    }
    assert!(!after.contains("410.5"), "values of another board: {after:?}");
}

#[test]
fn what_is_wrong_with_the_call_is_told_without_a_screen_or_after_it() {
    let (_scratch, file, schema) = design("screen-calls");
    let mut window = Window::new(schema, &[&file, "--set", "Servo=1000"]);
    assert_eq!(window.ended(&[]).code(), Some(2));
    assert!(window.after().contains("above the maximum"), "{:?}", window.seen);
    // Plain lines where they are asked for.
    let mut window = Window::new(schema, &[&file, "--format", "lines", "--seconds", "2"]);
    let hello = encode_hello(schema);
    assert_eq!(window.ended(&hello).code(), Some(0));
    assert!(window.seen.contains("Light = 841 (410.5 cm)") && !window.seen.contains('\u{1b}'));
}

#[test]
fn a_device_that_goes_and_comes_back_is_told() {
    let (scratch, file, schema) = design("screen-gone");
    let mut window = Window::new(schema, &[]);
    let _ = window.child.kill();
    // A name of its own: the system gives that of a terminal that is gone to the next one.
    let device = scratch.join("board");
    std::os::unix::fs::symlink(&window.line.device, &device).unwrap();
    let end = || Stdio::from(window.inner.try_clone().unwrap());
    let _ = window.child.wait();
    window.seen.clear();
    window.child = Command::new(binary())
        .args(["monitor", device.to_str().unwrap(), &file])
        .env("TERM", "xterm-256color")
        .stdin(end())
        .stdout(end())
        .stderr(end())
        .spawn()
        .unwrap();
    window.wait_for_text("410.5 cm");
    std::fs::remove_file(&device).unwrap();
    window.line = Line::new();
    window.wait_for_text("OFFLINE: the device is gone");
    std::os::unix::fs::symlink(&window.line.device, &device).unwrap();
    window.seen.clear();
    window.wait_for_text("online");
    window.press("n");
    window.wait_for_text("back on ");
    window.press("q");
    let hello = encode_hello(schema);
    assert_eq!(window.ended(&hello).code(), Some(0));
    assert!(window.seen.contains("the device is gone; waiting for it"), "{:?}", window.seen);
}
