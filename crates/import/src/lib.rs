//! Pin data from other tools: their files go in as bytes, a board table or a `.sense` file comes
//! out as text, with a coded diagnostic for everything that was left out or doubtful.
//!
//! Nothing here does I/O: a source that names other files (the alternate functions of an MCU, an
//! included `hwdef`) requests them through [`Source::beside`].
//!
//! # Example
//!
//! ```
//! use sensedsl_import::{ReadError, Source, import};
//!
//! // A row for each pin and signal.
//! let made = import(&Source {
//!     name: "pins.csv",
//!     bytes: b"Pin;Signal;AF\nPA1;ADC1_IN1;\nPA1;TIM2_CH2;1\nGND;;\n",
//!     format: None,
//!     sheet: None,
//!     table: "pins.csv",
//!     beside: &|_| Err(ReadError::Missing),
//! });
//! assert_eq!(made.table.as_deref(), Some("Pin,ADC,TIM\nPA1,ADC1_IN1,TIM2_CH2@1\n"));
//! assert_eq!(made.diagnostics[0].code.name(), "W0804");
//! ```

mod arduino;
mod assemble;
mod betaflight;
mod cubemx;
mod dbc;
mod decode;
mod detect;
mod devices;
mod format;
mod hwdef;
mod includes;
mod ioc;
mod log;
mod micropython;
mod ods;
mod package;
mod place;
mod project;
mod source;
mod tabular;
mod workbook;
mod zephyr;

use sensedsl_diagnostics::{Diagnostic, Severity, SourceMap, Span};

pub use detect::detect;
pub use format::Format;
pub use sensedsl_model::ReadError;
pub use source::Source;

use log::Log;
use source::Texts;

/// The result of an import.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The board table as CSV; none if the source could not be read, or has no pins.
    pub table: Option<String>,
    /// The `.sense` file that goes with it, from the project of another tool.
    pub program: Option<String>,
    /// The diagnostics, in the order of the source.
    pub diagnostics: Vec<Diagnostic>,
    /// The texts that the diagnostics refer to. A sheet of a workbook is a separate text, with a
    /// line for each row.
    pub sources: SourceMap,
}

impl Imported {
    /// Whether the source could not be imported.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.diagnostics.iter().any(|one| one.severity == Severity::Error)
    }
}

/// Imports many sources of one folder, from any number of threads. Files that several of them refer
/// to are read only once.
#[derive(Debug, Default)]
pub struct Importer {
    cubemx: cubemx::Cache,
}

/// Imports a single source. Never fails: anything that cannot be read is in the diagnostics.
#[must_use]
pub fn import(source: &Source<'_>) -> Imported {
    Importer::default().import(source)
}

impl Importer {
    /// Imports a source. Never fails: anything that cannot be read is in the diagnostics.
    #[must_use]
    pub fn import(&self, source: &Source<'_>) -> Imported {
        self.import_for(source, None)
    }

    /// Like [`Self::import`]; from a DBC file, imports only what concerns `node`.
    #[must_use]
    pub fn import_for(&self, source: &Source<'_>, node: Option<&str>) -> Imported {
        let mut log = Log::default();
        let format = source.format.or_else(|| detect(source.bytes));
        let made = match format {
            None => unknown(source, &mut log),
            Some(Format::Xlsx | Format::Ods) => workbook::import(source, &mut log),
            Some(Format::Dbc) => {
                let (file, text) = log.text(source.name, source.bytes);
                dbc::import(file, source.name, &text, node, &mut log)
            }
            Some(_) if source.sheet.is_some() => no_sheets(source, &mut log),
            Some(Format::MicroPython) if micropython::is_list(&start(source.bytes)) => {
                micropython::import(source, &mut log)
            }
            Some(Format::Arduino) => arduino::import(source, &mut log),
            Some(Format::Zephyr) => zephyr::import(source, &mut log),
            Some(Format::Betaflight) => betaflight::import(source, &mut log),
            Some(Format::Csv | Format::MicroPython) => {
                let (file, text) = log.text(source.name, source.bytes);
                tabular::import(file, &text, None, &mut log)
            }
            Some(Format::CubeMx) => cubemx::import(source, &self.cubemx, &mut log),
            Some(Format::Ioc) => ioc::import(source, &mut log),
            Some(Format::Hwdef) => hwdef::import(source, &mut log),
        };
        let (sources, diagnostics) = log.finish();
        let mut imported =
            Imported { table: made.table, program: made.program, diagnostics, sources };
        if imported.failed() {
            (imported.table, imported.program) = (None, None);
        }
        imported
    }
}

/// The beginning of a file as text.
fn start(bytes: &[u8]) -> String {
    decode::decode(bytes.get(..detect::HEAD_BYTES).unwrap_or(bytes))
        .map_or(String::new(), |read| read.text)
}

fn unknown(source: &Source<'_>, log: &mut Log) -> Texts {
    let why = "it is not a table, nor a file of one of the tools that `sensedsl help import` lists";
    let file = log.sources.add(source.name, "");
    log.unreadable(Span::new(file, 0..0), source.name, why);
    Texts::default()
}

fn no_sheets(source: &Source<'_>, log: &mut Log) -> Texts {
    let file = log.sources.add(source.name, "");
    log.no_sheet(Span::new(file, 0..0), source.sheet.unwrap_or_default(), &[]);
    Texts::default()
}
