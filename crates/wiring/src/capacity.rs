//! Capacity: what can still be added to a wiring, and what blocks the next device.
//!
//! The existing devices keep their wires (or may be rearranged, if asked for); further devices of
//! only one kind are added until there is no wiring.

use sensedsl_diagnostics::Span;
use sensedsl_model::design::{
    BoardIndex, Bounds, Connection, ConnectionIndex, Design, Device, DeviceIndex, Part, PartIndex,
    PinRef, Placement, Presentation, Spanned,
};
use sensedsl_model::kind::{Kind, KindName, Sharing};
use sensedsl_model::protocol::{Coding, Filter};
use sensedsl_wire::{Direction, ScalarType, ValueType};

use crate::Cancel;
use crate::answers::{Found, Solved};
use crate::assignment::Assignment;
use crate::wiring::Wiring;

/// The number of identifiers for devices.
const DEVICES_MAX: usize = 254;
/// 7-bit addresses that the I2C specification leaves to devices.
const ADDRESSES: std::ops::RangeInclusive<u8> = 0x08..=0x77;

/// The number of devices of one kind that still fit on one board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// The board.
    pub board: BoardIndex,
    /// The kind.
    pub kind: KindName,
    /// How many further devices of that kind fit, with none of other kinds.
    pub more: usize,
    /// Pins and resources that the next one lacks.
    pub blocked_by: Vec<String>,
}

/// The capacities of every board for every kind, in order; only the first of them if time runs out.
#[must_use]
pub fn capacity(
    design: &Design,
    wiring: &Assignment,
    rearrange: bool,
    cancel: Cancel<'_>,
) -> Found<Capacity> {
    let mut base = design.clone();
    if !rearrange {
        fix(&mut base, wiring);
    }
    let mut all = Vec::new();
    for board in (0..design.boards.len()).map(BoardIndex) {
        for kind in KindName::wired() {
            let one = of_kind(&base, board, kind, cancel);
            // The number on which time ran out may be too low.
            if cancel.is_over() {
                return Found { all, complete: false };
            }
            all.push(one);
        }
    }
    Found { all, complete: true }
}

/// Fixes every device where the wiring has it.
fn fix(design: &mut Design, wiring: &Assignment) {
    let boards = design.boards.clone();
    for on in &wiring.boards {
        let Some(board) = boards.get(on.board.0) else { continue };
        for one in &on.connections {
            let Some(wires) = design.connections.get_mut(one.connection.0) else { continue };
            let part = design.parts.get_mut(wires.part.0);
            let Some(part) = part else { continue };
            let span = part.name.span;
            part.board = Some(on.board);
            wires.board = Some(on.board);
            wires.placement.pins = one
                .wires
                .iter()
                .filter_map(|wire| {
                    let value = PinRef::of_board(on.board, wire.pin(board)?.name.clone());
                    Some((wire.role, Spanned { value, span }))
                })
                .collect();
            // The converter is chosen after the wiring and may change when devices are added.
            if !wires.kind.is_sampled() {
                wires.placement.unit = one.unit.clone().map(|value| Spanned { value, span });
            }
        }
    }
}

fn of_kind(base: &Design, board: BoardIndex, kind: KindName, cancel: Cancel<'_>) -> Capacity {
    let room = DEVICES_MAX.saturating_sub(base.devices.len());
    let (limit, unbounded) = match kind.spec().sharing {
        Sharing::Own | Sharing::BusAndSelect => (room, false),
        // A shared bus carries any number of devices as soon as it carries one.
        Sharing::Bus => (room, true),
        Sharing::Addresses => (room.min(free_addresses(base).len()), true),
    };
    let most = if unbounded { limit.min(1) } else { limit };
    let (mut fits, mut too_many) = (0, most + 1);
    let mut step = 1;
    while fits < most && fits + step < too_many {
        if has_wiring(&with(base, board, kind, fits + step), cancel) {
            fits += step;
            step *= 2;
        } else {
            too_many = fits + step;
            step = 1;
        }
        step = step.min(most.saturating_sub(fits).max(1));
    }
    if unbounded && fits == 1 {
        return Capacity { board, kind, more: limit, blocked_by: beyond(kind, limit == room) };
    }
    let blocked_by = if fits == limit {
        beyond(kind, true)
    } else {
        blockers(&with(base, board, kind, fits + 1), kind, cancel)
    };
    Capacity { board, kind, more: fits, blocked_by }
}

fn beyond(kind: KindName, by_identifiers: bool) -> Vec<String> {
    let has_addresses = kind.spec().sharing == Sharing::Addresses;
    let what = if by_identifiers || !has_addresses { "id" } else { "address" };
    vec![what.to_owned()]
}

fn has_wiring(design: &Design, cancel: Cancel<'_>) -> bool {
    let wiring = Wiring::within(design, None, cancel);
    !wiring.is_impossible() && matches!(wiring.solve_only(true), Solved::Wired(_))
}

fn blockers(design: &Design, kind: KindName, cancel: Cancel<'_>) -> Vec<String> {
    match Wiring::within(design, None, cancel).solve_only(true) {
        Solved::Infeasible(conflict) if conflict.resources.is_empty() => {
            vec![format!("no free {} pin", kind.name())]
        }
        Solved::Infeasible(conflict) => {
            conflict.resources.into_iter().map(|one| one.name).collect()
        }
        Solved::Wired(_) | Solved::Failed(_) => Vec::new(),
    }
}

/// The design with `count` further devices of a kind on a board.
fn with(base: &Design, board: BoardIndex, kind: KindName, count: usize) -> Design {
    let mut design = base.clone();
    let addresses = free_addresses(base);
    let span = design.boards.first().map(|board| board.name.span);
    let span = span.unwrap_or_else(|| Span::new(design.file, 0..0));
    for number in 0..count {
        let address = addresses.get(number).copied().unwrap_or_default();
        add(&mut design, board, (kind, number, address), span);
    }
    design
}

/// Adds a device with only its kind.
fn add(
    design: &mut Design,
    board: BoardIndex,
    (kind, number, address): (KindName, usize, u8),
    span: Span,
) {
    let direction = kind.spec().directions.first().copied().unwrap_or(Direction::Sensor);
    let (part, name) =
        (PartIndex(design.parts.len()), Spanned { value: format!("further {}", number + 1), span });
    let device = DeviceIndex(design.devices.len());
    let connections = vec![ConnectionIndex(design.connections.len())];
    let kind = Kind::plain(kind, address);
    let (wishes, placement) = (Vec::new(), Placement::default());
    design.connections.push(Connection {
        part,
        name: None,
        element: None,
        device,
        kind: kind.clone(),
        direction,
        board: Some(board),
        placement,
        wishes,
        level: None,
    });
    design.devices.push(Device {
        part,
        name: name.clone(),
        block: span,
        id: Spanned { value: 0, span },
        direction,
        value: Spanned { value: ValueType::scalar(ScalarType::Uint16), span },
        kind,
        kind_span: span,
        delay_ms: 1_000,
        delay_span: None,
        prio: 0,
        prio_span: None,
        group: None,
        shown: Presentation::default(),
        coding: Coding::default(),
        filter: Filter::default(),
        connections,
    });
    let board = Some(board);
    design.parts.push(Part {
        name,
        block: span,
        board,
        driver: None,
        allows: Vec::new(),
        chip: None,
        bounds: Bounds::default(),
        module: None,
    });
}

fn free_addresses(design: &Design) -> Vec<u8> {
    let used = |address: &u8| {
        design
            .connections
            .iter()
            .filter_map(|one| one.kind.register_access()?.address)
            .any(|other| other == *address)
    };
    ADDRESSES.filter(|address| !used(address)).collect()
}
