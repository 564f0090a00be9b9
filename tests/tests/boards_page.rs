//! `docs/boards.md` agrees with `boards/`. `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests
//! boards_page::` rewrites the page.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_board::catalog::{self, Entry};
use sensedsl_board::mcu;
use sensedsl_board::pin::natural;
use sensedsl_board::profile::Transport;
use sensedsl_board::table::{Occupation, Pin};
use sensedsl_firmware_chibios::Facts;
use sensedsl_tests::{root, text};

const HEAD: &str = "# Built-in boards

A `.sense` file names a board by its name or by another of its names, in letters of any case, with `-` or `_` or
neither: `board Robot on NUCLEO_F411RE { … }`. `sensedsl boards` lists the boards, `sensedsl boards --search WORDS`
those with all of the words in what is known of them, and `sensedsl boards NAME` prints the [table](board-tables.md) of
one.

Each is a folder of `crates/board/boards/`: `pins.csv` says which pins there are, where they are brought out, and what
on the board is connected to them; `board.toml` has the other facts, each with its source. What a pin can be used for
comes from the MCU's part. The names of the Discovery, Nucleo and other boards are those of their makers.

- **Pins**: how many the table lists, and how many of them nothing on the board has taken. A pin that is *usable with
  care* (a light, a button) is among them and gives a warning; `release` frees a taken one.
- **Places**: what `header = …;` may name.
- **Link**: what carries the frames to the host; the first is the default.
- **ChibiOS**: the folder of the tree below `os/hal/boards` that firmware in C is built with. Without one there is
  firmware in [Rust](firmware.md#in-rust-on-embassy) where Embassy [knows the MCU](embassy-boards.md), and otherwise
  wiring alone; `sensedsl boards` has the systems of each board.

This page is made from `crates/board/boards/`.
";

/// The text of the page, from the boards.
fn page() -> String {
    let mut families: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
    for entry in catalog::all() {
        families.entry(mcu::family(entry.mcu)).or_default().push(entry);
    }
    let mut page = String::from(HEAD);
    for (family, entries) in families {
        write!(
            page,
            "\n## {family}\n\n| board | also | MCU | pins | places | on board | link | ChibiOS |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- |\n"
        )
        .unwrap();
        for entry in entries {
            page.push_str(&row(entry));
        }
    }
    page
}

fn row(entry: &Entry) -> String {
    let board = entry.board().unwrap();
    let pins = entry.table().pins;
    let taken = |pin: &&Pin| pin.onboard.as_ref().is_some_and(|part| part.how == Occupation::Taken);
    let free = pins.len() - pins.iter().filter(taken).count();
    let places = distinct(pins.iter().filter_map(|pin| pin.header.as_deref()));
    let parts = distinct(pins.iter().filter_map(|pin| pin.onboard.as_ref()).map(|p| &*p.part));
    let links = board.link.iter().map(|link| {
        let names: Vec<&str> = link.pins.iter().map(|pin| pin.as_str()).collect();
        let unit = match link.transport {
            Transport::Uart => link.unit.as_str(),
            Transport::Usb => "USB",
        };
        format!("{unit} ({})", names.join(" "))
    });
    let links: Vec<String> = links.collect();
    let chibios = Facts::of(&board).unwrap();
    let chibios = chibios.map(|chibios| format!("`{}`", chibios.board)).unwrap_or_default();
    format!(
        "| {} | {} | {} | {} of {} | {places} | {parts} | {} | {chibios} |\n",
        board.name,
        board.aliases.join(", "),
        board.mcu,
        free,
        pins.len(),
        links.join(", "),
    )
}

/// The distinct words, in natural order.
fn distinct<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let mut words: Vec<&str> = words.collect();
    words.sort_by(|a, b| natural(a, b));
    words.dedup();
    words.join(", ")
}

#[test]
fn the_page_is_fresh() {
    let wanted = page();
    if std::env::var("SENSEDSL_BLESS").is_ok() {
        std::fs::write(root().join("docs/boards.md"), &wanted).unwrap();
    }
    assert!(
        text("docs/boards.md") == wanted,
        "docs/boards.md is not what boards/ says: SENSEDSL_BLESS=1"
    );
}
