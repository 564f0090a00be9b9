//! Workbooks as LibreOffice writes them: Table 1 is read back from each format, and features that
//! only a spreadsheet has are reported at their cells. `soffice` creates the files here.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sensedsl_tests::{RunOutput, TempDir, few, has, is_thorough, root, sensedsl, text};

/// A sheet of remarks, and a sheet of pins with a title, a formula, merged cells and a number among
/// names.
const ODD: &str = r#"<table:table table:name="Notes">
 <table:table-row/><table:table-row><table:table-cell/>TEXT(nothing about pins)</table:table-row>
</table:table>
<table:table table:name="Pins">
 <table:table-row>TEXT(My board)</table:table-row>
 <table:table-row>TEXT(Pin)TEXT(Position)TEXT(ADC)TEXT(I2C)</table:table-row>
 <table:table-row>TEXT(PA1)NUMBER(23)<table:table-cell table:formula="of:=&quot;ADC&quot;&amp;[.B3]-22&amp;&quot;_IN1&quot;"/>TEXT(-)</table:table-row>
 <table:table-row>TEXT(PB6)NUMBER(92)TEXT(-)<table:table-cell office:value-type="string"
  table:number-rows-spanned="2" table:number-columns-spanned="1"><text:p>I2C1_SCL</text:p></table:table-cell></table:table-row>
 <table:table-row>TEXT(PB7)NUMBER(93)TEXT(-)<table:covered-table-cell/></table:table-row>
 <table:table-row/>
 <table:table-row>TEXT(PC1)NUMBER(16)NUMBER(11)TEXT(-)</table:table-row>
</table:table>
"#;

/// Letters that are in Windows-1252 but not in ASCII.
const WESTERN: &str = r#"<table:table table:name="Pins">
 <table:table-row>TEXT(Pin)TEXT(I²C)TEXT(Note)</table:table-row>
 <table:table-row>TEXT(PB6)TEXT(I2C1-SCL)TEXT(Prüfpunkt)</table:table-row>
 <table:table-row>TEXT(PB7)TEXT(I2C1-SDA)TEXT(-)</table:table-row>
</table:table>
"#;

/// The text before the sheets of a workbook that is a single XML file.
const START: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<office:document xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"
 xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0"
 xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"
 xmlns:of="urn:oasis:names:tc:opendocument:xmlns:of:1.2"
 office:version="1.2" office:mimetype="application/vnd.oasis.opendocument.spreadsheet">
<office:body><office:spreadsheet>
"#;
const END: &str = "</office:spreadsheet></office:body></office:document>\n";

/// A workbook made from sheets in which `TEXT(…)` and `NUMBER(…)` are cells.
fn flat(sheets: &str) -> String {
    let cell = |out: String, start: &str, before: &str, after: &str| {
        let mut parts = out.split(start);
        let mut made = parts.next().unwrap().to_owned();
        for part in parts {
            let (value, rest) = part.split_once(')').unwrap();
            made += &format!("{}{value}{after}{rest}", before.replace('#', value));
        }
        made
    };
    let end = "</text:p></table:table-cell>";
    let text = "<table:table-cell office:value-type=\"string\"><text:p>";
    let number = "<table:table-cell office:value-type=\"float\" office:value=\"#\"><text:p>";
    let sheets = cell(cell(sheets.to_owned(), "TEXT(", text, end), "NUMBER(", number, end);
    format!("{START}{sheets}{END}")
}

/// The file in another format, converted by LibreOffice.
fn converted(scratch: &TempDir, source: &Path, format: &str) -> PathBuf {
    let profile = format!("-env:UserInstallation=file://{}", scratch.join("profile").display());
    let ending = format.split(':').next().unwrap();
    let folder = scratch.join(ending);
    let mut soffice = Command::new("soffice");
    soffice.args([&profile, "--headless", "--convert-to", format, "--outdir"]).arg(&folder);
    soffice.arg(source).stdin(Stdio::null());
    let output = soffice.output().unwrap();
    let made = folder.join(source.file_name().unwrap()).with_extension(ending);
    assert!(made.is_file(), "{source:?} to {format}: {output:?}");
    made
}

fn import(source: &Path) -> RunOutput {
    sensedsl(["import"]).arg(source).run().exits(0)
}

#[test]
fn table_1_comes_back_from_libreoffice() {
    if !has("soffice") {
        return;
    }
    let scratch = TempDir::new("libreoffice");
    let table = root().join("crates/board/boards/STM32F4DiscoveryBoard/pins.csv");
    let expected = text("crates/board/boards/STM32F4DiscoveryBoard/pins.csv");
    for format in ["xlsx", "ods"] {
        let made = import(&converted(&scratch, &table, format));
        assert_eq!(
            (made.stdout.as_str(), made.stderr.as_str()),
            (expected.as_str(), ""),
            "{format}"
        );
    }
}

#[test]
fn what_only_a_spreadsheet_has_is_reported_at_its_cell() {
    if !is_thorough() {
        return;
    }
    if !has("soffice") {
        return;
    }
    let scratch = TempDir::new("libreoffice-odd");
    let odd = scratch.write("odd.fods", flat(ODD));
    for format in few(&["xlsx", "ods"], 1) {
        let made = import(&converted(&scratch, &odd, format));
        for (code, words) in [
            ("W0804", ["Notes!B2:", "no pin table"]),
            ("W0804", ["Pins!A1:", "above the table"]),
            ("W0805", ["Pins!C3:", "is read as its last value, `ADC1_IN1`"]),
            ("W0805", ["Pins!D4:", "merged up to D5"]),
            ("W0804", ["Pins!A6:", "empty row"]),
            ("W0805", ["Pins!C7:", "the number 11"]),
        ] {
            let reported =
                |line: &str| line.contains(code) && words.iter().all(|w| line.contains(w));
            assert!(
                made.stderr.lines().any(reported),
                "{format} {code} {words:?}\n{}",
                made.stderr
            );
        }
        let expected =
            "Pin,Position,ADC,I2C\nPA1,23,ADC1_IN1,-\nPB6,92,-,I2C1_SCL\nPB7,93,-,-\nPC1,16,11,-\n";
        assert_eq!(made.stdout, expected, "{format}");
    }
}

/// Text in Windows-1252 (number 1) separated by semicolons (59), as German machines write it.
#[test]
fn text_in_another_encoding_is_reported_at_its_cell() {
    if !is_thorough() {
        return;
    }
    if !has("soffice") {
        return;
    }
    let scratch = TempDir::new("libreoffice-csv");
    let book = scratch.write("book.fods", flat(WESTERN));
    let made = import(&converted(&scratch, &book, "csv:Text - txt - csv (StarCalc):59,34,1"));
    assert_eq!(made.stdout, "Pin,I²C,Note\nPB6,I2C1-SCL,Prüfpunkt\nPB7,I2C1-SDA,\n");
    assert!(made.stderr.contains("B1: byte 5 (0xB2) is no UTF-8"), "{}", made.stderr);
    assert!(made.stderr.contains("C2:") && made.stderr.contains("(0xFC)"), "{}", made.stderr);
}
