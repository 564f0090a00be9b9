//! The table of the devices: which columns fit, and what is in their cells.
//!
//! In: links, the state, and an area. Out: rows in a buffer. What tells most stays longest in a narrow window.

use std::collections::BTreeMap;
use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::Modifier;
use sensedsl_diagnostics::visible;
use sensedsl_host::{DeviceStats, Overstep, causes, status};
use sensedsl_wire::{Direction, Status};

use super::super::link::Link;
use super::state::{Item, State};
use super::style::{Look, Tone};
use super::traces::micros;
use super::words::{age, cut, number, put, rate, short, short_value, width};

/// The columns before the names: the letter in the plots, and an arrow for actuators.
const MARKS: usize = 3;
/// The most columns of a name, of a value, of what is wrong, and of a trend.
const NAME_MAX: usize = 28;
const VALUE_MAX: usize = 30;
const STATE_MAX: usize = 30;
const TREND_MAX: usize = 30;
/// A trend has at least as many.
const TREND_MIN: usize = 10;
/// What each column of a trend is of.
const TREND_US: u64 = 1_000_000;
const LEVELS: [&str; 8] = ["▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"];
/// The same where there are no bars.
const PLAIN_LEVELS: [&str; 8] = ["_", ".", "-", "=", "+", "*", "#", "@"];

/// What a column tells. They stand in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Column {
    Device,
    Value,
    Trend,
    Age,
    Rate,
    Jitter,
    Latency,
    Range,
    Missing,
    State,
}

/// The most important ones first.
const ORDER: [Column; 10] = [
    Column::Device,
    Column::Value,
    Column::State,
    Column::Age,
    Column::Rate,
    Column::Trend,
    Column::Missing,
    Column::Range,
    Column::Jitter,
    Column::Latency,
];

impl Column {
    fn head(self) -> &'static str {
        match self {
            Self::Device => "Device",
            Self::Value => "Value",
            Self::Trend => "Trend",
            Self::Age => "Age",
            Self::Rate => "Rate",
            Self::Jitter => "Jitter",
            Self::Latency => "Latency",
            Self::Range => "Range",
            Self::Missing => "Missing",
            Self::State => "State",
        }
    }

    fn is_right(self) -> bool {
        !matches!(self, Self::Device | Self::Trend | Self::State)
    }

    /// The least and the most columns that it takes.
    fn bounds(self) -> (usize, usize) {
        match self {
            Self::Device => (6, NAME_MAX),
            Self::Value => (5, VALUE_MAX),
            Self::Trend => (TREND_MIN, TREND_MIN),
            Self::Age | Self::Rate | Self::Jitter | Self::Latency => (7, 9),
            Self::Range => (11, 32),
            Self::Missing => (7, 9),
            Self::State => (7, STATE_MAX),
        }
    }
}

/// What is in a cell, and what that is.
type Cell = (String, Tone);

/// Draws the head and the rows that are seen.
pub(super) fn draw(
    buffer: &mut Buffer,
    area: Rect,
    state: &mut State<'_>,
    links: &[Link<'_>],
    (now, look): (Duration, Look),
) {
    if area.is_empty() {
        return;
    }
    let page = usize::from(area.height - 1).max(1);
    state.scroll(page);
    let seen: Vec<usize> = state.shown.iter().skip(state.top).take(page).copied().collect();
    // A long array is no reason to leave out everything else.
    let room = (usize::from(area.width) * 2 / 7).clamp(Column::Value.bounds().0, VALUE_MAX);
    let rows: Vec<BTreeMap<Column, Cell>> =
        seen.iter().map(|place| cells(state, *place, links, (now, room))).collect();
    let columns = fit(&widths(state, &rows), usize::from(area.width));
    head(buffer, area, &columns, state, look);
    for (row, (place, cells)) in (area.y + 1..area.bottom()).zip(seen.iter().zip(&rows)) {
        draw_row(
            buffer,
            Rect { y: row, height: 1, ..area },
            &columns,
            (*place, cells),
            (state, look),
        );
    }
    if seen.is_empty() {
        let text = format!("no device has `{}` in its name; Esc shows all", state.filter);
        let _ = put(buffer, area, (area.x + 2, area.y + 1), &text, look.of(Tone::Faint));
    }
}

fn head(
    buffer: &mut Buffer,
    area: Rect,
    columns: &[(Column, usize)],
    state: &State<'_>,
    look: Look,
) {
    let style = look.of(Tone::Head);
    let mut x = MARKS;
    for (column, wide) in columns {
        let mut text = column.head().to_owned();
        if *column == Column::Device && (state.top > 0 || state.shown.len() > state.page) {
            let end = (state.top + state.page).min(state.shown.len());
            let seen = format!("{}-{end}/{}", state.top + 1, state.shown.len());
            let both = format!("{text} {seen}");
            text = if width(&both) <= *wide { both } else { seen };
        }
        if *column == Column::Trend && *wide > 14 {
            text = format!("{text} of {wide} s");
        }
        cell(buffer, Rect { height: 1, ..area }, (x, *column, *wide), &text, style);
        x += wide + 1;
    }
}

/// Writes a text to its side of a column.
fn cell(
    buffer: &mut Buffer,
    area: Rect,
    (x, column, wide): (usize, Column, usize),
    text: &str,
    style: ratatui_core::style::Style,
) {
    let text = cut(text, wide);
    let before = if column.is_right() { wide.saturating_sub(width(&text)) } else { 0 };
    let x = u16::try_from(x + before).unwrap_or(u16::MAX);
    let _ = put(buffer, area, (area.x.saturating_add(x), area.y), &text, style);
}

fn draw_row(
    buffer: &mut Buffer,
    area: Rect,
    columns: &[(Column, usize)],
    (place, cells): (usize, &BTreeMap<Column, Cell>),
    (state, look): (&State<'_>, Look),
) {
    let Some(item) = state.items.get(place) else { return };
    let is_chosen = state.shown.get(state.chosen) == Some(&place);
    if let Some(line) = state.plotted.iter().position(|one| *one == place) {
        let style = look.of(Tone::Line(line)).add_modifier(Modifier::BOLD);
        let _ = put(buffer, area, (area.x, area.y), &letter(line), style);
    }
    if item.device.direction == Direction::Actuator {
        let _ = put(buffer, area, (area.x + 1, area.y), "›", look.of(Tone::Actuator));
    }
    let mut x = MARKS;
    for (column, wide) in columns {
        let (text, tone) = if *column == Column::Trend {
            let slider = slider(state, place, *wide, look).map(|text| (text, Tone::Actuator));
            slider.unwrap_or_else(|| (trend(state, item, *wide, look), Tone::Plain))
        } else {
            cells.get(column).cloned().unwrap_or((String::new(), Tone::Plain))
        };
        cell(buffer, area, (x, *column, *wide), &text, look.of(tone));
        x += wide + 1;
    }
    if is_chosen {
        buffer.set_style(area, ratatui_core::style::Style::new().add_modifier(Modifier::REVERSED));
    }
}

/// The letter of a line in the plots.
pub(super) fn letter(line: usize) -> String {
    char::from(b'a' + u8::try_from(line % 26).unwrap_or_default()).to_string()
}

fn cells(
    state: &State<'_>,
    place: usize,
    links: &[Link<'_>],
    (now, room): (Duration, usize),
) -> BTreeMap<Column, Cell> {
    let mut cells = BTreeMap::new();
    let Some(item) = state.items.get(place) else { return cells };
    let Some(link) = links.get(item.board) else { return cells };
    let is_sensor = item.device.direction == Direction::Sensor;
    let name_tone = if is_sensor { Tone::Plain } else { Tone::Actuator };
    let _ = cells.insert(Column::Device, (visible(&item.name).into_owned(), name_tone));
    let is_there = state.is_there(item.board);
    let latest = link.latest.get(item.index).and_then(Option::as_ref);
    let value = match latest {
        Some((_, value)) => {
            let shown = visible(&short_value(item.device, value, room)).into_owned();
            (shown, if is_there || !is_sensor { Tone::Plain } else { Tone::Faint })
        }
        None => ((if is_sensor { "-" } else { "not set" }).to_owned(), Tone::Faint),
    };
    let _ = cells.insert(Column::Value, value);
    if let Some((at, _)) = latest {
        let _ = cells.insert(Column::Age, (age(now.saturating_sub(*at)), Tone::Plain));
    }
    if let Some(stats) = link.stats.get(item.index).filter(|_| is_sensor) {
        times(&mut cells, stats, now);
    }
    if let Some((least, most)) = state.extremes(place) {
        let text = format!("{} … {}", number(item.device, least), number(item.device, most));
        let _ = cells.insert(Column::Range, (text, Tone::Plain));
    }
    let _ = cells.insert(Column::State, condition(item, link, is_there, now));
    cells
}

/// How regularly the values come.
fn times(cells: &mut BTreeMap<Column, Cell>, stats: &DeviceStats, now: Duration) {
    if let Some(hz) = stats.rate_hz(now) {
        let _ = cells.insert(Column::Rate, (rate(hz), Tone::Plain));
    }
    if let Some(jitter) = stats.intervals().deviation() {
        let _ = cells.insert(Column::Jitter, (short(jitter), Tone::Plain));
    }
    if let Some(latency) = stats.latencies().quantile(0.5) {
        let _ = cells.insert(Column::Latency, (short(latency), Tone::Plain));
    }
    let missing = stats.missing();
    let tone = if missing > 0 { Tone::Warning } else { Tone::Faint };
    if stats.count() > 0 {
        let _ = cells.insert(Column::Missing, (missing.to_string(), tone));
    }
}

/// What is wrong with a device: what counts now comes first.
fn condition(item: &Item<'_>, link: &Link<'_>, is_there: bool, now: Duration) -> Cell {
    let is_sensor = item.device.direction == Direction::Sensor;
    if is_there && is_sensor && !link.is_over && link.session.is_overdue(item.index, now) {
        return ("overdue".to_owned(), Tone::Bad);
    }
    let health = link
        .health
        .as_ref()
        .and_then(|health| health.devices.iter().find(|one| one.id == item.device.id));
    let why = health.map(|one| causes(one.causes.counts())).unwrap_or_default();
    if let Some(one) =
        health.filter(|one| matches!(one.status, Status::Failed | Status::Stale | Status::Invalid))
    {
        let text = status(one.status);
        let text = if why.is_empty() { text.to_owned() } else { format!("{text}: {why}") };
        return (text, Tone::Bad);
    }
    let value = link.latest.get(item.index).and_then(Option::as_ref);
    match value.and_then(|(_, value)| item.device.overstep(value)) {
        Some(Overstep::Below(least)) => return (format!("below {least}"), Tone::Warning),
        Some(Overstep::Above(most)) => return (format!("above {most}"), Tone::Warning),
        None => {}
    }
    if !why.is_empty() {
        return (why, Tone::Warning);
    }
    match health.map(|one| one.status) {
        Some(Status::Good) => ("good".to_owned(), Tone::Good),
        // What nobody has set is not worth a word.
        Some(Status::NeverRead) if !is_sensor => (String::new(), Tone::Plain),
        Some(other) => (status(other).to_owned(), Tone::Faint),
        None => (String::new(), Tone::Plain),
    }
}

/// The columns that cells have taken so far.
fn widths(state: &mut State<'_>, rows: &[BTreeMap<Column, Cell>]) -> BTreeMap<Column, usize> {
    for row in rows {
        for (column, (text, _)) in row {
            let (least, most) = column.bounds();
            let wide = state.widths.entry(*column).or_insert(least);
            *wide = (*wide).max(width(text).min(most));
        }
    }
    let mut widths = state.widths.clone();
    let _ = widths.insert(Column::Trend, TREND_MIN);
    widths
}

/// The columns that fit a window, with their widths; what is left over goes to the trend.
fn fit(widths: &BTreeMap<Column, usize>, window: usize) -> Vec<(Column, usize)> {
    let mut left = window.saturating_sub(MARKS);
    let mut columns: Vec<(Column, usize)> = Vec::new();
    for column in ORDER {
        let Some(wide) = widths.get(&column) else { continue };
        // Of the first two something is seen in any window.
        let most = if column == Column::Device { left / 2 } else { left };
        let is_first = column <= Column::Value;
        let wide = if is_first { (*wide).min(most) } else { *wide };
        if wide > 0 && wide <= left {
            columns.push((column, wide));
            left = left.saturating_sub(wide + 1);
        }
    }
    columns.sort_unstable();
    let more = left.saturating_sub(1);
    if let Some((_, wide)) = columns.iter_mut().find(|(column, _)| *column == Column::Trend) {
        *wide += more.min(TREND_MAX - TREND_MIN);
    }
    columns
}

/// Where an actuator's value is between its limits; none without limits, and for several values.
fn slider(state: &State<'_>, place: usize, wide: usize, look: Look) -> Option<String> {
    let device = state.items.get(place).map(|item| item.device)?;
    let (least, most) = device.min.zip(device.max).filter(|(least, most)| least < most)?;
    if device.direction != Direction::Actuator || device.value.length.is_some() || wide < 3 {
        return None;
    }
    let inner = wide - 2;
    let value = state.last(place).and_then(|value| value.first()).map(|raw| device.shown(*raw));
    let knob = value.map(|value| {
        let share = ((value - least) / (most - least)).clamp(0.0, 1.0);
        (share * (inner - 1) as f64).round() as usize
    });
    let [end, bar, at_value, other_end] =
        if look.has_shapes { ['├', '─', '●', '┤'] } else { ['|', '-', 'o', '|'] };
    let bar: String = (0..inner).map(|at| if Some(at) == knob { at_value } else { bar }).collect();
    Some(format!("{end}{bar}{other_end}"))
}

/// A small picture of the last seconds, whose scale is that of its own values.
fn trend(state: &State<'_>, item: &Item<'_>, wide: usize, look: Look) -> String {
    let Some(history) = state.traces.of(item.board, item.index).first() else {
        return String::new();
    };
    let levels = if look.has_shapes { LEVELS } else { PLAIN_LEVELS };
    let second = micros(state.now) / TREND_US;
    // The second that is under way has no column.
    let count = usize::try_from(second).unwrap_or(wide).min(wide);
    let from_us = (second - count as u64) * TREND_US;
    let columns = history.columns(from_us, TREND_US, count);
    let middle =
        |at: usize| columns.get(at).copied().flatten().map(|one| (one.least + one.most) / 2.0);
    // An actuator keeps what it was set to.
    let is_held = item.device.direction == Direction::Actuator;
    let mut last = history.at(from_us).map(|one| one.last).filter(|_| is_held);
    let all: Vec<Option<f64>> = (0..count)
        .map(|at| {
            let value = middle(at).or(last);
            last = value.filter(|_| is_held);
            value
        })
        .collect();
    let least = all.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let most = all.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
    let level = |value: f64| {
        let share = if most > least { (value - least) / (most - least) } else { 0.5 };
        levels.get((share * 7.0).round() as usize).copied().unwrap_or(" ")
    };
    let padding = " ".repeat(wide - count);
    let drawn: String = all.iter().map(|value| value.map_or(" ", level)).collect();
    format!("{padding}{drawn}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_tells_most_stays_longest() {
        let all: BTreeMap<Column, usize> = ORDER.iter().map(|one| (*one, one.bounds().0)).collect();
        let fitting =
            |window| fit(&all, window).into_iter().map(|(column, _)| column).collect::<Vec<_>>();
        assert_eq!(fitting(20), [Column::Device, Column::Value]);
        assert_eq!(fitting(200).len(), ORDER.len());
        for window in 0..200 {
            let columns = fit(&all, window);
            let used: usize = columns.iter().map(|(_, wide)| wide + 1).sum();
            assert!(columns.is_empty() || MARKS + used - 1 <= window, "{window}: {columns:?}");
        }
    }
}
