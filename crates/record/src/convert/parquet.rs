//! Apache Parquet: what pandas, Polars, `DuckDB` and Spark read fastest.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, TimeUnit, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use sensedsl_wire::Scalar;

use super::{Sample, Writer};
use crate::read::Past;

/// Rows that are kept in memory until they are written together.
const ROWS_MAX: usize = 1 << 17;

/// The table that is written.
pub(super) struct Table<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    rows: Rows,
}

/// Columns of the rows that are not yet written; what is not always there has its own list of who has it.
#[derive(Default)]
struct Rows {
    time_ns: Vec<i64>,
    sampled_ns: Vec<i64>,
    run_s: Vec<f64>,
    boards: Vec<ByteArray>,
    devices: Vec<ByteArray>,
    elements: Vec<i32>,
    raw: Vec<i64>,
    has_raw: Vec<i16>,
    values: Vec<f64>,
    units: Vec<ByteArray>,
    has_unit: Vec<i16>,
}

fn column(
    name: &str,
    physical: Physical,
    logical: Option<LogicalType>,
    is_optional: bool,
) -> Result<Type, ParquetError> {
    let repetition = if is_optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
    Type::primitive_type_builder(name, physical)
        .with_repetition(repetition)
        .with_logical_type(logical)
        .build()
}

fn schema() -> Result<Type, ParquetError> {
    let time = || Some(LogicalType::timestamp(true, TimeUnit::NANOS));
    let text = || Some(LogicalType::String);
    let columns = [
        column("time", Physical::INT64, time(), false)?,
        column("sampled", Physical::INT64, time(), false)?,
        column("time_s", Physical::DOUBLE, None, false)?,
        column("board", Physical::BYTE_ARRAY, text(), false)?,
        column("device", Physical::BYTE_ARRAY, text(), false)?,
        column("element", Physical::INT32, None, false)?,
        column("raw", Physical::INT64, None, true)?,
        column("value", Physical::DOUBLE, None, false)?,
        column("unit", Physical::BYTE_ARRAY, text(), true)?,
    ];
    Type::group_type_builder("values")
        .with_fields(columns.into_iter().map(Arc::new).collect())
        .build()
}

fn failed(error: ParquetError) -> io::Error {
    io::Error::other(error)
}

impl<W: Write + Send> Table<W> {
    pub(super) fn new(to: W) -> io::Result<Self> {
        let schema = Arc::new(schema().map_err(failed)?);
        let created = concat!("sensedsl ", env!("CARGO_PKG_VERSION")).to_owned();
        let properties = Arc::new(WriterProperties::builder().set_created_by(created).build());
        let writer = SerializedFileWriter::new(to, schema, properties).map_err(failed)?;
        Ok(Self { writer, rows: Rows::default() })
    }

    fn write(&mut self) -> Result<(), ParquetError> {
        let rows = std::mem::take(&mut self.rows);
        if rows.values.is_empty() {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        put::<Int64Type, W>(&mut group, &rows.time_ns, None)?;
        put::<Int64Type, W>(&mut group, &rows.sampled_ns, None)?;
        put::<DoubleType, W>(&mut group, &rows.run_s, None)?;
        put::<ByteArrayType, W>(&mut group, &rows.boards, None)?;
        put::<ByteArrayType, W>(&mut group, &rows.devices, None)?;
        put::<Int32Type, W>(&mut group, &rows.elements, None)?;
        put::<Int64Type, W>(&mut group, &rows.raw, Some(&rows.has_raw))?;
        put::<DoubleType, W>(&mut group, &rows.values, None)?;
        put::<ByteArrayType, W>(&mut group, &rows.units, Some(&rows.has_unit))?;
        group.close()?;
        Ok(())
    }
}

fn put<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    who_has: Option<&[i16]>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else { return Ok(()) };
    column.typed::<T>().write_batch(values, who_has, None)?;
    column.close()
}

/// A raw number that fits; floating point numbers are shown as they are.
fn whole(raw: Scalar) -> Option<i64> {
    match raw {
        Scalar::Bool(flag) => Some(flag.into()),
        Scalar::Unsigned(number) => number.try_into().ok(),
        Scalar::Signed(number) => Some(number),
        Scalar::Float32(_) | Scalar::Float64(_) => None,
    }
}

impl<W: Write + Send> Writer for Table<W> {
    fn take(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        let at = sample.entry.at;
        let Past::Value { latency, .. } = &sample.entry.what else { return Ok(()) };
        let sampled = at.unix.saturating_sub(latency.unwrap_or_default());
        let ns = |time: std::time::Duration| i64::try_from(time.as_nanos()).unwrap_or(i64::MAX);
        for (element, one) in sample.value.iter().enumerate() {
            let rows = &mut self.rows;
            rows.time_ns.push(ns(at.unix));
            rows.sampled_ns.push(ns(sampled));
            rows.run_s.push(at.run.as_secs_f64());
            rows.boards.push(sample.board.name.as_str().into());
            rows.devices.push(sample.device.name.as_str().into());
            rows.elements.push(i32::try_from(element).unwrap_or(i32::MAX));
            let raw = whole(*one);
            rows.has_raw.push(raw.is_some().into());
            rows.raw.extend(raw);
            rows.values.push(sample.device.shown(*one));
            rows.has_unit.push(sample.device.quantity.is_some().into());
            rows.units.extend(sample.device.quantity.as_deref().map(ByteArray::from));
        }
        if self.rows.values.len() >= ROWS_MAX { self.write().map_err(failed) } else { Ok(()) }
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.write().map_err(failed)?;
        self.writer.close().map(drop).map_err(failed)
    }
}
