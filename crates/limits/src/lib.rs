//! Limits on how much is read. Every budget is defined here, and [`ALL`] states for each what it
//! counts and which diagnostic reports that it is exceeded; `docs/limits.md` is made from it.
//!
//! The figures are far above what a real project needs and low enough that any input, however
//! hostile, is refused within a second and 200 MB. `sensedsl-verify` has limits of its own, since
//! it depends on no crate of the workspace.
//!
//! # Example
//!
//! ```
//! use sensedsl_limits::{ALL, PINS_MAX};
//!
//! let pins = ALL.iter().find(|one| one.name == "PINS_MAX").unwrap();
//! assert_eq!((pins.of, pins.most, pins.code), ("pins of a table", PINS_MAX, "E0317"));
//! ```

/// Bytes of one `.sense` text.
pub const SENSE_BYTES_MAX: usize = 4 << 20;
/// Bytes of one board table.
pub const TABLE_BYTES_MAX: usize = 4 << 20;
/// Bytes of one source of `import`: a workbook, XML or text.
pub const SOURCE_BYTES_MAX: usize = 16 << 20;
/// Bytes of one text that `import` reads: CSV, XML, `.ioc`, `hwdef`.
pub const SOURCE_TEXT_BYTES_MAX: usize = 4 << 20;
/// Bytes of one earlier answer (`--keep`, `diff`).
pub const ANSWER_BYTES_MAX: usize = 2 << 20;
/// Bytes of a world for `simulate`, and of a file with samples.
pub const WORLD_BYTES_MAX: usize = 4 << 20;
/// Tables and lists of a world, including nested ones.
pub const WORLD_TABLES_MAX: usize = 20_000;
/// Bytes of one chunk of a record, and of any other part of one.
pub const RECORD_PART_BYTES_MAX: usize = 64 << 20;
/// Bytes of an image of firmware for `simulate`.
pub const IMAGE_BYTES_MAX: usize = 16 << 20;
/// Bytes of a configuration of `monitor`.
pub const CONFIG_BYTES_MAX: usize = 256 << 10;
/// Tables and lists of a configuration of `monitor`, including nested ones.
pub const CONFIG_TABLES_MAX: usize = 2_000;
/// Bytes of one message that another program sends to `monitor`.
pub const MESSAGE_BYTES_MAX: usize = 64 << 10;
/// Programs that are connected to `monitor` at a time, for each way of connecting.
pub const CLIENTS_MAX: usize = 32;
/// Bytes of all files that one call reads.
pub const TOTAL_BYTES_MAX: usize = 32 << 20;

/// Tokens of a design, over all its files: words, numbers, signs, spaces and comments.
pub const TOKENS_MAX: usize = 500_000;
/// Mistakes that are listed for one design; the others are counted.
pub const DIAGNOSTICS_MAX: usize = 1_000;
/// Characters of one sentence of a diagnostic; what it quotes is cut.
pub const SENTENCE_CHARS_MAX: usize = 600;
/// Files that a design uses, directly or through others.
pub const USED_FILES_MAX: usize = 1_000;
/// Files that use each other in a chain.
pub const USE_DEPTH_MAX: usize = 64;
/// Boards, drivers and devices of a design, all together; identifiers go up to 254.
pub const ITEMS_MAX: usize = 2_000;
/// Sets of wires of a design, each with the rules for it: an array has one for each element.
pub const WIRES_MAX: usize = 16_000;
/// Readings and commands of one driver.
pub const DRIVER_VALUES_MAX: usize = 254;
/// Numbers, words and letters that constants bring into one value.
pub const CONSTANT_PARTS_MAX: usize = 4_096;
/// Letters of one text.
pub const TEXT_BYTES_MAX: usize = 4_096;
/// Properties and rules of a design, all together; a rule for several pins counts for each.
pub const STATEMENTS_MAX: usize = 8_000;

/// Cells of a table.
pub const CELLS_MAX: usize = 400_000;
/// Rows of a table. A long table has one for each pin and signal.
pub const ROWS_MAX: usize = 50_000;
/// Lines `# key = value` of a table.
pub const TABLE_PROPERTIES_MAX: usize = 256;
/// Columns of a table.
pub const COLUMNS_MAX: usize = 512;
/// Pins of a table.
pub const PINS_MAX: usize = 2_048;
/// Usages of one pin.
pub const PIN_USAGES_MAX: usize = 1_000;
/// Usages of all pins of a table.
pub const USAGES_MAX: usize = 100_000;
/// Boards of a design.
pub const BOARDS_MAX: usize = 254;
/// Pins and usages of all boards of a design.
pub const PLACES_MAX: usize = 300_000;
/// Bytes of the tables of all boards of a design, counted for each board that has the table.
pub const TABLES_BYTES_MAX: usize = 16 << 20;

/// Files in a workbook.
pub const MEMBERS_MAX: usize = 1_000;
/// Sheets of a workbook, which may all name one file in it.
pub const SHEETS_MAX: usize = 256;
/// Bytes of a workbook after decompression.
pub const INFLATED_BYTES_MAX: usize = 32 << 20;
/// Elements of XML in a workbook.
pub const XML_ELEMENTS_MAX: usize = 1_000_000;
/// Elements of a description of an MCU, of which a tree is made.
pub const XML_NODES_MAX: usize = 200_000;
/// Attributes of one element.
pub const XML_ATTRIBUTES_MAX: usize = 256;
/// Elements inside each other.
pub const XML_DEPTH_MAX: usize = 64;
/// Namespaces of an XML file.
pub const XML_NAMESPACES_MAX: usize = 256;
/// Bytes of text and formulas in the cells of a workbook, repetitions counted.
pub const CELL_TEXT_BYTES_MAX: usize = 8 << 20;
/// Merged ranges of a workbook.
pub const MERGED_MAX: usize = 10_000;
/// Files that an `hwdef.dat` includes, directly or through others.
pub const INCLUDES_MAX: usize = 64;
/// Files of `hwdef` that include each other in a chain.
pub const INCLUDE_DEPTH_MAX: usize = 8;

/// Lines of all files of an `hwdef`.
pub const HWDEF_LINES_MAX: usize = 50_000;
/// MCUs that all files of an `hwdef` name; a board has one, and an included file may name another.
pub const HWDEF_MCUS_MAX: usize = 4;
/// Nodes, messages, signals, receivers and words for values of a DBC file, all together.
pub const DBC_PARTS_MAX: usize = 200_000;

/// A budget as the documentation shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// The constant.
    pub name: &'static str,
    /// The most that is read.
    pub most: usize,
    /// What is counted.
    pub of: &'static str,
    /// The diagnostic that reports that there is more.
    pub code: &'static str,
}

macro_rules! limits {
    ($($name:ident: $of:literal, $code:literal;)*) => {
        /// All budgets, in the order of the documentation.
        pub const ALL: &[Limit] = &[$(Limit {
            name: stringify!($name), most: $name, of: $of, code: $code,
        }),*];
    };
}

limits! {
    SENSE_BYTES_MAX: "bytes of one `.sense` file", "E0112";
    TABLE_BYTES_MAX: "bytes of one board table", "E0112";
    SOURCE_BYTES_MAX: "bytes of one source of `import`", "E0112";
    SOURCE_TEXT_BYTES_MAX: "bytes of a source of `import` that is text or XML", "E0807";
    ANSWER_BYTES_MAX: "bytes of an answer for `--keep` or `diff`", "E0112";
    RECORD_PART_BYTES_MAX: "bytes of a chunk of a record", "E0565";
    WORLD_BYTES_MAX: "bytes of a world for `simulate`, and of a file with samples", "E0112";
    WORLD_TABLES_MAX: "tables and lists of a world, those in others included", "E0551";
    IMAGE_BYTES_MAX: "bytes of an image of firmware for `simulate`", "E0112";
    CONFIG_BYTES_MAX: "bytes of a configuration of `monitor`", "E0112";
    CONFIG_TABLES_MAX: "tables and lists of a configuration of `monitor`", "E0560";
    TOTAL_BYTES_MAX: "bytes of all files that one call reads", "E0112";
    TOKENS_MAX: "words, numbers, signs, spaces and comments of a design", "E0116";
    DIAGNOSTICS_MAX: "mistakes that are listed", "E0117";
    USED_FILES_MAX: "files that a design uses", "E0224";
    USE_DEPTH_MAX: "files that use each other in a chain", "E0224";
    ITEMS_MAX: "boards, drivers, chips and devices of a design; also devices, those that chips have by themselves included", "E0225";
    STATEMENTS_MAX: "properties, rules and constants of a design", "E0225";
    WIRES_MAX: "sets of wires of a design, with the rules for each", "E0225";
    DRIVER_VALUES_MAX: "readings and commands of a driver", "E0229";
    CONSTANT_PARTS_MAX: "numbers, words and letters that constants bring into one value", "E0227";
    TEXT_BYTES_MAX: "letters of one text", "E0211";
    BOARDS_MAX: "boards of a design", "E0225";
    PLACES_MAX: "pins and usages of all boards of a design", "E0225";
    TABLES_BYTES_MAX: "bytes of the tables of all boards of a design", "E0225";
    CELLS_MAX: "cells of a table", "E0317";
    ROWS_MAX: "rows of a table", "E0317";
    TABLE_PROPERTIES_MAX: "lines `# key = value` of a table", "E0317";
    COLUMNS_MAX: "columns of a table", "E0317";
    PINS_MAX: "pins of a table", "E0317";
    PIN_USAGES_MAX: "usages of one pin", "E0317";
    USAGES_MAX: "usages of all pins of a table", "E0317";
    MEMBERS_MAX: "files in a workbook", "E0807";
    SHEETS_MAX: "sheets of a workbook", "E0807";
    INFLATED_BYTES_MAX: "bytes of a workbook after decompression", "E0807";
    XML_ELEMENTS_MAX: "elements of XML in a workbook", "E0807";
    XML_NODES_MAX: "elements of XML in the description of an MCU", "E0807";
    XML_ATTRIBUTES_MAX: "attributes of one element", "E0807";
    XML_DEPTH_MAX: "elements of XML inside each other", "E0807";
    XML_NAMESPACES_MAX: "namespaces of an XML file", "E0807";
    CELL_TEXT_BYTES_MAX: "bytes of text and formulas in the cells of a workbook", "E0807";
    MERGED_MAX: "merged ranges of a workbook", "E0807";
    INCLUDES_MAX: "files that an `hwdef.dat` includes", "E0808";
    INCLUDE_DEPTH_MAX: "files of `hwdef` that include each other in a chain", "E0808";
    HWDEF_LINES_MAX: "lines of all files of an `hwdef`", "E0807";
    HWDEF_MCUS_MAX: "MCUs that all files of an `hwdef` name", "E0807";
    DBC_PARTS_MAX: "nodes, messages, signals, receivers and words for values of a DBC file", "E0807";
}
