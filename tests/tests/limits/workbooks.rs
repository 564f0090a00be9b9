//! Workbooks: archives that expand to far more than their size, and sheets that repeat themselves.

use std::fs::File;
use std::io::Write as _;

use sensedsl_tests::{TempDir, is_thorough};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{expect, repeat};

const MAIN: &str = "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"";
const RELATION: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";

/// Imports an archive of these files and expects this status and code.
#[track_caller]
fn archive(name: &str, files: &[(&str, &str)], status: i32, code: &str) {
    let folder = TempDir::new("limits");
    let mut archive = ZipWriter::new(File::create(folder.join(name)).unwrap());
    for (path, content) in files {
        archive.start_file(*path, SimpleFileOptions::default()).unwrap();
        archive.write_all(content.as_bytes()).unwrap();
    }
    archive.finish().unwrap();
    expect(&folder, &["import", name], status, code);
}

/// Imports a workbook of one sheet.
#[track_caller]
fn xlsx(sheet: &str, strings: Option<&str>, status: i32, code: &str) {
    xlsx_of(1, sheet, strings, status, code);
}

/// Imports a workbook with `count` sheets, which are all the same file in the archive.
#[track_caller]
fn xlsx_of(count: usize, sheet: &str, strings: Option<&str>, status: i32, code: &str) {
    let types = "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"/>";
    let relations = |kind: &str, target: &str| {
        let package = "http://schemas.openxmlformats.org/package/2006/relationships";
        format!(
            "<Relationships xmlns=\"{package}\"><Relationship Id=\"rId1\" \
             Type=\"{RELATION}/{kind}\" Target=\"{target}\"/></Relationships>"
        )
    };
    let sheets =
        repeat(count, |at| format!("<sheet name=\"S{at}\" sheetId=\"{}\" r:id=\"rId1\"/>", at + 1));
    let book =
        format!("<workbook {MAIN} xmlns:r=\"{RELATION}\"><sheets>{sheets}</sheets></workbook>");
    let (first, second) = (
        relations("officeDocument", "xl/workbook.xml"),
        relations("worksheet", "worksheets/sheet1.xml"),
    );
    let mut files = vec![
        ("[Content_Types].xml", types),
        ("_rels/.rels", &first),
        ("xl/workbook.xml", &book),
        ("xl/_rels/workbook.xml.rels", &second),
        ("xl/worksheets/sheet1.xml", sheet),
    ];
    files.extend(strings.map(|strings| ("xl/sharedStrings.xml", strings)));
    archive("a.xlsx", &files, status, code);
}

/// A sheet of rows; `row` makes the cells of each from its number.
fn sheet(rows: usize, row: impl Fn(usize) -> String) -> String {
    let rows = repeat(rows, |at| format!("<row r=\"{}\">{}</row>", at + 1, row(at + 1)));
    format!("<worksheet {MAIN}><sheetData>{rows}</sheetData></worksheet>")
}

/// Imports a workbook of one table and expects a refusal with this code.
#[track_caller]
fn ods(rows: &str, code: &str) {
    let content = format!(
        "<office:document-content xmlns:office=\"urn:oasis:names:tc:opendocument:xmlns:office:1.0\" \
         xmlns:table=\"urn:oasis:names:tc:opendocument:xmlns:table:1.0\" \
         xmlns:text=\"urn:oasis:names:tc:opendocument:xmlns:text:1.0\"><office:body>\
         <office:spreadsheet><table:table table:name=\"S\">{rows}</table:table>\
         </office:spreadsheet></office:body></office:document-content>"
    );
    opendocument(&content, code);
}

#[track_caller]
fn opendocument(content: &str, code: &str) {
    let mime = "application/vnd.oasis.opendocument.spreadsheet";
    archive("a.ods", &[("mimetype", mime), ("content.xml", content)], 1, code);
}

/// A cell with more attributes.
fn cell(attributes: &str) -> String {
    format!(
        "<table:table-cell office:value-type=\"string\" {attributes}><text:p>x</text:p>\
         </table:table-cell>"
    )
}

#[test]
fn an_archive_is_larger_inside() {
    if !is_thorough() {
        return;
    }
    let spaces = " ".repeat(48 << 20);
    archive("a.xlsx", &[("xl/worksheets/sheet1.xml", &spaces)], 1, "E0807");
}

#[test]
fn shared_strings() {
    let cells = |row| -> String {
        let cell = |column| format!("<c r=\"{column}{row}\" t=\"s\"><v>0</v></c>");
        ('A'..='H').map(cell).collect()
    };
    let string = "y".repeat(1_000_000);
    let strings =
        format!("<sst {MAIN} count=\"1\" uniqueCount=\"1\"><si><t>{string}</t></si></sst>");
    xlsx(&sheet(9_000, cells), Some(&strings), 1, "E0807");
    let strings = "count=\"1\" uniqueCount=\"999999999999999\"><si><t>y</t></si></sst>";
    xlsx(&sheet(0, cells), Some(&format!("<sst {MAIN} {strings}")), 1, "E0807");
}

#[test]
fn cells_and_attributes() {
    if !is_thorough() {
        return;
    }
    let attributes = repeat(1_000_000, |at| format!(" a{at}=\"\""));
    xlsx(&format!("<worksheet {MAIN}{attributes}/>"), None, 1, "E0807");
    let far = |row| match row {
        19_000 => "<c r=\"SR19000\"><v>1</v></c>".to_owned(),
        _ => format!("<c r=\"A{row}\"><v>1</v></c>"),
    };
    xlsx(&sheet(19_000, far), None, 1, "E0807");
    let full =
        |row| ('A'..='Z').map(|column| format!("<c r=\"{column}{row}\"><v>1</v></c>")).collect();
    xlsx(&sheet(19_000, full), None, 1, "E0807");
}

/// 33 kB that would expand to 962 MB.
#[test]
fn sheets_that_are_all_one_file() {
    let row =
        |row| ('A'..='T').map(|column| format!("<c r=\"{column}{row}\"><v>1</v></c>")).collect();
    xlsx_of(1_000, &sheet(100, row), None, 1, "E0807");
    xlsx_of(200, &sheet(2_000, row), None, 1, "E0807");
    xlsx_of(200, &sheet(200, row), None, 1, "E0807");
    xlsx_of(
        250,
        &format!("<worksheet {MAIN}>{}</worksheet>", "<a/>".repeat(900_000)),
        None,
        1,
        "E0807",
    );
}

#[test]
fn a_sheet_that_is_one_cell() {
    let text = |place, text| format!("<c r=\"{place}\" t=\"inlineStr\"><is><t>{text}</t></is></c>");
    let whole = format!(
        "<worksheet {MAIN}><dimension ref=\"A1:XFD1048576\"/><sheetData><row r=\"1\">{}{}</row>\
         <row r=\"2\">{}{}</row></sheetData><mergeCells><mergeCell ref=\"A1:XFD1048576\"/>\
         </mergeCells></worksheet>",
        text("A1", "Pin"),
        text("B1", "ADC"),
        text("A2", "PA1"),
        text("B2", "ADC1_IN1")
    );
    xlsx(&whole, None, 0, "W0805");
}

#[test]
fn rows_and_cells_that_repeat() {
    if !is_thorough() {
        return;
    }
    let four = cell("").repeat(4);
    let row = |attributes: &str, cells: &str| {
        format!("<table:table-row {attributes}>{cells}</table:table-row>")
    };
    ods(&row("table:number-rows-repeated=\"1000000000\"", &four), "E0802");
    let wide = cell("table:number-columns-repeated=\"16000\"");
    ods(&row("table:number-rows-repeated=\"20000\"", &wide), "E0807");
    let span =
        "table:number-columns-spanned=\"4000000000\" table:number-rows-spanned=\"4000000000\"";
    ods(&row("", &cell(span)).repeat(50_000), "E0807");
}

#[test]
fn entities() {
    let (large, many) = ("x".repeat(1_000), "&a;".repeat(1_000));
    let laughs = format!("<!DOCTYPE a [<!ENTITY a \"{large}\"><!ENTITY b \"{many}\">]><a>&b;</a>");
    opendocument(&laughs, "E0801");
}
