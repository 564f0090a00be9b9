//! The crates `teensy4-pins` and `imxrt-iomuxc`. In: the table of functions in the comments of the first, the
//! converters' inputs of the second. Out: the pads of i.MX RT1062 that the boards Teensy 4.0 and 4.1 lead out.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use sensedsl_board::table::ROUTED;

use super::metapac::{Pins, between};
use super::sources::text;

/// The usages of the pads.
pub(crate) fn read(teensy: &Path, iomuxc: &Path) -> Result<Pins> {
    let mut pins = Pins::new();
    for file in ["common.rs", "t40.rs", "t41.rs"] {
        for line in text(&teensy.join(file))?.lines() {
            let Some(row) = line.strip_prefix("//! |") else { continue };
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            let [_, pad, functions @ .., _] = cells.as_slice() else { continue };
            if !pad.starts_with("GPIO_") {
                continue;
            }
            let usages: &mut BTreeSet<_> = pins.entry((*pad).to_owned()).or_default();
            for (number, name) in (0..).zip(functions) {
                usages.extend(usage(name).map(|usage| (usage, Some(number))));
            }
            // The crossbar leads its pads to the decoders.
            if functions.iter().any(|name| name.starts_with("XBAR1_INOUT")) {
                let lines = (1..=4).flat_map(|unit| [(unit, "A"), (unit, "B")]);
                let routed = lines.map(|(unit, line)| format!("{ROUTED}ENC{unit}_{line}"));
                usages.extend(routed.map(|name| (name, None)));
            }
        }
    }
    for line in text(&iomuxc.join("imxrt1060/adc.rs"))?.lines() {
        let Some(call) = between(line, "adc!(", ");") else { continue };
        let field = |name: &str| {
            let mut fields = call.split(", ");
            fields.find_map(|field| field.strip_prefix(name)).context("half an input")
        };
        let (unit, pad, input) = (field("module: ")?, field("pad: ")?, field("input: ")?);
        // Pads that no board leads out are left out.
        if let Some(usages) = pins.get_mut(pad) {
            usages.insert((format!("ADC{unit}_IN{input}"), None));
        }
    }
    ensure!(pins.len() >= 50, "{} pads", pins.len());
    Ok(pins)
}

/// The usage for a function, with `FLEXPWM4_PWMA2` for `FLEXPWM4_PWMA02`: numbers have no leading zero.
fn usage(name: &str) -> Option<String> {
    if name == "---" || name.starts_with("GPIO") || name.starts_with("XBAR1_INOUT") {
        return None;
    }
    let output = name.strip_prefix("FLEXPWM").and_then(|rest| rest.split_once('0'));
    Some(
        output.map_or_else(|| name.to_owned(), |(start, number)| format!("FLEXPWM{start}{number}")),
    )
}
