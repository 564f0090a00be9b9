//! The frames of CAN buses: which bits each value has, which frame a selector means, and reports of
//! what is impossible.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{
    e0211_out_of_range, e0212_unknown_word, e0222_contradiction, e0237_overlap_in_frame,
    e0238_frame_clash, e0239_outside_frame, w0614_several_repeated,
};
use sensedsl_diagnostics::{Diagnostic, nearest};
use sensedsl_wire::Direction;

use crate::design::{BoardIndex, Design, Device, PartIndex};
use crate::kind::Kind;
use crate::kind::can::{Can, Mux};
use crate::part::words::Words;

/// The bits of a frame that count, and their contents; byte 0 of the frame is the lowest.
type Bits = (u64, u64);

/// What identifies frames: board, bit rate, identifier, whether it has 29 bits.
type Identifier = (Option<BoardIndex>, u32, u32, bool);

/// Resolves selectors, and reports what is impossible.
pub(crate) fn settle(design: &mut Design, diagnostics: &mut Vec<Diagnostic>) {
    let mut frames: BTreeMap<Identifier, Vec<usize>> = BTreeMap::new();
    for (index, device) in design.devices.iter().enumerate() {
        let Some(can) = device.kind.can() else { continue };
        diagnostics.extend(outside(device, can));
        let board = design.part(device.part).and_then(|part| part.board);
        let identifier = (board, can.bitrate_hz, can.frame_id, can.is_extended);
        frames.entry(identifier).or_default().push(index);
    }
    for devices in frames.values() {
        select(design, devices, diagnostics);
        let own = || devices.iter().filter_map(|index| design.devices.get(*index));
        let sent: Vec<&Device> = own().filter(|one| one.direction == Direction::Actuator).collect();
        let received = own().find(|one| one.direction == Direction::Sensor);
        if let (Some(one), Some(other)) = (sent.first(), received) {
            let frame = one.kind.can().map(Can::shown).unwrap_or_default();
            let (name, from) = (&one.name.value, &other.name.value);
            let clash = e0238_frame_clash::frame_clash;
            diagnostics.push(clash(one.name.span, name, &frame, from, other.name.span));
        }
        overlap(&sent, diagnostics);
    }
    repeated(design, diagnostics);
    for device in &design.devices {
        diagnostics.extend(slower_link(design, device));
    }
}

/// Reports a frame that is to be repeated more often than the link's `rate` lets the board check
/// it.
fn slower_link(design: &Design, device: &Device) -> Option<Diagnostic> {
    let resend_ms = device.kind.resend_ms();
    let board = design.board(design.part(device.part)?.board?)?;
    let cycle_ms = board.link.report_ms()?;
    let message = format!(
        "{} repeats its frame every {resend_ms} ms, and the link's `rate` lets the board look every {cycle_ms} ms",
        device.name.value
    );
    let (at, other) = (device.name.span, board.name.span);
    let help = format!(
        "leave `rate` out, or let it be at least {} Hz",
        1_000_u32.div_ceil(resend_ms.max(1))
    );
    (resend_ms > 0 && cycle_ms > resend_ms).then(|| {
        e0222_contradiction::contradiction(at, &message, other, "its link has the `rate`", &help)
    })
}

/// Reports a value that ends after its frame.
fn outside(device: &Device, can: &Can) -> Option<Diagnostic> {
    let end = u16::from(can.byte).saturating_add(Words::of(device)?.wire_bytes());
    let (at, name) = (device.name.span, &device.name.value);
    (end > u16::from(can.room())).then(|| {
        let unit = if end == 1 { "byte" } else { "bytes" };
        e0239_outside_frame::outside_frame(at, name, &format!("{end} {unit}"), can.room())
    })
}

/// Finds the bits that tell which of the frames of an identifier holds a value.
fn select(design: &mut Design, devices: &[usize], diagnostics: &mut Vec<Diagnostic>) {
    let mut found: Vec<(usize, Bits)> = Vec::new();
    for index in devices {
        let Some(device) = design.devices.get(*index) else { continue };
        let Some(mux) = device.kind.can().and_then(|can| can.mux.as_ref()) else { continue };
        let others = devices.iter().filter(|other| *other != index);
        let others: Vec<&Device> = others
            .filter_map(|other| design.devices.get(*other))
            .filter(|other| other.direction == device.direction)
            .filter(|other| other.kind.can().is_some_and(|can| can.mux.is_none()))
            .collect();
        match selected(device, mux, &others) {
            Ok(bits) => found.push((*index, bits)),
            Err(report) => diagnostics.push(*report),
        }
    }
    for (index, bits) in found {
        let device = design.devices.get_mut(index);
        if let Some(Kind::Can(Can { mux: Some(mux), .. })) = device.map(|device| &mut device.kind) {
            mux.bits = Some(bits);
        }
    }
}

/// The bits of the selector, and their contents.
fn selected(device: &Device, mux: &Mux, others: &[&Device]) -> Result<Bits, Box<Diagnostic>> {
    let Mux { selector, value, .. } = mux;
    let is_it = |other: &&&Device| {
        let of_part = other.part == device.part && other.coding.reading.is_some();
        other.name.value == selector.value
            || of_part && other.coding.reading.as_ref() == Some(&selector.value)
    };
    let Some(other) = others.iter().find(is_it) else {
        let names: Vec<&str> = others.iter().map(|other| other.name.value.as_str()).collect();
        let meant = nearest(&selector.value, names.iter().copied());
        let list = if names.is_empty() {
            "another value of the same frame, of which there is none yet".to_owned()
        } else {
            names.join(", ")
        };
        let unknown = e0212_unknown_word::unknown_word;
        return Err(unknown(selector.span, "mux", &selector.value, &list, meant).into());
    };
    let place = other.kind.can().zip(Words::of(other));
    let bits = place.as_ref().and_then(|(can, words)| {
        Some((words.in_frame(can.byte), words.placed(can.byte, value.value)?))
    });
    bits.ok_or_else(|| {
        let bits = place.map_or(0, |(_, words)| words.bits);
        let most = if bits >= 64 { u64::MAX } else { (1 << bits) - 1 };
        let range = format!("0 to {most}, which {} can be", other.name.value);
        let found = value.value.to_string();
        e0211_out_of_range::out_of_range(value.span, "mux", &found, &range).into()
    })
}

/// Reports commands that take the same bits of a frame.
fn overlap(sent: &[&Device], diagnostics: &mut Vec<Diagnostic>) {
    let bits = |device: &Device| {
        let can = device.kind.can()?;
        Some((Words::of(device)?.in_frame(can.byte), can.select()))
    };
    let mut before: Vec<(&Device, u64, Option<Bits>)> = Vec::new();
    for device in sent {
        let Some((own, selected)) = bits(device) else { continue };
        let is_beside = |of: &Option<Bits>| match (of, &selected) {
            (Some((mask, one)), Some((other, another))) => mask == other && one != another,
            (_, _) => false,
        };
        let clash = before.iter().find(|(_, bits, of)| bits & own != 0 && !is_beside(of));
        if let Some((other, ..)) = clash {
            let frame = device.kind.can().map(Can::shown).unwrap_or_default();
            let (name, from) = (&device.name.value, &other.name.value);
            let report = e0237_overlap_in_frame::overlap_in_frame;
            diagnostics.push(report(device.name.span, name, from, other.name.span, &frame));
        }
        before.push((device, own, selected));
    }
}

/// Reports chips with several repeated frames.
fn repeated(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    let mut parts: BTreeMap<PartIndex, Vec<&Device>> = BTreeMap::new();
    for device in &design.devices {
        let is_on_can = device.kind.can().is_some();
        if is_on_can && device.coding.reading.is_some() && device.kind.resend_ms() > 0 {
            parts.entry(device.part).or_default().push(device);
        }
    }
    for (index, devices) in parts {
        let frame = |device: &&Device| device.kind.can().map(|can| (can.frame_id, can.is_extended));
        let is_one = devices.iter().all(|one| frame(one) == devices.first().and_then(frame));
        let Some(part) = design.part(index).filter(|_| !is_one) else { continue };
        let names: Vec<&str> = devices.iter().map(|one| one.name.value.as_str()).collect();
        let report = w0614_several_repeated::several_repeated;
        diagnostics.push(report(part.name.span, &part.name.value, &names.join(", ")));
    }
}
