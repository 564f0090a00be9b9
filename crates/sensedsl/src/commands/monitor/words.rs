//! Words for people about a board and its values.

use sensedsl_host::{Board, Device, Overstep, causes, status};
use sensedsl_wire::{Health, NEVER_MS, Scalar};

use sensedsl_report::columns::table;

/// What is said behind a value outside of its limits.
pub(super) fn mark(device: &Device, value: &[Scalar]) -> String {
    let unit = device.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    match device.overstep(value) {
        Some(Overstep::Below(least)) => format!(" (below the minimum of {least}{unit})"),
        Some(Overstep::Above(greatest)) => format!(" (above the maximum of {greatest}{unit})"),
        None => String::new(),
    }
}

/// What a board was restarted by, if not by its supply.
pub(super) fn restarted(board: &Board, health: &Health) -> Option<String> {
    let device = |id| board.devices.iter().find(|device| device.id == id);
    sensedsl_host::restarted(health, |id| device(id).map(|device| device.name.clone()))
}

/// How a board is, in lines.
pub(super) fn health(board: &Board, health: &Health) -> String {
    let Health { uptime_ms, reports_sent, reports_refused, .. } = health;
    let restarted = restarted(board, health).map(|text| format!(", {text}"));
    let head = format!(
        "health of {}: up {:.1} s{}, {reports_sent} reports sent, {reports_refused} refused\n",
        board.name,
        f64::from(*uptime_ms) / 1e3,
        restarted.unwrap_or_default()
    );
    let rows: Vec<[String; 4]> = health
        .devices
        .iter()
        .map(|one| {
            let device = board.devices.iter().find(|device| device.id == one.id);
            let name = device.map_or(String::new(), |device| device.name.clone());
            let age =
                if one.age_ms == NEVER_MS { "-".to_owned() } else { format!("{} ms", one.age_ms) };
            [name, status(one.status).to_owned(), age, causes(one.causes.counts())]
        })
        .collect();
    format!("{head}{}", table(["Device", "Status", ">Age", "Failures"], &rows))
}
