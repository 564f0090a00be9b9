//! Values as they are printed: lines, JSON, CSV, or a table of the latest ones.

use std::time::Duration;

use anyhow::Result;
use sensedsl_host::{Board, Device, Moment, News, What};
use sensedsl_record::text::{CSV_HEAD, object, rows};
use sensedsl_wire::{Direction, Scalar, Stamp};

use super::face::{Ask, Face};
use super::link::Link;
use super::words::{health, mark};
use crate::cli::{MonitorArgs, MonitorFormat};
use crate::commands::table::table;
use crate::terminal::Terminal;

/// The most characters of a value in the table; arrays can be longer.
const VALUE_CHARS: usize = 40;
/// The interval at which the table is refreshed.
const REFRESH: Duration = Duration::from_millis(200);

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
    /// The lines of the table that is on the screen.
    lines: usize,
    has_head: bool,
    refreshed: Duration,
}

impl<'a> Printer<'a> {
    pub(super) fn new(args: &MonitorArgs, terminal: &'a Terminal, format: MonitorFormat) -> Self {
        let (is_health_asked, refreshed) = (args.health.is_some(), Duration::ZERO);
        Self { terminal, format, is_health_asked, lines: 0, has_head: false, refreshed }
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

    /// The tables of all boards.
    fn tables(links: &[Link<'_>], now: Duration) -> String {
        links.iter().map(|link| board_table(link, now)).collect()
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
                self.lines = 0;
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
        // The next table begins below it.
        self.lines = 0;
        Ok(self.terminal.aside(text)?)
    }

    fn look(&mut self, now: Moment, links: &[Link<'_>]) -> Result<Vec<Ask>> {
        let is_time = now.run.saturating_sub(self.refreshed) >= REFRESH;
        if self.format == MonitorFormat::Table && self.terminal.is_watched() && is_time {
            self.refreshed = now.run;
            let text = Self::tables(links, now.run);
            let lines = fitting(&text, self.terminal.size());
            let up = if self.lines > 0 { format!("\x1b[{}A", self.lines) } else { String::new() };
            self.lines = lines.len();
            let lines: Vec<String> = lines.iter().map(|line| format!("{line}\x1b[K\n")).collect();
            self.terminal.result(&format!("{up}{}", lines.concat()))?;
        }
        Ok(Vec::new())
    }

    fn close(&mut self, now: Moment, links: &[Link<'_>]) -> Result<()> {
        if self.format == MonitorFormat::Table {
            let up =
                if self.lines > 0 { format!("\x1b[{}A\x1b[J", self.lines) } else { String::new() };
            self.terminal.result(&format!("{up}{}", Self::tables(links, now.run)))?;
        }
        Ok(())
    }
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
    let count = link.stats.get(index).map_or(0, |stats| stats.count()).to_string();
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

/// The lines of a text that fit a terminal, each cut to its width; the last one says how many are missing.
fn fitting(text: &str, size: Option<(usize, usize)>) -> Vec<String> {
    let all: Vec<&str> = text.lines().collect();
    let Some((columns, rows)) = size else { return all.into_iter().map(str::to_owned).collect() };
    let cut = |line: &str| line.chars().take(columns.saturating_sub(1)).collect::<String>();
    // The cursor is in the row below the table.
    let room = rows.saturating_sub(1).max(2);
    if all.len() <= room {
        return all.into_iter().map(cut).collect();
    }
    let mut lines: Vec<String> = all.iter().take(room - 1).map(|line| cut(line)).collect();
    let missing = all.len() - lines.len();
    lines.push(cut(&format!(
        "  and {missing} more: make the window higher, or use `--format lines`"
    )));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_stays_in_its_terminal() {
        let text = "head\nabcdef\nb\nc\n";
        assert_eq!(fitting(text, None), ["head", "abcdef", "b", "c"]);
        assert_eq!(fitting(text, Some((5, 5))), ["head", "abcd", "b", "c"]);
        let cut = fitting(text, Some((20, 4)));
        assert_eq!(cut, ["head", "abcdef", "  and 2 more: make "]);
        assert_eq!(fitting(text, Some((1, 1))).len(), 2);
    }
}
