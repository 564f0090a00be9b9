//! The C code that is generated only for a wire, for the schemas of the vectors and of the core's
//! own tests.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sensedsl_firmware_c::{self as c, Role};
use sensedsl_wire::{Checksum, Schema};

use crate::hosts::designs::item;

/// Schemas of tests that are not vectors, written in the same words.
const OWN: &str = "\
schema model
checksum none
item 17 sensor Front uint16
item 19 sensor Rear uint8
item 40 actuator Motor int16
schema rig
checksum crc16
stamp on
item 1 sensor Range uint16
item 2 sensor Axes int16[3]
item 3 sensor Wheel uint32
item 4 sensor Level uint8
item 5 actuator Motor int16
item 6 actuator Lamp bool
";

/// All schemas in a text with lines of vector files.
fn schemas(text: &str) -> Vec<(String, Schema)> {
    let mut schemas: Vec<(String, Schema)> = Vec::new();
    for line in text.lines() {
        let line = line.split("  #").next().unwrap_or_default().trim_end();
        if let Some(name) = line.strip_prefix("schema ") {
            schemas.push((name.to_owned(), Schema::default()));
        } else if let Some((_, schema)) = schemas.last_mut() {
            match line.split_once(' ') {
                Some(("checksum", name)) => {
                    schema.checksum = Checksum::of_name(name).expect("a checksum");
                }
                Some(("stamp", "on")) => schema.stamp = true,
                Some(("item", rest)) => schema.items.push(item(rest)),
                _ => {}
            }
        }
    }
    schemas
}

/// Writes the codecs of all schemas side by side, each with its own name in place of `sense`.
pub(super) fn write(folder: &Path, vectors: &[PathBuf]) {
    let texts = vectors.iter().map(|path| std::fs::read_to_string(path).unwrap());
    let all: String = texts.chain([OWN.to_owned()]).collect();
    let (mut includes, mut rows) = (String::new(), String::new());
    for (name, schema) in schemas(&all) {
        let own = name.replace('-', "_");
        for (path, entry) in c::files(&name, &schema, Role::Both).iter() {
            let text = String::from_utf8(entry.bytes.clone()).unwrap();
            let text = text.replace("sense_", &format!("{own}_"));
            let text = text.replace("SENSE_", &format!("{}_", own.to_ascii_uppercase()));
            std::fs::write(folder.join(path.replace("sense_", &format!("{own}_"))), text).unwrap();
        }
        writeln!(includes, "#include \"{own}_model.h\"").unwrap();
        writeln!(
            rows,
            "  {{\"{name}\", &{own}_schema, &{own}_reports, &{own}_commands, sizeof({own}_values_t)}},"
        )
        .unwrap();
    }
    let text = format!(
        "#include \"codecs.h\"\n{includes}\nconst test_codec_t test_codecs[] = {{\n{rows}}};\n\
         const size_t test_codecs_count = sizeof test_codecs / sizeof test_codecs[0];\n"
    );
    std::fs::write(folder.join("codecs.c"), text).unwrap();
}
