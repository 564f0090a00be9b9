//! Judges a [`Timing`]: requests that cannot be met, requests that nearly cannot, and groups that
//! find no turns.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::codes::{
    e0621_too_often, e0622_link_too_slow, e0624_no_turns, w0623_nearly_busy,
    w0625_no_turns_by_default, w0628_locked_too_long,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_model::design::{Design, Device, DeviceIndex, Transport};
use sensedsl_wiring::assignment::Assignment;

use crate::context::{Context, Wired};
use crate::load::{BoardTiming, Timing};
use crate::rows::{Part, Row, per_second};
use crate::steps::STEPS;
use crate::units::{MILLISECOND_NS, SECOND_NS};
use crate::{groups, link};

/// The load from which there is a warning.
const WARN_NS: u64 = SECOND_NS / 100 * 70;

pub(crate) fn judge(design: &Design, timing: &Timing) -> Vec<Diagnostic> {
    timing.boards.iter().flat_map(|board| of_board(design, board)).collect()
}

fn of_board(design: &Design, timing: &BoardTiming) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut units: BTreeMap<(Part, &str), Vec<&Row>> = BTreeMap::new();
    for row in &timing.rows {
        match row.part {
            Part::Converter | Part::Bus | Part::Wire | Part::Port | Part::Thread => {
                units.entry((row.part, &row.name)).or_default().push(row);
            }
            Part::Processor => diagnostics.extend(of_processor(design, timing, row)),
            Part::Link | Part::Output | Part::Interrupts => {}
        }
    }
    for ((part, unit), rows) in units {
        diagnostics.extend(of_unit(design, part, unit, &rows));
    }
    diagnostics.extend(of_locks(design, timing));
    diagnostics
}

/// Reports a serial port on which a whole byte can come while a wire keeps interrupts off: the next one overwrites it.
fn of_locks(design: &Design, timing: &BoardTiming) -> Option<Diagnostic> {
    /// The bits of the shortest byte on a line, with start and stop.
    const BYTE_BITS: u64 = 9;
    let locks = timing.rows.iter().filter(|row| row.locked_ns.is_some());
    let wire = locks.max_by_key(|row| row.locked_ns)?;
    let locked_ns = wire.locked_ns?;
    let is_short = |row: &&Row| {
        let is_port = matches!(row.part, Part::Port | Part::Link);
        is_port
            && row
                .clock_hz
                .is_some_and(|hz| BYTE_BITS * SECOND_NS / u64::from(hz.max(1)) < locked_ns)
    };
    let port = timing.rows.iter().find(is_short)?;
    let device = design.device(*wire.devices.first()?)?;
    let most = BYTE_BITS * SECOND_NS / locked_ns;
    let (name, lock) = (&device.name.value, shown_time(locked_ns));
    Some(w0628_locked_too_long::locked_too_long(device.name.span, name, &lock, &port.name, most))
}

/// The place of a device's cycle time.
fn place(device: &Device) -> Span {
    device.delay_span.unwrap_or(device.name.span)
}

fn names(design: &Design, devices: &[DeviceIndex]) -> String {
    const NAMED_MAX: usize = 3;
    let names: Vec<&str> = devices
        .iter()
        .filter_map(|index| Some(design.device(*index)?.name.value.as_str()))
        .collect();
    match names.as_slice() {
        [first, second, third, _, ..] => {
            format!("{first}, {second}, {third} and {} more", names.len() - NAMED_MAX)
        }
        [firsts @ .., last] if !firsts.is_empty() => format!("{} and {last}", firsts.join(", ")),
        _ => names.concat(),
    }
}

/// What could be changed other than the cycle time.
fn otherwise(part: Part) -> &'static str {
    match part {
        Part::Converter => ", fewer `samples`, or a shorter `sampling`",
        Part::Bus => ", a faster bus, or another one",
        Part::Port => ", or more `baud`",
        Part::Wire => ", or a wire for each part",
        Part::Thread | Part::Output | Part::Link | Part::Interrupts | Part::Processor => "",
    }
}

/// Formats a time for people.
#[must_use]
pub fn shown_time(ns: u64) -> String {
    let tenths = |unit: u64| {
        let tenths = ns.saturating_mul(10).div_ceil(unit);
        format!("{}.{}", tenths / 10, tenths % 10)
    };
    match ns {
        0..1_000_000 => format!("{} us", ns.div_ceil(1_000)),
        1_000_000..100_000_000 => format!("{} ms", tenths(MILLISECOND_NS)),
        _ => format!("{} ms", ns.div_ceil(MILLISECOND_NS)),
    }
}

fn of_unit(design: &Design, part: Part, unit: &str, rows: &[&Row]) -> Option<Diagnostic> {
    let busy_ns = rows.iter().filter_map(|row| row.busy_ns).fold(0, u64::saturating_add);
    let worst = rows.iter().max_by_key(|row| row.busy_ns)?;
    let late = |row: &&&Row| {
        row.shortest_ms.zip(row.cycle).is_some_and(|(least, cycle)| least > cycle.delay_ms)
    };
    let blamed = rows.iter().filter(late).max_by_key(|row| row.busy_ns).unwrap_or(worst);
    let (cycle, device) = (blamed.cycle?, design.device(*blamed.devices.first()?)?);
    let asked = names(design, &blamed.devices);
    if busy_ns <= SECOND_NS && rows.iter().find(late).is_none() {
        let near = (busy_ns > WARN_NS && part != Part::Thread).then_some(busy_ns)?;
        let device = design.device(*worst.devices.first()?)?;
        return Some(w0623_nearly_busy::nearly_busy(place(device), unit, near / (SECOND_NS / 100)));
    }
    // A thread that sends pulses sleeps most of its time.
    let takes = match blamed.shortest_ms.filter(|_| part == Part::Thread) {
        Some(ms) => format!("{ms} ms"),
        None => shown_time(blamed.cycle_ns?),
    };
    let others = busy_ns.saturating_sub(blamed.busy_ns.unwrap_or_default());
    let message = if others == 0 {
        let delay_ms = cycle.delay_ms;
        format!("{unit} takes {takes} for a cycle of {asked}, which comes every {delay_ms} ms")
    } else {
        let percent = busy_ns / (SECOND_NS / 100);
        format!("{unit} is asked to be busy {percent} % of the time, mostly by {asked}")
    };
    let help = match blamed.shortest_ms {
        Some(least) => format!(
            "write `delay = {least} ms;` or more for {asked}: it is the shortest that can be kept here{}",
            otherwise(part)
        ),
        None => {
            let least = scaled_ms(cycle.delay_ms, busy_ns);
            format!(
                "the others alone are too much: all cycle times have to grow, that of {asked} to {least} ms{}",
                otherwise(part)
            )
        }
    };
    let diagnostic = e0621_too_often::too_often(place(device), &message, &help);
    let others = rows.iter().filter(|row| row.cycle != blamed.cycle).take(3);
    let others = others.filter_map(|row| {
        let device = design.device(*row.devices.first()?)?;
        Some((
            place(device),
            format!("{} of it each {} ms", shown_time(row.cycle_ns?), row.cycle?.delay_ms),
        ))
    });
    Some(others.fold(diagnostic, |diagnostic, (span, text)| diagnostic.label(span, text)))
}

/// A cycle time that grows in proportion to the excess work.
fn scaled_ms(delay_ms: u32, busy_ns: u64) -> u64 {
    let ms = u128::from(delay_ms) * u128::from(busy_ns) / u128::from(SECOND_NS) + 1;
    u64::try_from(ms).unwrap_or(u64::MAX)
}

fn of_processor(design: &Design, timing: &BoardTiming, row: &Row) -> Option<Diagnostic> {
    let busy_ns = row.busy_ns?;
    let threads = timing.rows.iter().filter(|row| row.part == Part::Thread);
    let worst = threads.filter(|row| !row.devices.is_empty()).max_by_key(|row| row.busy_ns)?;
    let device = design.device(*worst.devices.first()?)?;
    let percent = busy_ns / (SECOND_NS / 100);
    if busy_ns > SECOND_NS {
        let asked = names(design, &worst.devices);
        let message =
            format!("the processor is asked to be busy {percent} % of the time, mostly by {asked}");
        let least = worst.cycle.map(|cycle| scaled_ms(cycle.delay_ms, busy_ns));
        let is_code = design.controllers.iter().any(|one| worst.devices.contains(&one.device));
        let help = match least {
            Some(least) if is_code => {
                format!("write `every {least} ms` for {asked}, or a shorter `takes`")
            }
            Some(least) => format!("write `delay = {least} ms;` or more for {asked}"),
            None if worst.name == STEPS => format!("write a lower `speed` for {asked}"),
            None => format!("state a lower `max` for {asked}, or count with a slower wheel"),
        };
        return Some(e0621_too_often::too_often(place(device), &message, &help));
    }
    (busy_ns > WARN_NS)
        .then(|| w0623_nearly_busy::nearly_busy(place(device), "the processor", percent))
}

/// Reports a link that cannot carry what is requested for each cycle.
pub(crate) fn of_link(context: &Context<'_>) -> Option<Diagnostic> {
    let reports = link::reports(context);
    let (_, most) = link::capacity(context);
    let most = most?;
    let name = match (context.board.link.transport, &context.wiring.link) {
        (Transport::Uart, Some(link)) => link.unit.clone(),
        (Transport::Uart | Transport::Usb | Transport::None, _) => "the USB link".to_owned(),
    };
    let cyclic = |wired: &&Wired<'_>| !wired.device.kind.name().spec().triggers_itself;
    let rate = |wired: &&Wired<'_>| {
        per_second(wired.device.value.value.size_bytes() as u64 + 1, wired.device.delay_ms)
    };
    let sensors = context
        .devices
        .iter()
        .filter(|wired| wired.device.direction == sensedsl_wire::Direction::Sensor);
    let worst = sensors.clone().filter(cyclic).max_by_key(rate).or(sensors.clone().next())?;
    let busy_ns = link::busy_ns(reports.cyclic_bytes, most);
    if busy_ns > SECOND_NS {
        let (asked, delay_ms) = (&worst.device.name.value, worst.device.delay_ms);
        let message = format!(
            "{name} carries {most} bytes a second, and the reports come to {}",
            reports.cyclic_bytes
        );
        let least = scaled_ms(delay_ms, busy_ns);
        let baud = (context.board.link.transport == Transport::Uart).then(|| {
            let baud = u64::from(context.board.link.baud) * busy_ns.div_ceil(SECOND_NS / 10) / 10;
            format!(", at least {baud} `baud`")
        });
        let help = format!(
            "write `delay = {least} ms;` or more for {asked} and cycle times as much longer for the others{}, or a `rate` for the link",
            baud.unwrap_or_default()
        );
        return Some(e0622_link_too_slow::link_too_slow(place(worst.device), &message, &help));
    }
    let busy_ns = link::busy_ns(reports.bytes, most);
    let percent = busy_ns / (SECOND_NS / 100);
    (busy_ns > WARN_NS).then(|| w0623_nearly_busy::nearly_busy(place(worst.device), &name, percent))
}

/// Reports groups whose devices cannot take turns, once each.
pub(crate) fn turns(design: &Design, assignment: &Assignment) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    for (wiring, board) in assignment.used(design) {
        diagnostics.extend(of_link(&Context::new(design, board, wiring)));
        let turns = groups::turns(design, wiring);
        let names: BTreeSet<&str> = turns.iter().map(|turn| turn.group.as_str()).collect();
        for name in names {
            let members = || turns.iter().filter(|turn| turn.group == name);
            let Some(first) = members().find(|turn| turn.overlaps) else { continue };
            let Some(device) = design.device(first.device) else { continue };
            let Some(group) = &device.group else { continue };
            let all_ms: u32 = members().map(|turn| turn.measuring_ms).fold(0, u32::saturating_add);
            let stated = members().any(|turn| {
                let group = design.device(turn.device).and_then(|device| device.group.as_ref());
                group.is_some_and(|group| group.own)
            });
            let span = if group.own { group.span } else { place(device) };
            let report =
                if stated { e0624_no_turns::no_turns } else { w0625_no_turns_by_default::no_turns };
            diagnostics.push(report(span, &device.name.value, name, members().count(), all_ms));
        }
    }
    diagnostics
}
