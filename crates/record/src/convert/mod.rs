//! A record in other forms: CSV, with a row a value or a row a moment; NDJSON; Parquet.
//!
//! In: a [`RecordReader`], a choice of boards, devices and times. Out: bytes, as they are ready. All forms have the
//! time since the run began, the raw value and what is shown; those for programs also the times of the clock.

mod parquet;
mod wide;

use std::collections::BTreeSet;
use std::io::{self, Read, Write};
use std::time::Duration;

use sensedsl_host::{Board, Device};
use sensedsl_wire::Scalar;

use crate::read::{Ending, Entry, Past, RecordError, RecordReader};
use crate::text::{CSV_HEAD, object, rows};

/// The form of a converted record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A row for each element of each value, as `monitor --format csv` prints it.
    Csv,
    /// A row for each moment, a column for each device.
    WideCsv,
    /// An object for each value, as `monitor --format ndjson` prints it.
    Ndjson,
    /// A table in the format of Apache Parquet, with a row for each element of each value.
    Parquet,
}

/// Which part of a record.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// The board of that name alone.
    pub board: Option<String>,
    /// These devices alone; all, if there are none.
    pub devices: Vec<String>,
    /// From that time of the run on.
    pub from: Option<Duration>,
    /// Before that time of the run.
    pub until: Option<Duration>,
}

/// Why a record is not converted.
#[derive(Debug)]
pub enum ConvertError {
    /// It cannot be read.
    Read(RecordError),
    /// What came of it cannot be written.
    Write(io::Error),
    /// It has no board or device of that name; what it has.
    Name(String, Vec<String>),
}

/// What was converted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Converted {
    /// How many values.
    pub values: u64,
    /// How the record ended.
    pub ending: Ending,
}

/// A value with all that is known of it.
struct Sample<'a> {
    board: &'a Board,
    device: &'a Device,
    place: (usize, usize),
    entry: &'a Entry,
    value: &'a [Scalar],
}

/// Writes samples in a form.
trait Writer {
    fn take(&mut self, sample: &Sample<'_>) -> io::Result<()>;
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// Converts a part of a record.
///
/// # Errors
/// Fails if the record cannot be read, the result cannot be written, or a name is not in the record. What was written
/// until then is not whole.
pub fn convert<R: Read>(
    mut reader: RecordReader<R>,
    form: Form,
    part: &Part,
    to: impl Write + Send + 'static,
) -> Result<Converted, ConvertError> {
    let boards = reader.boards().to_vec();
    check_names(&boards, part)?;
    let is_one = boards.len() == 1 || part.board.is_some();
    let writer: Result<Box<dyn Writer>, io::Error> = match form {
        Form::Csv => Rows::new(to, !is_one).map(|rows| Box::new(rows) as _),
        Form::Ndjson => Ok(Box::new(Objects(to))),
        Form::WideCsv => {
            wide::Wide::new(to, &boards, part, !is_one).map(|wide| Box::new(wide) as _)
        }
        Form::Parquet => parquet::Table::new(to).map(|table| Box::new(table) as _),
    };
    let mut writer = writer.map_err(ConvertError::Write)?;
    let mut values = 0;
    while let Some(entry) = reader.next_entry().map_err(ConvertError::Read)? {
        if part.until.is_some_and(|until| entry.at.run >= until) {
            break;
        }
        let Past::Value { device, value, .. } = &entry.what else { continue };
        let place = (entry.board, *device);
        let Some(board) = boards.get(place.0) else { continue };
        let Some(device) = board.devices.get(place.1) else { continue };
        if !part.has(board, device) || part.from.is_some_and(|from| entry.at.run < from) {
            continue;
        }
        values += 1;
        writer
            .take(&Sample { board, device, place, entry: &entry, value })
            .map_err(ConvertError::Write)?;
    }
    writer.finish().map_err(ConvertError::Write)?;
    Ok(Converted { values, ending: reader.ending().unwrap_or(Ending::Whole) })
}

impl Part {
    fn has(&self, board: &Board, device: &Device) -> bool {
        let is_board = self.board.as_ref().is_none_or(|name| *name == board.name);
        is_board && (self.devices.is_empty() || self.devices.contains(&device.name))
    }
}

pub(crate) fn check_names(boards: &[Board], part: &Part) -> Result<(), ConvertError> {
    if let Some(name) = &part.board
        && !boards.iter().any(|board| board.name == *name)
    {
        let all = boards.iter().map(|board| board.name.clone()).collect();
        return Err(ConvertError::Name(name.clone(), all));
    }
    let wanted = |board: &&Board| part.board.as_ref().is_none_or(|name| board.name == *name);
    let all: BTreeSet<&str> = boards
        .iter()
        .filter(wanted)
        .flat_map(|board| &board.devices)
        .map(|device| device.name.as_str())
        .collect();
    match part.devices.iter().find(|name| !all.contains(name.as_str())) {
        Some(name) => {
            Err(ConvertError::Name(name.clone(), all.into_iter().map(str::to_owned).collect()))
        }
        None => Ok(()),
    }
}

/// A row an element.
struct Rows<W> {
    to: W,
    has_boards: bool,
}

impl<W: Write> Rows<W> {
    fn new(mut to: W, has_boards: bool) -> io::Result<Self> {
        to.write_all(CSV_HEAD.as_bytes())?;
        Ok(Self { to, has_boards })
    }
}

impl<W: Write> Writer for Rows<W> {
    fn take(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        let prefix =
            if self.has_boards { format!("{}/", sample.board.name) } else { String::new() };
        self.to
            .write_all(rows(sample.device, &prefix, sample.entry.at.run, sample.value).as_bytes())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.to.flush()
    }
}

/// An object a value.
struct Objects<W>(W);

impl<W: Write> Writer for Objects<W> {
    fn take(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        let Past::Value { stamp, .. } = &sample.entry.what else { return Ok(()) };
        let object = object(sample.board, sample.device, sample.entry.at.run, sample.value, *stamp);
        writeln!(self.0, "{object}")
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.0.flush()
    }
}
