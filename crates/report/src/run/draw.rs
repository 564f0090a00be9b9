//! The pieces of a run's picture: a map with a way on it, a plot, the times below.

use std::fmt::Write as _;

use super::{Floor, MAP_MAX, MARGIN, NUMBERS, PLOT, PLOT_HEAD, Plot, WIDTH};
use crate::markup::escaped;

/// Colours of light and dark pages; elements of an array have those of a record's page.
pub(super) const STYLE: &str = "<style>
.rn-page{fill:#fff}.rn-floor{fill:#f4f6f8;stroke:#c8d0d8}.rn-line{stroke:#1b2733;stroke-opacity:.35;fill:none}
.rn-wall{stroke:#5b6875;stroke-width:3;fill:none;stroke-linecap:square}.rn-path{stroke:#0b6bcb;stroke-width:1.6;fill:none;stroke-linejoin:round}
.rn-robot{fill:#0b6bcb;fill-opacity:.2;stroke:#0b6bcb}.rn-mark{fill:#c4431a}.rn-grid{stroke:#c8d0d8;fill:none}
text{font:12px system-ui,sans-serif;fill:#1b2733}.rn-title{font-size:16px;font-weight:bold}.rn-dim{fill:#5b6875}
.rn-curve{fill:none;stroke-width:1.3;stroke-linejoin:round}
.rn-e0{stroke:#0b6bcb}.rn-e1{stroke:#c4431a}.rn-e2{stroke:#22803d}.rn-e3{stroke:#8a3ffc}.rn-e4{stroke:#9a6700}.rn-e5{stroke:#b0206b}.rn-e6{stroke:#00767d}.rn-e7{stroke:#5b6875}
text.rn-e0,text.rn-e1,text.rn-e2,text.rn-e3,text.rn-e4,text.rn-e5,text.rn-e6,text.rn-e7{stroke:none}
text.rn-e0{fill:#0b6bcb}text.rn-e1{fill:#c4431a}text.rn-e2{fill:#22803d}text.rn-e3{fill:#8a3ffc}text.rn-e4{fill:#9a6700}text.rn-e5{fill:#b0206b}text.rn-e6{fill:#00767d}text.rn-e7{fill:#5b6875}
@media (prefers-color-scheme:dark){
.rn-page{fill:#14191f}.rn-floor{fill:#1a232d;stroke:#3a4652}.rn-line{stroke:#dfe6ee}.rn-wall{stroke:#9aa7b4}.rn-path,.rn-robot{stroke:#58a6ff}.rn-robot{fill:#58a6ff}.rn-mark{fill:#ff8f5c}.rn-grid{stroke:#3a4652}
text{fill:#dfe6ee}.rn-dim{fill:#9aa7b4}
.rn-e0{stroke:#58a6ff}.rn-e1{stroke:#ff8f5c}.rn-e2{stroke:#56d364}.rn-e3{stroke:#be95ff}.rn-e4{stroke:#e3b341}.rn-e5{stroke:#ff7eb6}.rn-e6{stroke:#3ddbd9}.rn-e7{stroke:#9aa7b4}
text.rn-e0{fill:#58a6ff}text.rn-e1{fill:#ff8f5c}text.rn-e2{fill:#56d364}text.rn-e3{fill:#be95ff}text.rn-e4{fill:#e3b341}text.rn-e5{fill:#ff7eb6}text.rn-e6{fill:#3ddbd9}text.rn-e7{fill:#9aa7b4}
}
</style>
";
/// Colours of elements.
const COLOURS: usize = 8;
/// Marks of time on a way, at most.
const MARKS: f64 = 12.0;
/// The room that a mark takes with its text.
const ROOM: (f64, f64) = (34.0, 14.0);
/// Times below the plots, at most.
const TICKS: f64 = 8.0;
/// A letter's width.
const LETTER: f64 = 7.0;

/// A number with as many decimals as it needs, two at most.
pub(super) fn short(number: f64) -> String {
    let text = format!("{number:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A text.
pub(super) fn text(out: &mut String, (x, y): (f64, f64), class: &str, what: &str) {
    let (x, y, what) = (short(x), short(y), escaped(what));
    // Writing to a String cannot fail.
    let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" class=\"{class}\">{what}</text>");
}

fn anchored(out: &mut String, (x, y): (f64, f64), anchor: &str, what: &str) {
    let (x, y, what) = (short(x), short(y), escaped(what));
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" class=\"rn-dim\" text-anchor=\"{anchor}\">{what}</text>"
    );
}

/// From metres to the page.
struct Frame {
    each: f64,
    x: f64,
    y: f64,
}

impl Frame {
    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.x + x * self.each, self.y - y * self.each)
    }
}

/// A map with the robot's way; gives the lower end of it.
pub(super) fn floor(out: &mut String, floor: &Floor, (left, top): (f64, f64)) -> f64 {
    // A robot without a map has as much room as its way takes.
    let (low, high) = extent(floor);
    let (width, height) = ((high.0 - low.0).max(0.1), (high.1 - low.1).max(0.1));
    let each = ((WIDTH - 2.0 * MARGIN) / width).min(MAP_MAX / height);
    let frame = Frame { each, x: left - low.0 * each, y: top + high.1 * each };
    let size = (short(width * each), short(height * each));
    let (x, y) = (short(left), short(top));
    let _ = writeln!(
        out,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" class=\"rn-floor\"/>",
        size.0, size.1
    );
    for stroke in &floor.strokes {
        let mut path = String::new();
        let mut last = None;
        for (from, to) in &stroke.pieces {
            if last != Some(*from) {
                push(&mut path, 'M', frame.at(*from));
            }
            push(&mut path, 'L', frame.at(*to));
            last = Some(*to);
        }
        let width = short((stroke.width * each).max(1.0));
        let _ = match stroke.is_wall {
            true => writeln!(out, "<path class=\"rn-wall\" d=\"{path}\"/>"),
            false => {
                writeln!(out, "<path class=\"rn-line\" stroke-width=\"{width}\" d=\"{path}\"/>")
            }
        };
    }
    way(out, floor, &frame);
    scale(out, each, (left, top + height * each));
    top + height * each
}

/// The corners of the map, or of the way with some room around it.
fn extent(floor: &Floor) -> ((f64, f64), (f64, f64)) {
    if !floor.strokes.is_empty() {
        return ((0.0, -floor.size.1), (floor.size.0, 0.0));
    }
    let room = 2.0 * floor.body + 0.1;
    let start = ((f64::MAX, f64::MAX), (f64::MIN, f64::MIN));
    let (low, high) = floor.path.iter().fold(start, |(low, high), (_, x, y)| {
        ((low.0.min(*x), low.1.min(*y)), (high.0.max(*x), high.1.max(*y)))
    });
    ((low.0 - room, low.1 - room), (high.0 + room, high.1 + room))
}

fn push(path: &mut String, letter: char, (x, y): (f64, f64)) {
    let _ = write!(path, "{letter}{} {}", short(x), short(y));
}

/// The way, with marks of time, and the robot at its end.
fn way(out: &mut String, floor: &Floor, frame: &Frame) {
    let mut path = String::new();
    let mut last: Option<(f64, f64)> = None;
    for (place, (_, x, y)) in floor.path.iter().enumerate() {
        let at = frame.at((*x, *y));
        let is_end = place + 1 == floor.path.len();
        // Points closer than half a pixel are one.
        let is_near = |last: (f64, f64)| (at.0 - last.0).abs() + (at.1 - last.1).abs() < 0.5;
        if last.is_some_and(is_near) && !is_end {
            continue;
        }
        push(&mut path, if last.is_none() { 'M' } else { 'L' }, at);
        last = Some(at);
    }
    let _ = writeln!(out, "<path class=\"rn-path\" d=\"{path}\"/>");
    let seconds = floor.path.last().map_or(0.0, |last| last.0);
    let step = nice(seconds / MARKS);
    let mut next = 0.0;
    let mut marked: Vec<(f64, f64)> = Vec::new();
    for (time, x, y) in &floor.path {
        if *time + 1e-9 < next {
            continue;
        }
        let (x, y) = frame.at((*x, *y));
        // A robot that stands, or comes by again, is not marked over a mark.
        let is_near = |(mx, my): &(f64, f64)| (x - mx).abs() < ROOM.0 && (y - my).abs() < ROOM.1;
        if marked.iter().any(is_near) {
            next += step;
            continue;
        }
        marked.push((x, y));
        let _ = writeln!(
            out,
            "<circle class=\"rn-mark\" cx=\"{}\" cy=\"{}\" r=\"2.5\"/>",
            short(x),
            short(y)
        );
        text(out, (x + 5.0, y - 5.0), "rn-dim", &format!("{} s", short(next)));
        next += step;
    }
    let Some((_, x, y)) = floor.path.last() else { return };
    let ((cx, cy), radius) = (frame.at((*x, *y)), floor.body * frame.each);
    let (dx, dy) = (radius * floor.looks.0, -radius * floor.looks.1);
    let _ = writeln!(
        out,
        "<circle class=\"rn-robot\" cx=\"{}\" cy=\"{}\" r=\"{}\"/><path class=\"rn-path\" d=\"M{0} {1}l{} {}\"/>",
        short(cx),
        short(cy),
        short(radius),
        short(dx),
        short(dy)
    );
}

/// How long a metre is, below the lower left corner.
fn scale(out: &mut String, each: f64, (left, bottom): (f64, f64)) {
    let metres = nice(120.0 / each);
    let (x, y, length) = (short(left + 8.0), short(bottom - 8.0), short(metres * each));
    let _ = writeln!(out, "<path class=\"rn-wall\" d=\"M{x} {y}h{length}\"/>");
    let name = if metres < 1.0 {
        format!("{} cm", short(100.0 * metres))
    } else {
        format!("{} m", short(metres))
    };
    text(out, (left + 10.0, bottom - 13.0), "rn-dim", &name);
}

/// The next greater one of 1, 2 and 5 times a power of ten.
fn nice(number: f64) -> f64 {
    let mut each = 1e-3;
    while each < 1e9 {
        for factor in [1.0, 2.0, 5.0] {
            if factor * each >= number {
                return factor * each;
            }
        }
        each *= 10.0;
    }
    each
}

/// The way from seconds to the page.
fn across(at: f64, seconds: f64) -> f64 {
    let left = MARGIN + NUMBERS;
    left + (WIDTH - MARGIN - left) * at / seconds.max(1e-9)
}

/// A plot; its heading begins at `top`.
pub(super) fn plot(out: &mut String, plot: &Plot, seconds: f64, top: f64) {
    let heading = match (plot.unit.is_empty(), plot.is_set) {
        (true, true) => format!("{} (set)", plot.name),
        (false, true) => format!("{} in {} (set)", plot.name, plot.unit),
        (true, false) => plot.name.clone(),
        (false, false) => format!("{} in {}", plot.name, plot.unit),
    };
    let left = MARGIN + NUMBERS;
    text(out, (left, top + 14.0), "rn-ink", &heading);
    let all = plot.lines.iter().flat_map(|line| &line.points);
    let ends = all.fold((f64::MAX, f64::MIN), |(low, high), (_, least, most)| {
        (low.min(*least), high.max(*most))
    });
    let (least, most) = if ends.0 <= ends.1 { ends } else { (0.0, 0.0) };
    // A line that never moves is in the middle.
    let margin = if most > least { 0.0 } else { least.abs().max(1.0) / 2.0 };
    let (low, high) = if plot.is_switch { (0.0, 1.0) } else { (least - margin, most + margin) };
    let (upper, lower) = (top + PLOT_HEAD, top + PLOT - 6.0);
    let _ = writeln!(
        out,
        "<path class=\"rn-grid\" d=\"M{0} {1}V{2}H{3}\"/>",
        short(left),
        short(upper),
        short(lower),
        short(WIDTH - MARGIN)
    );
    anchored(out, (left - 6.0, upper + 9.0), "end", &figure(high, high - low));
    anchored(out, (left - 6.0, lower), "end", &figure(low, high - low));
    let letters = u32::try_from(heading.chars().count()).unwrap_or(0);
    let mut x = left + f64::from(letters) * LETTER + 14.0;
    for (place, line) in plot.lines.iter().enumerate() {
        let class = place % COLOURS;
        let y = |value: f64| lower - (lower - upper) * (value - low) / (high - low).max(1e-300);
        let mut path = String::new();
        let mut last: Option<f64> = None;
        for (at, least, most) in &line.points {
            let (at, least, most) = (across(*at, seconds), y(*least), y(*most));
            // The nearer end first, so that no line crosses the band.
            let is_below = last.is_some_and(|last| (last - least).abs() > (last - most).abs());
            let ends = if is_below { [most, least] } else { [least, most] };
            for end in ends {
                if last.is_none_or(|last| (last - end).abs() > 0.05) || end == ends[0] {
                    push(&mut path, if last.is_none() { 'M' } else { 'L' }, (at, end));
                    last = Some(end);
                }
            }
        }
        let _ = writeln!(out, "<path class=\"rn-curve rn-e{class}\" d=\"{path}\"/>");
        if plot.lines.len() > 1 || !line.name.is_empty() {
            text(out, (x, top + 14.0), &format!("rn-e{class}"), &line.name);
            x += 26.0;
        }
    }
}

/// A number with digits that tell it from its neighbours in a range.
fn figure(number: f64, range: f64) -> String {
    let digits = [(20.0, 0), (2.0, 1), (0.2, 2), (0.02, 3)];
    let digits = digits.into_iter().find(|(least, _)| range >= *least).map_or(4, |(_, all)| all);
    let text = format!("{number:.digits$}");
    if text.trim_start_matches('-').chars().all(|c| matches!(c, '0' | '.')) {
        return "0".to_owned();
    }
    text
}

/// Times below all plots, with lines through them.
pub(super) fn times(out: &mut String, seconds: f64, (from, to): (f64, f64)) {
    let step = nice(seconds / TICKS);
    let mut at = 0.0;
    while at <= seconds + 1e-9 {
        let x = across(at, seconds);
        let _ = writeln!(
            out,
            "<path class=\"rn-grid\" stroke-dasharray=\"1 4\" d=\"M{} {}V{}\"/>",
            short(x),
            short(from),
            short(to)
        );
        anchored(out, (x, to + 14.0), "middle", &format!("{} s", short(at)));
        at += step;
    }
}
