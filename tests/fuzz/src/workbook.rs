//! Workbooks: the bytes are the parts of an XLSX or ODS file, which are zipped as they should be (a
//! mutated archive seldom gets past its checksum), or the archive itself.

use std::io::{Cursor, Write as _};

use sensedsl_import::{Format, ReadError, Source, import};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::draw::Draw;
use crate::import::check;

const TYPES: &str = r#"<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>"#;
const RELS: &str = r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>"#;
const BOOK: &str = r#"<?xml version="1.0"?><workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="Pins" sheetId="1" r:id="rId1"/></sheets></workbook>"#;
const BOOK_RELS: &str = r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/><Relationship Id="rId2" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/sharedStrings" Target="sharedStrings.xml"/></Relationships>"#;
const ODS_TYPE: &str = "application/vnd.oasis.opendocument.spreadsheet";
const MANIFEST: &str = r#"<?xml version="1.0"?><manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0"><manifest:file-entry manifest:full-path="/" manifest:media-type="application/vnd.oasis.opendocument.spreadsheet"/></manifest:manifest>"#;
const CONTENT: &str = r#"<?xml version="1.0"?><office:document-content xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"><office:body><office:spreadsheet><table:table table:name="Pins">"#;
const CONTENT_END: &str =
    "</table:table></office:spreadsheet></office:body></office:document-content>";
const SHEET: &str = r#"<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main">"#;
const SHEET_END: &str = "</worksheet>";

/// The body of the target. The first byte chooses the form; then come the parts, with a byte 0xFF
/// between them.
pub fn run(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let form = draw.byte();
    let rest = draw.rest();
    let method =
        if form & 8 == 0 { CompressionMethod::Stored } else { CompressionMethod::Deflated };
    let mut parts = rest.split(|byte| *byte == 0xFF);
    let mut part = || parts.next().unwrap_or_default();
    let wrapped =
        |start: &str, part: &[u8], end: &str| [start.as_bytes(), part, end.as_bytes()].concat();
    let (archive, format) = match form & 3 {
        0 => {
            let sheet = wrapped(SHEET, part(), SHEET_END);
            let strings = wrapped("<sst>", part(), "</sst>");
            (xlsx(method, &sheet, &strings, &or(part(), BOOK)), Format::Xlsx)
        }
        1 => (ods(method, &wrapped(CONTENT, part(), CONTENT_END)), Format::Ods),
        2 => (ods(method, &or(part(), CONTENT)), Format::Ods),
        _ => (rest.to_vec(), if form & 4 == 0 { Format::Xlsx } else { Format::Ods }),
    };
    let sheet = (form & 16 != 0).then_some("Pins");
    let made = import(&Source {
        name: "source",
        bytes: &archive,
        format: (form & 32 == 0).then_some(format),
        sheet,
        table: "pins.csv",
        beside: &|_| Err(ReadError::Missing),
    });
    check(&made);
}

fn or(part: &[u8], plain: &str) -> Vec<u8> {
    if part.is_empty() { plain.as_bytes().to_vec() } else { part.to_vec() }
}

fn xlsx(method: CompressionMethod, sheet: &[u8], strings: &[u8], book: &[u8]) -> Vec<u8> {
    archive(
        method,
        &[
            ("[Content_Types].xml", TYPES.as_bytes()),
            ("_rels/.rels", RELS.as_bytes()),
            ("xl/workbook.xml", book),
            ("xl/_rels/workbook.xml.rels", BOOK_RELS.as_bytes()),
            ("xl/sharedStrings.xml", strings),
            ("xl/worksheets/sheet1.xml", sheet),
        ],
    )
}

fn ods(method: CompressionMethod, content: &[u8]) -> Vec<u8> {
    archive(
        method,
        &[
            ("mimetype", ODS_TYPE.as_bytes()),
            ("META-INF/manifest.xml", MANIFEST.as_bytes()),
            ("content.xml", content),
        ],
    )
}

fn archive(method: CompressionMethod, members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        let method = if *name == "mimetype" { CompressionMethod::Stored } else { method };
        let options = SimpleFileOptions::default().compression_method(method);
        writer.start_file(*name, options).expect("an archive in memory");
        writer.write_all(bytes).expect("an archive in memory");
    }
    writer.finish().expect("an archive in memory").into_inner()
}
