//! A picture of a simulated run: robots on their maps with the ways that they went, and signals over time.
//!
//! In: plain numbers, in metres and seconds. Out: SVG for light and dark pages, in the colours of a record's page. What
//! takes how much room is decided here; `run/draw.rs` writes the pieces.

mod draw;

use std::fmt::Write as _;

use crate::markup::escaped;

/// A stroke of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its straight pieces: from and to, metres to the right and upwards.
    pub pieces: Vec<((f64, f64), (f64, f64))>,
    /// How wide it is, in metres.
    pub width: f64,
    /// Whether it is a wall.
    pub is_wall: bool,
}

/// A robot on its map.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    /// The name of the robot.
    pub name: String,
    /// Width and height of the map in metres; its top left corner is at (0, 0).
    pub size: (f64, f64),
    /// Its lines and walls.
    pub strokes: Vec<Stroke>,
    /// Where the robot was: seconds, metres to the right and upwards.
    pub path: Vec<(f64, f64, f64)>,
    /// The radius of the robot in metres.
    pub body: f64,
    /// The direction that it looks in at the end, to the right and upwards, with a length of 1.
    pub looks: (f64, f64),
}

/// An element of a device over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its place in an array; empty for a single value.
    pub name: String,
    /// Seconds, and the least and the greatest value from then on to the next point.
    pub points: Vec<(f64, f64, f64)>,
}

/// A device over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Its name.
    pub name: String,
    /// The unit that it shows; empty for none.
    pub unit: String,
    /// Whether it is an actuator.
    pub is_set: bool,
    /// Whether it is only on or off.
    pub is_switch: bool,
    /// Its elements.
    pub lines: Vec<Line>,
}

/// What a picture shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunPicture {
    /// The heading.
    pub title: String,
    /// Lines below the heading.
    pub notes: Vec<String>,
    /// The length of the run.
    pub seconds: f64,
    /// Robots on maps.
    pub floors: Vec<Floor>,
    /// Signals.
    pub plots: Vec<Plot>,
}

/// The size of the picture, and the room around things.
const WIDTH: f64 = 960.0;
const MARGIN: f64 = 20.0;
const HEADING: f64 = 44.0;
const NOTE: f64 = 18.0;
/// The greatest height of a map.
const MAP_MAX: f64 = 560.0;
/// The height of a plot, with its heading.
const PLOT: f64 = 92.0;
const PLOT_HEAD: f64 = 20.0;
/// The room for the numbers to the left of a plot, and for the times below all plots.
const NUMBERS: f64 = 70.0;
const TIMES: f64 = 26.0;

/// The picture.
#[must_use]
pub fn svg(picture: &RunPicture) -> String {
    let mut body = String::new();
    let mut y = HEADING;
    draw::text(&mut body, (MARGIN, 28.0), "rn-title", &picture.title);
    for note in &picture.notes {
        draw::text(&mut body, (MARGIN, y + 4.0), "rn-dim", note);
        y += NOTE;
    }
    for floor in picture.floors.iter().filter(|floor| floor.path.len() > 1) {
        y = draw::floor(&mut body, floor, (MARGIN, y + 4.0)) + MARGIN;
    }
    let from = y + PLOT_HEAD;
    for plot in &picture.plots {
        draw::plot(&mut body, plot, picture.seconds, y);
        y += PLOT;
    }
    if !picture.plots.is_empty() {
        draw::times(&mut body, picture.seconds, (from, y));
        y += TIMES;
    }
    let height = y + MARGIN / 2.0;
    let title = escaped(&picture.title);
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {}\" width=\"{WIDTH}\" height=\"{0}\" role=\"img\">\n<title>{title}</title>",
        draw::short(height)
    );
    out.push_str(draw::STYLE);
    let _ = writeln!(out, "<rect class=\"rn-page\" width=\"100%\" height=\"100%\"/>");
    out.push_str(&body);
    out.push_str("</svg>\n");
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> RunPicture {
        let path =
            (0..100).map(|step| (f64::from(step) / 10.0, 0.2 + f64::from(step) / 100.0, -0.5));
        let floor = Floor {
            name: "Robot".into(),
            size: (2.0, 1.0),
            strokes: vec![
                Stroke { pieces: vec![((0.2, -0.5), (1.8, -0.5))], width: 0.02, is_wall: false },
                Stroke { pieces: vec![((0.0, 0.0), (2.0, 0.0))], width: 0.0, is_wall: true },
            ],
            path: path.collect(),
            body: 0.09,
            looks: (1.0, 0.0),
        };
        let points = (0..100).map(|step| {
            let at = f64::from(step) / 10.0;
            (at, at, at + 1.0)
        });
        let line = Line { name: "[0]".into(), points: points.collect() };
        let plot = Plot {
            name: "A<b".into(),
            unit: "deg".into(),
            is_set: false,
            is_switch: false,
            lines: vec![line],
        };
        RunPicture {
            title: "Rover & more, 10.0 s".into(),
            notes: vec!["Robot: 1.00 m".into()],
            seconds: 10.0,
            floors: vec![floor],
            plots: vec![plot],
        }
    }

    #[test]
    fn a_picture_is_well_formed_and_has_all_that_there_is() {
        let text = svg(&picture());
        let document = roxmltree::Document::parse(&text).unwrap();
        let all: Vec<_> = document.descendants().filter(roxmltree::Node::is_element).collect();
        let with = |class: &str| {
            let is = |one: &&roxmltree::Node<'_, '_>| {
                let classes = one.attribute("class").unwrap_or_default();
                classes.split(' ').any(|one| one == class)
            };
            all.iter().filter(is).count()
        };
        // The scale is drawn as a wall is; where the robot looks, as its way.
        assert_eq!((with("rn-line"), with("rn-wall"), with("rn-path")), (1, 2, 2));
        assert_eq!((with("rn-robot"), with("rn-e0")), (1, 2));
        assert!(text.contains("A&lt;b") && text.contains("Rover &amp; more"));
        // Everything is on the page.
        let height: f64 = document.root_element().attribute("height").unwrap().parse().unwrap();
        let places = all.iter().filter_map(|one| one.attribute("y")?.parse::<f64>().ok());
        assert!(places.into_iter().all(|y| (0.0..=height).contains(&y)));
    }

    #[test]
    fn a_run_without_robots_has_plots_alone() {
        let text = svg(&RunPicture { floors: Vec::new(), ..picture() });
        assert!(!text.contains("class=\"rn-robot") && text.contains("rn-e0"));
        roxmltree::Document::parse(&text).unwrap();
        roxmltree::Document::parse(&svg(&RunPicture::default())).unwrap();
    }
}
