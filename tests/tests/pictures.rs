//! The picture of a wiring, on every built-in board: no text touches another one or a wire, nothing is outside of the
//! page, and every pin in use has a wire.
//!
//! The picture is read back from its XML with metrics of its own.

use std::collections::BTreeSet;

use sensedsl_board::catalog::{self, Entry};
use sensedsl_board::silicon::{self, PinRole};
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_report::{rows, svg::svg};
use sensedsl_wiring::{Search, Solved, Wiring};

use sensedsl_tests::{is_exhaustive, one_in, root, sensedsl, text};

use crate::boards::captures;

/// The width of a character and the height of a line above and below its baseline, as multiples of the font size.
const BREADTH: f64 = 0.62;
const ABOVE: f64 = 0.72;
const BELOW: f64 = 0.2;

/// A rectangle: left, top, right, bottom.
#[derive(Clone, Copy, Debug)]
struct Area([f64; 4]);

impl Area {
    fn meets(&self, Self(other): &Self) -> bool {
        let [left, top, right, bottom] = self.0;
        left < other[2] && other[0] < right && top < other[3] && other[1] < bottom
    }

    fn middle(&self) -> (f64, f64) {
        let [left, top, right, bottom] = self.0;
        (f64::midpoint(left, right), f64::midpoint(top, bottom))
    }

    /// The ends of the horizontal or vertical line that it is.
    fn ends(&self) -> [(f64, f64); 2] {
        let [left, top, right, bottom] = self.0;
        [(left + 1.0, top + 1.0), (right - 1.0, bottom - 1.0)]
    }

    fn is_in(&self, Self(page): &Self) -> bool {
        let [left, top, right, bottom] = self.0;
        left >= page[0] && top >= page[1] && right <= page[2] && bottom <= page[3]
    }
}

/// What is drawn.
#[derive(Debug, Default)]
struct Picture {
    page: Option<Area>,
    texts: Vec<(String, Area)>,
    /// The letters in marks, where wires end.
    letters: Vec<Area>,
    /// The straight lines of wires, and the number of wires.
    lines: Vec<Area>,
    wires: usize,
    /// Rectangles and circles.
    shapes: Vec<Area>,
}

fn is_near(one: (f64, f64), other: (f64, f64)) -> bool {
    (one.0 - other.0).abs() < 1.5 && (one.1 - other.1).abs() < 1.5
}

fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    let at = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[at..].split('"').next()
}

fn number(tag: &str, name: &str) -> f64 {
    attribute(tag, name)
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{name} of {tag}"))
}

fn text_area(tag: &str, content: &str) -> Area {
    let (x, y, size) = (number(tag, "x"), number(tag, "y"), number(tag, "font-size"));
    let plain = content
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&amp;", "&");
    let long = plain.chars().count() as f64 * BREADTH * size;
    let start = match attribute(tag, "text-anchor") {
        Some("middle") => -long / 2.0,
        Some("end") => -long,
        _ => 0.0,
    };
    if attribute(tag, "transform").is_some_and(|turn| turn.starts_with("rotate(-90 ")) {
        return Area([x - ABOVE * size, y - start - long, x + BELOW * size, y - start]);
    }
    Area([x + start, y - ABOVE * size, x + start + long, y + BELOW * size])
}

fn line_areas(path: &str) -> Vec<Area> {
    let mut areas = Vec::new();
    let mut last = None;
    for (at, _) in path.match_indices(['M', 'L']) {
        let rest = path[at + 1..].split(['M', 'L']).next().unwrap();
        let (x, y) = rest.split_once(' ').unwrap();
        let here: (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        if let Some((x, y)) = last.filter(|_| path[at..].starts_with('L')) {
            let (x, y): (f64, f64) = (x, y);
            assert!(
                (x - here.0).abs() < 0.11 || (y - here.1).abs() < 0.11,
                "{path} has an oblique line"
            );
            areas.push(Area([
                x.min(here.0) - 1.0,
                y.min(here.1) - 1.0,
                x.max(here.0) + 1.0,
                y.max(here.1) + 1.0,
            ]));
        }
        last = Some(here);
    }
    areas
}

/// Reads a picture back.
fn read(svg: &str) -> Picture {
    let mut picture = Picture::default();
    let mut moves = vec![(0.0, 0.0)];
    for (at, _) in svg.match_indices('<') {
        let (tag, after) = svg[at + 1..].split_once('>').unwrap();
        let (dx, dy) = *moves.last().unwrap();
        let moved = |Area([left, top, right, bottom]): Area| {
            Area([left + dx, top + dy, right + dx, bottom + dy])
        };
        match tag.split([' ', '/']).next().unwrap() {
            "svg" => {
                let [.., width, height] = [number(tag, "width"), number(tag, "height")];
                picture.page = Some(Area([0.0, 0.0, width, height]));
            }
            "g" => {
                let own =
                    attribute(tag, "transform").and_then(|text| text.strip_prefix("translate("));
                let own = own.and_then(|text| text.strip_suffix(')')?.split_once(' '));
                let (x, y) =
                    own.map_or((0.0, 0.0), |(x, y)| (x.parse().unwrap(), y.parse().unwrap()));
                moves.push((dx + x, dy + y));
            }
            "" if tag == "/g" => {
                moves.pop();
            }
            "text" => {
                let content = after.split('<').next().unwrap();
                let area = moved(text_area(tag, content));
                if attribute(tag, "class").is_some_and(|class| class.starts_with("sd-on-")) {
                    picture.letters.push(area);
                } else {
                    picture.texts.push((content.to_owned(), area));
                }
            }
            "path"
                if attribute(tag, "class").is_some_and(|class| class.starts_with("sd-wire ")) =>
            {
                picture.wires += 1;
                picture
                    .lines
                    .extend(line_areas(attribute(tag, "d").unwrap()).into_iter().map(moved));
            }
            "rect" if attribute(tag, "width") != Some("100%") => {
                let (x, y) = (number(tag, "x"), number(tag, "y"));
                let (right, bottom) = (x + number(tag, "width"), y + number(tag, "height"));
                picture.shapes.push(moved(Area([x, y, right, bottom])));
            }
            "circle" => {
                let (x, y, r) = (number(tag, "cx"), number(tag, "cy"), number(tag, "r"));
                picture.shapes.push(moved(Area([x - r, y - r, x + r, y + r])));
            }
            _ => {}
        }
    }
    picture
}

/// What is wrong with a picture.
fn faults(picture: &Picture) -> Vec<String> {
    let page = picture.page.expect("it has a size");
    let mut faults = Vec::new();
    for (at, (text, area)) in picture.texts.iter().enumerate() {
        for (other, its) in &picture.texts[at + 1..] {
            if area.meets(its) {
                faults.push(format!("{text} touches {other}"));
            }
        }
        if picture.lines.iter().any(|line| line.meets(area)) {
            faults.push(format!("a wire crosses {text}"));
        }
        if picture.letters.iter().any(|letter| letter.meets(area)) {
            faults.push(format!("a mark covers {text}"));
        }
    }
    for letter in &picture.letters {
        // A wire ends in the middle of its mark, and passes no other one.
        let middle = letter.middle();
        let passes = |line: &&Area| line.ends().iter().all(|end| !is_near(*end, middle));
        if picture.lines.iter().filter(passes).any(|line| line.meets(letter)) {
            faults.push(format!("a wire crosses the mark at {middle:?}"));
        }
    }
    let texts = picture.texts.iter().map(|(_, area)| area);
    let outside =
        texts.chain(&picture.lines).chain(&picture.shapes).filter(|area| !area.is_in(&page));
    faults.extend(outside.map(|area| format!("{area:?} is not on the page")));
    faults
}

/// A design with parts of many kinds, or a smaller one.
fn designs(entry: &Entry) -> [String; 2] {
    let release = if entry.name == "STM32L-DISCOVERY" { "release LCD;" } else { "" };
    let few = "sensor Front returns uint16 { id = 17; type = analog; }
        sensor Rear returns uint16 { id = 19; driver = srf08; address = 0x73; delay = 70; }";
    let wheel =
        if captures(entry) { "sensor Wheel returns uint32 { id = 20; type = icu; }" } else { "" };
    let more = "sensor Side returns uint16 { id = 1; type = analog; }
        actuator Steering accepts uint16 { id = 2; type = pwm; }
        sensor Bumper returns bool { id = 3; type = digital; }
        actuator Lamp accepts bool { id = 4; type = digital; }
        chip Climate { driver = bme280; sensor Temperature returns int32 { id = 5; } sensor Humidity returns uint32 { id = 6; } }
        sensor Angle returns uint16 { id = 7; type = spi; }";
    let head = format!("board Rover on {} {{ {release}", entry.name.replace('-', "_"));
    [format!("{head} {few} {wheel} {more} }}"), format!("{head} {few} {wheel} }}")]
}

/// The picture of the first design that can be wired, and the pins that are used.
fn picture(entry: &Entry) -> (String, BTreeSet<String>) {
    let wired = designs(entry).iter().find_map(|text| {
        let request = Request { path: "rover.sense", text, board: None, target: Some("none") };
        let resolved = resolve(&request, &NoFiles);
        let design =
            resolved.design.unwrap_or_else(|| panic!("{}: {:?}", entry.name, resolved.diagnostics));
        let Solved::Wired(wiring) = Wiring::new(&design, None).solve(&Search::default()) else {
            return None;
        };
        let pins = rows(&design, &wiring).into_iter().map(|row| row.pin).collect();
        Some((svg(&design, &wiring), pins))
    });
    wired.unwrap_or_else(|| panic!("{} cannot be wired", entry.name))
}

/// The pins that the MCU needs for itself and that the picture shows as free.
fn free_by_mistake(entry: &Entry, svg: &str) -> Vec<String> {
    let roles = silicon::pin_roles(entry.mcu).into_iter();
    let needed: Vec<String> = roles
        .filter(|(_, role)| *role != PinRole::Oscillator)
        .map(|(pin, _)| pin.to_string())
        .collect();
    let contacts = svg.split("<g><title>").skip(1).filter_map(|rest| rest.split_once("</title>"));
    let free = contacts.filter(|(_, mark)| mark.lines().next().unwrap().contains("\"sd-free\""));
    let pins = free.filter_map(|(title, _)| title.split("; ").next()?.split(' ').next_back());
    pins.filter(|pin| needed.iter().any(|one| one == pin)).map(str::to_owned).collect()
}

#[test]
fn no_text_touches_anything_on_any_board() {
    let (mut found, mut missing) = (Vec::new(), 0);
    let step = if is_exhaustive() { 1 } else { 3 };
    for entry in one_in(4, catalog::all().iter().step_by(step)) {
        let (svg, pins) = picture(entry);
        let picture = read(&svg);
        found.extend(faults(&picture).into_iter().map(|fault| format!("{}: {fault}", entry.name)));
        let free = free_by_mistake(entry, &svg).into_iter();
        found.extend(free.map(|pin| format!("{}: {pin} looks free", entry.name)));
        missing += pins.len().saturating_sub(picture.wires);
        assert!(picture.texts.len() > 30 && picture.shapes.len() > 20, "{}", entry.name);
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    // Where no way is free, a pin has only its marks.
    assert!(missing <= 1, "{missing} wires are missing");
}

#[test]
fn a_fault_is_found() {
    let page = |body: &str| read(&format!("<svg width=\"100\" height=\"50\">{body}</svg>"));
    let text = |x: u8, content: &str| {
        format!("<text x=\"{x}\" y=\"20\" font-size=\"10\">{content}</text>")
    };
    assert_eq!(faults(&page(&(text(10, "one") + &text(40, "two")))), [""; 0]);
    assert_eq!(faults(&page(&(text(10, "one") + &text(20, "two")))), ["one touches two"]);
    assert_eq!(
        faults(&page(&text(90, "&lt;out")))[0].split(']').nth(1),
        Some(") is not on the page")
    );
    let wire = "<g transform=\"translate(5 0)\"><path d=\"M0 17L50 17\" class=\"sd-wire sd-wire-pwm\"/></g>";
    assert_eq!(faults(&page(&(text(10, "one") + wire))), ["a wire crosses one"]);
}

/// A board with a form is drawn to scale, with the USB plug up.
#[test]
fn contacts_are_where_they_are_on_the_board() {
    let at = |svg: &str, contact: &str| {
        let after =
            svg.split(&format!("<title>{contact}: ")).nth(1).unwrap_or_else(|| panic!("{contact}"));
        let tag = after.split_once("</title><").unwrap().1.split('>').next().unwrap();
        if tag.starts_with("circle") {
            (number(tag, "cx"), number(tag, "cy"))
        } else {
            (
                number(tag, "x") + number(tag, "width") / 2.0,
                number(tag, "y") + number(tag, "height") / 2.0,
            )
        }
    };
    for (board, from, to, millimetres) in [
        ("NUCLEO-F446RE", "CN7.1", "CN10.2", (63.5, 0.0)),
        ("NUCLEO-F446RE", "CN7.1", "CN8.6", (7.62, 45.69)),
        ("RASPBERRYPI-PICO", "Pico.1", "Pico.21", (17.7, 48.26)),
        ("ARDUINO-UNO-R3", "POWER.1", "ANALOG.6", (0.0, 35.56)),
        ("ARDUINO-UNO-R3", "POWER.1", "DIGITAL_L.1", (48.26, 35.56)),
    ] {
        let (svg, _) = picture(catalog::find(board).unwrap());
        let ((x, y), (to_x, to_y)) = (at(&svg, from), at(&svg, to));
        let scale = 8.0;
        let wrong =
            (to_x - x - scale * millimetres.0).abs().max((to_y - y - scale * millimetres.1).abs());
        assert!(wrong < 0.25, "{board}: {from} {x} {y}, {to} {to_x} {to_y}");
    }
}

/// The pictures of the README are those of the program; `SENSEDSL_BLESS=1` writes them again.
#[test]
fn the_readme_shows_what_the_program_draws() {
    let calls: [(&str, &[&str]); 2] = [
        ("docs/pinout.svg", &["examples/fig2.sense", "--board", "STM32F407G-DISC1"]),
        ("docs/line_follower.svg", &["examples/line_follower.sense"]),
    ];
    for (page, call) in calls {
        let picture = sensedsl(["solve", "-q", "--format", "svg"]).args(call).run().exits(0).stdout;
        if std::env::var("SENSEDSL_BLESS").is_ok() {
            std::fs::write(root().join(page), &picture).unwrap();
        }
        assert!(text(page) == picture, "{page} is of another wiring: SENSEDSL_BLESS=1");
    }
}
