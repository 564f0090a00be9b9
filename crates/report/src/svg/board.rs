//! The picture of one board with its parts: everything is placed here, then drawn.
//!
//! The order of decisions: contacts, their texts, the side of each part, how wires leave the board,
//! the boxes in the order of these wires, the lanes between, and last the board's name, which takes
//! what room is left.

use super::area::{Area, Point, Side};
use super::boxes::{self, PartBox};
use super::exits::{Start, Surroundings, WIRE_GAP, exits};
use super::labels::{labels, pads};
use super::landmarks;
use super::lanes::{self, Run, boxes_at};
use super::nets::{Net, nets, sides};
use super::parts::Part;
use super::shape::{Contact, PITCH, Shape};
use super::text::{Anchor, Text, cut, width};
use super::usages;

/// A board with its parts, placed.
#[derive(Debug)]
pub(super) struct Picture<'p> {
    pub(super) shape: &'p Shape<'p>,
    /// The texts beside its contacts, and the names of its connectors.
    pub(super) texts: Vec<Text>,
    pub(super) landmarks: Vec<landmarks::Placed>,
    pub(super) boxes: Vec<Placed<'p>>,
    pub(super) wires: Vec<Wire<'p>>,
}

/// A box, where its inner edge is, and the heights of the ends of its wires.
#[derive(Debug)]
pub(super) struct Placed<'p> {
    pub(super) part: PartBox<'p>,
    pub(super) x: f64,
    pub(super) marks: Vec<f64>,
}

/// A drawn net: lines from point to point, and where they branch.
#[derive(Debug)]
pub(super) struct Wire<'p> {
    pub(super) kind: &'p str,
    /// The pin, and the parts that it is wired to.
    pub(super) pin: &'p str,
    pub(super) parts: Vec<&'p str>,
    pub(super) lines: Vec<Vec<Point>>,
    pub(super) dots: Vec<Point>,
}

/// Places everything that belongs to a board.
pub(super) fn picture<'p>(
    shape: &'p Shape<'p>,
    parts: &'p [Part],
    is_used: &dyn Fn(&Contact<'_>) -> bool,
) -> Picture<'p> {
    let mut texts = labels(shape, is_used);
    let usages = usages::texts(shape, &texts, is_used);
    texts.extend(usages);
    let pads = pads(shape, is_used);
    let sides = sides(parts, shape);
    let nets = nets(parts, &sides, shape);
    let around = surroundings(shape, &texts, pads);
    let starts = nets.iter().filter_map(|net| {
        let at = shape.contacts.get(net.contact)?.at;
        Some(Start { contact: net.contact, at, side: net.side })
    });
    let exits = exits(&starts.collect::<Vec<_>>(), &around);
    let taken = taken(shape, &around.pads, &exits);
    add_captions(shape, &taken, &mut texts);
    let landmarks = landmarks::place(shape, &taken, &mut texts);
    let routed: Vec<Routed<'_, 'p>> =
        nets.iter().zip(&exits).filter(|(_, way)| !way.is_empty()).collect();
    let mut picture = Picture { shape, texts, landmarks, boxes: Vec::new(), wires: Vec::new() };
    for side in Side::BOTH {
        let routed: Vec<Routed<'_, 'p>> =
            routed.iter().copied().filter(|(net, _)| net.side == side).collect();
        let edge = match side {
            Side::Left => around.edges.0,
            Side::Right => around.edges.1,
        };
        one_side(&mut picture, parts, &sides, (side, edge), &routed);
    }
    picture
}

/// A net and how it leaves the board.
type Routed<'n, 'p> = (&'n Net<'p>, &'n Vec<Point>);

/// What names on the board must not touch: the marks of contacts, wires, and the plug.
fn taken(shape: &Shape<'_>, pads: &[Area], ways: &[Vec<Point>]) -> Vec<Area> {
    let lines = ways.iter().flat_map(|way| way.windows(2)).filter_map(|pair| match pair {
        [from, to] => Some(Area::of_line(*from, *to, WIRE_GAP)),
        _ => None,
    });
    pads.iter().copied().chain(lines).chain(shape.plug()).collect()
}

/// The names of connectors, where they touch nothing.
fn add_captions(shape: &Shape<'_>, taken: &[Area], texts: &mut Vec<Text>) {
    for (name, (x, y)) in &shape.captions {
        let name = cut(name, 9.0, 3.5 * PITCH);
        let half = width(&name, 9.0) / 2.0 + 3.0;
        let at = (x.max(half).min(shape.width - half), *y);
        let text = Text::new(at, 9.0, "sd-soft", &name).anchored(Anchor::Middle);
        let area = text.area();
        let mut others = texts.iter().map(Text::area).chain(taken.iter().copied());
        if !others.any(|other| other.meets(&area)) {
            texts.push(text);
        }
    }
}

/// What wires have to keep away from.
fn surroundings(shape: &Shape<'_>, texts: &[Text], pads: Vec<Area>) -> Surroundings {
    let texts: Vec<Area> = texts.iter().map(Text::area).collect();
    let own = Area { left: 0.0, top: 0.0, right: shape.width, bottom: shape.height };
    let all = texts.iter().fold(own, Area::with);
    Surroundings {
        pads,
        texts,
        edges: (all.left, all.right),
        heights: (all.top - 24.0, all.bottom + 24.0),
    }
}

/// Places the boxes and lanes of one side.
fn one_side<'p>(
    picture: &mut Picture<'p>,
    parts: &'p [Part],
    sides: &[Side],
    (side, edge): (Side, f64),
    nets: &[Routed<'_, 'p>],
) {
    let level = |way: &[Point]| way.last().map_or(0.0, |point| point.1);
    let exits: Vec<f64> = nets.iter().map(|(_, way)| level(way)).collect();
    let exit_of = |part: usize, wire: usize| {
        let mut all = nets.iter().zip(&exits);
        all.find(|((net, _), _)| net.ends.contains(&(part, wire))).map(|(_, exit)| *exit)
    };
    let (indices, mut stacked, wanted) =
        ordered(parts, sides, side, picture.shape.height, &exit_of);
    boxes::stack(&mut stacked, &wanted, picture.shape.height);
    let marks: Vec<Vec<f64>> = indices
        .iter()
        .zip(&stacked)
        .map(|(part, one)| marks(one, |wire| exit_of(*part, wire), &exits))
        .collect();
    let mark_of = |(part, wire): (usize, usize)| {
        let at = indices.iter().position(|index| *index == part)?;
        marks.get(at)?.get(wire).copied()
    };
    let runs: Vec<Run> = nets
        .iter()
        .zip(&exits)
        .map(|((net, _), from)| {
            let to = net.ends.iter().filter_map(|end| mark_of(*end)).collect();
            Run { from: *from, to }
        })
        .collect();
    let (lanes, count) = lanes::lanes(&runs);
    let outward = side.outward();
    let x = edge + outward * boxes_at(count);
    for ((run, lane), (net, way)) in runs.iter().zip(&lanes).zip(nets) {
        let lane = edge + outward * lanes::lane_at(*lane);
        let (lines, dots) = lines(way, run, (lane, x));
        let ends = net.ends.iter().filter_map(|(part, wire)| {
            let part = parts.get(*part)?;
            Some((part.name.as_str(), part.wires.get(*wire)?.pin.as_str()))
        });
        let pin = ends.clone().next().map_or("", |(_, pin)| pin);
        let parts = ends.map(|(part, _)| part).collect();
        picture.wires.push(Wire { kind: net.kind, pin, parts, lines, dots });
    }
    let placed = stacked.into_iter().zip(marks);
    picture.boxes.extend(placed.map(|(part, marks)| Placed { part, x, marks }));
}

/// The boxes of one side in the order of their wires, with the indices of their parts and the
/// heights that they want.
fn ordered<'p>(
    parts: &'p [Part],
    sides: &[Side],
    side: Side,
    bottom: f64,
    exit_of: &dyn Fn(usize, usize) -> Option<f64>,
) -> (Vec<usize>, Vec<PartBox<'p>>, Vec<f64>) {
    let mut found = Vec::new();
    for (index, part) in parts.iter().enumerate().filter(|(at, _)| sides.get(*at) == Some(&side)) {
        let exit = |wire: usize| exit_of(index, wire).unwrap_or(bottom);
        let mut order: Vec<usize> = (0..part.wires.len()).collect();
        order.sort_by(|a, b| exit(*a).total_cmp(&exit(*b)).then(a.cmp(b)));
        let one = PartBox { part, side, order, top: 0.0 };
        // Each end asks for the height at which its wire is straight.
        let mut wanted: Vec<f64> = Vec::new();
        for (wire, down) in one.ends() {
            wanted.extend(exit_of(index, wire).map(|exit| exit - down));
        }
        wanted.sort_by(f64::total_cmp);
        let middle = wanted.get(wanted.len() / 2).copied().unwrap_or(bottom);
        found.push((middle, index, one));
    }
    found.sort_by(|a, b| {
        let centre = |entry: &(f64, usize, PartBox<'_>)| entry.0 + entry.2.height() / 2.0;
        centre(a).total_cmp(&centre(b)).then(a.1.cmp(&b.1))
    });
    let wanted = found.iter().map(|entry| entry.0).collect();
    let indices = found.iter().map(|entry| entry.1).collect();
    (indices, found.into_iter().map(|entry| entry.2).collect(), wanted)
}

/// The heights of the ends of a box's wires, by the wire's index: beside their lines, but not where
/// another wire leaves the board, because the two would look like one.
fn marks(one: &PartBox<'_>, exit_of: impl Fn(usize) -> Option<f64>, exits: &[f64]) -> Vec<f64> {
    let mut marks = vec![one.top; one.part.wires.len()];
    for (wire, down) in one.ends() {
        let own = exit_of(wire);
        let line = one.top + down;
        let distance = |y: f64| {
            let others = exits.iter().filter(|exit| own != Some(**exit));
            others.map(|exit| (exit - y).abs()).fold(WIRE_GAP, f64::min)
        };
        let moves = [0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5, 2.0, -2.0];
        let straight = own.filter(|exit| (exit - line).abs() <= 2.0).map(|exit| exit - line);
        let mut best = (f64::NEG_INFINITY, line);
        for offset in straight.into_iter().chain(moves) {
            let found = distance(line + offset);
            if found > best.0 + 0.01 {
                best = (found, line + offset);
            }
        }
        if let Some(place) = marks.get_mut(wire) {
            *place = best.1;
        }
    }
    marks
}

/// The lines of a net: along its way to its lane, along the lane, and from there to its ends; where lines
/// meet.
fn lines(way: &[Point], run: &Run, (lane, x): Point) -> (Vec<Vec<Point>>, Vec<Point>) {
    let mut trunk = way.to_vec();
    let end = |y: f64| (x, y);
    if let [only] = run.to.as_slice() {
        if run.is_straight() {
            trunk.push(end(run.from));
        } else {
            trunk.extend([(lane, run.from), (lane, *only), end(*only)]);
        }
        return (vec![trunk], Vec::new());
    }
    trunk.push((lane, run.from));
    let mut lines = vec![trunk];
    let mut heights: Vec<f64> = run.to.iter().copied().chain([run.from]).collect();
    heights.sort_by(f64::total_cmp);
    let (Some(top), Some(bottom)) = (heights.first().copied(), heights.last().copied()) else {
        return (lines, Vec::new());
    };
    lines.push(vec![(lane, top), (lane, bottom)]);
    lines.extend(run.to.iter().map(|y| vec![(lane, *y), end(*y)]));
    // Where three lines or more meet.
    let meet = |y: &f64| {
        let ends = heights.iter().filter(|other| (*other - y).abs() < 0.3).count();
        ends + usize::from(*y > top + 0.3) + usize::from(*y < bottom - 0.3) >= 3
    };
    let dots = heights.iter().filter(|y| meet(y)).map(|y| (lane, *y)).collect();
    (lines, dots)
}
