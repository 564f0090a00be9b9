//! Mistakes put into the Rust that is generated for a rover, one at a time. The types of the HAL
//! accept them; the test finds what notices them when the program runs in its world.
//!
//! The table is in `docs/seeded-mistakes.md`, written together with that of `seeded.rs`.

use sensedsl_tests::assert_section;

use super::seeded::{noticed_by, table};
use super::trial::{System, rover};
use crate::firmware::embassy::{build, generated, project};

const WIRING: &str = "src/wiring.rs";
const MAIN: &str = "src/main.rs";
const TABLES: &str = "src/tables.rs";

/// A mistake: its name, its files, and the text whose occurrences are all replaced, with the
/// replacement.
type Seed = (&'static str, &'static [&'static str], &'static str, &'static str);

const SEEDS: &[Seed] = &[
    ("another pin of the converter", &[WIRING, MAIN], "PC4", "PC3"),
    ("two analog sensors are swapped", &[MAIN], "tables::NEAR, Scalar", "tables::FAR, Scalar"),
    ("address of a chip", &[TABLES], "address: 0x70", "address: 0x71"),
    ("register of a chip", &[TABLES], "select: &[0x02]", "select: &[0x03]"),
    ("trigger of a chip", &[TABLES], "&[0x00, 0x51]", "&[0x00, 0x50]"),
    ("wait for a chip", &[TABLES], "wait_ms: 65", "wait_ms: 6"),
    ("clock of a bus", &[WIRING], "i2c::config(400000)", "i2c::config(100000)"),
    ("mode of SPI", &[MAIN], "rt::spi::config(1, 656250)", "rt::spi::config(0, 656250)"),
    ("clock of SPI", &[MAIN], "rt::spi::config(1, 656250)", "rt::spi::config(1, 5250000)"),
    (
        "byte order of a serial message",
        &[TABLES],
        "is_little_endian: true",
        "is_little_endian: false",
    ),
    ("checksum of a message", &[TABLES], "MessageChecksum::Sum8", "MessageChecksum::Xor8"),
    ("speed of a serial port", &[WIRING], "config(115200,", "config(57600,"),
    ("parity of a serial port", &[WIRING], "Parity::ParityNone", "Parity::ParityEven"),
    ("filter of a CAN frame", &[MAIN], "standard(0x120)", "standard(0x121)"),
    ("place in a CAN frame", &[TABLES], "item: 8, byte: 2", "item: 8, byte: 3"),
    ("bit rate of a CAN bus", &[MAIN], "divider: 6,", "divider: 12,"),
    ("divider of a timer that measures", &[WIRING], "hz(1000000)", "hz(500000)"),
    (
        "ticks of a measured pulse",
        &[MAIN],
        "measure(timer, true, 1000000,",
        "measure(timer, true, 500000,",
    ),
    ("edges that are counted", &[MAIN], "Edges::Rising", "Edges::Both"),
    ("pull of a contact", &[WIRING], "(p.PC5, Pull::Up)", "(p.PC5, Pull::Down)"),
    ("level of a contact", &[MAIN], "bumper.is_low()", "bumper.is_high()"),
    ("frequency of pulses", &[WIRING], "hz(50)", "hz(60)"),
    ("shortest pulse", &[MAIN], "[1000, 2000, 20000]", "[1100, 2000, 20000]"),
    (
        "failsafe",
        &[MAIN],
        "5000); outputs.tim9.ch1().enable();\n",
        "0); outputs.tim9.ch1().enable();\n",
    ),
];

/// Mistakes that nothing notices here, and why.
const UNSEEN: &[(&str, &str)] = &[(
    "ticks of a measured pulse",
    "they only say which period is longer than the timer counts, and none here is.",
)];

const HEADING: &str = "In Rust, when it runs";

const INTRO: &str = "\
The same rover, generated for Embassy, with mistakes that its types take. Written by
`tests/tests/firmware/twin/seeded_rust.rs`.

";

#[test]
fn mistakes_that_types_take_are_noticed() {
    if !sensedsl_tests::is_exhaustive() {
        return;
    }
    let Some(board) = project("seeded_rust", &rover()) else { return };
    let try_out = || noticed_by(System::Embassy, &std::fs::read(build(&board)).unwrap());
    assert_eq!(try_out(), "", "the rover is wrong without a mistake");
    let mut rows = Vec::new();
    for (what, files, find, with) in SEEDS {
        let right: Vec<_> = files
            .iter()
            .map(|file| (board.join(file), std::fs::read_to_string(board.join(file)).unwrap()))
            .collect();
        for (path, text) in &right {
            assert!(text.contains(find), "{what}: {} has no `{find}`", path.display());
            std::fs::write(path, text.replace(find, with)).unwrap();
        }
        let by = try_out();
        for (path, text) in &right {
            std::fs::write(path, text).unwrap();
        }
        eprintln!("{what}: {by}");
        rows.push((*what, by));
    }
    let table = table(&rows, UNSEEN);
    assert_section("docs/seeded-mistakes.md", HEADING, &format!("{INTRO}{table}"));
}

/// The text that each mistake replaces must exist, so that the list follows the generator.
#[test]
fn mistakes_in_rust_are_of_texts_that_are_there() {
    let board = generated("seeded_rust_texts", &rover());
    for (what, files, find, _) in SEEDS {
        for file in *files {
            let text = std::fs::read_to_string(board.join(file)).unwrap();
            assert!(text.contains(find), "{what}: {file} has no `{find}`");
        }
    }
}
