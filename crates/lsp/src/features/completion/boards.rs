//! Boards: those that are built in, and the MCU parts.

use std::sync::OnceLock;

use sensedsl_board::catalog;
use serde_json::json;

use super::item::Item;
use crate::features::hover;
use crate::protocol::completion::{CLASS, MODULE};

/// What a board is, in Markdown.
pub(super) fn page(name: &str) -> Option<String> {
    hover::board(name)
}

/// What an MCU part is, in Markdown.
pub(super) fn mcu(name: &str) -> Option<String> {
    let found = sensedsl_parts::find(name)?;
    let part = found.parts.first()?;
    let cores: Vec<&str> = part.cores().collect();
    let flash = part.flash_bytes().map(|bytes| format!(", {} KiB flash", bytes / 1_024));
    let numbers: Vec<String> = part.numbers().collect();
    Some(format!(
        "**{}**\n\n{} in {}, {} pins of its ports, {} KiB RAM{}\n\nAlso `{}`",
        part.name(),
        cores.join(" + "),
        part.package().unwrap_or("an unknown package"),
        found.sheet.pins().count(),
        part.ram_bytes() / 1_024,
        flash.unwrap_or_default(),
        numbers.join("`, `")
    ))
}

/// The built-in boards, named as the language has them.
fn boards() -> Vec<Item> {
    let all = catalog::all().iter();
    all.map(|entry| {
        let aliases = entry.aliases.iter().copied().chain([entry.name, entry.mcu]);
        Item::new(entry.name.replace('-', "_"), CLASS)
            .detail(format!("{}, {}", entry.mcu, entry.description))
            .words(aliases)
            .data(json!({ "board": entry.name }))
            .rank(10)
    })
    .collect()
}

/// The names of a board that is built in.
pub(super) fn names() -> Vec<Item> {
    static ALL: OnceLock<Vec<Item>> = OnceLock::new();
    ALL.get_or_init(boards).clone()
}

/// What may stand after `on`.
pub(super) fn sources() -> Vec<Item> {
    static ALL: OnceLock<Vec<Item>> = OnceLock::new();
    let make = || {
        let mut items = boards();
        items.extend(sensedsl_parts::all().map(|part| {
            let cores: Vec<&str> = part.cores().collect();
            let package = part.package().unwrap_or("package unknown");
            let kib = part.ram_bytes() / 1_024;
            Item::new(part.name().replace('-', "_"), MODULE)
                .detail(format!("MCU, {}, {package}, {kib} KiB RAM", cores.join(" + ")))
                .data(json!({ "mcu": part.name() }))
                .rank(20)
        }));
        items
    };
    ALL.get_or_init(make).clone()
}
