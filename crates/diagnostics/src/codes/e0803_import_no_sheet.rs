//! E0803: the workbook has no such sheet.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0803",
    title: "the workbook has no such sheet",
    explanation: r#"`--sheet` names a sheet that is not in the workbook, or the source is not a workbook.

Way out: give one of the names in the message, or leave `--sheet` out."#,
});

/// `name` is the sheet asked for, `sheets` has the names of all.
pub fn import_no_sheet(span: Span, name: &str, sheets: &[String]) -> Diagnostic {
    let sheets: Vec<String> = sheets.iter().map(|sheet| format!("`{sheet}`")).collect();
    let there = if sheets.is_empty() {
        "it has no sheets".into()
    } else {
        format!("there is {}", sheets.join(", "))
    };
    Diagnostic::new(CODE, span, format!("there is no sheet `{name}`"))
        .help(format!("{there}; or leave `--sheet` out"))
}
