//! Step functions of time: values that stay until the next one.

/// A function that is known from its first piece to its end, both included.
#[derive(Clone, Debug, PartialEq)]
pub struct Steps<V> {
    /// The time in nanoseconds from which on it has a value, and the value. The times grow.
    pub pieces: Vec<(u64, V)>,
    /// The last moment at which it is known.
    pub end_ns: u64,
}

/// What a formula is worth at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// How far it is from changing, in the unit of what is compared: positive where it holds.
    pub robustness: f64,
    /// Whether it holds. At a robustness of 0 only this tells.
    pub holds: bool,
}

impl<V: Copy> Steps<V> {
    /// It is known nowhere.
    pub(crate) const fn nowhere() -> Self {
        Self { pieces: Vec::new(), end_ns: 0 }
    }

    /// The first moment at which it is known.
    #[must_use]
    pub fn start_ns(&self) -> Option<u64> {
        self.pieces.first().map(|piece| piece.0)
    }

    /// The value at a moment.
    #[must_use]
    pub fn at(&self, at_ns: u64) -> Option<V> {
        let index = self.pieces.partition_point(|piece| piece.0 <= at_ns);
        let piece = self.pieces.get(index.checked_sub(1)?)?;
        (at_ns <= self.end_ns).then_some(piece.1)
    }

    /// Each piece with the moment at which the next one begins; the last one lasts to the end, which it includes.
    pub fn spans(&self) -> impl Iterator<Item = (u64, u64, V)> + '_ {
        let ends = self.pieces.iter().skip(1).map(|piece| piece.0);
        let ends = ends.chain([self.end_ns]);
        self.pieces.iter().zip(ends).map(|(piece, end)| (piece.0, end, piece.1))
    }

    /// Another function of the same moments.
    pub(crate) fn map<W>(&self, of: impl Fn(V) -> W) -> Steps<W> {
        let pieces = self.pieces.iter().map(|piece| (piece.0, of(piece.1))).collect();
        Steps { pieces, end_ns: self.end_ns }
    }

    /// A function of two, where both are known.
    pub(crate) fn join<W: Copy, X: Copy>(
        &self,
        other: &Steps<W>,
        of: impl Fn(V, W) -> X,
    ) -> Steps<X> {
        let (Some(one_ns), Some(other_ns)) = (self.start_ns(), other.start_ns()) else {
            return Steps::nowhere();
        };
        let (start_ns, end_ns) = (one_ns.max(other_ns), self.end_ns.min(other.end_ns));
        if start_ns > end_ns {
            return Steps::nowhere();
        }
        let mut pieces = Vec::with_capacity(self.pieces.len() + other.pieces.len());
        let (mut left, mut right) = (self.pieces.iter().peekable(), other.pieces.iter().peekable());
        let (mut one, mut two) = (None, None);
        let mut at_ns = start_ns;
        loop {
            while let Some(piece) = left.next_if(|piece| piece.0 <= at_ns) {
                one = Some(piece.1);
            }
            while let Some(piece) = right.next_if(|piece| piece.0 <= at_ns) {
                two = Some(piece.1);
            }
            if let (Some(one), Some(two)) = (one, two) {
                pieces.push((at_ns, of(one, two)));
            }
            let next = [left.peek().map(|piece| piece.0), right.peek().map(|piece| piece.0)];
            match next.into_iter().flatten().min() {
                Some(next_ns) if next_ns <= end_ns => at_ns = next_ns,
                Some(_) | None => break,
            }
        }
        Steps { pieces, end_ns }
    }
}
