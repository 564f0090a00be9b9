//! How much a run tries: `SENSEDSL_THOROUGH` and `SENSEDSL_SEED`.

use super::Random;

/// The share of the heaviest cases that an exhaustive run draws: one in so many.
const ONE_IN: usize = 12;

fn level() -> u32 {
    std::env::var("SENSEDSL_THOROUGH").ok().and_then(|level| level.parse().ok()).unwrap_or(0)
}

/// Whether the cases that quick runs leave out are requested as well: `SENSEDSL_THOROUGH=1`, as in
/// CI.
#[must_use]
pub fn is_thorough() -> bool {
    level() >= 1
}

/// Whether cases that take many minutes are requested as well: `SENSEDSL_THOROUGH=2`, as in
/// `.ci/full`.
#[must_use]
pub fn is_exhaustive() -> bool {
    level() >= 2
}

/// Whether all cases of the heaviest tests are requested: `SENSEDSL_THOROUGH=3`, which takes hours.
#[must_use]
pub fn is_whole() -> bool {
    level() >= 3
}

/// Random numbers of a case; others with another `SENSEDSL_SEED`.
fn seeded(case: &str) -> Random {
    let seed = std::env::var("SENSEDSL_SEED").unwrap_or_default();
    // FNV-1a, which is the same on every machine.
    let hash = seed
        .bytes()
        .chain(*b"/")
        .chain(case.bytes())
        .fold(0xCBF2_9CE4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        });
    Random::new(hash)
}

/// Whether an exhaustive run has the case, of which it has one in twelve; `SENSEDSL_SEED` draws them.
/// A whole run has all.
#[must_use]
pub fn is_drawn(case: &str) -> bool {
    is_whole() || (is_exhaustive() && seeded(case).below(ONE_IN) == 0)
}

/// `count` of the items in their order, which `SENSEDSL_SEED` draws; all of them in an exhaustive run.
#[must_use]
pub fn drawn<'a, T>(what: &str, all: &'a [T], count: usize) -> Vec<&'a T> {
    let mut left: Vec<&T> = all.iter().collect();
    let mut random = seeded(what);
    while !is_exhaustive() && left.len() > count {
        left.remove(random.below(left.len()));
    }
    left
}

/// The first `count` items, or all of them in a thorough run.
#[must_use]
pub fn few<T>(all: &[T], count: usize) -> &[T] {
    if is_thorough() { all } else { all.get(..count).unwrap_or(all) }
}

/// Every `step`-th item, or all of them in a thorough run.
pub fn one_in<I: IntoIterator>(step: usize, all: I) -> impl Iterator<Item = I::Item> {
    all.into_iter().step_by(if is_thorough() { 1 } else { step })
}
