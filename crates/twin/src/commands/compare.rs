//! Comparison of a board's outputs with the expected ones.

use sensedsl_model::design::ConnectionIndex;

use super::expect::{Expectation, Expected, Sent};
use super::outputs::Outputs;
use super::track;
use super::written::Written;
use sensedsl_surroundings::CanFrame;

/// The number of bytes of a transfer that are shown.
const SHOWN: usize = 24;

/// The latest time at which the first of repeated frames may come.
const FIRST_NS: u64 = 40_000_000;

/// The output found instead of the expected one; `None` if it is as expected. Only transfers, messages and frames after
/// a given time count.
pub(super) fn differs(
    one: &Expected,
    outputs: &Outputs,
    (since_ns, now_ns): (u64, u64),
) -> Option<String> {
    match &one.what {
        Expectation::Level(role, high) => {
            let found = outputs.level(one.at, *role);
            (found != Some(*high)).then(|| found.map_or("not driven", level).to_owned())
        }
        Expectation::Pulses(wanted) => {
            let found = outputs.pulses(one.at);
            (!is_same(*wanted, found)).then(|| pulses(found))
        }
        Expectation::Millivolts(wanted) => {
            let found = outputs.millivolts(one.at).unwrap_or(0.0);
            ((found - wanted).abs() > 0.5).then(|| format!("{found:.0} mV"))
        }
        Expectation::Write(_) if outputs.wrong(one.at).is_some() => {
            outputs.wrong(one.at).map(str::to_owned)
        }
        Expectation::Write(wanted) => {
            let found = last_write(one.at, outputs, since_ns, wanted);
            let is_it = found.as_deref().is_some_and(|found| wanted.is(found));
            (!is_it).then(|| found.map_or("nothing".into(), |one| hex(&one)))
        }
        Expectation::Message(unit, bytes) => {
            let found = outputs.bytes(*unit, since_ns);
            let is_there = found.windows(bytes.len().max(1)).any(|part| part == bytes);
            let last = found.len().saturating_sub(bytes.len());
            (!is_there).then(|| hex(found.get(last..).unwrap_or_default()))
        }
        Expectation::Motion(motion) => match outputs.track(one.at) {
            Some(track) => track.differs(*motion, now_ns),
            None => Some("no steps".to_owned()),
        },
        Expectation::Frame(sent) => {
            let span = (since_ns, now_ns);
            let found = frame(sent, outputs, since_ns);
            found
                .or_else(|| too_seldom(sent, outputs, span))
                .or_else(|| too_often(sent, outputs, span))
        }
    }
}

/// The last transfer with the same start and length, otherwise the last one of any kind.
fn last_write(
    at: ConnectionIndex,
    outputs: &Outputs,
    since_ns: u64,
    wanted: &Written,
) -> Option<Vec<u8>> {
    let Written { bytes, begins, .. } = wanted;
    let is_alike =
        |one: &&[u8]| one.len() == bytes.len() && one.get(..*begins) == bytes.get(..*begins);
    let alike = outputs.writes(at, since_ns).filter(is_alike).last();
    alike.or_else(|| outputs.writes(at, since_ns).last()).map(<[u8]>::to_vec)
}

/// A timer counts whole ticks of its clock, at most 65,536 of them.
fn is_same(wanted: Option<(u64, u64)>, found: Option<(u64, u64)>) -> bool {
    let (period_ns, width_ns) = wanted.unwrap_or((0, 0));
    let (found_period_ns, found_width_ns) = found.unwrap_or((0, 0));
    if width_ns == 0 {
        return found_width_ns == 0;
    }
    width_ns.abs_diff(found_width_ns) <= period_ns / 20_000 + 30
        && period_ns.abs_diff(found_period_ns) <= period_ns / 2_000 + 30
}

fn frame(sent: &Sent, outputs: &Outputs, since_ns: u64) -> Option<String> {
    let bits = |frame: &CanFrame| u64::from_le_bytes(frame.data);
    let own = outputs.frames(sent.unit, since_ns).filter(|frame| {
        (frame.id, frame.extended, frame.remote) == (sent.identifier, sent.is_extended, false)
            && bits(frame) & sent.select.0 == sent.select.1
    });
    let data =
        |frame: &CanFrame| hex(frame.data.get(..usize::from(frame.length)).unwrap_or_default());
    let Some(found) = own.last() else {
        let other = outputs.frames(sent.unit, since_ns).last();
        return Some(
            other.map_or("nothing".into(), |one| format!("{} in frame 0x{:X}", data(one), one.id)),
        );
    };
    let is_right = found.length == sent.length && bits(found) & sent.bits.0 == sent.bits.1;
    (!is_right).then(|| data(found))
}

/// A frame that is repeated, but less often than it must be.
fn too_seldom(sent: &Sent, outputs: &Outputs, (since_ns, now_ns): (u64, u64)) -> Option<String> {
    let span_ns = now_ns.saturating_sub(since_ns + FIRST_NS);
    let wanted = (span_ns / 10 * 9).checked_div(sent.resend_ns)?;
    let own = outputs
        .frames(sent.unit, since_ns)
        .filter(|frame| (frame.id, frame.extended) == (sent.identifier, sent.is_extended));
    let found = u64::try_from(own.count()).unwrap_or(u64::MAX);
    let span_ms = (now_ns - since_ns) / 1_000_000;
    (found < wanted).then(|| format!("only {found} times in {span_ms} ms"))
}

/// A frame that comes more often than commands and repetition explain. Each of its devices may be set twice in that
/// time. Multiplexed frames are left out: nothing tells how often each of them is repeated.
fn too_often(sent: &Sent, outputs: &Outputs, (since_ns, now_ns): (u64, u64)) -> Option<String> {
    if sent.select.0 != 0 {
        return None;
    }
    let span_ns = now_ns.saturating_sub(since_ns);
    let repeated = (span_ns / 10 * 11).checked_div(sent.resend_ns).unwrap_or(0);
    let most = repeated + 2 * sent.devices + 1;
    let own = outputs
        .frames(sent.unit, since_ns)
        .filter(|frame| (frame.id, frame.extended) == (sent.identifier, sent.is_extended));
    let found = u64::try_from(own.count()).unwrap_or(u64::MAX);
    (found > most).then(|| format!("it {found} times in {} ms", span_ns / 1_000_000))
}

/// The expected output, as text for people.
pub(super) fn shown(one: &Expected) -> String {
    match &one.what {
        Expectation::Level(_, high) => level(*high).to_owned(),
        Expectation::Pulses(wanted) => pulses(*wanted),
        Expectation::Millivolts(wanted) => format!("{wanted:.0} mV"),
        Expectation::Write(written) => {
            let own = written.mask().map(|mask| format!(" where bits are set in {}", hex(mask)));
            hex(&written.bytes) + &own.unwrap_or_default()
        }
        Expectation::Message(_, bytes) => hex(bytes),
        Expectation::Motion(motion) => track::shown(*motion),
        Expectation::Frame(sent) => {
            let Sent { identifier, length, bits: (mask, bits), .. } = sent;
            let shown =
                |bits: u64| hex(bits.to_le_bytes().get(..usize::from(*length)).unwrap_or_default());
            let whole = if *mask == u64::MAX {
                String::new()
            } else {
                format!(" where bits are set in {}", shown(*mask))
            };
            format!("{}{whole} in frame 0x{identifier:X}", shown(*bits))
        }
    }
}

fn level(is_high: bool) -> &'static str {
    if is_high { "high" } else { "low" }
}

fn pulses(found: Option<(u64, u64)>) -> String {
    match found {
        None | Some((_, 0)) => "no pulses".to_owned(),
        Some((period_ns, width_ns)) => {
            let [period, width] = [period_ns, width_ns].map(|ns| crate::arith::number(ns) / 1e3);
            format!("pulses of {width:.2} us each {period:.2} us")
        }
    }
}

fn hex(bytes: &[u8]) -> String {
    let all: Vec<String> = bytes.iter().take(SHOWN).map(|byte| format!("{byte:02X}")).collect();
    if bytes.is_empty() {
        return "nothing".to_owned();
    }
    format!("{}{}", all.join(" "), if bytes.len() > SHOWN { " …" } else { "" })
}
