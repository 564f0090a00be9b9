//! The smallest value of a step function in a window that slides along it.

use std::collections::VecDeque;

use crate::steps::Steps;

/// At each moment `t` the smallest value in `[t + from_ns, t + to_ns]`, where that is known as a whole.
///
/// Each value enters the window once and leaves it once, and those that can never be the smallest any more are dropped
/// (Lemire 2006): the time grows with the number of pieces, whatever the window is.
pub(crate) fn least(of: &Steps<f64>, from_ns: u64, to_ns: u64) -> Steps<f64> {
    let Some(known_ns) = of.start_ns() else { return Steps::nowhere() };
    let start_ns = known_ns.saturating_sub(from_ns);
    let Some(end_ns) = of.end_ns.checked_sub(to_ns).filter(|end_ns| *end_ns >= start_ns) else {
        return Steps::nowhere();
    };
    let mut pieces: Vec<(u64, f64)> = Vec::new();
    let mut entering = of.pieces.iter().peekable();
    // Values that can still be the smallest, with the moments at which they end; from the front on they grow.
    let mut inside: VecDeque<(u64, f64)> = VecDeque::new();
    let mut ends = of.pieces.iter().skip(1).map(|piece| piece.0);
    let mut at_ns = start_ns;
    loop {
        let reach_ns = at_ns.saturating_add(to_ns);
        while let Some((_, value)) = entering.next_if(|piece| piece.0 <= reach_ns) {
            // The last piece never leaves.
            let ends_ns = ends.next().unwrap_or(u64::MAX);
            while inside.back().is_some_and(|last| is_no_less(last.1, *value)) {
                let _ = inside.pop_back();
            }
            inside.push_back((ends_ns, *value));
        }
        let left_ns = at_ns.saturating_add(from_ns);
        while inside.front().is_some_and(|first| first.0 <= left_ns) {
            let _ = inside.pop_front();
        }
        if let Some((_, value)) = inside.front() {
            pieces.push((at_ns, *value));
        }
        let leaves = inside.front().map(|first| first.0.saturating_sub(from_ns));
        let enters = entering.peek().map(|piece| piece.0.saturating_sub(to_ns));
        match [leaves, enters].into_iter().flatten().filter(|next_ns| *next_ns > at_ns).min() {
            Some(next_ns) if next_ns <= end_ns => at_ns = next_ns,
            Some(_) | None => break,
        }
    }
    Steps { pieces, end_ns }
}

/// Whether a value can go once the other one has come: it is not smaller, or it is not a number.
fn is_no_less(one: f64, other: f64) -> bool {
    one >= other || one.is_nan()
}
