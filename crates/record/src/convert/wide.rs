//! CSV with a row for each moment: what a spreadsheet plots without further ado.
//!
//! Values of one report stand in one row. A device that did not report then has an empty cell.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::Duration;

use sensedsl_host::Board;

use super::{Part, Sample, Writer};
use crate::text::{cell, number, shown};

/// The table that is written.
pub(super) struct Wide<W> {
    to: W,
    /// The first column of each device.
    columns: BTreeMap<(usize, usize), usize>,
    at: Option<Duration>,
    row: Vec<String>,
}

impl<W: Write> Wide<W> {
    pub(super) fn new(
        mut to: W,
        boards: &[Board],
        part: &Part,
        has_boards: bool,
    ) -> io::Result<Self> {
        let (mut columns, mut heads) = (BTreeMap::new(), vec!["time_s".to_owned()]);
        for (index, board) in boards.iter().enumerate() {
            let devices =
                board.devices.iter().enumerate().filter(|(_, device)| part.has(board, device));
            for (place, device) in devices {
                columns.insert((index, place), heads.len() - 1);
                let prefix = if has_boards { format!("{}/", board.name) } else { String::new() };
                let unit =
                    device.quantity.as_ref().map_or_else(String::new, |unit| format!(" ({unit})"));
                let name = format!("{prefix}{}", device.name);
                match device.value.length {
                    None => heads.push(cell(&format!("{name}{unit}"))),
                    Some(count) => heads.extend(
                        (0..count).map(|element| cell(&format!("{name}[{element}]{unit}"))),
                    ),
                }
            }
        }
        writeln!(to, "{}", heads.join(","))?;
        Ok(Self { to, columns, at: None, row: vec![String::new(); heads.len() - 1] })
    }

    fn end_row(&mut self) -> io::Result<()> {
        let Some(at) = self.at.take() else { return Ok(()) };
        writeln!(self.to, "{:.6},{}", at.as_secs_f64(), self.row.join(","))?;
        self.row.iter_mut().for_each(String::clear);
        Ok(())
    }
}

impl<W: Write> Writer for Wide<W> {
    fn take(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        let Some(column) = self.columns.get(&sample.place).copied() else { return Ok(()) };
        let run = sample.entry.at.run;
        let is_taken = self.row.get(column).is_some_and(|cell| !cell.is_empty());
        if self.at.is_some_and(|at| at != run) || is_taken {
            self.end_row()?;
        }
        self.at = Some(run);
        for (element, one) in sample.value.iter().enumerate() {
            if let Some(cell) = self.row.get_mut(column + element) {
                *cell = number(&shown(sample.device, *one));
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.end_row()?;
        self.to.flush()
    }
}
