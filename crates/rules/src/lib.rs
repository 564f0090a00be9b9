//! What must hold of signals over time.
//!
//! In: signals as they were sampled ([`Trace`]), and rules over them. Out: for each [`Rule`] whether it held, the first
//! moment at which it did not, and by how much. The meaning is that of signal temporal logic with bounded intervals
//! (Maler and Nickovic 2004), the robustness that of Donzé and Maler (2010). The crate knows neither devices nor units
//! nor texts: signals are numbered, and their values are in whatever unit the caller compares them.
//!
//! # The meaning, exactly
//!
//! - A signal is a step function: from a sample on it has that sample's value, until the next one comes; the last value
//!   lasts to the end of the trace. Before its first sample it has no value, and no rule looks there.
//! - A comparison holds as its operator says. Its robustness is the difference of its sides, positive where it holds:
//!   `a < b` and `a <= b` have `b - a`, `a == b` has `-|a - b|`, `a != b` has `|a - b|`.
//! - `not` turns the sign; `and` has the smaller, `or` the greater of its sides.
//! - `rising(f)` is true from the sample that makes `f` true until the next sample of any signal in `f`.
//! - `always` over `[t + a, t + b]` has the smallest robustness in that closed interval, `eventually` the greatest. It is
//!   known only where the whole interval lies within the trace.
//! - A rule is violated by what is known. What the end of the trace leaves open is counted and is not a violation.

mod evaluate;
mod formula;
mod rule;
mod steps;
mod trace;
mod window;

pub use evaluate::{evaluate, values};
pub use formula::{Compare, Formula, Term};
pub use rule::{Outcome, Rule, Shape, Verdict};
pub use steps::{Steps, Truth};
pub use trace::{Signal, Trace};
