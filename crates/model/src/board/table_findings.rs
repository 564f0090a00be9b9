//! Findings in a board table in, diagnostics out. Crate `board` reads tables without knowing of diagnostics.

use sensedsl_board::finding::{Finding, FindingKind};
use sensedsl_board::landmark::LandmarkKind;
use sensedsl_diagnostics::codes::{
    e0117_more_mistakes, e0303_table_empty, e0304_table_pin_twice, e0305_table_pin_name,
    e0306_table_signal, e0307_table_ragged_row, e0308_table_column_twice, e0309_table_usage_twice,
    e0317_table_too_large, w0606_table_oddity,
};
use sensedsl_diagnostics::{Diagnostic, FileId, SourceMap, Span};

/// The diagnostic for a finding in the table `file`.
pub fn diagnostic(finding: &Finding, file: FileId, sources: &SourceMap) -> Diagnostic {
    use FindingKind as Kind;
    let at = Span::new(file, finding.range.clone());
    let row = finding.row;
    let column = finding.column.as_deref().unwrap_or("?");
    let place = |range: &std::ops::Range<usize>| Span::new(file, range.clone());
    match &finding.kind {
        Kind::EmptyTable => e0303_table_empty::table_empty(at, "a head and rows"),
        Kind::NoPinColumn { nearest } => {
            let diagnostic = e0303_table_empty::table_empty(at, "the column `Pin`");
            match nearest {
                Some(meant) => diagnostic.here(format!("is it `{meant}`? call it `Pin`")),
                None => diagnostic,
            }
        }
        Kind::DuplicateColumn { header, first } => {
            e0308_table_column_twice::table_column_twice(at, header, place(first))
        }
        Kind::RaggedRow { expected, found } => {
            e0307_table_ragged_row::table_ragged_row(at, row, *found, *expected)
        }
        Kind::MissingPin => e0305_table_pin_name::table_pin_name(at, row, ""),
        Kind::BadPinName { spelled } => e0305_table_pin_name::table_pin_name(at, row, spelled),
        Kind::DuplicatePin { pin, first } => {
            let first = place(first);
            let first_row = sources.line_column(file, first.start).line as usize;
            e0304_table_pin_twice::table_pin_twice(at, pin.as_str(), row, first, first_row)
        }
        Kind::DuplicateUsage { spelled, first } => {
            e0309_table_usage_twice::table_usage_twice(at, row, spelled, place(first))
        }
        Kind::MalformedSignal { spelled, nearest } => {
            e0306_table_signal::table_signal(at, row, column, spelled, nearest.as_deref())
        }
        Kind::BadAlternate { spelled } => {
            let here = if spelled.contains('#') {
                "behind `#` are remap blocks from 0 to 15, as in `#0|2`"
            } else {
                "the number behind `@` is an alternate function from 0 to 15"
            };
            e0306_table_signal::table_signal(at, row, column, spelled, None).here(here)
        }
        Kind::TooLarge { what, most } => e0317_table_too_large::table_too_large(at, what, *most),
        Kind::More { listed, more } => e0117_more_mistakes::more_mistakes(at, *listed, *more),
        Kind::UnnamedColumn
        | Kind::BadQuote
        | Kind::UnknownAlternate { .. }
        | Kind::AlternateCount { .. }
        | Kind::AlternateConflict { .. }
        | Kind::BadOccupation { .. }
        | Kind::UnknownMcu { .. }
        | Kind::UnknownForm { .. }
        | Kind::BadLandmark { .. }
        | Kind::BadPlace { .. }
        | Kind::NoContact { .. }
        | Kind::ContactTwice { .. }
        | Kind::DuplicateProperty { .. }
        | Kind::InvisibleCharacter { .. } => {
            let column = finding.column.as_deref();
            w0606_table_oddity::table_oddity(at, row, column, &oddity(&finding.kind))
        }
    }
}

/// The message for a finding that is only odd.
fn oddity(kind: &FindingKind) -> String {
    use FindingKind as Kind;
    let meant = |nearest: &Option<String>| {
        nearest.as_ref().map_or(String::new(), |meant| format!(", did you mean `{meant}`?"))
    };
    match kind {
        Kind::UnnamedColumn => "cells stand below no column head and are not read".into(),
        Kind::BadQuote => "a quoted cell does not end where it should".into(),
        Kind::UnknownAlternate { signal, nearest } => {
            format!("`{signal}` is not a usage in this row{}", meant(nearest))
        }
        Kind::AlternateCount { expected, found } => {
            format!("{found} alternate functions for {expected} usages")
        }
        Kind::AlternateConflict { spelled, usage, cell } => {
            format!("`{spelled}` says alternate function {usage}, the column AF says {cell}")
        }
        Kind::BadOccupation { spelled, nearest } => {
            format!("`{spelled}` is none of taken, bus, care{}", meant(nearest))
        }
        Kind::UnknownMcu { spelled, nearest } => {
            format!("`{spelled}` is no MCU that is known{}", meant(nearest))
        }
        Kind::UnknownForm { spelled, nearest } => {
            format!("`{spelled}` is not a known form of a board{}", meant(nearest))
        }
        Kind::BadLandmark { kind, spelled } => {
            format!(
                "`{spelled}` is not the place of {}: write its name, x and y in mm, and `;` before the next, as in \
                 `# {} = A 6.1 12.3; B 20 12.3`",
                match kind {
                    LandmarkKind::Button => "a button",
                    LandmarkKind::Led => "an LED",
                },
                kind.property()
            )
        }
        Kind::BadPlace { spelled } => {
            format!(
                "`{spelled}` is not a place: write the connector, a dot and the contact, as in `CN7.28`"
            )
        }
        Kind::NoContact { contact, form } => {
            format!("boards of the form `{form}` have no contact `{contact}`")
        }
        Kind::ContactTwice { contact, first } => {
            format!("`{contact}` carries `{first}` already")
        }
        Kind::DuplicateProperty { key } => {
            format!("`{key}` is given twice, the first one counts")
        }
        Kind::InvisibleCharacter { character } => {
            format!("an invisible character U+{:04X} is read as a space", u32::from(*character))
        }
        Kind::EmptyTable
        | Kind::NoPinColumn { .. }
        | Kind::DuplicateColumn { .. }
        | Kind::RaggedRow { .. }
        | Kind::MissingPin
        | Kind::BadPinName { .. }
        | Kind::DuplicatePin { .. }
        | Kind::DuplicateUsage { .. }
        | Kind::MalformedSignal { .. }
        | Kind::BadAlternate { .. }
        | Kind::TooLarge { .. }
        | Kind::More { .. } => "this has a code of its own".into(),
    }
}
