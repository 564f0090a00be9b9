//! The lanes between a board and its boxes: from where wires leave the board to where they end.
//!
//! Each wire has a vertical stretch in a lane; lanes are shared only by wires that are far from each
//! other. Among wires that go up, the upper ones turn first, and among those that go down the lower
//! ones: then they do not cross.

use super::area::Point;

/// Between two lanes.
const LANE: f64 = 5.0;
/// From the board's texts to the first lane, and from the last to the boxes.
const MARGIN: f64 = 8.0;
/// The distance of wires that share a lane.
const APART: f64 = 6.0;

/// A wire of one side: the heights at which it leaves and ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) from: f64,
    pub(super) to: Vec<f64>,
}

impl Run {
    fn span(&self) -> Point {
        let top = self.to.iter().copied().fold(self.from, f64::min);
        let bottom = self.to.iter().copied().fold(self.from, f64::max);
        (top, bottom)
    }

    /// Whether it needs no lane.
    pub(super) fn is_straight(&self) -> bool {
        let (top, bottom) = self.span();
        bottom - top < 0.3
    }

    fn goes_up(&self) -> bool {
        let (top, bottom) = self.span();
        self.from - top > bottom - self.from
    }
}

/// The lane of each run, from the board outwards, and the number of lanes.
pub(super) fn lanes(runs: &[Run]) -> (Vec<u16>, u16) {
    let mut order: Vec<usize> = (0..runs.len()).collect();
    let key = |index: &usize| {
        runs.get(*index).map_or((false, 0.0), |run| {
            let up = run.goes_up();
            (up, if up { run.from } else { -run.from })
        })
    };
    order.sort_by(|a, b| {
        let (one, other) = (key(a), key(b));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1)).then(a.cmp(b))
    });
    let mut lanes = vec![0; runs.len()];
    let mut placed: Vec<(u16, &Run)> = Vec::new();
    for index in order {
        let Some(run) = runs.get(index).filter(|run| !run.is_straight()) else { continue };
        let beside = || placed.iter().filter(|(_, other)| is_near(run, other));
        let same_way = beside().filter(|(_, other)| other.goes_up() == run.goes_up());
        let mut lane = same_way.map(|(lane, _)| lane + 1).max().unwrap_or(0);
        while beside().any(|(other, _)| *other == lane) {
            lane += 1;
        }
        placed.push((lane, run));
        if let Some(place) = lanes.get_mut(index) {
            *place = lane;
        }
    }
    let count = placed.iter().map(|(lane, _)| lane + 1).max().unwrap_or(0);
    (lanes, count)
}

fn is_near(one: &Run, other: &Run) -> bool {
    let (one, other) = (one.span(), other.span());
    one.0 - APART < other.1 && other.0 - APART < one.1
}

/// How far a lane is from the board's texts.
pub(super) fn lane_at(lane: u16) -> f64 {
    MARGIN + f64::from(lane) * LANE
}

/// How far the boxes are from the board's texts.
pub(super) fn boxes_at(lanes: u16) -> f64 {
    2.0 * MARGIN + f64::from(lanes.saturating_sub(1)) * LANE + 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(from: f64, to: f64) -> Run {
        Run { from, to: vec![to] }
    }

    #[test]
    fn wires_that_go_the_same_way_do_not_cross() {
        let up = [run(100.0, 10.0), run(120.0, 30.0), run(140.0, 50.0)];
        assert_eq!(lanes(&up), (vec![0, 1, 2], 3));
        let down = [run(10.0, 100.0), run(30.0, 120.0), run(50.0, 140.0)];
        assert_eq!(lanes(&down), (vec![2, 1, 0], 3));
    }

    #[test]
    fn lanes_are_shared_at_a_distance() {
        let apart = [run(10.0, 40.0), run(60.0, 90.0), run(200.0, 200.0)];
        assert_eq!(lanes(&apart), (vec![0, 0, 0], 1));
        assert!(apart[2].is_straight());
        assert_eq!(lanes(&[run(10.0, 60.0), run(90.0, 50.0)]), (vec![0, 1], 2));
    }
}
