//! The work of the hardware in a second, part by part, as a table and for scripts.

use sensedsl_model::design::{Design, DeviceIndex};
use sensedsl_timing::{BoardTiming, Count, Part, Row, SECOND_NS, Timing, shown_time};
use serde_json::{Value, json};

use crate::columns::{INDENT, table};

/// The meanings of the columns.
const LEGEND: [&str; 3] = [
    "A second: conversions, bytes (B), interrupts (irq) or instructions (ins).",
    "Least: the shortest delay that can be kept beside the others.",
    "not known: no profile, or no `max` of the device, says enough.",
];

/// The text for a fact that a profile lacks.
const UNKNOWN: &str = "not known";

fn board_name<'a>(design: &'a Design, board: &BoardTiming) -> &'a str {
    design.board(board.board).map_or("", |board| board.name.value.as_str())
}

fn device_name(design: &Design, index: DeviceIndex) -> &str {
    design.device(index).map_or("", |device| device.name.value.as_str())
}

/// The table, as `sensedsl explain timing --format json` prints it.
#[must_use]
pub fn value(design: &Design, timing: &Timing) -> Value {
    let boards: Vec<Value> = timing.boards.iter().map(|board| board_value(design, board)).collect();
    json!({ "version": 1, "boards": boards })
}

fn board_value(design: &Design, board: &BoardTiming) -> Value {
    let names = |devices: &[DeviceIndex]| -> Vec<&str> {
        devices.iter().map(|index| device_name(design, *index)).collect()
    };
    let rows = board.rows.iter().map(|row| {
        json!({
            "part": row.part.name(),
            "name": row.name,
            "devices": names(&row.devices),
            "delay_ms": row.cycle.map(|cycle| cycle.delay_ms),
            "prio": row.cycle.map(|cycle| cycle.prio),
            "start_ms": row.cycle.map(|cycle| cycle.start_ms),
            "clock_hz": row.clock_hz,
            "cycle_ns": row.cycle_ns,
            "unit": row.a_second.map(Count::unit),
            "a_second": row.a_second.map(Count::number),
            "busy_ns_a_second": row.busy_ns,
            "shortest_ms": row.shortest_ms,
            "locked_ns": row.locked_ns,
        })
    });
    let turns = board.turns.iter().map(|turn| {
        json!({
            "group": turn.group,
            "device": device_name(design, turn.device),
            "start_ms": turn.start_ms,
            "period_ms": turn.period_ms,
            "measuring_ms": turn.measuring_ms,
            "overlaps": turn.overlaps,
        })
    });
    json!({
        "board": board_name(design, board),
        "core_hz": board.core_hz,
        "rows": rows.collect::<Vec<_>>(),
        "turns": turns.collect::<Vec<_>>(),
    })
}

/// The table for people, with what its columns mean.
#[must_use]
pub fn human(design: &Design, timing: &Timing) -> String {
    let mut out = String::new();
    for board in &timing.boards {
        if !out.is_empty() {
            out.push('\n');
        }
        out.push_str(&format!("{}\n", board_name(design, board)));
        let rows: Vec<[String; 8]> = board.rows.iter().map(cells).collect();
        let heads = ["Part", "Name", ">Clock", ">Cycle", ">Takes", ">A second", ">Busy", ">Least"];
        out.push_str(&table(heads, &rows));
        let locked_ns = board.rows.iter().filter_map(|row| row.locked_ns).max();
        if let Some(locked_ns) = locked_ns {
            let time = shown_time(locked_ns);
            out.push_str(&format!("\n{INDENT}Interrupts are off for {time} at a time, while a bit of a wire is made.\n"));
        }
        if !board.turns.is_empty() {
            out.push('\n');
            out.push_str(&turns(design, board));
        }
    }
    out.push('\n');
    for line in LEGEND {
        out.push_str(&format!("{INDENT}{line}\n"));
    }
    out
}

fn turns(design: &Design, board: &BoardTiming) -> String {
    let rows: Vec<[String; 6]> = board
        .turns
        .iter()
        .map(|turn| {
            [
                turn.group.clone(),
                device_name(design, turn.device).to_owned(),
                format!("{} ms", turn.start_ms),
                format!("{} ms", turn.period_ms),
                format!("{} ms", turn.measuring_ms),
                if turn.overlaps { "finds no turn".to_owned() } else { String::new() },
            ]
        })
        .collect();
    let heads = ["Group", "Device", ">Starts", ">Then every", ">Measures", ""];
    table(heads, &rows)
}

fn cells(row: &Row) -> [String; 8] {
    let unknown = || UNKNOWN.to_owned();
    let ms = |ms: u32| format!("{ms} ms");
    [
        row.part.name().to_owned(),
        row.name.clone(),
        row.clock_hz.map(|hz| clock(row.part, hz)).unwrap_or_default(),
        row.cycle.map(|cycle| ms(cycle.delay_ms)).unwrap_or_default(),
        row.cycle_ns.map(shown_time).unwrap_or_default(),
        row.a_second.map_or_else(
            || if row.has_count() { unknown() } else { String::new() },
            |count| format!("{} {}", short(count.number()), count.short_unit()),
        ),
        row.busy_ns
            .map_or_else(|| if row.has_share() { unknown() } else { String::new() }, percent),
        row.shortest_ms.map(ms).unwrap_or_default(),
    ]
}

/// The clock of a part: in baud for a serial port, in Hz for anything else.
fn clock(part: Part, hz: u32) -> String {
    match part {
        Part::Link | Part::Port => format!("{hz} Bd"),
        Part::Converter
        | Part::Bus
        | Part::Wire
        | Part::Output
        | Part::Interrupts
        | Part::Thread
        | Part::Processor => frequency(hz),
    }
}

/// A share of a second: `0.4 %`.
fn percent(busy_ns: u64) -> String {
    let thousandths = busy_ns.saturating_mul(1_000).div_ceil(SECOND_NS);
    format!("{}.{} %", thousandths / 10, thousandths % 10)
}

/// A frequency without trailing zeros: `400 kHz`.
fn frequency(hz: u32) -> String {
    let of = |unit: u32, name: &str| {
        let (whole, rest) = (hz / unit, hz % unit);
        let digits = unit.ilog10() as usize;
        let rest = format!("{rest:0digits$}");
        let rest = rest.trim_end_matches('0');
        let point = if rest.is_empty() { "" } else { "." };
        format!("{whole}{point}{rest} {name}")
    };
    match hz {
        1_000_000.. => of(1_000_000, "MHz"),
        1_000.. => of(1_000, "kHz"),
        _ => format!("{hz} Hz"),
    }
}

/// A number with at most four digits.
fn short(number: u64) -> String {
    match number {
        0..10_000 => number.to_string(),
        10_000..10_000_000 => format!("{}k", number.div_ceil(1_000)),
        _ => format!("{}M", number.div_ceil(1_000_000)),
    }
}
