//! Opening a record, with what is said if it is none.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use sensedsl_diagnostics::codes::e0565_not_a_record::not_a_record;
use sensedsl_record::RecordReader;

use super::Refused;

/// A record that is read from its file.
pub(crate) type RecordFile = RecordReader<BufReader<File>>;

/// Opens a record.
///
/// # Errors
/// Fails if the file cannot be read, or is no record.
pub(crate) fn open_record(path: &Path) -> Result<RecordFile, Refused> {
    let file = File::open(path).map_err(|error| no_record(path, &error.to_string()))?;
    RecordReader::new(BufReader::new(file)).map_err(|error| no_record(path, &error.to_string()))
}

/// What is said of a file that cannot be read as a record, or not any further.
pub(crate) fn no_record(path: &Path, why: &str) -> Refused {
    Refused::new(path, |at, shown| not_a_record(at, shown, why))
}
