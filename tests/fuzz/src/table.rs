//! Any text as a board table: places are inside the text, each signal of a pin stands once, and the
//! canonical form reads back to the same pins.

use sensedsl_board::table::{Table, load};

/// A signal with its alternate function.
type Spelled = (String, Option<u8>);

/// Pins with their signals and alternate functions.
fn pins(table: &Table) -> Vec<(String, Vec<Spelled>)> {
    let row = |pin: &sensedsl_board::table::Pin| {
        let usages = pin.usages.iter();
        let usages = usages.map(|usage| (usage.signal.to_string(), usage.alternate)).collect();
        (pin.name.to_string(), usages)
    };
    table.pins.iter().map(row).collect()
}

/// The body of the target.
///
/// # Panics
/// Where a table is read or written wrong.
pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let loaded = load(text);
    for finding in &loaded.findings {
        let _ = &text[finding.range.clone()];
        assert!(finding.row >= 1);
    }
    for pin in &loaded.board.pins {
        let _ = &text[pin.range.clone()];
        for usage in &pin.usages {
            let _ = &text[usage.range.clone()];
            assert_eq!(pin.usage(&usage.signal), Some(usage));
        }
    }
    if !loaded.board.pins.is_empty() {
        let again = load(&loaded.board.to_csv()).board;
        assert_eq!(pins(&again), pins(&loaded.board));
    }
}
