//! The ways of wires around a board, in Wokwi's words: `v-20`, `h30`, with those at the part's end after `*`.
//!
//! In: a contact of the board and one of a part. Out: moves from both ends that meet in a lane, which no other wire
//! has. A wire leaves the board over the nearest edge; if that is the far one, it goes below the board to the other
//! side.

/// The space between wires.
const STEP: i32 = 6;
/// The wires that lanes on one side, or channels above and below the board, are made for.
const LANES: i32 = 30;
/// The space between the board and the first lane.
const FIRST: i32 = 14;

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) width: i32,
    pub(super) height: i32,
}

/// A side of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

impl Side {
    fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// An edge of a rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edge {
    Side(Side),
    Top,
    Bottom,
}

impl Area {
    /// The edge that is nearest to a contact in it.
    fn edge(self, (x, y): (i32, i32)) -> Edge {
        let edges = [
            (self.height - y, Edge::Bottom),
            (y, Edge::Top),
            (x, Edge::Side(Side::Left)),
            (self.width - x, Edge::Side(Side::Right)),
        ];
        edges.into_iter().min_by_key(|(far, _)| *far).map_or(Edge::Bottom, |(_, edge)| edge)
    }
}

/// The lanes around a board.
#[derive(Debug)]
pub(super) struct Lanes {
    board: Area,
    /// The lanes taken on the left and on the right, and the channels above and below.
    left: i32,
    right: i32,
    above: i32,
    below: i32,
}

impl Lanes {
    pub(super) fn around(board: Area) -> Self {
        Self { board, left: 0, right: 0, above: 0, below: 0 }
    }

    /// The lower end of the board with its channels.
    pub(super) fn bottom(&self) -> i32 {
        self.board.top + self.board.height + FIRST + STEP * self.below.min(LANES)
    }

    /// Where the column on a side begins.
    pub(super) fn end(&self, side: Side) -> i32 {
        self.x(side, LANES + 1)
    }

    fn x(&self, side: Side, number: i32) -> i32 {
        let away = FIRST + STEP * number;
        match side {
            Side::Left => self.board.left - away,
            Side::Right => self.board.left + self.board.width + away,
        }
    }

    /// The next lane on a side.
    fn lane(&mut self, side: Side) -> i32 {
        let taken = match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        };
        *taken += 1;
        let number = *taken % LANES;
        self.x(side, number)
    }

    /// The next channel below the board.
    fn channel(&mut self) -> i32 {
        self.below += 1;
        self.board.top + self.board.height + FIRST + STEP * (self.below % LANES)
    }

    /// The moves of a wire from a contact of the board to one of a part in the column on a side, of which it is the
    /// wire of that number.
    pub(super) fn route(
        &mut self,
        from: (i32, i32),
        (part, end): (Area, (i32, i32)),
        side: Side,
        number: i32,
    ) -> Vec<String> {
        let lane = self.lane(side);
        let mut moves = self.leave(from, side, lane);
        moves.push("*".to_owned());
        let mut arrive = arrive(part, end, side, (lane, number));
        // They are told from the lane to the part.
        arrive.reverse();
        moves.append(&mut arrive);
        moves.retain(|one| one != "h0" && one != "v0");
        moves
    }

    /// The moves from a contact of the board into a lane.
    fn leave(&mut self, from: (i32, i32), side: Side, lane: i32) -> Vec<String> {
        let (x, y) = (self.board.left + from.0, self.board.top + from.1);
        match self.board.edge(from) {
            Edge::Side(near) if near == side => vec![h(lane - x)],
            Edge::Side(_) => {
                let (around, channel) = (self.lane(side.other()), self.channel());
                vec![h(around - x), v(channel - y), h(lane - around)]
            }
            Edge::Top => {
                self.above += 1;
                let channel = self.board.top - FIRST - STEP * (self.above % LANES);
                vec![v(channel - y), h(lane - x)]
            }
            Edge::Bottom => {
                let channel = self.channel();
                vec![v(channel - y), h(lane - x)]
            }
        }
    }
}

/// The moves from a contact of a part into a lane.
fn arrive(part: Area, end: (i32, i32), side: Side, (lane, number): (i32, i32)) -> Vec<String> {
    let (x, y) = (part.left + end.0, part.top + end.1);
    let out = STEP * (number + 1);
    let bottom = part.top + part.height + out;
    match part.edge(end) {
        Edge::Bottom => vec![v(bottom - y), h(lane - x)],
        Edge::Top => vec![v(part.top - out - y), h(lane - x)],
        Edge::Side(near) if near != side => vec![h(lane - x)],
        Edge::Side(far) => {
            let away = if far == Side::Right { out } else { -out };
            vec![h(away), v(bottom - y), h(lane - x - away)]
        }
    }
}

fn h(by: i32) -> String {
    format!("h{by}")
}

fn v(by: i32) -> String {
    format!("v{by}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOARD: Area = Area { left: 0, top: 0, width: 80, height: 200 };
    const PART: Area = Area { left: 300, top: 50, width: 60, height: 40 };

    fn moves(from: (i32, i32), end: (i32, i32)) -> String {
        Lanes::around(BOARD).route(from, (PART, end), Side::Right, 0).join(" ")
    }

    #[test]
    fn wires_meet_in_their_lane() {
        // The first lane is at x = 100.
        assert_eq!(moves((75, 60), (30, 38)), "h25 * h-230 v8");
        assert_eq!(moves((40, 4), (0, 20)), "v-24 h60 * h-200");
        // From the far edge, below the board: x = -20, y = 220.
        assert_eq!(moves((5, 60), (30, 38)), "h-25 v160 h120 * h-230 v8");
        // From the far edge of the part, below it.
        assert_eq!(moves((75, 60), (60, 20)), "h25 * h-266 v26 h6");
    }

    #[test]
    fn each_wire_has_a_lane() {
        let mut lanes = Lanes::around(BOARD);
        let all: Vec<i32> = (0..20).map(|_| lanes.lane(Side::Left)).collect();
        assert!(all.windows(2).all(|pair| pair[0] - pair[1] == STEP), "{all:?}");
        assert!(all.iter().all(|x| *x > lanes.end(Side::Left) && *x < 0));
    }
}
