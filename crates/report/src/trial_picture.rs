//! The signals of a test around a moment, as a picture: step functions in, SVG out.
//!
//! Each signal has a lane of its own with its own scale, because a test compares centimetres with percentages. The time in
//! which a rule did not hold is marked across all lanes.

use crate::markup::escaped;

/// A signal that is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// What it is called.
    pub name: String,
    /// The unit of its values, if they have one.
    pub unit: Option<String>,
    /// Nanoseconds and values, in the order of time; each value stays until the next one.
    pub samples: Vec<(u64, f64)>,
}

/// What is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The name of the test.
    pub title: String,
    /// The rule, as it is written.
    pub rule: String,
    /// The first moment that is drawn, in nanoseconds.
    pub from_ns: u64,
    /// The last one.
    pub to_ns: u64,
    /// From when to when the rule did not hold.
    pub marked_ns: Option<(u64, u64)>,
    /// The signals, from the top to the bottom.
    pub courses: Vec<Course>,
}

const WIDTH: f64 = 860.0;
const LEFT: f64 = 150.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 64.0;
const LANE: f64 = 84.0;
const PLOT: f64 = 64.0;
const BOTTOM: f64 = 44.0;
/// About so many marks of time.
const TICKS: f64 = 8.0;
/// The columns in which a signal is drawn: of each its ends and extremes.
const COLUMNS: f64 = 1_000.0;

const STYLE: &str = "text{font:12px system-ui,sans-serif;fill:#1b1f24}.s{font-size:11px;fill:#57606a}\
.h{font-weight:600;font-size:14px}.g{stroke:#d0d7de;stroke-width:1}.l{fill:none;stroke:#0550ae;stroke-width:1.6}\
.m{fill:#cf222e;fill-opacity:.13}.e{stroke:#cf222e;stroke-width:1.4;stroke-dasharray:4 3}";

/// The picture.
#[must_use]
pub fn picture(scene: &Scene) -> String {
    let lanes: f64 = scene.courses.iter().map(|_| LANE).sum();
    let height = TOP + lanes + BOTTOM;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
         role=\"img\" aria-label=\"{}\">\n<style>{STYLE}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(&format!("{}: {}", scene.title, scene.rule))
    );
    out.push_str(&format!(
        "<text class=\"h\" x=\"16\" y=\"24\">{}</text>\n",
        escaped(&scene.title)
    ));
    out.push_str(&format!("<text x=\"16\" y=\"44\">{}</text>\n", escaped(&scene.rule)));
    mark(&mut out, scene, lanes);
    let mut top = TOP;
    for course in &scene.courses {
        lane(&mut out, scene, course, top);
        top += LANE;
    }
    axis(&mut out, scene, top);
    out.push_str("</svg>\n");
    out
}

#[expect(clippy::cast_precision_loss, reason = "an hour of nanoseconds is exact")]
fn seconds(ns: u64) -> f64 {
    ns as f64 / 1e9
}

impl Scene {
    fn x(&self, ns: u64) -> f64 {
        let length = seconds(self.to_ns.saturating_sub(self.from_ns)).max(1e-9);
        let share = (seconds(ns) - seconds(self.from_ns)) / length;
        LEFT + share.clamp(0.0, 1.0) * (WIDTH - LEFT - RIGHT)
    }
}

/// The time in which the rule did not hold.
fn mark(out: &mut String, scene: &Scene, lanes: f64) {
    let Some((from_ns, to_ns)) = scene.marked_ns else { return };
    let (from, to) = (scene.x(from_ns), scene.x(to_ns));
    let (top, bottom) = (TOP - 8.0, TOP + lanes - 8.0);
    if to > from {
        let (width, height) = (to - from, bottom - top);
        out.push_str(&format!(
            "<rect class=\"m\" x=\"{from:.1}\" y=\"{top}\" width=\"{width:.1}\" height=\"{height}\"/>\n"
        ));
    }
    for x in [Some(from), (to > from).then_some(to)].into_iter().flatten() {
        out.push_str(&format!(
            "<line class=\"e\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top}\" y2=\"{bottom}\"/>\n"
        ));
    }
}

/// One signal.
fn lane(out: &mut String, scene: &Scene, course: &Course, top: f64) {
    let bottom = top + PLOT;
    let points = points(scene, course);
    let values = points.iter().map(|point| point.1);
    let (least, most) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let unit = course.unit.as_ref().map(|unit| format!(" {unit}")).unwrap_or_default();
    let middle = top + PLOT / 2.0 + 4.0;
    out.push_str(&format!("<text x=\"16\" y=\"{middle}\">{}</text>\n", escaped(&course.name)));
    let right = WIDTH - RIGHT;
    for y in [top, bottom] {
        out.push_str(&format!(
            "<line class=\"g\" x1=\"{LEFT}\" x2=\"{right}\" y1=\"{y}\" y2=\"{y}\"/>\n"
        ));
    }
    if points.is_empty() {
        let x = LEFT + 8.0;
        out.push_str(&format!("<text class=\"s\" x=\"{x}\" y=\"{middle}\">no value came</text>\n"));
        return;
    }
    let label = |number: f64| escaped(&format!("{}{unit}", short(number)));
    let text = |y: f64, words: &str| {
        let x = LEFT - 8.0;
        format!("<text class=\"s\" x=\"{x}\" y=\"{y}\" text-anchor=\"end\">{words}</text>\n")
    };
    out.push_str(&text(top + 4.0, &label(most)));
    if most > least {
        out.push_str(&text(bottom + 4.0, &label(least)));
    }
    let height = |value: f64| {
        let share = if most > least { (value - least) / (most - least) } else { 1.0 };
        bottom - share * PLOT
    };
    let mut path = String::new();
    for (x, value) in points {
        let y = height(value);
        let step =
            if path.is_empty() { format!("M{x:.1} {y:.1}") } else { format!("H{x:.1}V{y:.1}") };
        path.push_str(&step);
    }
    path.push_str(&format!("H{right:.1}"));
    out.push_str(&format!("<path class=\"l\" d=\"{path}\"/>\n"));
}

/// Where a signal changes and what it then is; of each column only so much that nothing visible is lost.
fn points(scene: &Scene, course: &Course) -> Vec<(f64, f64)> {
    let first = course.samples.partition_point(|sample| sample.0 <= scene.from_ns);
    let end = course.samples.partition_point(|sample| sample.0 <= scene.to_ns);
    let inside = course.samples.get(first.saturating_sub(1)..end).unwrap_or_default();
    let width = (WIDTH - LEFT - RIGHT) / COLUMNS;
    let mut out: Vec<(f64, f64)> = Vec::new();
    let mut column: Vec<(f64, f64)> = Vec::new();
    for (ns, value) in inside.iter().filter(|sample| sample.1.is_finite()) {
        let x = scene.x(*ns);
        if column.first().is_some_and(|begin| x - begin.0 > width) {
            close(&mut out, &mut column);
        }
        column.push((x, *value));
    }
    close(&mut out, &mut column);
    out
}

/// Keeps the ends and the extremes of a column.
fn close(out: &mut Vec<(f64, f64)>, column: &mut Vec<(f64, f64)>) {
    if column.len() <= 4 {
        out.append(column);
        return;
    }
    let by_value = |one: &&(f64, f64), other: &&(f64, f64)| one.1.total_cmp(&other.1);
    let (least, most) = (column.iter().min_by(by_value), column.iter().max_by(by_value));
    let mut kept: Vec<(f64, f64)> =
        [column.first(), least, most, column.last()].into_iter().flatten().copied().collect();
    kept.sort_by(|one, other| one.0.total_cmp(&other.0));
    out.append(&mut kept);
    column.clear();
}

/// Marks of time in seconds.
fn axis(out: &mut String, scene: &Scene, y: f64) {
    let length = seconds(scene.to_ns.saturating_sub(scene.from_ns));
    let raw = (length / TICKS).max(1e-6);
    let power = 10_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= raw);
    let step = factor.unwrap_or(10.0) * power;
    let mut number = (seconds(scene.from_ns) / step).ceil();
    let (top, words) = (y - LANE + PLOT, y + 12.0);
    while number * step <= seconds(scene.to_ns) + 1e-9 {
        let at = number * step;
        let x = LEFT + (at - seconds(scene.from_ns)) / length.max(1e-9) * (WIDTH - LEFT - RIGHT);
        let end = top + 5.0;
        out.push_str(&format!(
            "<line class=\"g\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top}\" y2=\"{end}\"/>\n\
             <text class=\"s\" x=\"{x:.1}\" y=\"{words}\" text-anchor=\"middle\">{} s</text>\n",
            short(at)
        ));
        number += 1.0;
    }
}

/// A number with at most four significant digits after which nothing is seen.
fn short(number: f64) -> String {
    let text = format!("{number:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(samples: Vec<(u64, f64)>) -> Scene {
        let course = Course { name: "Front & <rear>".into(), unit: Some("cm".into()), samples };
        Scene {
            title: "Stops".into(),
            rule: "always Front < 20 cm".into(),
            from_ns: 0,
            to_ns: 10_000_000_000,
            marked_ns: Some((4_000_000_000, 5_000_000_000)),
            courses: vec![course],
        }
    }

    #[test]
    fn a_signal_is_drawn_as_steps_within_its_lane() {
        let text = picture(&scene(vec![(0, 10.0), (4_000_000_000, 30.0)]));
        assert!(text.contains("M150.0 128.0H424.4V64.0H836.0"), "{text}");
        assert!(text.contains("Front &amp; &lt;rear&gt;") && text.contains(">30 cm<"), "{text}");
        assert!(text.contains("class=\"m\" x=\"424.4\""), "{text}");
    }

    #[test]
    fn of_many_samples_the_extremes_are_kept() {
        let mut samples: Vec<(u64, f64)> = (0..100_000).map(|n| (n * 100_000, 1.0)).collect();
        samples[43_210].1 = 7.0;
        samples[71_234].1 = -3.0;
        let points = points(&scene(samples.clone()), &Course { samples, ..Course::default() });
        assert!(points.len() < 5_000, "{}", points.len());
        let has = |value: f64| points.iter().any(|point| point.1 == value);
        assert!(has(7.0) && has(-3.0));
    }
}
