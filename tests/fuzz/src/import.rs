//! Sources of other tools: whatever the bytes are, what comes out is a table that loads and a
//! program that parses.
//!
//! A byte 0xFF, which no text has, begins another file that lies beside the source; a path names
//! the one of the last digit in it.

use sensedsl_diagnostics::{Severity, SourceMap, render};
use sensedsl_import::{Format, Imported, ReadError, Source, import};

/// A table as text, wide or long; as what it looks like where it begins with `!`.
pub fn tabular(bytes: &[u8]) {
    match bytes.strip_prefix(b"!") {
        Some(rest) => source("source", None, rest),
        None => source("source", Some(Format::Csv), bytes),
    }
}

/// The description of an MCU in a CubeMX installation.
pub fn cubemx(bytes: &[u8]) {
    source("source", Some(Format::CubeMx), bytes);
}

/// A project of CubeMX.
pub fn ioc(bytes: &[u8]) {
    source("source", Some(Format::Ioc), bytes);
}

/// A board of ArduPilot.
pub fn hwdef(bytes: &[u8]) {
    source("source", Some(Format::Hwdef), bytes);
}

/// The alternate functions of MicroPython's ports, or the pins of a board with its header beside it.
pub fn micropython(bytes: &[u8]) {
    source("source", Some(Format::MicroPython), bytes);
}

/// A flight controller of Betaflight: a dump, or a header.
pub fn betaflight(bytes: &[u8]) {
    source("source", Some(Format::Betaflight), bytes);
}

/// A board of Zephyr; after `!`, an overlay, whose name says which board it is for.
pub fn zephyr(bytes: &[u8]) {
    match bytes.strip_prefix(b"!") {
        Some(rest) => source("boards/nucleo_f446re.overlay", Some(Format::Zephyr), rest),
        None => source("board.dts", Some(Format::Zephyr), bytes),
    }
}

/// A file of a variant of an Arduino core.
pub fn arduino(bytes: &[u8]) {
    source("variant.h", Some(Format::Arduino), bytes);
}

/// The messages of a CAN bus, of which a program comes and no table.
pub fn dbc(bytes: &[u8]) {
    source("bus.dbc", Some(Format::Dbc), bytes);
}

fn source(name: &str, format: Option<Format>, bytes: &[u8]) {
    let parts: Vec<&[u8]> = bytes.split(|byte| *byte == 0xFF).collect();
    let beside = |path: &str| {
        let digit = path.bytes().rev().find(u8::is_ascii_digit).unwrap_or(b'1');
        parts.get(usize::from(digit - b'0')).map(|part| part.to_vec()).ok_or(ReadError::Missing)
    };
    let made = import(&Source {
        name,
        bytes: parts.first().copied().unwrap_or_default(),
        format,
        sheet: None,
        table: "pins.csv",
        beside: &beside,
    });
    check(&made);
    let has_table = !matches!(format, None | Some(Format::Dbc));
    assert!(made.failed() || made.table.is_some() || !has_table, "no table and no reason");
}

/// What holds of all that is imported.
pub(crate) fn check(made: &Imported) {
    for one in &made.diagnostics {
        let labels = one.labels.iter().map(|label| label.span);
        for span in labels.chain([one.primary.span]) {
            let inside = made.sources.text(span.file).get(span.range());
            assert!(inside.is_some(), "{span:?} of {} is no place in the text", one.code);
        }
    }
    let shown = made.diagnostics.get(..made.diagnostics.len().min(3)).unwrap_or_default();
    let _ = render::human(shown, &made.sources, false);
    assert!(!made.failed() || (made.table.is_none() && made.program.is_none()));
    let has_result = made.table.is_some() || made.program.is_some();
    assert!(made.failed() || has_result, "neither a result nor a reason");
    if let Some(table) = &made.table {
        let loaded = sensedsl_board::table::load(table);
        // What is no signal in the source is none in the table, and was said.
        let mut sources = SourceMap::default();
        let file = sources.add("pins.csv", table.as_str());
        for finding in &loaded.findings {
            let one = sensedsl_model::table_diagnostic(finding, file, &sources);
            let is_said = one.code.name() == "E0306" && !made.diagnostics.is_empty();
            assert!(one.severity != Severity::Error || is_said, "{one:?}\n{table}");
        }
        assert_eq!(&loaded.board.to_csv(), table, "the table is not canonical");
    }
    if let Some(program) = &made.program {
        let parsed = sensedsl_syntax::parse(program);
        assert!(parsed.errors().is_empty(), "{:?}\n{program}", parsed.errors());
    }
}
