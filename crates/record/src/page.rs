//! The page of a recorded run: what it comes to, and a plot of each device. It needs no other file and no network.

use askama::Template;
use sensedsl_files::print;
use sensedsl_wire::ScalarType;

use crate::read::Ending;
use crate::series::Series;
use crate::summary::{BoardSummary, DeviceSummary, HEADS, Summary};

/// The size of a plot, and the room for its numbers.
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 160.0;
const LEFT: f64 = 84.0;
const BOTTOM: f64 = 22.0;
const TOP: f64 = 8.0;
/// How many times are written below a plot, at most.
const TICKS: f64 = 8.0;

#[derive(Template)]
#[template(path = "page.html", escape = "html")]
struct Page<'a> {
    title: &'a str,
    /// The begin, in seconds since 1970; the page puts it in the reader's time.
    began_s: u64,
    lasted: String,
    is_cut: bool,
    boards: Vec<BoardView>,
}

struct BoardView {
    name: String,
    head: String,
    notes: Vec<String>,
    heads: [&'static str; HEADS.len()],
    rows: Vec<[String; HEADS.len()]>,
    plots: Vec<Plot>,
}

/// A plot of one device.
struct Plot {
    name: String,
    unit: String,
    note: String,
    least: String,
    most: String,
    lines: Vec<Line>,
    /// Where times are written, and which.
    ticks: Vec<(String, String)>,
}

/// The course of one element.
struct Line {
    element: String,
    class: usize,
    path: String,
}

/// The page.
#[must_use]
pub fn html(summary: &Summary, title: &str) -> String {
    let lasted_s = summary.lasted.as_secs_f64();
    let boards = summary.boards.iter().map(|board| BoardView::new(board, summary)).collect();
    print(&Page {
        title,
        began_s: summary.began.as_secs(),
        lasted: format!("{lasted_s:.1} s"),
        is_cut: summary.ending == Ending::Cut,
        boards,
    })
}

impl BoardView {
    fn new(board: &BoardSummary, summary: &Summary) -> Self {
        let rows = board.devices.iter().flat_map(|device| device.rows(summary.lasted)).collect();
        let breaks: Vec<f64> = board.absences.iter().map(|(from, ..)| from.as_secs_f64()).collect();
        let seen = board.devices.iter().filter(|device| device.stats.count() > 0);
        Self {
            name: board.name.clone(),
            head: board.head(summary.lasted),
            notes: board.notes(),
            heads: HEADS,
            rows,
            plots: seen
                .map(|device| Plot::new(device, summary.lasted.as_secs_f64(), &breaks))
                .collect(),
        }
    }
}

impl Plot {
    fn new(device: &DeviceSummary, lasted_s: f64, breaks_s: &[f64]) -> Self {
        let all = device.elements.iter().map(Series::numbers);
        let ends = all.filter_map(|[least, _, most]| least.zip(most));
        let (least, most) =
            ends.reduce(|one, next| (one.0.min(next.0), one.1.max(next.1))).unwrap_or((0.0, 1.0));
        // A line that never moves is in the middle.
        let margin = if most > least { 0.0 } else { least.abs().max(1.0) / 2.0 };
        let (low, high) = (least - margin, most + margin);
        let is_stepped = device.device.value.scalar == ScalarType::Bool;
        let is_array = device.device.value.length.is_some();
        let lines = device.elements.iter().enumerate().map(|(element, series)| Line {
            element: if is_array { element.to_string() } else { String::new() },
            class: element % 8,
            path: path(series, lasted_s, (low, high), is_stepped, breaks_s),
        });
        let outside = device.overstepped;
        Self {
            name: device.device.name.clone(),
            unit: device.device.quantity.clone().unwrap_or_default(),
            note: if outside > 0 {
                format!("{outside} values outside of its limits")
            } else {
                String::new()
            },
            least: device.number(least),
            most: device.number(most),
            lines: lines.collect(),
            ticks: ticks(lasted_s),
        }
    }
}

/// A stroke from the least to the greatest of each span, joined but where the board was away.
fn path(
    series: &Series,
    lasted_s: f64,
    (low, high): (f64, f64),
    is_stepped: bool,
    breaks_s: &[f64],
) -> String {
    let span_s = series.span().as_secs_f64();
    let y = |number: f64| TOP + (HEIGHT - TOP - BOTTOM) * (high - number) / (high - low);
    let (mut path, mut last) = (String::new(), None::<f64>);
    let mut breaks_s = breaks_s.iter().peekable();
    for (place, span) in series.spans().iter().enumerate() {
        let Some((least, most)) = span else { continue };
        let at_s = place as f64 * span_s;
        while breaks_s.next_if(|away_s| **away_s <= at_s).is_some() {
            last = None;
        }
        let x = x(at_s, lasted_s);
        // It goes first to the end that is nearer to where the line is.
        let is_up = last.is_some_and(|last| (last - least).abs() > (last - most).abs());
        let (first, second) = if is_up { (*most, *least) } else { (*least, *most) };
        if is_stepped && last.is_some() {
            path.push_str(&format!("H{x:.1}"));
        }
        let letter = if last.is_none() { 'M' } else { 'L' };
        path.push_str(&format!("{letter}{x:.1} {:.1}", y(first)));
        if most > least {
            path.push_str(&format!("V{:.1}", y(second)));
        }
        last = Some(second);
    }
    // One point alone is drawn as a short line.
    if path.contains('M') && !path.contains(['L', 'V', 'H']) { format!("{path}h2") } else { path }
}

fn x(at_s: f64, lasted_s: f64) -> f64 {
    LEFT + (WIDTH - LEFT) * (at_s / lasted_s.max(1e-6)).min(1.0)
}

/// Round times, a few of them.
fn ticks(lasted_s: f64) -> Vec<(String, String)> {
    let rough = (lasted_s / TICKS).max(1e-4);
    let power = 10_f64.powf(rough.log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].map(|times| times * power).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    let decimals = (-step.log10().floor()).clamp(0.0, 4.0) as usize;
    let count = (lasted_s / step).floor() as usize;
    // The last one would be cut off at the edge.
    let all =
        (0..=count).map(|tick| tick as f64 * step).filter(|at| x(*at, lasted_s) < WIDTH - 24.0);
    all.map(|at| (format!("{:.1}", x(at, lasted_s)), format!("{at:.decimals$} s"))).collect()
}
