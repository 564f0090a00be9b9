//! Boards: of the design, and those that are built in.

use sensedsl_board::catalog;

use crate::context::Context;
use crate::wires::escaped;

/// A board of the design: what it is on, and how it talks to its host.
pub(crate) fn board(cx: &Context<'_>, name: &str) -> Option<String> {
    let design = cx.analysis.snapshot.sound()?.design;
    let board = design.boards.iter().find(|one| one.name.value == name)?;
    let mcu = board.mcu.as_deref().unwrap_or("MCU unknown");
    let target = board.profile().map_or("none, pins only", |profile| profile.name.as_str());
    let link = board.link.transport.name();
    let pins = board.table.pins.len();
    let mut text =
        format!("**{}**\n\n{mcu}, {pins} pins; target {target}; link {link}", escaped(name));
    if let Some(facts) = board.facts.as_ref().filter(|_| board.built_in) {
        text.push_str(&format!("\n\n{}: {}", facts.name, escaped(&facts.description)));
    }
    if let Some((design, wiring)) = cx.wired.as_ref().and_then(|wired| wired.wired()) {
        let mut used = wiring.used(design);
        if let Some((on, _)) = used.find(|(_, one)| one.name.value == name) {
            let status = wiring.status.name();
            let devices = on.devices.len();
            text.push_str(&format!(
                "\n\n{devices} devices, opportunity cost {}, {status}",
                on.cost
            ));
        }
    }
    Some(text)
}

/// A built-in board or an MCU part, by the name after `on`.
pub(crate) fn source(name: &str) -> Option<String> {
    let facts = catalog::find(name)?.board().ok()?;
    let (description, pins) =
        (escaped(&facts.description), catalog::find(name)?.table().pins.len());
    let mut text = format!("**{}**\n\n{description}\n\nMCU {}, {pins} pins", facts.name, facts.mcu);
    if !facts.aliases.is_empty() {
        text.push_str(&format!("; also `{}`", facts.aliases.join("`, `")));
    }
    Some(text)
}
