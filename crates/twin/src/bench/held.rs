//! A quantity of the world that somebody holds while the board runs.

use std::collections::BTreeMap;

use sensedsl_wire::ScalarType;

use crate::arith::number;
use crate::truth::Subject;
use crate::world::{Shape, Signal};

/// The time in which a quantity goes to where it is held: a wheel cannot jump, and an encoder would miss steps.
const MOVES_NS: u64 = 100_000_000;

/// What is held, with the world's own signals of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Held {
    /// By subject and element.
    own: BTreeMap<(usize, usize), Signal>,
}

impl Held {
    /// Holds an element of a subject at a value from a moment on, or gives it back to the world.
    pub(super) fn hold(
        &mut self,
        (place, subject): (usize, &mut Subject),
        element: usize,
        shown: Option<f64>,
        now_ns: u64,
    ) {
        let is_bool = subject.scalar == ScalarType::Bool;
        let Some(signal) = subject.signals.get_mut(element) else { return };
        let now = signal.at(now_ns);
        let Some(shown) = shown.filter(|shown| shown.is_finite()) else {
            if let Some(own) = self.own.remove(&(place, element)) {
                *signal = continued(own, now, now_ns);
            }
            return;
        };
        let own = std::mem::replace(signal, moved(is_bool, (now_ns, now), shown));
        self.own.entry((place, element)).or_insert(own);
    }
}

/// A quantity that goes to a value and stays there.
fn moved(is_bool: bool, from: (u64, f64), to: f64) -> Signal {
    if is_bool {
        return Signal::of(Shape::Constant(to));
    }
    let there = (from.0.saturating_add(MOVES_NS), to);
    Signal::of(Shape::Points { points: vec![from, there], is_straight: true })
}

/// The world's own signal from a moment on. What grows steadily goes on from where it was held, as a counter cannot go
/// back.
fn continued(own: Signal, now: f64, now_ns: u64) -> Signal {
    let Shape::Rate { a_second, .. } = own.shape else { return own };
    let since_zero = a_second * number(now_ns) / 1e9;
    Signal { shape: Shape::Rate { from: now - since_zero, a_second }, ..own }
}
