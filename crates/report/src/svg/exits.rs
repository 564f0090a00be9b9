//! How a wire leaves a board: from its contact to the edge of the room for lanes, between the
//! contacts and texts that are in its way.
//!
//! A wire goes straight if it can; otherwise it first goes up or down into the gap between two
//! contacts of its row, and once more where the gaps of the next row are not level with these. From
//! a row that runs across the board it goes between two neighbours.

use super::area::{Area, Point, Side};

/// The room that a wire keeps from contacts and texts.
const CLEARANCE: f64 = 3.4;
/// The room that it keeps where there is little.
const CLEARANCE_MIN: f64 = 2.4;
/// The least distance of two wires side by side.
pub(super) const WIRE_GAP: f64 = 3.2;

/// A contact that a wire begins at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub(super) contact: usize,
    pub(super) at: Point,
    pub(super) side: Side,
}

/// What is in the way.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    /// The areas of contacts, by their indices.
    pub(super) pads: Vec<Area>,
    pub(super) texts: Vec<Area>,
    /// Where the wires of each side have to get to: x on the left, x on the right.
    pub(super) edges: Point,
    /// The heights between which wires stay.
    pub(super) heights: Point,
}

/// The way of each start, in their order; empty if there is none. Those nearest to their edge
/// choose first.
pub(super) fn exits(starts: &[Start], around: &Surroundings) -> Vec<Vec<Point>> {
    let distance = |start: &Start| (start.at.0 - edge(start, around)).abs();
    let mut order: Vec<usize> = (0..starts.len()).collect();
    let key = |index: &usize| starts.get(*index).map_or(0.0, distance);
    order.sort_by(|a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    let mut found: Vec<Vec<Point>> = vec![Vec::new(); starts.len()];
    let mut wires: Vec<(usize, Line)> = Vec::new();
    for index in order {
        let Some(start) = starts.get(index) else { continue };
        let Some(way) = way(start, around, &wires) else { continue };
        let lines = way.windows(2).filter_map(Line::new);
        wires.extend(lines.map(|line| (start.contact, line)));
        if let Some(place) = found.get_mut(index) {
            *place = way;
        }
    }
    found
}

fn edge(start: &Start, around: &Surroundings) -> f64 {
    match start.side {
        Side::Left => around.edges.0,
        Side::Right => around.edges.1,
    }
}

/// A horizontal or vertical stretch of a wire.
#[derive(Clone, Copy, Debug)]
struct Line {
    from: Point,
    to: Point,
}

impl Line {
    fn new(pair: &[Point]) -> Option<Self> {
        match pair {
            [from, to] if from != to => Some(Self { from: *from, to: *to }),
            _ => None,
        }
    }

    fn is_horizontal(&self) -> bool {
        (self.from.1 - self.to.1).abs() < 0.01
    }

    fn area(&self, thickness: f64) -> Area {
        Area::of_line(self.from, self.to, thickness)
    }
}

/// The best way: the shortest detour, and few crossings of wires.
fn way(start: &Start, around: &Surroundings, wires: &[(usize, Line)]) -> Option<Vec<Point>> {
    const CROSSING: f64 = 6.0;
    let edge = edge(start, around);
    let near = beside(start.at, edge).into_iter().filter_map(|(detour, way)| {
        let crossings = judge(start, &way, (around, CLEARANCE), wires)?;
        Some((detour + CROSSING * f64::from(crossings), way))
    });
    let best = near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, way)| way);
    best.or_else(|| {
        let is_open = |from: Point, to: Point| {
            judge(start, &[from, to], (around, CLEARANCE_MIN), wires).is_some()
        };
        let mut far = jogs(start.at, edge, &is_open);
        far.extend(between(start.at, edge, around.heights));
        far.sort_by(|a, b| a.0.total_cmp(&b.0));
        let free = |room: f64| {
            let mut ways = far.iter().map(|(_, way)| way);
            ways.find(|way| judge(start, way, (around, room), wires).is_some()).cloned()
        };
        free(CLEARANCE).or_else(|| free(CLEARANCE_MIN))
    })
}

/// Ways straight to the edge, or through a gap beside the contact, with their detours.
fn beside((x, y): Point, edge: f64) -> Vec<(f64, Vec<Point>)> {
    const STEP: f64 = 0.5;
    const STEPS: i32 = 27;
    let steps = (0..=STEPS).flat_map(|step| if step == 0 { vec![0] } else { vec![step, -step] });
    let way = |step: i32| {
        let down = f64::from(step) * STEP;
        (down.abs(), vec![(x, y), (x, y + down), (edge, y + down)])
    };
    steps.map(way).collect()
}

/// Ways through the gaps of two rows that are not level with each other, as far as their first two stretches are open.
fn jogs(
    (x, y): Point,
    edge: f64,
    is_open: &dyn Fn(Point, Point) -> bool,
) -> Vec<(f64, Vec<Point>)> {
    const STEP: f64 = 3.0;
    let steps = |count: i32| (-count..=count).map(f64::from);
    let mut firsts: Vec<f64> = steps(9).filter(|one| is_open((x, y), (x, y + one))).collect();
    let aside = (edge - x).signum();
    let mut ways = Vec::new();
    let mut along = STEP;
    while along < (edge - x).abs() {
        let bend = x + aside * along;
        // What is blocked stays blocked further out.
        firsts.retain(|first| is_open((x, y + first), (bend, y + first)));
        let pairs = firsts.iter().flat_map(|one| steps(16).map(move |other| (*one, other)));
        for (first, second) in pairs {
            let detour = f64::abs(first) + (second - first).abs() + 10.0;
            let (near, far) = (y + first, y + second);
            let points = vec![(x, y), (x, near), (bend, near), (bend, far), (edge, far)];
            ways.push((detour, points));
        }
        along += STEP;
    }
    ways
}

/// Ways along a gap between two neighbours of a row that runs across the board.
fn between((x, y): Point, edge: f64, (top, bottom): Point) -> Vec<(f64, Vec<Point>)> {
    const STEP: f64 = 2.0;
    let mut ways = Vec::new();
    for aside in [0.0, 9.0, -9.0, 10.2, -10.2, 11.4, -11.4] {
        let mut level = top;
        while level <= bottom {
            let detour = f64::abs(aside) + (level - y).abs();
            let bend = x + aside;
            ways.push((detour, vec![(x, y), (bend, y), (bend, level), (edge, level)]));
            level += STEP;
        }
    }
    ways
}

/// The number of wires that a way crosses; none if something is in the way.
fn judge(
    start: &Start,
    way: &[Point],
    (around, room): (&Surroundings, f64),
    wires: &[(usize, Line)],
) -> Option<u16> {
    let mut crossings: u16 = 0;
    for line in way.windows(2).filter_map(Line::new) {
        let room = line.area(room);
        let others = around.pads.iter().enumerate().filter(|(at, _)| *at != start.contact);
        if others.map(|(_, pad)| pad).chain(&around.texts).any(|area| area.meets(&room)) {
            return None;
        }
        for (_, other) in wires.iter().filter(|(contact, _)| *contact != start.contact) {
            if other.is_horizontal() == line.is_horizontal() {
                if other.area(WIRE_GAP).meets(&line.area(WIRE_GAP)) {
                    return None;
                }
            } else if other.area(0.1).meets(&line.area(0.1)) {
                crossings += 1;
            }
        }
    }
    Some(crossings)
}
