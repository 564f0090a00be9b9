//! A generated application on an emulated STM32F4: kernel, shell, link and bus recovery, with all
//! of the kernel's own checks enabled.
//!
//! The emulator has neither DMA nor I2C: analog conversions never end and every I2C transfer times
//! out, as the test requires. Clocks are not started, because the emulator's hang, and the kernel
//! uses the core's tick.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use sensedsl_tests::{has, root};
use sensedsl_wire::{Checksum, Decoder, Direction, Event, Scalar, Schema};

use super::chibios::{build, tree, write};
use crate::hosts::designs;

const EMULATED: &str = include_str!("../../firmware/designs/emulated.sense");

/// The pins of [`EMULATED`].
pub(crate) const TABLE: &str = include_str!("../../firmware/designs/emulated.csv");

fn schema() -> Schema {
    // An array with one element is not a scalar: the text of the schema shows the difference.
    let echo = "5 sensor Echo uint8[1]";
    let items = ["1 sensor IR uint16", "2 sensor Ranger uint8", "3 sensor Wheel uint32"];
    designs::schema(Checksum::Crc16, &[&items[..], &["4 actuator Lamp uint8", echo]].concat())
}

/// Changes the application as the emulator needs, and adds a user's file.
fn adapt(board: &Path, user: &str) {
    let change = |path: &str, original: &str, changed: &str| {
        let path = board.join(path);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(original), "{text}");
        std::fs::write(&path, text.replacen(original, changed, 1)).unwrap();
    };
    let base = "#include UP_BASE_CHCONF";
    let kernel = [
        "CH_DBG_SYSTEM_STATE_CHECK TRUE",
        "CH_DBG_ENABLE_CHECKS TRUE",
        "CH_DBG_ENABLE_ASSERTS TRUE",
        "CH_DBG_ENABLE_STACK_CHECK TRUE",
        "CH_DBG_FILL_THREADS TRUE",
    ];
    let kernel = kernel.map(|setting| format!("#define {setting}\n")).concat();
    change("cfg/chconf.h", base, &format!("{kernel}{base}"));
    change("cfg/chconf.h", "CH_CFG_ST_TIMEDELTA 2", "CH_CFG_ST_TIMEDELTA 0");
    change("cfg/chconf.h", "CH_CFG_ST_FREQUENCY 10000", "CH_CFG_ST_FREQUENCY 1000");
    let base = "#include UP_BASE_MCUCONF";
    let clocks = "\n#undef STM32_NO_INIT\n#define STM32_NO_INIT TRUE";
    change("cfg/mcuconf.h", base, &format!("{base}{clocks}"));
    let user = root().join("tests/firmware").join(user);
    std::fs::copy(user, board.join("user/user.c")).unwrap();
}

/// The running board, whose output can be waited for.
struct Board {
    emulator: Child,
    output: Receiver<Vec<u8>>,
    reported: Vec<u8>,
}

impl Board {
    fn start(program: &Path, arguments: &[&str]) -> Self {
        let mut command = Command::new("qemu-system-arm");
        command.args(["-M", "netduinoplus2", "-display", "none", "-monitor", "none"]);
        command.args(["-serial", "stdio", "-kernel"]).arg(program).args(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut emulator = command.spawn().unwrap();
        let mut stdout = emulator.stdout.take().unwrap();
        let (sender, output) = channel();
        std::thread::spawn(move || {
            let mut bytes = [0; 1024];
            while let Ok(count) = stdout.read(&mut bytes) {
                if count == 0 || sender.send(bytes[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        Self { emulator, output, reported: Vec::new() }
    }

    fn say(&mut self, bytes: &[u8]) {
        let stdin = self.emulator.stdin.as_mut().unwrap();
        stdin.write_all(bytes).unwrap();
        stdin.flush().unwrap();
    }

    /// Waits until `found` accepts the output since the last call, and clears that output.
    fn wait<T>(&mut self, what: &str, found: impl Fn(&[u8]) -> Option<T>) -> T {
        let end = Instant::now() + Duration::from_secs(60);
        loop {
            if let Some(result) = found(&self.reported) {
                self.reported.clear();
                return result;
            }
            let text = String::from_utf8_lossy(&self.reported).into_owned();
            let left = end.checked_duration_since(Instant::now());
            let left = left.unwrap_or_else(|| panic!("no {what} in {text:?}"));
            if let Ok(bytes) = self.output.recv_timeout(left) {
                self.reported.extend(bytes);
            }
        }
    }

    /// Types a command and returns its answer.
    fn ask(&mut self, command: &str) -> String {
        self.say(format!("{command}\r\n").as_bytes());
        self.wait(command, |reported| {
            let text = String::from_utf8_lossy(reported);
            let answer = text.split_once(&format!("{command}\r\n"))?.1;
            Some(answer.strip_suffix("ch> ")?.to_owned())
        })
    }

    /// Repeats a command until its answer has the words.
    fn shows(&mut self, command: &str, words: &str) {
        let end = Instant::now() + Duration::from_secs(60);
        loop {
            let answer = self.ask(command);
            if answer.contains(words) {
                return;
            }
            assert!(Instant::now() < end, "{command}: {answer}");
        }
    }

    /// The reports from now on, as soon as there are `count`.
    fn reports(&mut self, schema: &Schema, count: usize) -> Vec<Vec<(u8, Vec<Scalar>)>> {
        self.wait(&format!("{count} reports"), |reported| {
            let mut decoder = Decoder::new(schema, Direction::Sensor);
            let mut reports = Vec::new();
            decoder.feed(reported, |event| {
                if let Event::Report(_, values) = event {
                    reports.push(values);
                }
            });
            (reports.len() >= count).then_some(reports)
        })
    }

    /// Waits until the frames in the output contain all of `wanted`; returns all frames.
    fn events(&mut self, wanted: &[Event]) -> Vec<Event> {
        let schema = schema();
        self.wait(&format!("{wanted:?}"), |reported| {
            let mut decoder = Decoder::new(&schema, Direction::Sensor);
            let mut events = Vec::new();
            decoder.feed(reported, |event| events.push(event));
            wanted.iter().all(|event| events.contains(event)).then_some(events)
        })
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.emulator.kill();
        let _ = self.emulator.wait();
    }
}

/// Two buses: the first hangs, the second has a register of one byte.
const BUSES: &str = include_str!("../../firmware/designs/buses.sense");

/// A frame from the host, with its checksum.
pub(crate) fn frame(values: &[u8]) -> Vec<u8> {
    let crc = values.iter().fold(0xFFFF_u16, |crc, byte| {
        (0..8).fold(crc ^ (u16::from(*byte) << 8), |crc, _| {
            (crc << 1) ^ if crc & 0x8000 == 0 { 0 } else { 0x1021 }
        })
    });
    let payload = [values, &[255], &crc.to_be_bytes()].concat();
    [format!("{}:", payload.len()).as_bytes(), &payload, b","].concat()
}

/// The number before a word.
fn number_before(text: &str, word: &str) -> u32 {
    let before = text.split_once(word).unwrap_or_else(|| panic!("no {word} in {text}")).0;
    before.split_whitespace().last().unwrap().parse().unwrap()
}

#[test]
fn an_application_runs_on_an_emulated_board() {
    let Some(tree) = tree() else { return };
    if !has("qemu-system-arm") {
        return;
    }
    let folder = write("emulated", EMULATED).join("Emulated");
    adapt(&folder, "emulated_user.c");
    build(&tree, &folder, "development");
    let mut board = Board::start(&folder.join("build/development/sense.elf"), &[]);
    board.wait("prompt", |reported| reported.ends_with(b"ch> ").then_some(()));

    assert!(board.ask("info").contains("STM32F407"));
    let threads = board.ask("threads");
    for name in ["ADC1 100 ms", "I2C1 50 ms", "I2C1 100 ms"] {
        assert!(threads.contains(name), "{threads}");
    }
    assert!(board.ask("mem").contains("core free memory"));
    // A host that has never sent anything counts as silent, like one that has stopped sending.
    board.shows("print Lamp", "  4 Lamp                     9 (");
    assert!(board.ask("print Wheel").contains("  3 Wheel                    7 ("));
    assert!(board.ask("print Nobody").contains("no such sensor: Nobody"));
    // The emulator has no DMA: a conversion that never ends is abandoned and counted. Nothing was
    // measured, so no value is shown, not even a zero.
    let sensors = board.ask("sensors");
    let given_up = sensors.split("  1 IR                       - ").nth(1);
    assert!(given_up.is_some_and(|rest| number_before(rest, "errors") > 0), "{sensors}");
    assert!(number_before(&sensors, "errors") > 0, "{sensors}");
    // The emulator's pads read low, so a bus that timed out stays stuck.
    let link = board.ask("link");
    let (_, stuck) = link.split_once("stayed stuck").unwrap();
    assert!(number_before(stuck, "times") > 0, "{link}");
    // The text from which the schema hash is computed; hosts compare it with theirs.
    let text = schema().canonical_text().replace('\n', "\r\n");
    assert!(board.ask("schema").contains(&text));

    board.say(b"stream\r\n");
    let hello = Event::Hello(schema().hash());
    let wheel = Event::Report(None, vec![(3, vec![Scalar::Unsigned(7)])]);
    let events = board.events(&[hello.clone(), wheel.clone()]);
    assert_eq!(events.first(), Some(&hello));
    board.say(&frame(&[4, 55]));
    board.events(&[Event::Report(None, vec![(5, vec![Scalar::Unsigned(56)])])]);
    board.say(&frame(&[0]));
    board.events(std::slice::from_ref(&hello));

    board.say(b"q");
    board.wait("prompt", |reported| reported.ends_with(b"ch> ").then_some(()));
    // The host is silent again, so the lamp falls back to its failsafe value.
    board.shows("print Lamp", "  4 Lamp                     9 (");
    // A host that does not know the shell requests a hello, and gets frames.
    board.say(&frame(&[0]));
    board.events(&[hello, wheel]);
}

/// A bus that hangs busy must not starve the reporter, and one byte must be read as one byte.
#[test]
fn a_bus_that_hangs_leaves_the_reports_alone() {
    let Some(tree) = tree() else { return };
    if !has("qemu-system-arm") {
        return;
    }
    let folder = write("buses", BUSES).join("Buses");
    adapt(&folder, "emulated_buses.c");
    // The runtime's calls of the driver go through the user's file first.
    let wrap = "USE_LTO := no\nUSE_LDOPT := --wrap=i2cMasterTransmitTimeout\n";
    std::fs::write(folder.join("user/user.mk"), wrap).unwrap();
    build(&tree, &folder, "production");
    // The board's time is counted in instructions, so that a busy machine changes nothing.
    let program = folder.join("build/production/sense.elf");
    let mut board = Board::start(&program, &["-icount", "shift=5,sleep=off"]);
    let items = ["1 sensor Stuck uint8", "2 sensor Byte uint8", "3 sensor Wheel uint32"];
    let schema = designs::schema(Checksum::Crc16, &items);
    let reports = board.reports(&schema, 200);
    let values = |wanted: u8| {
        let of_report = move |report: &Vec<(u8, Vec<Scalar>)>| {
            let (_, values) = report.iter().find(|(id, _)| *id == wanted)?;
            values.first().copied()
        };
        reports.iter().filter_map(of_report).collect::<Vec<_>>()
    };
    // The wheel gives the board's milliseconds; each report has one. The input itself has no edges,
    // and reports that once a second.
    let is_time = |value: &Scalar| *value != Scalar::Unsigned(0);
    let times: Vec<_> = values(3).into_iter().filter(is_time).collect();
    let (Some(Scalar::Unsigned(first)), Some(Scalar::Unsigned(last))) =
        (times.first(), times.last())
    else {
        panic!("{times:?}")
    };
    let per_second = 1_000 * (times.len() as u64 - 1) / (last - first);
    assert!(per_second >= 95, "{per_second} reports a second, {times:?}");
    assert!(values(1).is_empty());
    // The wrapper answers with the number of bytes that it was asked for.
    let bytes = values(2);
    assert!(
        bytes.len() > 20 && bytes.iter().all(|value| *value == Scalar::Unsigned(1)),
        "{bytes:?}"
    );
}
