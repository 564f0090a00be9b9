//! Writes the picture of one board as elements: outline, wires, contacts, texts, boxes.

use std::fmt::Write as _;

use super::area::{Area, Point};
use super::board::{Picture, Placed, Wire};
use super::boxes;
use super::landmarks;
use super::marks::{self, Unused};
use super::shape::{Carries, Contact, Shape};
use super::text::{Anchor, Text, cut, number};
use crate::markup::escaped;

/// The room that marks take around them.
const PAD: f64 = 13.0;

/// The wires of a pin, as far as its mark shows them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Use {
    pub(super) kind: String,
    /// Devices, role and signal.
    pub(super) words: String,
    pub(super) is_shared: bool,
}

/// Draws it and returns the room that it takes. `use_of` says what a pin is used for; `names` are the
/// lines that the board is labelled with, the first one in bold.
pub(super) fn draw(
    out: &mut String,
    picture: &Picture<'_>,
    use_of: &dyn Fn(&str) -> Option<Use>,
    names: &[String],
) -> Area {
    let shape = picture.shape;
    let mut room =
        Area { left: 0.0, top: 0.0, right: shape.width, bottom: shape.height }.grown(1.0);
    outline(out, shape, &mut room);
    landmarks::draw(out, &picture.landmarks);
    for wire in &picture.wires {
        room = draw_wire(out, wire, room);
    }
    for contact in &shape.contacts {
        draw_contact(out, contact, use_of);
    }
    let plate = plate(picture, names);
    for text in picture.texts.iter().chain(&plate) {
        room = room.with(&text.area());
        text.write(out);
    }
    for placed in &picture.boxes {
        let Placed { part, x, marks } = placed;
        let _ = writeln!(out, "<g data-part=\"{}\">", escaped(&part.part.name));
        room = room.with(&boxes::draw(out, part, *x, marks).grown(PAD));
        out.push_str("</g>\n");
    }
    room
}

/// The edge of the board and its plug.
fn outline(out: &mut String, shape: &Shape<'_>, room: &mut Area) {
    let (width, height) = (number(shape.width), number(shape.height));
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<rect x=\"0\" y=\"0\" width=\"{width}\" height=\"{height}\" rx=\"8\" class=\"sd-board\"/>"
    );
    let Some(area) = shape.plug() else { return };
    *room = room.with(&area.grown(1.0));
    let _ = writeln!(
        out,
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\" class=\"sd-taken\"/>",
        number(area.left),
        number(area.top),
        number(area.right - area.left),
        number(area.bottom - area.top)
    );
    let at = (f64::midpoint(area.left, area.right), f64::midpoint(area.top, area.bottom));
    Text::new(at, 9.0, "sd-ink", "USB").anchored(Anchor::Middle).write(out);
}

fn draw_wire(out: &mut String, wire: &Wire<'_>, room: Area) -> Area {
    let mut path = String::new();
    let mut room = room;
    for line in &wire.lines {
        for (at, (x, y)) in line.iter().enumerate() {
            let _ =
                write!(path, "{}{} {}", if at == 0 { 'M' } else { 'L' }, number(*x), number(*y));
            room = room.with(&Area::around((*x, *y), 4.0, 4.0));
        }
    }
    let kind = wire.kind;
    // By these names a page finds what it shows: of pins and of parts, which have no blank space.
    let (pin, parts) = (escaped(wire.pin), escaped(&wire.parts.join(" ")));
    let _ = writeln!(
        out,
        "<path d=\"{path}\" fill=\"none\" class=\"sd-wire sd-wire-{kind}\" data-pin=\"{pin}\" data-parts=\"{parts}\"/>"
    );
    for dot in &wire.dots {
        marks::circle(out, *dot, 3.0, &format!("sd-dot-{kind}"));
    }
    room
}

fn draw_contact(out: &mut String, contact: &Contact<'_>, use_of: &dyn Fn(&str) -> Option<Use>) {
    let used = contact.pin().and_then(|pin| use_of(pin.name.as_str()));
    let pin = contact
        .pin()
        .map_or(String::new(), |pin| format!(" data-pin=\"{}\"", escaped(&pin.name.to_string())));
    let _ = write!(out, "<g{pin}><title>{}</title>", escaped(&title(contact, used.as_ref())));
    match used {
        Some(used) => {
            marks::of_kind(out, contact.at, &used.kind);
            if used.is_shared {
                marks::shared(out, contact.at);
            }
        }
        None => marks::unused(out, contact.at, unused(contact)),
    }
    out.push_str("</g>\n");
}

/// What a contact without a wire is.
pub(super) fn unused(contact: &Contact<'_>) -> Unused {
    match contact.carries {
        Carries::Pin(_) if contact.kept_for.is_some() => Unused::Taken,
        Carries::Pin(pin) if pin.onboard.is_some() => Unused::WithCare,
        Carries::Pin(_) => Unused::Free,
        Carries::Signal("NC") | Carries::Unknown => Unused::Open,
        Carries::Signal(_) => Unused::Supply,
    }
}

/// All that is known about a contact, in words.
fn title(contact: &Contact<'_>, used: Option<&Use>) -> String {
    let mut words = vec![match contact.carries {
        Carries::Pin(pin) => pin.name.to_string(),
        Carries::Signal(signal) => signal.to_owned(),
        Carries::Unknown => "not in the table".to_owned(),
    }];
    words.extend(contact.label.map(|label| format!("printed {}", shortened(label))));
    words.extend(used.map(|used| used.words.clone()));
    if let Some(pin) = contact.pin() {
        let part = pin.onboard.as_ref().map(|part| part.part.as_str());
        words.extend(part.map(|part| format!("on the board: {part}")));
        let kept_for = contact.kept_for.as_deref().filter(|what| part != Some(what));
        words.extend(kept_for.filter(|_| used.is_none()).map(|what| format!("kept for {what}")));
        let usages: Vec<&str> = pin.usages.iter().map(|usage| usage.spelled.as_str()).collect();
        words.extend((!usages.is_empty()).then(|| format!("can be {}", usages.join(" "))));
    }
    let words = words.join("; ");
    match &contact.name {
        Some(name) => format!("{}: {words}", shortened(name)),
        None => words,
    }
}

/// A text of the table, which may be of any length.
fn shortened(text: &str) -> String {
    cut(text, 1.0, 14.0)
}

/// The board's name and MCU in the middle of the board, where they touch nothing; nothing if there is
/// no such place.
fn plate(picture: &Picture<'_>, names: &[String]) -> Vec<Text> {
    let shape = picture.shape;
    let taken = taken(picture);
    let sizes = [(15.0, 11.0), (12.0, 9.0), (10.0, 9.0)];
    let choices = sizes.into_iter().flat_map(|sizes| [(sizes, false), (sizes, true)]);
    for (sizes, is_turned) in choices {
        for step in 0..100_u8 {
            let offset = f64::from(step.div_ceil(2)) * 4.0;
            let offset = if step % 2 == 0 { offset } else { -offset };
            let middle = if shape.is_to_scale { shape.height / 2.0 + offset } else { 26.0 };
            let lines = lines(names, (shape.width / 2.0, middle), sizes, is_turned);
            let areas: Vec<Area> = lines.iter().map(|line| line.area().grown(6.0)).collect();
            let is_inside = |area: &Area| {
                area.left > 0.0
                    && area.top > 0.0
                    && area.right < shape.width
                    && area.bottom < shape.height
            };
            let is_free = |area: &Area| !taken.iter().any(|other| other.meets(area));
            if areas.iter().all(|area| is_inside(area) && is_free(area)) {
                return lines;
            }
        }
    }
    Vec::new()
}

/// The lines around a point.
fn lines(names: &[String], (x, y): Point, (first, others): Point, is_turned: bool) -> Vec<Text> {
    let mut lines = Vec::new();
    let mut offset = if names.len() > 1 { -first * 0.6 } else { 0.0 };
    for (index, name) in names.iter().enumerate() {
        let size = if index == 0 { first } else { others };
        let at = if is_turned { (x + offset, y) } else { (x, y + offset) };
        let class = if index == 0 { "sd-ink" } else { "sd-soft" };
        let text = Text::new(at, size, class, name).anchored(Anchor::Middle);
        lines.push(text.bold(index == 0).turned(is_turned));
        offset += first * 1.4;
    }
    lines
}

/// What the name of a board must not touch.
fn taken(picture: &Picture<'_>) -> Vec<Area> {
    let shape = picture.shape;
    let pads = shape.contacts.iter().map(|contact| Area::around(contact.at, PAD, PAD));
    let texts = picture.texts.iter().map(Text::area);
    let lines = picture.wires.iter().flat_map(|wire| &wire.lines).flat_map(|line| {
        line.windows(2).filter_map(|pair| match pair {
            [from, to] => Some(Area::of_line(*from, *to, 4.0)),
            _ => None,
        })
    });
    let landmarks = picture.landmarks.iter().map(|one| one.symbol.body);
    pads.chain(texts).chain(lines).chain(landmarks).chain(shape.plug()).collect()
}
