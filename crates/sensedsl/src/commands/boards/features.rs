//! What a board has, as words to search for: `can`, `dac`, `usb`, `3v3`, `arduino`.

use std::collections::BTreeSet;

use sensedsl_board::catalog;
use sensedsl_board::profile::Transport;
use sensedsl_board::signal::Function;
use sensedsl_board::silicon;
use sensedsl_board::table::{Pin, Table};

use sensedsl_session::boards::is_free;

/// What is known of a board, to look words up in.
pub(super) struct Features {
    /// Names, parts on the board, connectors, as one text in lower case.
    text: String,
    /// Words that only count as a whole: peripherals, voltages.
    words: BTreeSet<String>,
}

impl Features {
    /// The features of a board, of which `cells` are known already.
    pub(super) fn of(board: &catalog::Entry, cells: &[String]) -> Self {
        let mut table = board.table();
        // A board of an unknown part has the usages that its own table lists.
        let _ = sensedsl_parts::complete(&mut table);
        let names = board.aliases.iter().copied().chain([board.name, board.description]);
        let texts = names.chain(cells.iter().map(String::as_str));
        let mut text: Vec<String> = texts.map(str::to_lowercase).collect();
        text.extend(on_board(&table));
        Self { text: text.join("\n"), words: words(board, &table) }
    }

    /// Whether the board has all of these words, which are in lower case.
    pub(super) fn has_all(&self, search: &str) -> bool {
        search.split_whitespace().all(|word| self.words.contains(word) || self.text.contains(word))
    }
}

/// The parts on the board, its connectors and its form.
fn on_board(table: &Table) -> Vec<String> {
    let parts = table.pins.iter().filter_map(|pin| Some(pin.onboard.as_ref()?.part.as_str()));
    let headers = table.pins.iter().flat_map(Pin::headers);
    let form = table.form().map(|form| form.name.as_str());
    let all: BTreeSet<String> = parts.chain(headers).chain(form).map(str::to_lowercase).collect();
    all.into_iter().collect()
}

/// What its free pins can be used for, its links, and the voltage of its outputs.
fn words(board: &catalog::Entry, table: &Table) -> BTreeSet<String> {
    let free = table.pins.iter().filter(|pin| is_free(table, pin));
    let functions = free.flat_map(|pin| &pin.usages).map(|usage| usage.signal.function());
    let mut words: BTreeSet<&str> = functions.flat_map(peripheral).copied().collect();
    let facts = board.board().ok();
    let mut links = facts.iter().flat_map(|facts| &facts.link);
    if links.any(|link| link.transport == Transport::Usb) {
        words.insert("usb");
    }
    let level = silicon::volts(board.mcu).map(|volts| match volts.supply_mv {
        5_000 => ["5v", "5.0v"],
        _ => ["3v3", "3.3v"],
    });
    words.extend(level.into_iter().flatten());
    let is_arduino = |label: &str| label == "D2" || label == "A0";
    if table.pins.iter().flat_map(Pin::labels).any(is_arduino) {
        words.insert("arduino");
    }
    words.into_iter().map(str::to_owned).collect()
}

/// The words for what a signal is for.
fn peripheral(function: &Function) -> &'static [&'static str] {
    match function {
        Function::Adc { .. } => &["analog", "adc"],
        Function::I2c { .. } => &["i2c"],
        Function::Timer { line, .. } if line.is_output() => &["pwm", "timer"],
        Function::Timer { .. } => &["timer"],
        Function::Uart { .. } => &["uart", "serial"],
        Function::Spi { .. } => &["spi"],
        Function::Can { .. } => &["can"],
        Function::Dac { .. } => &["dac"],
        Function::Pio { .. } => &["pio"],
        Function::Other => &[],
    }
}
