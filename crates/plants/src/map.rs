//! The floor that a robot drives on: lines that it can see, walls that it cannot pass.

/// A place on the map in metres: x to the right and y upwards, as it is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
}

/// A straight piece of a line or a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) from: Point,
    pub(crate) to: Point,
}

/// A line on the floor: its pieces, and half of its width in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Line {
    pub(crate) pieces: Vec<Piece>,
    pub(crate) half_width_m: f64,
}

/// A line or a wall as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The ends of each straight piece.
    pub pieces: Vec<(Point, Point)>,
    /// How wide it is, in metres; walls have no width.
    pub width_m: f64,
    /// Whether it stops a robot.
    pub is_wall: bool,
}

/// Lines and walls.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Map {
    pub(crate) lines: Vec<Line>,
    pub(crate) walls: Vec<Piece>,
    /// Width and height of the drawing in metres; its top left corner is at (0, 0), so what is on it has negative y.
    pub size: (f64, f64),
}

impl Map {
    /// All lines, then all walls.
    #[must_use]
    pub fn strokes(&self) -> Vec<Stroke> {
        let ends = |pieces: &[Piece]| pieces.iter().map(|one| (one.from, one.to)).collect();
        let line = |line: &Line| Stroke {
            pieces: ends(&line.pieces),
            width_m: 2.0 * line.half_width_m,
            is_wall: false,
        };
        let walls = Stroke { pieces: ends(&self.walls), width_m: 0.0, is_wall: true };
        self.lines.iter().map(line).chain((!self.walls.is_empty()).then_some(walls)).collect()
    }

    /// Where its first line begins, and where that goes (radians, counter-clockwise from the right); `None` without
    /// lines.
    #[must_use]
    pub fn begin(&self) -> Option<(Point, f64)> {
        let first = self.lines.first()?.pieces.first()?;
        let (dx, dy) = (first.to.x - first.from.x, first.to.y - first.from.y);
        Some((first.from, libm::atan2(dy, dx)))
    }

    /// How dark the floor is under a round spot: 0 beside all lines, 1 on one, and in between while the spot is over an
    /// edge.
    #[must_use]
    pub fn darkness(&self, at: Point, spot_radius_m: f64) -> f64 {
        let mut darkest = 0.0_f64;
        for line in &self.lines {
            let nearest = line.pieces.iter().map(|piece| piece.distance(at));
            let beside = nearest.fold(f64::INFINITY, f64::min) - line.half_width_m;
            let dark = if spot_radius_m > 0.0 {
                (0.5 - beside / (2.0 * spot_radius_m)).clamp(0.0, 1.0)
            } else if beside <= 0.0 {
                1.0
            } else {
                0.0
            };
            darkest = darkest.max(dark);
        }
        darkest
    }

    /// The distance to the first wall in a direction (radians, counter-clockwise from the right); `None` if there is
    /// none within `most_m` metres.
    #[must_use]
    pub fn ray(&self, from: Point, heading: f64, most_m: f64) -> Option<f64> {
        let (dx, dy) = (libm::cos(heading), libm::sin(heading));
        let hits = self.walls.iter().filter_map(|wall| wall.hit(from, dx, dy));
        let nearest = hits.fold(f64::INFINITY, f64::min);
        (nearest <= most_m).then_some(nearest)
    }

    /// The distance to the nearest wall; infinite without walls.
    #[must_use]
    pub fn clearance(&self, at: Point) -> f64 {
        self.walls.iter().map(|wall| wall.distance(at)).fold(f64::INFINITY, f64::min)
    }

    /// The distance to the middle of the nearest line; infinite without lines.
    #[must_use]
    pub fn off_line(&self, at: Point) -> f64 {
        let pieces = self.lines.iter().flat_map(|line| &line.pieces);
        pieces.map(|piece| piece.distance(at)).fold(f64::INFINITY, f64::min)
    }
}

impl Piece {
    fn distance(&self, at: Point) -> f64 {
        let (dx, dy) = (self.to.x - self.from.x, self.to.y - self.from.y);
        let length = dx * dx + dy * dy;
        let (px, py) = (at.x - self.from.x, at.y - self.from.y);
        let share = if length > 0.0 { ((px * dx + py * dy) / length).clamp(0.0, 1.0) } else { 0.0 };
        let (ex, ey) = (px - share * dx, py - share * dy);
        (ex * ex + ey * ey).sqrt()
    }

    /// How far away a ray with a direction of length 1 meets it.
    fn hit(&self, from: Point, dx: f64, dy: f64) -> Option<f64> {
        let (wx, wy) = (self.to.x - self.from.x, self.to.y - self.from.y);
        let cross = dx * wy - dy * wx;
        if cross.abs() < 1e-12 {
            return None;
        }
        let (px, py) = (self.from.x - from.x, self.from.y - from.y);
        let along = (px * wy - py * wx) / cross;
        let share = (px * dy - py * dx) / cross;
        (along >= 0.0 && (0.0..=1.0).contains(&share)).then_some(along)
    }
}
