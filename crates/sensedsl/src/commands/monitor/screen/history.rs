//! What a plot shows of one number: its values of the last ten minutes, in as much memory after a day as at once.
//!
//! In: values with their times. Out: the least and the greatest of each column of a plot, and the value at a time. The
//! latest values are kept one by one; those of the last minute and of the last ten minutes in buckets, each with its
//! least, its greatest and its last value. So a peak is never lost, however few columns a plot has.

use std::collections::VecDeque;

/// How far back it goes.
pub(super) const SPAN_US: u64 = 600_000_000;
/// The spans of the two tiers of buckets.
const TIERS_US: [u64; 2] = [SPAN_US / 10, SPAN_US];
/// The bytes of an entry of each of the three: a value, and two buckets.
pub(super) const ENTRY_BYTES: usize = size_of::<(u64, f64)>() + 2 * size_of::<Bucket>();

/// Some values that follow each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bucket {
    /// When the first of them came.
    pub(super) at_us: u64,
    pub(super) least: f64,
    pub(super) most: f64,
    pub(super) last: f64,
}

impl Bucket {
    fn of(at_us: u64, value: f64) -> Self {
        Self { at_us, least: value, most: value, last: value }
    }

    fn join(&mut self, later: &Self) {
        self.least = self.least.min(later.least);
        self.most = self.most.max(later.most);
        self.last = later.last;
    }
}

/// Buckets of one width.
#[derive(Debug)]
struct Tier {
    width_us: u64,
    buckets: VecDeque<Bucket>,
    /// The end of the last bucket.
    ends_us: u64,
    is_cut: bool,
}

impl Tier {
    fn add(&mut self, at_us: u64, value: f64, capacity: usize) {
        match self.buckets.back_mut() {
            Some(last) if at_us < self.ends_us => last.join(&Bucket::of(at_us, value)),
            Some(_) | None => {
                if self.buckets.len() >= capacity {
                    let _ = self.buckets.pop_front();
                    self.is_cut = true;
                }
                self.buckets.push_back(Bucket::of(at_us, value));
                self.ends_us = (at_us / self.width_us + 1) * self.width_us;
            }
        }
    }
}

/// The values of one number.
#[derive(Debug)]
pub(super) struct History {
    capacity: usize,
    values: VecDeque<(u64, f64)>,
    is_cut: bool,
    tiers: [Tier; 2],
}

impl History {
    /// A history of so many values, and of as many buckets of each tier.
    pub(super) fn new(capacity: usize) -> Self {
        let capacity = capacity.max(2);
        let tiers = TIERS_US.map(|span_us| Tier {
            width_us: span_us.div_ceil(capacity as u64 - 1),
            buckets: VecDeque::new(),
            ends_us: 0,
            is_cut: false,
        });
        Self { capacity, values: VecDeque::new(), is_cut: false, tiers }
    }

    /// Takes a value; what is no number leaves nothing.
    pub(super) fn add(&mut self, at_us: u64, value: f64) {
        if !value.is_finite() {
            return;
        }
        // Time never goes back; what says so is of the same moment.
        let at_us = self.values.back().map_or(at_us, |(last_us, _)| at_us.max(*last_us));
        if self.values.len() >= self.capacity {
            let _ = self.values.pop_front();
            self.is_cut = true;
        }
        self.values.push_back((at_us, value));
        for tier in &mut self.tiers {
            tier.add(at_us, value, self.capacity);
        }
    }

    #[cfg(test)]
    pub(super) fn last(&self) -> Option<(u64, f64)> {
        self.values.back().copied()
    }

    /// The value that counted at a time: the last one until then.
    pub(super) fn at(&self, at_us: u64) -> Option<Bucket> {
        let after = self.values.partition_point(|(value_us, _)| *value_us <= at_us);
        let found = after.checked_sub(1).and_then(|index| self.values.get(index));
        if let Some((value_us, value)) = found {
            return Some(Bucket::of(*value_us, *value));
        }
        if !self.is_cut {
            return None;
        }
        self.tiers.iter().find_map(|tier| {
            let after = tier.buckets.partition_point(|bucket| bucket.at_us <= at_us);
            tier.buckets.get(after.checked_sub(1)?).copied()
        })
    }

    /// The values of each column, from a time on; none where no value came.
    pub(super) fn columns(
        &self,
        from_us: u64,
        column_us: u64,
        count: usize,
    ) -> Vec<Option<Bucket>> {
        let column_us = column_us.max(1);
        let to_us = from_us.saturating_add(column_us.saturating_mul(count as u64));
        let mut columns: Vec<Option<Bucket>> = vec![None; count];
        let mut take = |bucket: Bucket| {
            let place = bucket.at_us.saturating_sub(from_us) / column_us;
            let place = usize::try_from(place).ok().and_then(|place| columns.get_mut(place));
            match place {
                Some(Some(column)) => column.join(&bucket),
                Some(column) => *column = Some(bucket),
                None => {}
            }
        };
        // The coarsest that is fine enough, and before it begins a coarser one.
        let first = self.tiers.iter().rposition(|tier| tier.width_us <= column_us);
        let coarser = self.tiers.iter().skip(first.unwrap_or_default());
        let mut parts: Vec<(&Tier, u64, u64)> = Vec::new();
        let mut until_us = to_us;
        if first.is_none() {
            let begin = self.values.partition_point(|(at_us, _)| *at_us < from_us);
            if self.is_cut {
                until_us = self.values.front().map_or(to_us, |(at_us, _)| to_us.min(*at_us));
            } else {
                until_us = from_us;
            }
            for tier in coarser {
                until_us = older(&mut parts, tier, from_us, until_us);
            }
            visit(&parts, &mut take);
            let values = self.values.range(begin..).take_while(|(at_us, _)| *at_us < to_us);
            values.for_each(|(at_us, value)| take(Bucket::of(*at_us, *value)));
        } else {
            for tier in coarser {
                until_us = older(&mut parts, tier, from_us, until_us);
            }
            visit(&parts, &mut take);
        }
        columns
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        let buckets: usize = self.tiers.iter().map(|tier| tier.buckets.capacity()).sum();
        self.values.capacity() * size_of::<(u64, f64)>() + buckets * size_of::<Bucket>()
    }
}

/// Notes that a tier has the values from a time until another one. Gives the time before which an older one has them.
fn older<'t>(
    parts: &mut Vec<(&'t Tier, u64, u64)>,
    tier: &'t Tier,
    from_us: u64,
    until_us: u64,
) -> u64 {
    if from_us >= until_us {
        return until_us;
    }
    parts.push((tier, from_us, until_us));
    match tier.buckets.front() {
        Some(first) if tier.is_cut => until_us.min(first.at_us),
        Some(_) | None => from_us,
    }
}

/// The oldest first, so that the last value of a column is its last one.
fn visit(parts: &[(&Tier, u64, u64)], take: &mut impl FnMut(Bucket)) {
    for (tier, from_us, until_us) in parts.iter().rev() {
        let begin = tier.buckets.partition_point(|bucket| bucket.at_us < *from_us);
        let end = tier.buckets.partition_point(|bucket| bucket.at_us < *until_us);
        tier.buckets.range(begin..end.max(begin)).for_each(|bucket| take(*bucket));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that look like chance and are the same everywhere.
    fn drawn(seed: &mut u64) -> u64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        *seed
    }

    /// The least and the greatest of all values within a time.
    fn envelope(all: &[(u64, f64)], from_us: u64, to_us: u64) -> Option<(f64, f64)> {
        let some = all.iter().filter(|(at_us, _)| (from_us..to_us).contains(at_us));
        some.fold(None, |found, (_, value)| {
            let (least, most) = found.unwrap_or((*value, *value));
            Some((least.min(*value), most.max(*value)))
        })
    }

    fn random(seed: &mut u64, capacity: usize) -> (History, Vec<(u64, f64)>) {
        let mut history = History::new(capacity);
        let (mut at_us, mut all) = (0, Vec::new());
        let usual_us = [900, 10_000, 170_000, 3_000_000][(drawn(seed) % 4) as usize];
        for _ in 0..drawn(seed) % 6_000 {
            let pause = if drawn(seed).is_multiple_of(500) { 100 } else { 1 };
            at_us += drawn(seed) % (2 * usual_us) * pause;
            let value = (drawn(seed) % 2_000) as f64 - 1_000.0;
            history.add(at_us, value);
            all.push((at_us, value));
        }
        (history, all)
    }

    #[test]
    fn columns_have_the_peaks_of_all_values() {
        let mut seed = 0x5eed_1234;
        for _ in 0..150 {
            let capacity = [16, 64, 256, 1024][(drawn(&mut seed) % 4) as usize];
            let (history, all) = random(&mut seed, capacity);
            let now_us = all.last().map_or(0, |(at_us, _)| *at_us);
            let span_us =
                [1_000_000, 10_000_000, 60_000_000, SPAN_US][(drawn(&mut seed) % 4) as usize];
            let back_us = drawn(&mut seed) % (SPAN_US - span_us + 1);
            let Some(from_us) = now_us.checked_sub(back_us + span_us) else { continue };
            let column_us = span_us / 100;
            let columns = history.columns(from_us, column_us, 100);
            // What is old stands in the widest buckets.
            let slack_us = history.tiers[1].width_us.max(column_us);
            for (index, found) in columns.iter().enumerate() {
                let begin_us = from_us + index as u64 * column_us;
                if let Some(found) = found {
                    let until_us = begin_us + column_us + slack_us;
                    let (least, most) = envelope(&all, begin_us, until_us).unwrap();
                    assert!(found.least >= least && found.most <= most, "{index}: {found:?}");
                }
                let Some((least, most)) = envelope(&all, begin_us, begin_us + column_us) else {
                    continue;
                };
                let around = (index.saturating_sub((slack_us / column_us) as usize + 2)..=index)
                    .filter_map(|index| columns[index]);
                let around = around.reduce(|mut one, other| {
                    one.join(&other);
                    one
                });
                let edge = (slack_us / column_us) as usize + 2;
                if index > edge {
                    let around = around.unwrap();
                    assert!(around.least <= least && around.most >= most, "{index}: {around:?}");
                }
            }
        }
    }

    #[test]
    fn recent_values_are_exact() {
        let mut history = History::new(1024);
        let all: Vec<(u64, f64)> =
            (0..5_000_u64).map(|n| (n * 1_000, (n * n % 977) as f64)).collect();
        all.iter().for_each(|(at_us, value)| history.add(*at_us, *value));
        let columns = history.columns(4_500_000, 5_000, 100);
        for (index, column) in columns.iter().enumerate() {
            let begin_us = 4_500_000 + index as u64 * 5_000;
            let expected = envelope(&all, begin_us, begin_us + 5_000).unwrap();
            let column = column.unwrap();
            assert_eq!((column.least, column.most), expected);
            assert_eq!(column.last, all[(begin_us / 1_000) as usize + 4].1);
        }
        assert_eq!(history.at(4_700_500).unwrap().last, all[4_700].1);
        // Older ones are known to a bucket.
        let old = history.at(1_000_000).unwrap();
        assert!(old.at_us <= 1_000_000 && old.at_us > 1_000_000 - history.tiers[0].width_us);
        assert_eq!(history.last(), all.last().copied());
        history.add(6_000_000, f64::NAN);
        assert_eq!(history.last(), all.last().copied());
    }

    #[test]
    fn memory_is_bounded_and_reaches_back() {
        let capacity = 2048;
        let mut history = History::new(capacity);
        // A quarter of an hour at 1 kHz.
        for n in 0..900_000_u64 {
            history.add(n * 1_000, n as f64);
            assert!(!n.is_multiple_of(100_000) || history.bytes() <= capacity * ENTRY_BYTES);
        }
        assert_eq!(history.bytes(), capacity * ENTRY_BYTES);
        let oldest = history.columns(300_000_000, 6_000_000, 100);
        assert!(oldest.iter().all(Option::is_some));
    }
}
