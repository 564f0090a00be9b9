//! `docs/boards.md` agrees with `boards/`, and so does the list that `sensedsl boards` prints. `SENSEDSL_BLESS=1 cargo
//! test -p sensedsl-tests boards_page::` rewrites both.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_board::catalog::{self, Entry};
use sensedsl_board::mcu;
use sensedsl_board::pin::natural;
use sensedsl_board::profile::Transport;
use sensedsl_board::table::{Occupation, Pin};
use sensedsl_firmware_chibios::Facts;
use sensedsl_generate::listing;
use sensedsl_tests::{assert_page, root, write_file};

/// The text of the page, from the boards.
fn page() -> String {
    let mut families: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
    for entry in catalog::all() {
        families.entry(mcu::family(entry.mcu)).or_default().push(entry);
    }
    let mut page = String::new();
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
    let places = distinct(pins.iter().flat_map(Pin::headers));
    let places = if places.is_empty() { "unknown".to_owned() } else { places };
    let parts = distinct(pins.iter().filter_map(|pin| pin.onboard.as_ref()).map(|p| &*p.part));
    let links = board.link.iter().map(|link| {
        let names: Vec<&str> = link.pins.iter().map(|pin| pin.as_str()).collect();
        let unit = match link.transport {
            Transport::Uart => link.unit.as_str(),
            Transport::Usb => "USB",
        };
        if names.is_empty() { unit.to_owned() } else { format!("{unit} ({})", names.join(" ")) }
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
    assert_page("docs/boards.md", "## ", page().trim_start());
}

/// What `sensedsl boards` prints is embedded, because to work it out takes a tenth of a second.
#[test]
fn the_list_is_fresh() {
    let rows = catalog::all().iter().map(|entry| listing::row(entry, &entry.table()));
    let rows: Vec<listing::Row> = rows.collect();
    assert!(rows.iter().flatten().all(|cell| !cell.contains([',', '\n'])));
    let place = root().join("crates/generate/src/listing.csv");
    let wanted: String = rows.iter().map(|row| row.join(",") + "\n").collect();
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        write_file(&place, &wanted);
    }
    assert_eq!(wanted, std::fs::read_to_string(&place).unwrap(), "SENSEDSL_BLESS=1");
    // What was compiled is older than what was just written.
    if std::env::var_os("SENSEDSL_BLESS").is_none() {
        let read: Vec<listing::Row> = listing::rows().map(|(_, row)| row).collect();
        assert_eq!(read, rows);
    }
}
