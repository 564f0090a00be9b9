//! Values as they are printed: lines, JSON, CSV, or a table of the latest ones.

use std::time::Duration;

use anyhow::Result;
use sensedsl_host::{Board, Device, DeviceStats, Moment, News, What};
use sensedsl_record::text::{CSV_HEAD, object, rows};
use sensedsl_wire::{Direction, Scalar, Stamp};

use super::face::{Ask, Face};
use super::link::Link;
use super::words::{health, mark};
use crate::cli::{MonitorArgs, MonitorFormat};
use crate::terminal::Terminal;
use sensedsl_report::columns::table;

/// The most characters of a value in the table; arrays can be longer.
const VALUE_CHARS: usize = 40;

/// How values are shown.
pub(super) fn format(args: &MonitorArgs, terminal: &Terminal) -> MonitorFormat {
    let usual = if terminal.is_watched() { MonitorFormat::Table } else { MonitorFormat::Lines };
    args.format.unwrap_or(usual)
}

/// Prints values as they come.
pub(super) struct Printer<'a> {
    terminal: &'a Terminal,
    format: MonitorFormat,
    is_health_asked: bool,
    has_head: bool,
    is_closed: bool,
}

impl<'a> Printer<'a> {
    pub(super) fn new(args: &MonitorArgs, terminal: &'a Terminal, format: MonitorFormat) -> Self {
        let is_health_asked = args.health.is_some();
        Self { terminal, format, is_health_asked, has_head: false, is_closed: false }
    }

    fn value(
        &mut self,
        (board, prefix): (&Board, &str),
        at: Moment,
        (index, value): (usize, &[Scalar]),
        stamp: Option<Stamp>,
    ) -> String {
        let Some(device) = board.devices.get(index) else { return String::new() };
        match self.format {
            MonitorFormat::Table => String::new(),
            MonitorFormat::Lines => format!(
                "{:9.3} s  {prefix}{} = {}{}\n",
                at.run.as_secs_f64(),
                device.name,
                device.text(value),
                mark(device, value)
            ),
            MonitorFormat::Ndjson => format!("{}\n", object(board, device, at.run, value, stamp)),
            MonitorFormat::Csv => {
                let head = if self.has_head { "" } else { CSV_HEAD };
                self.has_head = true;
                format!("{head}{}", rows(device, prefix, at.run, value))
            }
        }
    }
}

impl Face for Printer<'_> {
    fn take(&mut self, news: &News<'_>, links: &[Link<'_>]) -> Result<()> {
        let Some(link) = links.get(news.board) else { return Ok(()) };
        match news.what {
            What::Report(report) => {
                // Several boards may have devices of one name.
                let prefix =
                    if links.len() > 1 { format!("{}/", link.board.name) } else { String::new() };
                let values = report.values.iter();
                let printed = values.map(|(index, value)| {
                    let of = (link.board, prefix.as_str());
                    self.value(of, news.at, (*index, value.as_slice()), report.stamp)
                });
                let printed: String = printed.collect();
                if !printed.is_empty() {
                    self.terminal.result(&printed)?;
                }
            }
            What::Health(told) if self.is_health_asked => {
                for line in health(link.board, told).lines() {
                    self.terminal.aside(line)?;
                }
            }
            What::Health(_)
            | What::Received(_)
            | What::Sent(_)
            | What::Online
            | What::Offline(_)
            | What::Command { .. } => {}
        }
        Ok(())
    }

    fn say(&mut self, text: &str) -> Result<()> {
        Ok(self.terminal.aside(text)?)
    }

    fn look(&mut self, _: Moment, _: &[Link<'_>]) -> Result<Vec<Ask>> {
        Ok(Vec::new())
    }

    fn close(&mut self, now: Moment, links: &[Link<'_>]) -> Result<()> {
        if self.format == MonitorFormat::Table && !self.is_closed {
            self.is_closed = true;
            self.terminal.result(&tables(links, now.run))?;
        }
        Ok(())
    }
}

/// The tables of all boards.
pub(super) fn tables(links: &[Link<'_>], now: Duration) -> String {
    links.iter().map(|link| board_table(link, now)).collect()
}

fn board_table(link: &Link<'_>, now: Duration) -> String {
    let all = link.board.devices.iter().enumerate();
    let rows: Vec<[String; 5]> =
        all.map(|(index, device)| cells(link, index, device, now)).collect();
    let counts = link.counts();
    let lost = if link.board.schema.stamp {
        format!(", {} reports lost", counts.lost)
    } else {
        String::new()
    };
    let head = format!(
        "{} for {:.0} s: {} frames, {} bytes dropped{lost}\n",
        link.board.name,
        now.as_secs_f64(),
        counts.frames,
        counts.dropped_bytes
    );
    format!("{head}{}", table(["Device", ">Value", ">Age", ">Values", ""], &rows))
}

fn cells(link: &Link<'_>, index: usize, device: &Device, now: Duration) -> [String; 5] {
    let count = link.stats.get(index).map_or(0, DeviceStats::count).to_string();
    let Some((at, value)) = link.latest.get(index).and_then(Option::as_ref) else {
        let none = match device.direction {
            Direction::Sensor => "-",
            Direction::Actuator => "not set",
        };
        return [device.name.clone(), none.to_owned(), String::new(), count, String::new()];
    };
    let mut shown = device.brief(value);
    if shown.chars().count() > VALUE_CHARS {
        shown = shown.chars().take(VALUE_CHARS - 2).chain([' ', '…']).collect();
    }
    let age = now.saturating_sub(*at).as_millis();
    let is_overdue = device.direction == Direction::Sensor && link.session.is_overdue(index, now);
    let mut marks = mark(device, value).trim().to_owned();
    if is_overdue {
        marks = format!("{marks} overdue").trim().to_owned();
    }
    [device.name.clone(), shown, format!("{age} ms"), count, marks]
}
