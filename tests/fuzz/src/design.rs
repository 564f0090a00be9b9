//! Choices in, the files of a design out: most of them well-formed and small, some broken.

mod devices;
mod words;

use sensedsl_model::{FileRequest, Files, ReadError};

use crate::draw::Draw;
use words::{BOARDS, BREAKS, CODES, ODD_CELLS, ODD_ROWS, PINS, ROWS, TARGETS, UNITS};

/// What a command line would name.
#[derive(Clone, Debug, Default)]
pub struct Input {
    /// The text of `robot.sense`.
    pub text: String,
    /// Other files, by path.
    pub files: Vec<(String, String)>,
    /// The argument of `--board`.
    pub board: Option<&'static str>,
    /// The argument of `--target`.
    pub target: Option<&'static str>,
}

impl Files for Input {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        let found = self.files.iter().find(|(name, _)| name == wanted.path);
        found.map(|(_, text)| text.clone()).ok_or(ReadError::Missing)
    }
}

/// The kinds of devices that designs are made of.
#[must_use]
pub fn kinds() -> Vec<&'static str> {
    words::KINDS.iter().map(|kind| kind.name).collect()
}

/// Makes a design of the choices.
#[must_use]
pub fn draw(draw: &mut Draw<'_>) -> Input {
    if draw.chance(8) {
        // The file as it stands in the bytes.
        let text = String::from_utf8_lossy(draw.rest()).into_owned();
        return Input { text, ..Input::default() };
    }
    let manner = match draw.byte() {
        0..=169 => Manner::Plain,
        170..=214 => Manner::Mixed,
        _ => Manner::Odd,
    };
    let mut writer = Writer { manner, ids: 0, devices: 0, own: 0 };
    let mut input = Input::default();
    let boards = if draw.chance(96) { 2 + draw.below(2) } else { 1 };
    for number in 0..boards {
        let board = writer.board(draw, number, &mut input.files);
        input.text.push_str(&board);
    }
    for _ in 0..if draw.chance(80) { 1 + draw.below(3) } else { 0 } {
        let device = writer.device(draw, "");
        input.text.push_str(&device);
    }
    for _ in 0..writer.own {
        let driver = writer.driver(draw);
        input.text.push_str(&driver);
    }
    if draw.chance(24) {
        writer.used(draw, &mut input);
    }
    if draw.chance(48) {
        input.target = Some(draw.word(if manner == Manner::Odd { TARGETS } else { &TARGETS[..1] }));
    }
    if draw.chance(12) {
        input.board = Some(if draw.chance(128) { "table0.csv" } else { draw.word(BOARDS) });
    }
    if manner != Manner::Plain && draw.chance(64) {
        input.text.push_str(&parts(draw));
    }
    if manner == Manner::Odd && draw.chance(80) {
        broken(draw, &mut input.text);
    }
    input
}

/// Puts a piece of text somewhere, in place of some characters.
fn broken(draw: &mut Draw<'_>, text: &mut String) {
    let at = draw.below(text.len() + 1);
    let at = (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    let end = (at + draw.below(12)).min(text.len());
    let end = (end..=text.len()).find(|end| text.is_char_boundary(*end)).unwrap_or(at);
    text.replace_range(at..end, draw.word(BREAKS));
}

/// How a design is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Manner {
    /// Of what firmware is generated for, well-formed.
    Plain,
    /// Of all kinds and boards, mostly well-formed.
    Mixed,
    /// Anything, with wrong values.
    Odd,
}

impl Manner {
    /// As many of a list whose first ones are the plain ones.
    fn some<T>(self, list: &[T], plain: usize) -> &[T] {
        if self == Self::Plain { &list[..plain] } else { list }
    }
}

/// What the parts of one design share.
struct Writer {
    manner: Manner,
    /// Identifiers given so far.
    ids: usize,
    devices: usize,
    /// Drivers of the file itself that devices name.
    own: usize,
}

impl Writer {
    /// A file that the design uses.
    fn used(&mut self, draw: &mut Draw<'_>, input: &mut Input) {
        let mut used = self.driver(draw);
        used.push_str(&self.device(draw, ""));
        if draw.chance(64) {
            used.push_str("use \"parts/more.sense\";\n");
            input.files.push(("parts/more.sense".into(), self.device(draw, "")));
        }
        input.files.push(("other.sense".into(), used));
        input.text.insert_str(0, "use \"other.sense\";\n");
    }

    fn board(
        &mut self,
        draw: &mut Draw<'_>,
        number: usize,
        files: &mut Vec<(String, String)>,
    ) -> String {
        let name = draw.word(self.manner.some(BOARDS, words::WITH_FIRMWARE_BOARDS));
        let on = match draw.below(6) {
            0 | 1 if number == 0 => String::new(),
            0..=2 => format!(" on {name}"),
            3 | 4 => {
                let path = format!("table{number}.csv");
                files.push((path.clone(), table(draw, self.manner)));
                format!(" on \"{path}\"")
            }
            _ => " on STM32F4DiscoveryBoard".to_owned(),
        };
        let own_name = if on.is_empty() { name.to_owned() } else { format!("Board{number}") };
        let spare = if draw.chance(32) && number > 0 { "spare " } else { "" };
        let mut text = format!("{spare}board {own_name}{on} {{\n");
        if draw.chance(64) {
            text.push_str(&link(draw, self.manner));
        }
        for _ in 0..if draw.chance(80) { 1 + draw.below(2) } else { 0 } {
            text.push_str(&rule(draw));
        }
        let (least, first) = (usize::from(number == 0), self.devices);
        for _ in 0..least + draw.below(if number == 0 { 6 } else { 3 }) {
            text.push_str(&self.device(draw, "    "));
        }
        if draw.chance(40) {
            text.push_str(&self.controller(draw, first));
        }
        text.push_str("}\n");
        text
    }
}

/// Constants, a chip, and a driver of a part with several values.
fn parts(draw: &mut Draw<'_>) -> String {
    let mut text = String::new();
    for number in 0..draw.below(3) {
        text.push_str(&format!("const N{number} = {};\n", draw.word(words::CONSTANTS)));
    }
    let block = |draw: &mut Draw<'_>, head: &str, lines: &[&str]| {
        let mut text = format!("{head} {{\n");
        for _ in 0..1 + draw.below(5) {
            text.push_str(&format!("    {}\n", draw.word(lines)));
        }
        text + "}\n"
    };
    if draw.chance(160) {
        text.push_str(&block(draw, "chip C0", words::CHIP_LINES));
    }
    if draw.chance(160) {
        let head = draw.word(&["driver Part0", "driver Part0 for i2c", "driver Part0 for digital"]);
        text.push_str(&block(draw, head, words::READING_LINES));
    }
    text
}

fn link(draw: &mut Draw<'_>, manner: Manner) -> String {
    let mut text = "    link {".to_owned();
    let transport = draw.word(manner.some(&["uart", "usb", "", "none"], 3));
    if !transport.is_empty() {
        text.push_str(&format!(" transport = {transport};"));
    }
    if draw.chance(96) {
        text.push_str(&format!(" checksum = {};", draw.word(&["crc16", "crc32"])));
    }
    let is_serial = transport == "uart" || manner == Manner::Odd;
    if is_serial && draw.chance(96) {
        let units = ["USART2", "USART3", "UART4", "USART9"];
        text.push_str(&format!(" unit = {};", draw.word(manner.some(&units, 3))));
    }
    if is_serial && draw.chance(96) {
        let rates = ["9600", "1200", "10000000", "1"];
        text.push_str(&format!(" baud = {};", draw.word(manner.some(&rates, 3))));
    }
    if draw.chance(24) && (transport == "usb" || manner == Manner::Odd) {
        text.push_str(&format!(" vbus = {};", draw.word(&["false", "true"])));
    }
    if draw.chance(64) {
        text.push_str(&format!(
            " rate = {};",
            draw.word(manner.some(&["10 Hz", "1", "10 kHz", "0.5"], 3))
        ));
    }
    text.push_str(" }\n");
    text
}

/// A rule that boards and devices may have, or one that only boards may have.
fn rule(draw: &mut Draw<'_>) -> String {
    if draw.chance(100) {
        let word = draw.word(&["reserve", "release"]);
        let what = if draw.chance(80) { draw.word(UNITS) } else { draw.word(PINS) };
        return format!("    {word} {what};\n");
    }
    wish(draw)
}

fn wish(draw: &mut Draw<'_>) -> String {
    if draw.chance(24) {
        return format!("    allow {} \"because\";\n", draw.word(CODES));
    }
    let word = draw.word(&["avoid", "prefer"]);
    let (what, value) = match draw.below(8) {
        0..=3 => ("pin", draw.word(PINS)),
        4 | 5 => ("unit", draw.word(UNITS)),
        6 => ("header", draw.word(&["P1", "P2"])),
        _ => (draw.word(&["scl", "sda", "tx", "a", "cs", "trigger", "side"]), draw.word(PINS)),
    };
    format!("    {word} {what} = {value};\n")
}

/// A board table of a few pins.
fn table(draw: &mut Draw<'_>, manner: Manner) -> String {
    let own = !draw.chance(48);
    let mut text = String::new();
    if !draw.chance(16) {
        let mcu = draw.word(manner.some(&["STM32F407VGT6", "STM32F411RE", "RP2040", "x"], 2));
        text.push_str(&format!("# mcu = {mcu}\n"));
    }
    text.push_str(if own { "Pin,Header,Onboard,Usages\n" } else { "Pin,Header,Onboard\n" });
    let skip = draw.below(4);
    let count = 4 + draw.below(9);
    for (number, [pin, usages]) in ROWS.iter().skip(skip).take(count).enumerate() {
        let header = if number % 3 == 2 { "P2" } else { "P1" };
        let onboard = if draw.chance(24) {
            draw.word(&["LED:care", "CS43L22:bus", "MIC", "MIC:taken", ":care", "a:b"])
        } else {
            ""
        };
        let usages = if draw.chance(12) { draw.word(ODD_CELLS) } else { *usages };
        let row = if own { format!(",{usages}") } else { String::new() };
        text.push_str(&format!("{pin},{header},{onboard}{row}\n"));
    }
    if draw.chance(12) {
        text.push_str(draw.word(ODD_ROWS));
    }
    text
}
