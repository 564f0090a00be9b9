//! The plots: the numbers of the chosen devices over time, those of one unit in one frame.
//!
//! In: the state with its histories, and an area. Out: lines, axes and legends in a buffer.

use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::Modifier;
use sensedsl_diagnostics::visible;
use sensedsl_wire::{Direction, ScalarType};

use super::canvas::{ACROSS, Canvas};
use super::history::{Bucket, History};
use super::slider::round;
use super::state::{Item, State};
use super::style::{Look, Tone};
use super::table::letter;
use super::traces::micros;
use super::view::Axis;
use super::words::{cut, label, moment, number, put, width};

/// The least rows of a frame: its legend and three of values.
pub(super) const FRAME_MIN: u16 = 4;
/// The most columns of the labels of an axis.
const LABELS_MAX: usize = 10;
/// A sensor that has not reported for so many of its cycles has no line until it does.
const CYCLES_MISSED: u64 = 3;
const PAUSE_MIN_US: u64 = 1_000_000;

/// What is drawn in one frame.
struct Frame {
    unit: String,
    /// Places in the list of what is plotted.
    lines: Vec<usize>,
}

/// The columns of one number.
struct Line {
    /// Its place among all that is plotted.
    place: usize,
    before: Option<Bucket>,
    columns: Vec<Option<Bucket>>,
    /// How long a value counts; until the next one if there is none.
    holds_us: Option<u64>,
}

/// What time a frame shows.
#[derive(Clone, Copy)]
struct Times {
    /// The first column begins so many columns after the run began; less than none if the run is younger.
    first: i64,
    column_us: u64,
    count: usize,
}

impl Times {
    fn new(state: &State<'_>, now: Duration, count: usize) -> Self {
        let span_us = micros(state.view.span());
        let column_us = (span_us / count.max(1) as u64).max(1);
        let last = i64::try_from(micros(state.view.end(now)) / column_us).unwrap_or(i64::MAX);
        // The column of now is not over: in a picture that is held it would go on.
        let end = last + i64::from(!state.view.is_frozen());
        Self { first: end - i64::try_from(count).unwrap_or(0), column_us, count }
    }

    /// When a column begins.
    fn begin_us(self, column: usize) -> u64 {
        let place = self.first + i64::try_from(column).unwrap_or(0);
        u64::try_from(place).map_or(0, |place| place * self.column_us)
    }

    fn columns(self, history: &History) -> (Option<Bucket>, Vec<Option<Bucket>>) {
        let early = usize::try_from(-self.first).unwrap_or(0).min(self.count);
        let from_us = self.begin_us(early);
        let before = from_us.checked_sub(1).and_then(|at_us| history.at(at_us));
        let mut columns = vec![None; early];
        columns.extend(history.columns(from_us, self.column_us, self.count - early));
        (before, columns)
    }
}

/// Draws all frames, and the axis of the time below them.
pub(super) fn draw(
    buffer: &mut Buffer,
    area: Rect,
    state: &mut State<'_>,
    (now, look): (Duration, Look),
) {
    if area.height <= FRAME_MIN || area.width < 16 {
        return;
    }
    let frames = frames(state);
    let room = area.height - 1;
    let fit = frames.len().min(usize::from(room / FRAME_MIN));
    let mut top = area.y;
    let left = (LABELS_MAX as u16 + 1).min(area.width / 3);
    for (index, frame) in frames.iter().take(fit).enumerate() {
        let share = (area.y + room - top) / u16::try_from(fit - index).unwrap_or(1);
        let within = Rect { y: top, height: share, ..area };
        draw_frame(buffer, within, left, frame, state, (now, look));
        top += share;
    }
    let missing = frames.len() - fit;
    let axis = Rect { x: area.x + left, y: area.bottom() - 1, width: area.width - left, height: 1 };
    time_axis(buffer, axis, state, now, look);
    if missing > 0 {
        let text = format!("{missing} more");
        let _ = put(buffer, area, (area.x, area.bottom() - 1), &text, look.of(Tone::Warning));
    }
}

/// What is plotted, by its unit.
fn frames(state: &State<'_>) -> Vec<Frame> {
    let mut frames: Vec<Frame> = Vec::new();
    for (place, item) in state.plotted.iter().enumerate() {
        let Some(item) = state.items.get(*item) else { continue };
        let unit = unit(item);
        match frames.iter_mut().find(|frame| frame.unit == unit) {
            Some(frame) => frame.lines.push(place),
            None => frames.push(Frame { unit, lines: vec![place] }),
        }
    }
    frames
}

fn unit(item: &Item<'_>) -> String {
    match (&item.device.quantity, item.device.value.scalar) {
        (_, ScalarType::Bool) => "off, on".to_owned(),
        (Some(unit), _) => visible(unit).into_owned(),
        (None, _) => String::new(),
    }
}

fn item<'s, 'a>(state: &'s State<'a>, place: usize) -> Option<&'s Item<'a>> {
    state.plotted.get(place).and_then(|item| state.items.get(*item))
}

fn draw_frame(
    buffer: &mut Buffer,
    area: Rect,
    left: u16,
    frame: &Frame,
    state: &mut State<'_>,
    (now, look): (Duration, Look),
) {
    legend(buffer, Rect { height: 1, ..area }, frame, state, (now, look));
    let inner = Rect {
        x: area.x + left,
        y: area.y + 1,
        width: area.width - left,
        height: area.height.saturating_sub(1),
    };
    if inner.is_empty() {
        return;
    }
    let mut canvas = Canvas::new(inner.width.into(), inner.height.into());
    let (across, down) = canvas.size();
    let times = Times::new(state, now, across);
    let lines: Vec<Line> =
        frame.lines.iter().flat_map(|place| lines(state, *place, times)).collect();
    let range = range(state, frame, &lines);
    let _ = state.ranges.insert(frame.unit.clone(), range);
    let range = magnified(state, &lines, range);
    for line in &lines {
        draw_line(&mut canvas, line, times, range, down);
    }
    axis(buffer, Rect { x: area.x, width: left, ..inner }, range, look);
    cursor(buffer, inner, state, times, look);
    canvas.show(buffer, inner, look);
}

/// The lines of a device: one for each of its elements.
fn lines(state: &State<'_>, place: usize, times: Times) -> Vec<Line> {
    let Some(item) = item(state, place) else { return Vec::new() };
    let cycle_us = item.device.cycle_ms.map(|cycle_ms| u64::from(cycle_ms) * 1_000);
    let is_sensor = item.device.direction == Direction::Sensor;
    let holds_us =
        cycle_us.filter(|_| is_sensor).map(|cycle_us| (CYCLES_MISSED * cycle_us).max(PAUSE_MIN_US));
    let all = state.traces.of(item.board, item.index).iter().map(|history| {
        let (before, columns) = times.columns(history);
        Line { place, before, columns, holds_us }
    });
    all.collect()
}

/// From the least to the greatest number of a frame's axis.
fn range(state: &State<'_>, frame: &Frame, lines: &[Line]) -> (f64, f64) {
    if state.view.axis == Axis::Held
        && let Some(range) = state.ranges.get(&frame.unit)
    {
        return *range;
    }
    let devices =
        || frame.lines.iter().filter_map(|place| item(state, *place)).map(|item| item.device);
    if devices().all(|device| device.value.scalar == ScalarType::Bool) {
        return (0.0, 1.0);
    }
    if state.view.axis == Axis::Limits {
        let least = devices().filter_map(|device| device.min).fold(f64::INFINITY, f64::min);
        let most = devices().filter_map(|device| device.max).fold(f64::NEG_INFINITY, f64::max);
        if least < most {
            return (least, most);
        }
    }
    let seen = lines.iter().flat_map(|line| line.columns.iter().chain([&line.before])).flatten();
    let (least, most) = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), bucket| {
        (least.min(bucket.least), most.max(bucket.most))
    });
    if !least.is_finite() || !most.is_finite() {
        return (0.0, 1.0);
    }
    outwards(least, most)
}

/// A range with round ends that has another one in it.
fn outwards(least: f64, most: f64) -> (f64, f64) {
    let size = (most - least).max(most.abs().max(least.abs()) * 1e-6).max(1e-9);
    let step = round(size / 4.0);
    let (from, to) = ((least / step).floor() * step, (most / step).ceil() * step);
    if from < to { (from, to) } else { (from - step, to + step) }
}

/// A part of the range, around the value at the cursor, or the last one.
fn magnified(state: &State<'_>, lines: &[Line], (least, most): (f64, f64)) -> (f64, f64) {
    if state.view.magnified == 0 {
        return (least, most);
    }
    // The chosen device counts, if it is in the frame.
    let chosen = state.shown.get(state.chosen);
    let is_chosen = |line: &&Line| state.plotted.get(line.place) == chosen && chosen.is_some();
    let line = lines.iter().find(is_chosen).or_else(|| lines.first());
    let of = line.and_then(|line| item(state, line.place));
    let at =
        of.and_then(|item| state.traces.of(item.board, item.index).first()).and_then(|history| {
            history.at(micros(state.view.cursor.unwrap_or(state.view.end(state.now))))
        });
    let middle = at.map_or((least + most) / 2.0, |at| at.last);
    let half = (most - least) / 2.0 / f64::from(2_u32.pow(state.view.magnified.into()));
    // It stays where it is as long as the value does not go far.
    let middle = (middle / half * 2.0).round() * half / 2.0;
    (middle - half, middle + half)
}

fn draw_line(
    canvas: &mut Canvas,
    line: &Line,
    times: Times,
    (least, most): (f64, f64),
    down: usize,
) {
    let rows = (down - 1) as f64;
    let row = |value: f64| ((most - value) / (most - least) * rows).round();
    let mut last = line.before;
    for (column, bucket) in line.columns.iter().enumerate() {
        let is_held = |last: &Bucket| {
            let since_us = times.begin_us(column).saturating_sub(last.at_us);
            line.holds_us.is_none_or(|holds_us| since_us <= holds_us)
        };
        let held = last.filter(is_held).map(|last| row(last.last));
        let (from, to) = match (bucket, held) {
            (Some(bucket), Some(held)) => {
                let (top, bottom) = (row(bucket.most), row(bucket.least));
                (top.min(held), bottom.max(held))
            }
            (Some(bucket), None) => (row(bucket.most), row(bucket.least)),
            (None, Some(held)) => (held, held),
            (None, None) => continue,
        };
        last = bucket.or(last);
        if to < 0.0 || from > rows {
            continue;
        }
        let place = |row: f64| row.clamp(0.0, rows) as usize;
        canvas.draw(column, (place(from), place(to)), line.place);
    }
}

/// The labels of the values: round numbers, or in a low frame its ends.
fn axis(buffer: &mut Buffer, area: Rect, (least, most): (f64, f64), look: Look) {
    for row in area.y..area.bottom() {
        let _ = put(buffer, area, (area.right() - 1, row), "│", look.of(Tone::Faint));
    }
    let rows = f64::from((area.height - 1).max(1));
    let count = (area.height / 2).clamp(1, 5);
    let step = step_of((most - least) / f64::from(count));
    let (first, last) = ((least / step - 1e-6).ceil(), (most / step + 1e-6).floor());
    let is_low = area.height < 5 || last <= first;
    let places = (0..=count).map(|place| (first + f64::from(place)) * step);
    let values: Vec<f64> = if is_low {
        vec![most, least]
    } else {
        places.filter(|value| *value <= last * step + step / 2.0).collect()
    };
    let apart = if is_low { round((most - least) / 20.0) } else { step };
    for value in values {
        let row = ((most - value) / (most - least) * rows).round().clamp(0.0, rows) as u16;
        let text = cut(&label(value, apart), usize::from(area.width).saturating_sub(1));
        let x = area.right().saturating_sub(1 + u16::try_from(width(&text)).unwrap_or(0));
        let _ = put(buffer, area, (x, area.y + row), &text, look.of(Tone::Faint));
    }
}

/// The least of 1, 2 and 5, and ten times or a tenth of these, that is no less than a number.
fn step_of(number: f64) -> f64 {
    let size = 10_f64.powf(number.log10().floor());
    let fits = |many: &&f64| **many * size >= number * 0.999;
    [1.0, 2.0, 5.0].iter().find(fits).map_or(10.0 * size, |many| many * size)
}

/// The devices of a frame with their values: at the cursor, at the end of a picture that is held, or now.
fn legend(
    buffer: &mut Buffer,
    area: Rect,
    frame: &Frame,
    state: &State<'_>,
    (now, look): (Duration, Look),
) {
    let mut x = area.x;
    for place in &frame.lines {
        let Some(item) = item(state, *place) else { continue };
        let at = state.view.cursor.unwrap_or(state.view.end(now));
        let values: Vec<String> = state
            .traces
            .of(item.board, item.index)
            .iter()
            .map(|history| history.at(micros(at)))
            .map(|found| found.map_or("-".to_owned(), |found| number(item.device, found.last)))
            .collect();
        let value = if item.device.value.length.is_some() {
            format!("[{}]", cut(&values.join(" "), 40))
        } else {
            values.concat()
        };
        let style = look.of(Tone::Line(*place)).add_modifier(Modifier::BOLD);
        x = put(
            buffer,
            area,
            (x, area.y),
            &format!("{} {}", letter(*place), visible(&item.name)),
            style,
        );
        x = put(buffer, area, (x, area.y), &format!(" {value}  "), look.of(Tone::Plain));
    }
    if !frame.unit.is_empty() {
        let text = format!(" {}", frame.unit);
        let right = area.right().saturating_sub(u16::try_from(width(&text)).unwrap_or(0)).max(x);
        let _ = put(buffer, area, (right, area.y), &text, look.of(Tone::Faint));
    }
}

fn cursor(buffer: &mut Buffer, area: Rect, state: &State<'_>, times: Times, look: Look) {
    let Some(at) = state.view.cursor else { return };
    let place = i64::try_from(micros(at) / times.column_us).unwrap_or(i64::MAX) - times.first;
    let Ok(column) = usize::try_from(place) else { return };
    let Ok(column) = u16::try_from(column / ACROSS) else { return };
    for row in area.y..area.bottom() {
        let _ = put(buffer, area, (area.x.saturating_add(column), row), "┊", look.of(Tone::Head));
    }
}

/// The times below the frames.
fn time_axis(buffer: &mut Buffer, area: Rect, state: &State<'_>, now: Duration, look: Look) {
    let (span, end) = (state.view.span(), state.view.end(now));
    let told = told(state, now);
    let is_fine = span < Duration::from_secs(10);
    let precise = |time: Duration| match time.as_secs() {
        0..60 if is_fine => format!("{:.2} s", time.as_secs_f64()),
        _ => moment(time),
    };
    let text = |back: Duration| match (state.view.is_frozen(), back.is_zero()) {
        (false, true) => "now".to_owned(),
        (false, false) => {
            format!("-{}", precise(back).replace(".00 s", " s").replace(".0 s", " s"))
        }
        (true, _) => end.checked_sub(back).map_or_else(String::new, precise),
    };
    let steps: u32 = if area.width >= 60 { 4 } else { 2 };
    let place = area.x + area.width / 8;
    let beyond = place.saturating_add(u16::try_from(width(&told)).unwrap_or(0));
    for step in 0..=steps {
        let label = text(span * (steps - step) / steps);
        let wide = u16::try_from(width(&label)).unwrap_or(0);
        let centre = (u32::from(area.width) * step / steps) as u16;
        let x = area.x + centre.saturating_sub(wide / 2).min(area.width.saturating_sub(wide));
        // What is told stands in the place of labels.
        if told.is_empty() || x + wide < place || x > beyond {
            let _ = put(buffer, area, (x, area.y), &label, look.of(Tone::Faint));
        }
    }
    let style = look.of(Tone::Warning).add_modifier(Modifier::REVERSED);
    let _ = put(buffer, area, (place, area.y), &told, style);
}

/// How the plots are not as usual.
fn told(state: &State<'_>, now: Duration) -> String {
    let mut told = Vec::new();
    if state.view.is_frozen() {
        let behind = now.saturating_sub(state.view.end(now));
        told.push(format!("held, {} ago", moment(behind)));
    }
    if let Some(at) = state.view.cursor {
        told.push(format!("cursor at {:.2} s", at.as_secs_f64()));
    }
    match state.view.axis {
        Axis::Auto => {}
        Axis::Limits => told.push("axis by limits".to_owned()),
        Axis::Held => told.push("axis held".to_owned()),
    }
    if told.is_empty() { String::new() } else { format!(" {} ", told.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_round() {
        assert_eq!([0.3, 1.0, 1.2, 4.0, 70.0].map(step_of), [0.5, 1.0, 2.0, 5.0, 100.0]);
    }

    #[test]
    fn axes_have_round_ends() {
        assert_eq!(outwards(12.3, 33.1), (10.0, 35.0));
        assert_eq!(outwards(0.0, 0.0).0, -outwards(0.0, 0.0).1);
        let (least, most) = outwards(5e9, 5e9);
        assert!(least < 5e9 && most > 5e9);
        for (least, most) in [(-1.0, 1.0), (0.001, 0.0013), (1e6, 1e6 + 1.0), (-3e-12, 0.0)] {
            let (from, to) = outwards(least, most);
            assert!(from <= least && to >= most && from < to, "{least} {most}: {from} {to}");
        }
    }
}
