//! Analog sensors: how long a converter takes for its threads' groups.

use sensedsl_board::profile::Cycles;
use sensedsl_model::kind::analog::Analog;

use crate::clocks::{converter_hz, sampling};
use crate::context::{Context, Wired};
use crate::processor::Work;
use crate::rows::{Count, Part, Row, clocks_ns, per_second, shortest};

/// Rows of samples that a group converts: as many as its most demanding sensor needs. If there is
/// more than one row, the number is even, as the driver requires.
#[must_use]
pub fn depth(samples: impl Iterator<Item = u16>) -> u16 {
    let most = samples.max().unwrap_or(1);
    if most > 1 { most.next_multiple_of(2) } else { most }
}

/// The sampling times that the inputs of a group get, ascending, if they requested these and the
/// group can have `most` different ones: the shortest as requested, all others the longest.
fn sampling_times(most: Option<u8>, mut asked: Vec<Cycles>) -> Vec<Cycles> {
    asked.sort_unstable();
    let (Some(most), Some(longest)) = (most, asked.last().copied()) else { return asked };
    let mut different = asked.clone();
    different.dedup();
    different.truncate(usize::from(most).saturating_sub(1));
    let own = different.last().copied();
    for time in &mut asked {
        if own.is_none_or(|own| *time > own) {
            *time = longest;
        }
    }
    asked
}

pub(crate) fn rows(context: &Context<'_>, work: &Work) -> Vec<Row> {
    let Some(profile) = context.board.profile() else { return Vec::new() };
    let hz = converter_hz(context);
    let of = |wired: &Wired<'_>| wired.device.kind.analog().cloned();
    let mut rows = Vec::new();
    let (mut unit_rows, mut own_ns, mut last) = (Vec::new(), Vec::new(), None);
    let classes = context.classes(of);
    for ((unit, cycle), sensors) in classes {
        if last.as_ref() != Some(&unit) {
            finish(&mut rows, &mut unit_rows, &mut own_ns);
            last = Some(unit.clone());
        }
        let devices = sensors.iter().map(|(wired, _)| wired.index).collect();
        let mut row = Row::new(Part::Converter, unit.as_str(), devices);
        let analogs: Vec<Analog> = sensors.into_iter().map(|(_, analog)| analog).collect();
        let depth = depth(analogs.iter().map(|analog| analog.samples));
        let conversions = u64::from(depth) * analogs.len() as u64;
        row.cycle = Some(cycle);
        row.clock_hz = hz;
        row.a_second = Some(Count::Conversions(per_second(conversions, cycle.delay_ms)));
        row.cycle_ns = hz.zip(profile.adc.conversion_cycles).and_then(|(hz, conversion)| {
            let asked = analogs.iter().map(|analog| sampling(&profile.adc, analog.sampling_cycles));
            let times = sampling_times(profile.adc.sampling_times, asked.collect::<Option<_>>()?);
            let row_halves: u64 =
                times.into_iter().map(|time| halves(time) + halves(conversion)).sum();
            Some(clocks_ns(row_halves * u64::from(depth), hz.saturating_mul(2)))
        });
        row.busy_ns = row.cycle_ns.map(|ns| per_second(ns, cycle.delay_ms));
        own_ns.push(row.cycle_ns.unwrap_or_default() + work.of_converter(&analogs));
        unit_rows.push(row);
    }
    finish(&mut rows, &mut unit_rows, &mut own_ns);
    rows
}

fn finish(rows: &mut Vec<Row>, unit_rows: &mut Vec<Row>, own_ns: &mut Vec<u64>) {
    shortest(unit_rows, own_ns);
    rows.append(unit_rows);
    own_ns.clear();
}

fn halves(cycles: Cycles) -> u64 {
    u64::from(cycles.halves())
}

#[cfg(test)]
mod tests {
    use sensedsl_board::profile::Cycles;

    use super::{depth, sampling_times};

    #[test]
    fn inputs_share_the_sampling_times_of_their_group() {
        let cycles = |times: &[u32]| times.iter().copied().map(Cycles::new).collect::<Vec<_>>();
        let get = |most| sampling_times(most, cycles(&[20, 7, 39, 7]));
        assert_eq!(get(None), cycles(&[7, 7, 20, 39]));
        assert_eq!(get(Some(1)), cycles(&[39, 39, 39, 39]));
        assert_eq!(get(Some(2)), cycles(&[7, 7, 39, 39]));
        assert_eq!(get(Some(3)), cycles(&[7, 7, 20, 39]));
    }

    #[test]
    fn a_group_of_several_rows_has_an_even_number() {
        assert_eq!(depth([1, 1].into_iter()), 1);
        assert_eq!(depth([1, 3].into_iter()), 4);
        assert_eq!(depth([1024, 2].into_iter()), 1024);
        assert_eq!(depth(std::iter::empty()), 1);
    }
}
